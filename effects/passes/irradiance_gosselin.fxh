// Pass Irradiance of Gosselin's technique: diffuse light without colour into texture space; alpha: the kernel size, at most
// kTgLargestAlpha.
#ifndef TEGUMENT_PASSES_IRRADIANCE_GOSSELIN_FXH
#define TEGUMENT_PASSES_IRRADIANCE_GOSSELIN_FXH

Texture2D gKernelSizeMap : KERNELSIZE < float4 Fallback = { 0.6, 0.6, 0.6, 1.0 }; string UIName = "Kernel size map";
    float UIMax = 0.99; string UIHelp = "1 marks texels without skin: above 0.99 it is read as 0.99"; >;
TG_SAMPLER2D(gKernelSize, LINEAR, CLAMP);

float3 diffuseLight(LitPoint p)
{
    return WITH_MORE_LIGHT(p.light * (saturate(p.cosine) * p.shadow), moreIrradiance(p));
}

// By the last pass.
float3 diffuseHere(LitPoint p)
{
    return WITH_MORE_LIGHT_HERE(p.light * (saturate(p.cosine) * p.shadow), moreIrradiance(p));
}

float4 GosselinIrradiancePS(SurfaceVarying input) : SV_Target0
{
    LitPoint p = surfacePoint(input);
    p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
    float kernel = tex2D(gKernelSize, input.uv).x;
    return float4(tgIrradianceBounded(diffuseLight(p), kTgLargestLight), kernel < kTgLargestAlpha ? kernel : kTgLargestAlpha);
}

#endif
// SPDX-License-Identifier: MIT
