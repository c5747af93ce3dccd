// expect: 1002_includes_itself.fx(2,2): error TG1002: includes are nested deeper than 64; does '1002_includes_itself.fx' include itself without an include guard?
#include "1002_includes_itself.fx"
