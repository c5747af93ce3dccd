// Technique CoatChance: strands as fibres (fur_fibre_light.fxh), drawn by stochastic transparency (E. Enderton et al., Stochastic
// Transparency, 2010): a strand that covers a share of a pixel is there, opaque, with that chance. The mean is what sorted strands would
// show when blended, in any order. Chances are hashes of whole numbers, the same on every target; each of four samples of a pixel has its
// own.
#ifndef TEGUMENT_PASSES_FUR_CHANCE_FXH
#define TEGUMENT_PASSES_FUR_CHANCE_FXH

int gNoiseFrame < string UIName = "Frame of the noise"; string UIWidget = "None";
    string UIHelp = "another number, other chances: for a filter over several frames"; > = 0;

#ifdef TEGUMENT_COMPUTE
static const float kChanceLeast = 0.002; // coverage of which nothing is drawn

struct ChanceVarying
{
    float4 position : SV_Position;
    centroid float4 color : TEXCOORD0; // as of RibbonVarying
    float2 edge : TEXCOORD1;
    nointerpolation uint strand : TEXCOORD2;
};

// number: of the strand in its lock, underfur from kLockOfUnderfur on.
ChanceVarying chanceVarying(RibbonVarying ribbon, TgVertexInput input, float number)
{
    ChanceVarying output;
    output.position = ribbon.position;
    output.color = ribbon.color;
    output.edge = ribbon.edge;
    output.strand = 128u * (uint)input.uv.y + (uint)number;
    return output;
}

ChanceVarying ChanceLocksVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    float child = TG_LAYER_INDEX(gFurChild);
    return chanceVarying(lockVarying(input, child, 0.0, true), input, child);
}

ChanceVarying ChanceUnderfurVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    float child = TG_LAYER_INDEX(gFurChild);
    return chanceVarying(lockVarying(input, child, 1.0, true), input, child + kLockOfUnderfur);
}

// Hashes of three numbers (M. Jarzynski and M. Olano, Hash Functions for GPU Rendering, 2020: pcg3d).
uint3 chanceHash(uint3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// In [0, 1), of 24 bits, all of which a float holds.
float chanceOf(uint hash)
{
    return (float)(hash >> 8u) * (1.0 / 16777216.0);
}

// Of four samples, each 1 with the chance `coverage`: stratified. first: which of them has the first stratum.
float4 chanceSamples(float coverage, float chance, uint first)
{
    float4 strata = frac(float4(0.0, 0.25, 0.5, 0.75) + 0.25 * (float)(first & 3u));
    return step(max(strata + 0.25 * chance, kChanceLeast), coverage);
}

struct ChancePixel
{
    float4 color : SV_Target0;
    uint covered : SV_Coverage;
};

ChancePixel ChancePS(ChanceVarying input)
{
    float coverage = tgRibbonCoverage(float3(input.edge, abs(input.color.w)));
    uint3 hash = chanceHash(uint3((uint2)input.position.xy, input.strand + 747796405u * (uint)gNoiseFrame));
    float4 samples = chanceSamples(coverage, chanceOf(hash.x), hash.y);
    clip(dot(samples, 1.0) - 0.5);
    ChancePixel output;
    output.color = float4(input.color.rgb, 1.0);
    output.covered = (uint)(dot(samples, float4(1.0, 2.0, 4.0, 8.0)) + 0.5) * 0x11111111u;
    return output;
}

OpacityVarying FibreOpacityVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return lockOpacity(input, TG_LAYER_INDEX(gFurChild), kFibreUnder);
}

// Of light whose colour is E / pi on what faces it, what a dull surface of the coat's colour sends out below the fibres that it has passed.
float3 undercoatLit(FibrePoint p, float3 toLight, FibrePassed passed)
{
    float3 depth = tgFibreDepth(tgFibreAlbedo(tgFibreAbsorption(p.albedo))) * passed.own;
    float cosine = dot(p.normal, toLight);
    float up = fibreCosine(cosine);
    float left = exp(-passed.before);
    float3 through = max(exp(-depth) * left, fibreStraight(p, toLight, passed));
    return p.albedo * passed.open * (through * saturate(cosine) + left * tgFibreField(p.albedo, depth * up, up).mean);
}

#if TEGUMENT_LAMPS
float3 undercoatLamps(FibrePoint p, float3 world)
{
    float3 sum = 0.0;
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, world, 1.0);
        sum += lamp.light * undercoatLit(p, lamp.toLight, fibrePassedByLamp(gCoatUndercoat, dot(p.normal, lamp.toLight)));
    }
    return sum;
}
#endif

float4 FibreUndercoatPS(FurVarying input) : SV_Target0
{
    float3 toEye = gCameraPosition - input.world;
    float pixel = ribbonPixel() * length(toEye);
    TgLight ours = ownLight(input.world);
    float3 toLight = ours.toLight;
    FibrePoint p;
    p.normal = tgWorldNormal(input.normal);
    p.tangent = p.normal;
    p.toEye = tgSafeNormalize(toEye);
    p.albedo = undercoatAlbedo(dot(p.normal, gFurDown), pixel);
    FibrePassed passed = fibrePassed(input.world, gCoatUndercoat * (1.0 - gCoatShort), dot(p.normal, toLight), pixel);
    float3 below = tgFibreDepth(tgFibreAlbedo(tgFibreAbsorption(p.albedo))) * kFibreDeep;
    float3 around = p.albedo * tgFibreFieldAround(p.albedo, below).mean * fibreAround(p.normal);
    float3 lit = ours.color * ownVisibility(input.world, p.normal, 1.0) * undercoatLit(p, toLight, passed) + around;
    return float4(WITH_LAMPS(lit, undercoatLamps(p, input.world)), 1.0);
}

#define CHANCE_SCRIPT \
    LIGHT_SCRIPT("Pass=Fibre;" OPACITY_SCRIPT) "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Undercoat;" \
    TG_LAYER_SCRIPT("gCoatUnderfur", "gFurChild", "Underfur") TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Core") COAT_MOTION_SCRIPT
// Any coverage may show: the underfur leaves out nothing that LOCK_UNDER does.
#define LOCK_CHANCE_UNDER RIBBON_REACH LOCK_SHARE_OF("gCoatUnderThin") float SegmentScale = 0.5;
#define CHANCE_PASSES TG_COMPUTE_PASS(Fibre, FibreCS, "gFibrePathMap") \
    OPACITY_PASSES_OF(FibreFrontVS, FibreOpacityVS, FibreOpacityPS) \
    TG_PART_PASS(Undercoat, "skin", UndercoatVS, FibreUndercoatPS, TG_STATE_SOLID) \
    TG_SEEN_LAYER_PASS(Underfur, "underfur", LOCK_CHANCE_UNDER, "gCoatUnderfur", ChanceUnderfurVS, ChancePS, TG_STATE_TWOSIDED) \
    TG_SEEN_LAYER_PASS(Core, "underfur", LOCK_SEEN, "gCoatChildren", ChanceLocksVS, ChancePS, TG_STATE_TWOSIDED) COAT_MOTION_PASSES
#endif

#endif
// SPDX-License-Identifier: MIT
