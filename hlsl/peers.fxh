// Group peers: other people's diffusion, to compare with. About the paths see surface.fxh. Effects in effects/peers include the files one by one.
#include "../hlsl/settings.fxh"
#include "../hlsl/surface.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/peers/screen.fxh"
#include "../hlsl/peers/separable.fxh"
#include "../hlsl/peers/burley.fxh"
#include "../hlsl/peers/preintegrated.fxh"
#include "../hlsl/peers/penumbra.fxh"
