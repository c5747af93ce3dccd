// The maps of a pyramid: gEntry0Map to gEntry6Map, light that enters times coverage, and gLight0Map to gLight6Map, what each level and all
// that are coarser make of it. Each has half the texels of the one before along a side.
#ifndef TEGUMENT_PASSES_PYRAMID_MAPS_FXH
#define TEGUMENT_PASSES_PYRAMID_MAPS_FXH

#define PYRAMID_SIZE(share) ((TEGUMENT_MAP_SIZE + share - 1) / share)
#define PYRAMID_MAPS(level, share) \
Texture2D gEntry##level##Map : RENDERCOLORTARGET < SQUARE_TARGET(PYRAMID_SIZE(share), "A16B16G16R16F") >; \
Texture2D gLight##level##Map : RENDERCOLORTARGET < SQUARE_TARGET(PYRAMID_SIZE(share), "A16B16G16R16F") bool Keeps = true; >; \
TG_SAMPLER2D(gEntry##level, LINEAR, CLAMP); \
TG_SAMPLER2D(gLight##level, LINEAR, CLAMP); \
static const float kPyramidSize##level = PYRAMID_SIZE(share);

PYRAMID_MAPS(0, 1)
PYRAMID_MAPS(1, 2)
PYRAMID_MAPS(2, 4)
PYRAMID_MAPS(3, 8)
PYRAMID_MAPS(4, 16)
PYRAMID_MAPS(5, 32)
PYRAMID_MAPS(6, 64)

Texture2D gLadderMap < string Producer = "Ladder.fx/gLadderMap"; string ResourceName = "ladder.dds"; >;
TG_SAMPLER2D(gLadder, LINEAR, CLAMP);

// Weight (RGB) of a step of the ladder; row: counted over all profiles.
float3 ladderWeight(float row, float density)
{
    return tex2Dlod(gLadder, float4(tgLadderCoordinate(row, density), 0.0, 0.0)).rgb;
}

#endif
// SPDX-License-Identifier: MIT
