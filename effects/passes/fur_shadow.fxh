// Passes HullFront, HullBack: the shadow that a coat throws on other parts of the mesh. The coat counts as full up to gFurShadowHeight;
// this hull is drawn from the light, its nearest side that faces the light and its nearest side that turns away. Between them light passes
// so much of the coat before it comes out behind. A point that it has not come out before is in this coat, whose own shadow is
// tgFurTransmittance: only what is more than that counts.
#ifndef TEGUMENT_PASSES_FUR_SHADOW_FXH
#define TEGUMENT_PASSES_FUR_SHADOW_FXH

Texture2D gHullFrontMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_SHADOW_SIZE, "R32F") >;
Texture2D gHullMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_SHADOW_SIZE, "G32R32F") >;
TG_SAMPLER2D(gHullFront, POINT, CLAMP);
TG_SAMPLER2D(gHull, POINT, CLAMP);

// Runs the passes if gFurShadow is 1. The map they fill is cleared in any case: 0 is no hull.
#define HULL_SCRIPT \
    "RenderColorTarget0=gHullMap; RenderDepthStencilTarget=gShadowDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color;" \
    "LoopByCount=gFurShadow; RenderColorTarget0=gHullFrontMap; Clear=Color; Clear=Depth; Pass=HullFront;" \
    "RenderColorTarget0=gHullMap; Clear=Depth; Pass=HullBack; LoopEnd;"
#define HULL_PASSES \
    TG_MESH_PASS(HullFront, HullVS, HullFrontPS, TG_STATE_TWOSIDED) \
    TG_MESH_PASS(HullBack, HullVS, HullBackPS, TG_STATE_TWOSIDED)

FurVarying HullVS(TgVertexInput input)
{
    FurVarying output = furVarying(input, float2(gFurShadowHeight, 1.0), kFurNear);
    float4 position = output.lightClip;
    position.z = tgFurNearDepth(position.z, position.w);
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    return output;
}

float4 HullFrontPS(FurVarying input) : SV_Target0
{
    return float4(furFromLight(input.world), 0.0, 0.0, 1.0);
}

// Distance from the light, and mm of coat before it.
float4 HullBackPS(FurVarying input) : SV_Target0
{
    clip(-dot(tgWorldNormal(input.normal), tgLightDirection(input.world)));
    float distance = furFromLight(input.world);
    float front = tex2Dlod(gHullFront, float4(tgShadowCoordinate(input.lightClip), 0.0, 0.0)).x;
    return float4(distance, max(distance - front, 0.0), 0.0, 1.0);
}

// Share of the light that comes through the coat of other parts. What stands above the hull may be behind its own.
float furHullShadow(FurVarying input)
{
    float2 hull = tex2Dlod(gHull, float4(tgShadowCoordinate(input.lightClip), 0.0, 0.0)).xy;
    float thickness = tgMillimetres(gFurLength * gMeshRadius);
    float place = furFromLight(input.world) - max(furHeight(input) - gFurShadowHeight, 0.0) * thickness;
    float own = tgFurWay(furHeight(input), dot(tgWorldNormal(input.normal), tgLightDirection(input.world)), gFurLength);
    float foreign = tgFurForeignCoat(place, hull.x - hull.y, hull.x, own, thickness);
    return hull.x > 0.0 ? exp(-gFurDensity * gFurShadow * foreign) : 1.0;
}

float4 CoatedSkinPS(FurVarying input) : SV_Target0
{
    return float4(furRadiance(input, furAlbedo(input), 0.0, furHullShadow(input)), 1.0);
}

#endif
// SPDX-License-Identifier: MIT
