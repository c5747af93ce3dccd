// Group scatter: light in texture space, its convolution by Gaussians and by Poisson discs, seams, transmission. About the paths see surface.fxh.
#include "../hlsl/settings.fxh"
#include "../hlsl/surface.fxh"
#include "../hlsl/scatter/irradiance.fxh"
#include "../hlsl/scatter/seam.fxh"
#include "../hlsl/scatter/gaussian.fxh"
#include "../hlsl/scatter/poisson.fxh"
#include "../hlsl/scatter/transmission.fxh"
