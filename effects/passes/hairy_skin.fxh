// Skin below hair: strands take light from it, as they take it from each other (fur_opacity.fxh).
#ifndef TEGUMENT_PASSES_HAIRY_SKIN_FXH
#define TEGUMENT_PASSES_HAIRY_SKIN_FXH

// What hair leaves of the light to the skin at a point of the world.
float skinOpen(float3 world)
{
    float2 place = tgShadowCoordinate(mul(float4(world, 1.0), gLightViewProjection));
    float4 sums = tex2Dlod(gCoatOpacity, float4(place, 0.0, log2(kCoatSoft)));
    return exp(-gCoatShadow * tgFurOpacity(sums, kCoatLayers, coatDepth(place, furFromLight(world)) - kCoatOwn));
}

#endif
// SPDX-License-Identifier: MIT
