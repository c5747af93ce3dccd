// What the lit passes of d'Eon and Luebke's technique know besides: colour, shadow and entry of light by the translucent shadow map,
// energy.
#ifndef TEGUMENT_PASSES_SKIN_POINT_FXH
#define TEGUMENT_PASSES_SKIN_POINT_FXH

Texture2D gEnergyAttenuationMap < string Producer = "EnergyAttenuation.fx/gEnergyAttenuationMap";
    string ResourceName = "energy_attenuation.dds"; >;
TG_SAMPLER2D(gEnergyAttenuation, LINEAR, CLAMP);

// Techniques begin with OWN_SHADOW_SCRIPT and OWN_SHADOW_PASS, which are empty where the translucent shadow map serves as the shadow map.
#if TEGUMENT_SHADOW_FROM_TSM
#define OWN_SHADOW_SCRIPT ""
#define OWN_SHADOW_PASS
#else
#define OWN_SHADOW_SCRIPT SHADOW_MAP_SCRIPT
#define OWN_SHADOW_PASS SHADOW_MAP_PASS
#endif

// Without shadow.
LitPoint colouredPoint(SurfaceVarying input)
{
    LitPoint p = surfacePoint(input);
    float4 colour = tex2D(gSkin, input.uv);
    p.albedo = colour.rgb;
    p.scatters = colour.a;
    return p;
}

LitPoint litPoint(SurfaceVarying input)
{
    LitPoint p = colouredPoint(input);
    // Where the surface turns away from the light, no map need say so.
    p.shadow = 0.0;
    [branch] if (tgShadowHorizon(dot(p.meshNormal, p.toLight)) > 0.0)
    {
#if TEGUMENT_SHADOW_FROM_TSM
        p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gTsm), p);
#else
        p.shadow = surfaceShadow(TG_SAMPLER2D_ARG(gShadow), p);
#endif
    }
    return p;
}

// Where the light entered on its way to this point: u, v, and the way through the body (mm, or z/w); w = 0 where there is no such place. At
// the outline seen from the light a texel may hold a surface behind this one.
float4 lightEntry(LitPoint p)
{
    float4 texel = tgTsmEntry(TG_SAMPLER2D_ARG(gTsm), p.lightUv);
    float path = p.depth - texel.x;
    return float4(texel.yz, max(path, 0.0), path > -gShadowTolerance ? texel.w : 0.0);
}

#endif
// SPDX-License-Identifier: MIT
