// Group fur: shells, near and afar, the vectors that look up fur maps, the light on strands; strands that grow on the surface itself: the
// lattice or the roots that they stand in, cones, and the ray's way through them. About the paths see surface.fxh.
#include "../hlsl/shadow.fxh"
#include "../hlsl/fur/shell.fxh"
#include "../hlsl/fur/afar.fxh"
#include "../hlsl/fur/mapping.fxh"
#include "../hlsl/fur/lighting.fxh"
#include "../hlsl/fur/cells.fxh"
#include "../hlsl/fur/cones.fxh"
#include "../hlsl/fur/roots.fxh"
#include "../hlsl/fur/ribbons.fxh"
#include "../hlsl/fur/fibre.fxh"
#include "../hlsl/fur/sweep.fxh"
// SPDX-License-Identifier: MIT
