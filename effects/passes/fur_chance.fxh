// Technique CoatChance: strands as fibres (fur_fibre_light.fxh), drawn by stochastic transparency (E. Enderton et al., Stochastic
// Transparency, 2010): a strand that covers a share of a pixel is there, opaque, with that chance. The mean is what sorted strands would
// show when blended, in any order. Chances are hashes of whole numbers, the same on every target. With TEGUMENT_SAMPLES above 1 each of
// four samples of a pixel has its own; without, a pixel is covered in all of them or in none.
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
ChanceVarying chanceVarying(RibbonVarying ribbon, VertexInput input, float number)
{
    ChanceVarying output;
    output.position = ribbon.position;
    output.color = ribbon.color;
    output.edge = ribbon.edge;
    output.strand = 128u * (uint)input.uv.y + (uint)number;
    return output;
}

ChanceVarying ChanceLocksVS(TG_LAYER_INPUT(VertexInput, input))
{
    float child = TG_LAYER_INDEX(gFurChild);
    return chanceVarying(lockVarying(input, child, 0.0, true), input, child);
}

ChanceVarying ChanceUnderfurVS(TG_LAYER_INPUT(VertexInput, input))
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
#if TEGUMENT_SAMPLES > 1
    uint covered : SV_Coverage;
#endif
};

ChancePixel ChancePS(ChanceVarying input)
{
    float coverage = tgRibbonCoverage(float3(input.edge, abs(input.color.w)));
    uint3 hash = chanceHash(uint3((uint2)input.position.xy, input.strand + 747796405u * (uint)gNoiseFrame));
    float chance = chanceOf(hash.x);
    ChancePixel output;
    output.color = float4(input.color.rgb, 1.0);
#if TEGUMENT_SAMPLES > 1
    float4 samples = chanceSamples(coverage, chance, hash.y);
    clip(dot(samples, 1.0) - 0.5);
    output.covered = (uint)(dot(samples, float4(1.0, 2.0, 4.0, 8.0)) + 0.5) * 0x11111111u;
#else
    clip(step(max(chance, kChanceLeast), coverage) - 0.5);
#endif
    return output;
}

OpacityVarying FibreOpacityVS(TG_LAYER_INPUT(VertexInput, input))
{
    return lockOpacity(input, TG_LAYER_INDEX(gFurChild), kFibreUnder);
}

// A dull surface of the coat's colour, lit through the fibres above it.
float4 FibreUndercoatPS(FurVarying input) : SV_Target0
{
    float3 normal = tgWorldNormal(input.normal);
    float pixel = ribbonPixel() * length(gCameraPosition - input.world);
    float3 albedo = undercoatAlbedo(dot(normal, gFurDown), pixel);
    float2 passed = fibrePassed(input.world, pixel);
    float3 depth = tgFibreDepth(tgFibreAlbedo(tgFibreAbsorption(albedo))) * passed.x;
    float cosine = dot(normal, tgLightDirection(input.world));
    float up = fibreCosine(cosine);
    float3 lit = gLightColor * passed.y * (exp(-depth) * saturate(cosine) + tgFibreField(albedo, depth * up, up).mean);
    float3 around = tgFibreFieldAround(albedo, depth * up).mean;
    return float4(albedo * WITH_SURROUNDINGS(lit, around * surroundingsAt(normal, kTgSurroundingsDiffuse)), 1.0);
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
