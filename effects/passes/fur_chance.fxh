// Technique CoatChance: strands as fibres (fur_fibre_light.fxh), drawn by stochastic transparency (E. Enderton et al., Stochastic
// Transparency, 2010): a strand that covers a share of a pixel is there, opaque, with that chance. The mean is what sorted strands would
// show when blended, in any order; four samples of a pixel have four chances.
#ifndef TEGUMENT_PASSES_FUR_CHANCE_FXH
#define TEGUMENT_PASSES_FUR_CHANCE_FXH

float gNoiseFrame < string UIName = "Frame of the noise"; string UIWidget = "None";
    string UIHelp = "another number, other chances: for a filter over several frames"; > = 0.0;

static const float kChanceFrame = 0.6180340; // by which chances move from frame to frame
static const float kChanceLeast = 0.002;     // coverage of which nothing is drawn

struct ChanceVarying
{
    float4 position : SV_Position;
    centroid float4 color : TEXCOORD0; // as of RibbonVarying
    float3 edge : TEXCOORD1;           // and in z a number of the strand, in [0, 1)
};

ChanceVarying chanceVarying(RibbonVarying ribbon, VertexInput input, float number)
{
    float3 noise = lockNoise(input.uv.y, number);
    ChanceVarying output;
    output.position = ribbon.position;
    output.color = ribbon.color;
    output.edge = float3(ribbon.edge, frac(noise.x + 37.0 * noise.y));
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

// In [0, 1): of each pixel, and of each strand apart. seed: of the strand, in [0, 1).
float chanceOf(float2 pixel, float seed)
{
    float3 p = frac(pixel.xyx * 0.1031 + seed * float3(1.0, 61.0, 367.0));
    p += dot(p, p.yzx + 33.33);
    return frac((p.x + p.y) * p.z);
}

// Of four samples, each 1 with the chance `coverage`: stratified, and which of them is first is chance, too.
float4 chanceSamples(float coverage, float chance)
{
    float4 strata = frac(float4(0.0, 0.25, 0.5, 0.75) + floor(4.0 * frac(61.0 * chance)) * 0.25);
    return step(max(strata + 0.25 * chance, kChanceLeast), coverage);
}

struct ChancePixel
{
    float4 color : SV_Target0;
    TG_COVERAGE_MEMBER
};

ChancePixel ChancePS(TG_PIXEL_INPUT(ChanceVarying, input))
{
    float coverage = tgRibbonCoverage(float3(input.edge.xy, abs(input.color.w)));
    float4 samples = chanceSamples(coverage, chanceOf(TG_PIXEL_CENTRE(input), frac(input.edge.z + kChanceFrame * gNoiseFrame)));
    ChancePixel output;
    TG_COVER(output, samples);
    output.color = float4(input.color.rgb, 1.0);
    return output;
}

#define FIBRE_SCRIPT TG_BEYOND_3("RenderColorTarget0=gFibrePathMap; RenderColorTarget1=gFibreBrightMap; RenderDepthStencilTarget=;" \
    "Pass=Fibre; RenderColorTarget1=;")
#define CHANCE_SCRIPT LIGHT_SCRIPT(FIBRE_SCRIPT OPACITY_SCRIPT) "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Undercoat;" \
    TG_LAYER_SCRIPT("gCoatUnderfur", "gFurChild", "Underfur") TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Core") COAT_MOTION_SCRIPT
// Any coverage may show: the underfur leaves out nothing that LOCK_UNDER does.
#define LOCK_CHANCE_UNDER RIBBON_REACH LOCK_SHARE_OF("gCoatUnderThin") float SegmentScale = 0.5;
#define CHANCE_PASSES TG_BEYOND_3(TG_QUAD_PASS(Fibre, QuadVS, FibrePS, TG_STATE_BUFFER)) \
    OPACITY_PASSES_OF(FibreFrontVS, FibreOpacityVS, FibreOpacityPS) \
    TG_PART_PASS(Undercoat, "skin", UndercoatVS, FibreUndercoatPS, TG_STATE_SOLID) \
    TG_SEEN_LAYER_PASS(Underfur, "underfur", LOCK_CHANCE_UNDER, "gCoatUnderfur", ChanceUnderfurVS, ChancePS, TG_STATE_TWOSIDED) \
    TG_SEEN_LAYER_PASS(Core, "underfur", LOCK_SEEN, "gCoatChildren", ChanceLocksVS, ChancePS, TG_STATE_TWOSIDED) COAT_MOTION_PASSES

#endif
