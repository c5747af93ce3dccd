// Group fur roots: what strands need that grow on the surface itself: the lattice, cones, and the ray's way through them. About the paths see surface.fxh.
#include "../hlsl/fur.fxh"
#include "../hlsl/fur/cells.fxh"
#include "../hlsl/fur/cones.fxh"
#include "../hlsl/fur/roots.fxh"
#include "../hlsl/fur/sweep.fxh"
