#include "INC\Common.FXH"
