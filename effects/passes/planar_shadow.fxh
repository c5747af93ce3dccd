// Pass ShadowMap, with distances to the plane through the light: one number to interpolate (hlsl/shadow/planar.fxh).
#ifndef TEGUMENT_PASSES_PLANAR_SHADOW_FXH
#define TEGUMENT_PASSES_PLANAR_SHADOW_FXH

#define PLANAR_SHADOW_PASS TG_MESH_PASS(ShadowMap, PlanarShadowVS, PlanarShadowPS, TG_STATE_TWOSIDED)

struct PlanarVarying
{
    float4 position : SV_Position;
    float depth : TEXCOORD0; // mm
};

// The bound below keeps 0, which is nothing, apart from what touches the light.
PlanarVarying PlanarShadowVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    PlanarVarying output;
    float3 world = tgWorldPosition(input.position);
    output.position = TG_HALF_PIXEL(mul(float4(world, 1.0), gLightViewProjection), gViewportSize);
    output.depth = -dot(tgMillimetres(tgLightVector(world)), tgLightRays());
    return output;
}

float4 PlanarShadowPS(PlanarVarying input) : SV_Target0
{
    return float4(input.depth, 0.0, 0.0, 1.0);
}

// Place in the map, and distance there.
float planarDepth(float4 lightClip, float3 world)
{
    return tgShadowPlanarDepth(lightClip, tgMillimetres(tgLightVector(world)), tgLightRays());
}

float planarTolerance()
{
    return kTgDepthInMillimetres ? gShadowTolerance : gShadowTolerance * tgMillimetres(gLightFar - gLightNear);
}

// Where a point is held against the map, and the distance that it is held to there.
struct PlanarPlace
{
    float2 uv;
    float depth; // less tolerance
};

PlanarPlace planarPlace(LitPoint p, float2 slope, float texels)
{
    PlanarPlace at;
    float2 aside = tgShadowPlanarAside(p.meshNormal, p.toLight, tgLightRays(), slope, texels);
    at.uv = p.lightUv + aside / kTgShadowSize;
    at.depth = p.depth + dot(slope, aside) - planarTolerance() - kTgPlanarFacets * (abs(slope.x) + abs(slope.y));
    return at;
}

// Cosine between a facet and the mesh's normal from which on the two ways lie on one facet.
static const float kOneFacet = 0.7;

// The normal of the facet that a point lies on: shadow maps hold facets, which at grazing light are other planes than the mesh's normals
// say. along, across: two ways on it, world units. Where they lead elsewhere, or the facet turns from the light, it is the mesh's.
float3 facetNormal(LitPoint p, float3 along, float3 across)
{
    float3 facet = tgSafeNormalize(cross(tgMillimetres(along), tgMillimetres(across)));
    facet *= dot(facet, p.meshNormal) < 0.0 ? -1.0 : 1.0;
    return dot(facet, p.meshNormal) > kOneFacet && dot(facet, p.toLight) > 0.0 ? facet : p.meshNormal;
}

// By how much the next facets may stand before this one's plane within a texel, mm: where they are other planes the mesh's normal, which is
// between them, has another slope than this one.
float facetBend(LitPoint p, float2 slope)
{
    float2 meant = tgShadowPlanarSlope(p.meshNormal, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint);
    return dot(abs(slope - meant), 1.0);
}

#endif
// SPDX-License-Identifier: MIT
