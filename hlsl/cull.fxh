// Group cull: which texels the picture needs. About the paths see surface.fxh.
#include "../hlsl/scatter.fxh"
#include "../hlsl/cull/visibility.fxh"
#include "../hlsl/cull/outside.fxh"
#include "../hlsl/printed/outside.fxh"
#include "../hlsl/cull/reach.fxh"
