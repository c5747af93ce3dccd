// Passes Entry, Reduce1 to 6 and Light6 to 0: light that enters over the charts, its pyramid, and the levels weighed and added from the
// coarsest to the base. Full-screen passes over the maps of Atlas.fx: no triangle is drawn.
#ifndef TEGUMENT_PASSES_PYRAMID_FXH
#define TEGUMENT_PASSES_PYRAMID_FXH

// Taps of the shadow cover a texel of the base; their distance in texels of the shadow map, from where they still see different ones to
// where they would miss what is between them.
static const float2 kEntryTaps = float2(0.75, 6.0);
// Largest density that half floats hold.
static const float kLargestDensity = 60000.0;
// Texels of the links' map, along a side.
static const float kLinkTexels = 256.0;
// Sides of such a texel, mm: from the first on it is too wide for the fifth Gaussian (1.41 mm), which links then blur by more than its own
// width; at the second all of that Gaussian is the levels'. Where the base has as many texels, quarters of such texels have links of
// their own.
static const float2 kWideTexel = TEGUMENT_MAP_SIZE >= 512 ? float2(5.2, 6.8) : float2(2.6, 3.4);

// Variances (mm^2) of which the two weights of a link still tell the weight (pyramid_links.fxh).
static const float2 kLinkedVariances = float2(1.9, 12.0);

// Variances of the fifth and sixth Gaussian.
float2 linkedVariances()
{
    return float2(gGaussianWeight[4].w, gGaussianWeight[5].w);
}

bool linksBring(float variance)
{
    return variance >= kLinkedVariances.x && variance <= kLinkedVariances.y;
}

// Of a tone the widest alone is, with the variance that links are made for.
bool fifthLinked()
{
    return !toneGiven() && linksBring(linkedVariances().x);
}

bool sixthLinked()
{
    return toneGiven() || linksBring(linkedVariances().y);
}

// Share of the fifth Gaussian that levels bring beside links. density: texels^2 of the base per mm^2.
float fifthByLevels(float density)
{
    float side = TEGUMENT_MAP_SIZE / kLinkTexels * rsqrt(max(density, 1e-4));
    float share = saturate((side - kWideTexel.x) / (kWideTexel.y - kWideTexel.x));
    return fifthLinked() ? share : 1.0;
}

// Weight of a step beside links, with what they leave of the fifth Gaussian.
float3 linkedWeight(float step, float density)
{
    float3 weight = ladderWeight(kTgLadderSteps + step, density);
    float fifth = fifthByLevels(density);
    [branch] if (fifth > 0.0)
        weight += fifth * ladderWeight(3.0 * kTgLadderSteps + step, density);
    return weight;
}

// What a lit pass knows of a texel of the base.
LitPoint entryPoint(float2 uv, float4 albedo, float3 place, float3 normal)
{
    LitPoint p;
    float3 world = tgWorldPosition(place);
    float4 lightClip = mul(float4(world, 1.0), gLightViewProjection);
    p.albedo = albedo.rgb;
    p.scatters = albedo.a;
    p.normal = tgWorldNormal(normal);
    p.meshNormal = tgWorldNormal(tex2Dlod(gAtlasMeshNormal, float4(uv, 0.0, 0.0)).xyz);
    TgLight light = ownLight(world);
    p.world = world;
    p.light = light.color;
    p.toLight = light.toLight;
    p.cosine = dot(p.normal, p.toLight);
    p.shadow = 1.0;
    p.lightUv = tgShadowCoordinate(lightClip);
    p.depth = planarDepth(lightClip, world);
    p.footprint = tgShadowFootprint(lightClip.w, tgLightSpread());
    p.axisX = tgLightRight();
    p.axisY = tgLightUp();
    MORE_LIGHT_AT(p, uv, world)
    LOBES_AT(p, float3(0.5, 0.5, 1.0))
    SHINE_AT(p, uv)
    return p;
}

// Whether light reaches a surface at all, as far as it says itself: where the mesh or its normal map turns away, no map need be asked.
bool facesLight(LitPoint p)
{
    return min(dot(p.meshNormal, p.toLight), p.cosine) > 0.0;
}

// Taps as wide as a texel of the base, or the map's nearest texels where taps would not meet each of them and print its steps; shader
// model 3 has no slots for those beside lamps. facet: the normal of the receiver's plane; density: texels^2 of the base per mm^2.
float entryShadow(LitPoint p, float3 facet, float density)
{
    float lit = 0.0;
    [branch] if (facesLight(p))
    {
        float own = tgShadowPlanarHorizon(dot(p.meshNormal, p.toLight));
        float2 slope = tgShadowPlanarSlope(facet, p.axisX, p.axisY, p.toLight, tgLightRays(), p.footprint);
        float bend = facetBend(p, slope);
        p.meshNormal = facet;
        float apart = clamp(0.25 * rsqrt(max(density, 1e-8)), kEntryTaps.x * p.footprint, kEntryTaps.y * p.footprint);
        bool narrow = !kTgFewSlots && p.footprint > kTgNarrowTexel && apart * dot(facet, p.toLight) < kEntryTaps.x * p.footprint;
        PlanarPlace at = planarPlace(p, slope, kTgPlanarTexel);
        TgShadowTaps taps = tgShadowTapsOnPlane(slope, facet, p.axisX, p.axisY, tgLightRays(), p.footprint, apart);
        if (narrow)
            taps = tgShadowTapsOfTexels(at.uv);
        lit = own * tgShadowTapped(TG_SAMPLER2D_ARG(gShadow), at.uv, at.depth - bend, slope, taps);
        lit = ownVisibility(p.world, p.meshNormal, lit);
    }
    return lit;
}

// From a texel of the atlas to the next one along u or v; 0 where no chart covers that.
float3 atlasWay(float2 uv, float3 place, float2 way)
{
    float4 next = tex2Dlod(gAtlasPosition, float4(uv + way / kPyramidSize0, 0.0, 0.0));
    return next.w > 0.0 ? tgWorldPosition(next.xyz) - tgWorldPosition(place) : float3(0.0, 0.0, 0.0);
}

// Texels that no chart covers have nothing to light.
float4 entryLight(float2 uv)
{
    float4 place = tex2Dlod(gAtlasPosition, float4(uv, 0.0, 0.0));
    float4 light = 0.0;
    [branch] if (place.w > 0.0)
    {
        float2 right = float2(1.0 / kPyramidSize0, 0.0);
        float4 albedo = tex2Dgrad(gSkin, uv, right, right.yx);
        float4 normal = tex2Dlod(gAtlasNormal, float4(uv, 0.0, 0.0));
        LitPoint p = entryPoint(uv, albedo, place.xyz, normal.xyz);
        float3 facet = p.meshNormal;
        if (!kTgFewSlots)
            facet = facetNormal(p, atlasWay(uv, place.xyz, float2(1.0, 0.0)), atlasWay(uv, place.xyz, float2(0.0, 1.0)));
        p.shadow = entryShadow(p, facet, tex2Dlod(gAtlasMetric, float4(uv, 0.0, 0.0)).z) * skinOpen(tgWorldPosition(place.xyz));
        float covered = place.w * normal.w;
        light = float4(tgIrradianceBounded(enteringLight(p), kTgLargestHalf) * covered, covered);
    }
    return light;
}

float4 EntryPS(TgQuadVarying input) : SV_Target0
{
    return entryLight(input.uv);
}

// A place of the atlas in the world, mm, and the mesh's normal there.
struct AtlasPlace
{
    float3 place;
    float3 normal;
    float covered;
};

AtlasPlace atlasPlace(float2 uv)
{
    AtlasPlace at;
    float4 place = tex2Dlod(gAtlasPosition, float4(uv, 0.0, 0.0));
    at.place = tgMillimetres(tgWorldPosition(place.xyz));
    at.normal = tgWorldNormal(tex2Dlod(gAtlasMeshNormal, float4(uv, 0.0, 0.0)).xyz);
    at.covered = place.w > 0.0 ? 1.0 : 0.0;
    return at;
}

float3 fleshFactor()
{
    return toneGiven() ? tgToneFlesh(gBlood) : gFlesh.rgb;
}

bool fleshPasses()
{
    return toneGiven() || max(gFlesh.x, max(gFlesh.y, gFlesh.z)) > 0.0;
}

// What bent skin lets through more at a level, by its neighbours a texel of that level away. size: of its map; variance: mm^2.
float3 levelFlesh(float2 uv, float size, float variance)
{
    float3 share = 1.0;
    [branch] if (fleshPasses())
    {
        AtlasPlace here = atlasPlace(uv);
        float2 sum = float2(0.0, 1e-6);
        [unroll] for (int i = 0; i < 4; i++)
        {
            float2 step = float2(i < 2 ? 1.0 : 0.0, i < 2 ? 0.0 : 1.0) * (i % 2 == 0 ? 1.0 : -1.0);
            AtlasPlace there = atlasPlace(uv + step / size);
            sum += there.covered * float2(tgFleshCurvature(here.place, here.normal, there.place, there.normal), 1.0);
        }
        share = tgFleshShare(fleshFactor(), here.covered * sum.x / sum.y, variance);
    }
    return share;
}

// A level by itself, weighed: alpha keeps the density, below 0 where links bring the widest Gaussians. fourth: 1 where they
// bring, too, what other charts send by the fourth, of which only what the chart itself sends then counts, not divided by coverage.
float4 levelLight(TG_SAMPLER2D_PARAM(map), float2 uv, float size, float level, float linked, float fourth)
{
    float3 metric = tex2Dlod(gAtlasMetric, float4(uv, 0.0, 0.0)).xyz;
    float4 light = tgPyramidRound(TG_SAMPLER2D_ARG(map), uv, size, level, metric.xy);
    float density = clamp(metric.z, 1e-4, kLargestDensity);
    float3 weight = linked > 0.5 ? linkedWeight(level + 1.0, density) : ladderWeight(level + 1.0, density);
    [branch] if (fourth > 0.5 && light.w < 1.0)
        weight = max(weight + (light.w - 1.0) * ladderWeight(2.0 * kTgLadderSteps + level + 1.0, density), 0.0);
    weight *= levelFlesh(uv, size, tgLadderVariance(level) / density);
    return float4(light.rgb * weight, linked > 0.5 ? -density : density);
}

// Levels up to this one are left out where no chart is near: from 16 texels of the base on nothing reads them there.
static const float kLastSpared = 2.0;

// Whether a level is worked out at a texel.
bool levelServes(float level, float2 uv)
{
    return level > kLastSpared || tex2Dlod(gAtlasMetric, float4(uv, 0.0, 0.0)).w > 0.5;
}

// What the coarser levels have added up to.
float4 coarser(TG_SAMPLER2D_PARAM(map), float2 uv)
{
    return float4(tex2Dlod(map, float4(uv, 0.0, 0.0)).rgb, 0.0);
}

#define PYRAMID_REDUCE(level, finer) \
float4 Reduce##level##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return tgPyramidReduce(TG_SAMPLER2D_ARG(gEntry##finer), input.uv, kPyramidSize##finer); \
}
#define PYRAMID_LEVEL(level, wider) \
float4 Light##level##PS(TgQuadVarying input) : SV_Target0 \
{ \
    float4 light = 0.0; \
    [branch] if (levelServes(level, input.uv)) \
        light = levelLight(TG_SAMPLER2D_ARG(gEntry##level), input.uv, kPyramidSize##level, level, 0.0, 0.0) + \
                coarser(TG_SAMPLER2D_ARG(gLight##wider), input.uv); \
    return light; \
}

PYRAMID_REDUCE(1, 0)
PYRAMID_REDUCE(2, 1)
PYRAMID_REDUCE(3, 2)
PYRAMID_REDUCE(4, 3)
PYRAMID_REDUCE(5, 4)
PYRAMID_REDUCE(6, 5)

float4 Light6PS(TgQuadVarying input) : SV_Target0
{
    return levelLight(TG_SAMPLER2D_ARG(gEntry6), input.uv, kPyramidSize6, 6, 0.0, 0.0);
}
PYRAMID_LEVEL(5, 6)
PYRAMID_LEVEL(4, 5)
PYRAMID_LEVEL(3, 4)
PYRAMID_LEVEL(2, 3)
PYRAMID_LEVEL(1, 2)
PYRAMID_LEVEL(0, 1)

// One pass into one map. name: both of the pass and, with its number, of the map.
#define PYRAMID_STEP(map, name) "RenderColorTarget0=" map "; Pass=" name ";"
#define ENTRY_SCRIPT "RenderColorTarget0=gEntry0Map; RenderDepthStencilTarget=; Pass=Entry;"
#define REDUCE_SCRIPT(level) PYRAMID_STEP("gEntry" level "Map", "Reduce" level)
#define LEVEL_SCRIPT(level) PYRAMID_STEP("gLight" level "Map", "Light" level)
#define ENTRY_PASS TG_QUAD_PASS(Entry, TgQuadVS, EntryPS, TG_STATE_BUFFER)
#define REDUCE_PASS(level) TG_QUAD_PASS(Reduce##level, TgQuadVS, Reduce##level##PS, TG_STATE_BUFFER)
#define LEVEL_PASS(level) TG_QUAD_PASS(Light##level, TgQuadVS, Light##level##PS, TG_STATE_BUFFER)

#endif
// SPDX-License-Identifier: MIT
