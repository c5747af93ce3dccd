// Group shadow: the translucent shadow map. About the paths see surface.fxh.
#include "../hlsl/settings.fxh"
#include "../hlsl/shadow/tsm.fxh"
