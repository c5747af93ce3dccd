// Pass Final of the pyramid: one look-up of what all levels have added up to, and the first Gaussian at the pixel itself: light that enters
// there, its shadow filtered as widely as that Gaussian. The rest of the colour, specular reflection.
#ifndef TEGUMENT_PASSES_PYRAMID_FINAL_FXH
#define TEGUMENT_PASSES_PYRAMID_FINAL_FXH

// No more than what cannot be had from it again: 12 numbers to interpolate.
struct FinalVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 world : TEXCOORD1; // world units
    float3 normal : TEXCOORD2;
    float4 tangent : TEXCOORD3;
};

FinalVarying PyramidFinalVS(TgVertexInput stored)
{
    SurfaceVarying surface = SurfaceVS(stored);
    FinalVarying output;
    output.position = surface.position;
    output.uv = surface.uv;
    output.world = surface.world;
    output.normal = surface.normal;
    output.tangent = surface.tangent;
    return output;
}

// normal: with the normal map; colour: of the colour map.
LitPoint finalPoint(FinalVarying input, float3 normal, float4 colour)
{
    SurfaceVarying surface;
    surface.position = input.position;
    surface.uv = input.uv;
    surface.world = input.world;
    surface.normal = input.normal;
    surface.tangent = input.tangent;
    surface.lightClip = mul(float4(input.world, 1.0), gLightViewProjection);
    LitPoint p = surfacePoint(surface, normal);
    p.albedo = colour.rgb;
    p.scatters = colour.a;
    p.depth = planarDepth(surface.lightClip, input.world);
    p.footprint = tgShadowFootprint(surface.lightClip.w, tgLightSpread());
    return p;
}

// facet: the normal of the receiver's plane.
float finalShadow(LitPoint p, float3 facet)
{
    float lit = 0.0;
    [branch] if (facesLight(p))
    {
        float own = tgShadowPlanarHorizon(dot(p.meshNormal, p.toLight));
        float2 slope = tgShadowPlanarSlope(facet, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint);
        float bend = facetBend(p, slope);
        p.meshNormal = facet;
        bool plain = p.scatters < 0.5; // no level softens its shadows: its filter is some texels of the shadow map wide
        bool wide = plain || p.footprint < kTgNarrowTexel;
        float apart = plain ? max(kEntryTaps.x * p.footprint, kTgNarrowStep) : kTgNarrowStep;
        PlanarPlace at = planarPlace(p, slope, kTgPlanarTexel);
        TgShadowTaps taps = tgShadowTapsOnPlane(slope, facet, p.axisX, p.axisY, tgLightRays(), p.footprint, apart);
        if (!wide)
            taps = tgShadowTapsOfTexels(at.uv);
        lit = own * tgShadowTapped(TG_SAMPLER2D_ARG(gShadow), at.uv, at.depth - bend, slope, taps);
        lit = ownVisibility(p.world, p.meshNormal, lit);
    }
    return lit;
}

// Of the light that enters at the pixel.
float3 ownWeight(float4 wide)
{
    return wide.w < 0.0 ? linkedWeight(0.0, -wide.w) : ladderWeight(0.0, wide.w);
}

float4 finalColour(FinalVarying input, LitPoint p, float3 facet)
{
    p.shadow = finalShadow(p, facet) * skinOpen(input.world);
    float4 wide = tex2Dlod(gLight0, float4(input.uv, 0.0, 0.0));
    float3 diffused = max(enteringHere(p) * ownWeight(wide) + wide.rgb, 0.0);
    float3 toEye = tgSafeNormalize(gCameraPosition - input.world);
    float3 skin = diffused * tgIrradianceColour(p.albedo, 1.0 - gMix) * diffuseShare(dot(p.normal, toEye));
    float3 plain = plainLight(p);
    return float4(lerp(plain, skin, p.scatters) + mirroredLight(p, toEye), 1.0);
}

LitPoint texturedPoint(FinalVarying input)
{
    float3 texel = tex2D(gNormal, input.uv).xyz;
    LitPoint p = finalPoint(input, tgSurfaceNormal(input.normal, input.tangent, texel), tex2D(gSkin, input.uv));
    LOBES_AT(p, texel)
    return p;
}

float4 PyramidFinalPS(FinalVarying input) : SV_Target0
{
    LitPoint p = texturedPoint(input);
    return finalColour(input, p, facetNormal(p, ddx(input.world), ddy(input.world)));
}

#if TEGUMENT_LIGHT_BY_LIGHT
LitShare PyramidShare(FinalVarying input)
{
    return skinShare(texturedPoint(input), ownWeight(tex2Dlod(gLight0, float4(input.uv, 0.0, 0.0))));
}
#endif
LIGHTS(Pyramid, FinalVarying)

#define PYRAMID_FINAL_SCRIPT "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Final;" LIGHTS_SCRIPT("Pyramid")
#define PYRAMID_FINAL_PASS \
    TG_MESH_PASS(Final, PyramidFinalVS, PyramidFinalPS, TG_STATE_SOLID) \
    LIGHTS_PASSES(Pyramid, PyramidFinalVS)

#endif
// SPDX-License-Identifier: MIT
