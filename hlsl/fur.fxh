// Group fur: shells, the vectors that look up fur maps, the light on strands. About the paths see surface.fxh.
#include "../hlsl/shadow.fxh"
#include "../hlsl/fur/shell.fxh"
#include "../hlsl/fur/mapping.fxh"
#include "../hlsl/fur/lighting.fxh"
