// Pass Irradiance: light entering the skin, in texture space; alpha: thickness towards the light, or 1 (outside) for what does not scatter.
#ifndef TEGUMENT_PASSES_IRRADIANCE_FXH
#define TEGUMENT_PASSES_IRRADIANCE_FXH

Texture2D gIrradianceMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, TG_SKIN_MAP_FORMAT) >;
TG_SAMPLER2D(gIrradiance, POINT, CLAMP);

// name: of the pass that fills the map, a string. Prepasses that spare texels stand in front of it: UNWRAP_SCRIPT (cull.fxh) instead.
#define IRRADIANCE_SCRIPT(name) \
    "RenderColorTarget0=gIrradianceMap; RenderDepthStencilTarget=; ClearSetColor=gClearInvalid; Clear=Color; Pass=" name ";"

SurfaceVarying IrradianceVS(TgVertexInput input)
{
    SurfaceVarying output = surfaceVarying(input);
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(output.uv, 0.0), gViewportSize);
    return output;
}

// By the normal of the mesh: that of the normal map would punch holes of no thickness into every bump that catches light.
float thicknessTowardsLight(LitPoint p)
{
    float range = kTgDepthInMillimetres ? 1.0 : tgMillimetres(gLightFar - gLightNear);
    float3 litNormal = tgTsmNormal(TG_SAMPLER2D_ARG(gTsm), p.lightUv, p.axisX, p.axisY, p.toLight, p.footprint, range);
    float4 entry = lightEntry(p);
    return entry.w > 0.5 ? tgTransmissionThickness(entry.z, dot(p.meshNormal, p.toLight), p.meshNormal, litNormal) : kTgOpaqueDistance;
}

float4 IrradiancePS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = litPoint(input);
    float alpha = tgTransmissionEncode(thicknessTowardsLight(p));
    return float4(tgIrradianceBounded(enteringLight(p), kTgLargestLight), p.scatters > 0.5 ? alpha : 1.0);
}

#endif
// SPDX-License-Identifier: MIT
