// Group shadow: the translucent shadow map. About the paths see surface.fxh.
#include "../hlsl/surface.fxh"
#include "../hlsl/shadow/tsm.fxh"
