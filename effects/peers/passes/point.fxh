// What the lit passes of the peers share, so that they differ in nothing but diffusion: the light that enters the skin, and the picture
// made of it. As Main.fx has it, with a plain shadow map.
#ifndef TEGUMENT_PEERS_PASSES_POINT_FXH
#define TEGUMENT_PEERS_PASSES_POINT_FXH

// Without shadow.
LitPoint peerPoint(SurfaceVarying input)
{
    LitPoint p = surfacePoint(input);
    float4 colour = tex2D(gSkin, input.uv);
    p.albedo = colour.rgb;
    p.scatters = colour.a;
    return p;
}

// diffused: light under the surface, to be coloured and let out.
float4 peerRadiance(SurfaceVarying input, LitPoint p, float3 diffused)
{
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float3 skin = diffused * tgIrradianceColour(p.albedo, 1.0 - gMix) * diffuseShare(dot(p.normal, toEye));
    float3 plain = plainLight(p);
    return float4(lerp(plain, skin, p.scatters) + mirroredLight(p, toEye), 1.0);
}

#endif
// SPDX-License-Identifier: MIT
