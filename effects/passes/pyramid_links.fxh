// Passes LinkedLight6 to 0: the levels of the pyramid where the light of the fifth and sixth Gaussian comes along links in space. `tegument
// prep links` makes them, and Generator has them made: a sheet of square tiles, as many along each side as its last texel says in x; tile k
// holds link k of each texel of a map of 256 x 256. Link = (u, v, weights of the two Gaussians) of a texel that sends light. Signs tell the
// size of the map that it belongs to: u < 0 halves 512, v < 0 quarters it, the second weight < 0 takes a sixteenth; 0 ends a list. A mesh
// without links gets all its light from the pyramid. Where texels are too wide, their quarters have lists of their own, in rows below the
// map: the last tile says of each texel where, (0, x + 1, y, 1 where they replace its own list), counted in 2 x 2.
#ifndef TEGUMENT_PASSES_PYRAMID_LINKS_FXH
#define TEGUMENT_PASSES_PYRAMID_LINKS_FXH

Texture2D gLinksMap < string Generator = "skin links"; float4 Fallback = { 0.0, 0.0, 0.0, 0.0 }; string UIName = "Links";
    string UIHelp = "from tegument prep links, made from this mesh"; >;
TG_SAMPLER2D(gLinks, POINT, CLAMP);

static const float kMostLinks = 64.0;
// Variances (mm^2) of the two Gaussians that links are made for.
static const float2 kLinkVariance = float2(1.99, 7.41);
// Smallest weight that a half float holds.
static const float kLeastWeight = 6e-8;
// A source with less coverage than this lies beside the charts.
static const float kLeastSource = 1e-4;

// Maps of light by their size, as links name them: coarser ones where there are none as fine. WIDE_n(light): `light` at the level whose map
// is as large as the links' own, quarters' at the next, else nothing. FINE_...: passes without the coarse levels (gCoarseLevels = 0).
#if TEGUMENT_MAP_SIZE >= 2048
#define LINK_512 gEntry2
#define LINK_256 gEntry3
#define LINK_128 gEntry4
#define LINK_64 gEntry5
#define LINK_32 gEntry6
#define LINK_16 gEntry6
#elif TEGUMENT_MAP_SIZE >= 1024
#define LINK_512 gEntry1
#define LINK_256 gEntry2
#define LINK_128 gEntry3
#define LINK_64 gEntry4
#define LINK_32 gEntry5
#define LINK_16 gEntry6
#elif TEGUMENT_MAP_SIZE >= 512
#define LINK_512 gEntry0
#define LINK_256 gEntry1
#define LINK_128 gEntry2
#define LINK_64 gEntry3
#define LINK_32 gEntry4
#define LINK_16 gEntry5
#elif TEGUMENT_MAP_SIZE >= 256
#define LINK_512 gEntry0
#define LINK_256 gEntry0
#define LINK_128 gEntry1
#define LINK_64 gEntry2
#define LINK_32 gEntry3
#define LINK_16 gEntry4
#else
#define LINK_512 gEntry0
#define LINK_256 gEntry0
#define LINK_128 gEntry0
#define LINK_64 gEntry1
#define LINK_32 gEntry2
#define LINK_16 gEntry3
#endif
#if TEGUMENT_MAP_SIZE >= 2048
#define WIDE_3(light) light
#else
#define WIDE_3(light) 0.0
#endif
#if TEGUMENT_MAP_SIZE >= 1024 && TEGUMENT_MAP_SIZE < 2048
#define WIDE_2(light) light
#elif TEGUMENT_MAP_SIZE >= 2048
#define WIDE_2(light) quarterLinks(input.uv)
#else
#define WIDE_2(light) 0.0
#endif
#if TEGUMENT_MAP_SIZE >= 512 && TEGUMENT_MAP_SIZE < 1024
#define WIDE_1(light) light
#elif TEGUMENT_MAP_SIZE >= 1024 && TEGUMENT_MAP_SIZE < 2048
#define WIDE_1(light) quarterLinks(input.uv)
#else
#define WIDE_1(light) 0.0
#endif
#if TEGUMENT_MAP_SIZE < 512
#define WIDE_0(light) light
#elif TEGUMENT_MAP_SIZE < 1024
#define WIDE_0(light) quarterLinks(input.uv)
#else
#define WIDE_0(light) 0.0
#endif

// What weights are made for; those that links do not bring are left out afterwards.
float2 boundVariances()
{
    return clamp(linkedVariances(), kLinkedVariances.x, kLinkedVariances.y);
}

// Whether the weights that links bring are those that they were made with.
bool linksAsMade()
{
    return toneGiven() || all(linkedVariances() == kLinkVariance);
}

// Of a link. Its two weights are a G(v, d) for two v: they tell area a and distance d of the source, and so what it weighs for any v.
float2 linkWeights(float4 link)
{
    float2 stored = abs(link.zw);
    float2 weights = stored;
    [branch] if (!linksAsMade())
    {
        float2 v = boundVariances();
        float2 part = (1.0 / v - 1.0 / kLinkVariance.y) / (1.0 / kLinkVariance.x - 1.0 / kLinkVariance.y);
        float2 grown = log2(max(stored, kLeastWeight) * kLinkVariance);
        weights = exp2(part * grown.x + (1.0 - part) * grown.y) / v;
    }
    return weights;
}

// x: as many tiles as lie side by side, 0 where the mesh has no links or they do not reach as far as the sixth Gaussian, which the levels
// then bring as all the others; y: 1 where the fourth Gaussian comes along; z: the height of a tile,
// 1 without quarters, of which older sheets say nothing.
float3 linkSheet()
{
    float3 sheet = max(tex2Dlod(gLinks, float4(1.0, 1.0, 0.0, 0.0)).xyz, float3(0.0, 0.0, 1.0));
    sheet.y *= fifthLinked() ? 1.0 : 0.0;
    return sixthLinked() ? sheet : float3(0.0, 0.0, 1.0);
}

// Link number k of a list; slot: where each tile holds the list.
float4 linkOf(float2 slot, float k, float tiles)
{
    float row = floor((k + 0.5) / tiles);
    return tex2Dlod(gLinks, float4((float2(k - row * tiles, row) + slot) / tiles, 0.0, 0.0));
}

float2 linkSlot(float2 uv, float high)
{
    return float2(uv.x, uv.y / high);
}

// Where the lists of a texel's quarters are.
float4 quartersOf(float2 uv, float3 sheet)
{
    float4 found = 0.0;
    [branch] if (sheet.z > 1.0)
        found = linkOf(linkSlot(uv, sheet.z), sheet.x * sheet.x - 1.0, sheet.x);
    return found;
}

float linkMap(float4 link)
{
    return (link.x < 0.0 ? 1.0 : 0.0) + (link.y < 0.0 ? 2.0 : 0.0) + (link.w < 0.0 ? 4.0 : 0.0);
}

// What weights made anew must be multiplied by: those of a list add up to what the stored ones do, between the two in the logarithm of the
// variance, for a list was fitted to its sums, and its distances are means.
float2 linkScale(float2 slot, float tiles, float last)
{
    float2 scale = 1.0;
    [branch] if (!linksAsMade())
    {
        float2 stored = 0.0;
        float2 anew = 0.0;
        [loop] for (float k = 0.0; k <= last; k += 1.0)
        {
            float4 link = linkOf(slot, k, tiles);
            last = link.x == 0.0 ? -1.0 : last;
            stored += link.x == 0.0 ? float2(0.0, 0.0) : abs(link.zw);
            anew += link.x == 0.0 ? float2(0.0, 0.0) : linkWeights(link);
        }
        float2 place = log2(boundVariances() / kLinkVariance.x) / log2(kLinkVariance.y / kLinkVariance.x);
        float2 sums = max(stored, kLeastWeight);
        scale = sums.x * exp2(place * log2(sums.y / sums.x)) / max(anew, kLeastWeight);
    }
    return scale;
}

// What bent skin lets through more from a link's source to a place. Shader model 3 has no room for it.
#ifdef TEGUMENT_HLSL_3
#define LINK_RECEIVER(uv)
#define LINK_FLESH(link) 1.0
#else
float3 linkFlesh(float2 uv, AtlasPlace here)
{
    float3 share = 1.0;
    [branch] if (fleshPasses())
    {
        AtlasPlace there = atlasPlace(uv);
        share += fleshFactor() * (here.covered * there.covered * tgFleshUnder(here.place, here.normal, there.place, there.normal));
    }
    return share;
}
#define LINK_RECEIVER(uv) \
    AtlasPlace here = (AtlasPlace)0; \
    [branch] if (fleshPasses()) \
        here = atlasPlace(uv);
#define LINK_FLESH(link) linkFlesh(abs(link.xy), here)
#endif

// Colours of the fifth and sixth Gaussian.
struct LinkColours
{
    float3 fifth;
    float3 sixth;
};

LinkColours linkColours()
{
    LinkColours colours;
    colours.fifth = gGaussianWeight[4].rgb; // beside a tone levels bring it
    colours.sixth = gGaussianWeight[5].rgb;
    [branch] if (toneGiven())
        colours.sixth = ladderWeight(kTgLadderGaussians + 5.0, 1.0);
    return colours;
}

// weights: of the fifth and sixth Gaussian.
float3 linkLight(float2 weights, LinkColours colours, float4 source)
{
    float3 share = weights.x * colours.fifth + weights.y * colours.sixth;
    return share * source.rgb / max(source.a, kLeastSource);
}

// From maps of 512 to 128 texels.
float4 fineSource(float4 link)
{
    float map = linkMap(link);
    float4 at = float4(abs(link.xy), 0.0, 0.0);
    float4 source;
    [branch] if (map < 0.5)
        source = tex2Dlod(LINK_512, at);
    else
    {
        [branch] if (map < 1.5)
            source = tex2Dlod(LINK_256, at);
        else
            source = tex2Dlod(LINK_128, at);
    }
    return source;
}

// From maps of 512 to 16 texels.
float4 anySource(float4 link)
{
    float map = linkMap(link);
    float4 at = float4(abs(link.xy), 0.0, 0.0);
    float4 source;
    [branch] if (map < 2.5)
        source = fineSource(link);
    else
    {
        [branch] if (map < 3.5)
            source = tex2Dlod(LINK_64, at);
        else
        {
            [branch] if (map < 4.5)
                source = tex2Dlod(LINK_32, at);
            else
                source = tex2Dlod(LINK_16, at);
        }
    }
    return source;
}

// Light of the fifth and sixth Gaussian by the list at `slot`, of each `apart`th link from `first` on, none where `lists` is below 0.5. A
// list ends the loop by its 0, and the sheet by its last tile: beyond it a look-up would find the tiles' lowest row again.
#define LINKED_LIST(name, sourceOf) \
float4 name(float2 uv, float2 slot, float3 sheet, float lists, float first, float apart) \
{ \
    float fifth = 1.0 - fifthByLevels(tex2Dlod(gAtlasMetric, float4(uv, 0.0, 0.0)).z); \
    float3 sum = 0.0; \
    float last = lists > 0.5 ? min(sheet.x * sheet.x, kMostLinks) - 1.0 : -1.0; \
    float2 scale = float2(fifth, 1.0) * linkScale(slot, sheet.x, last); \
    LinkColours colours = linkColours(); \
    LINK_RECEIVER(uv) \
    [loop] for (float k = first; k <= last; k += apart) \
    { \
        float4 link = linkOf(slot, k, sheet.x); \
        last = link.x == 0.0 ? -1.0 : last; \
        sum += link.x == 0.0 ? float3(0.0, 0.0, 0.0) : LINK_FLESH(link) * linkLight(scale * linkWeights(link), colours, sourceOf(link)); \
    } \
    return float4(sum, 0.0); \
}
LINKED_LIST(fineList, fineSource)
LINKED_LIST(anyList, anySource)

// Of a texel, but where its quarters bring it.
float listsAt(float2 uv, float3 sheet)
{
    float lists = sheet.x;
#if TEGUMENT_MAP_SIZE >= 512
    lists *= 1.0 - quartersOf(uv, sheet).w;
#endif
    return lists;
}

float4 fineLinks(float2 uv, float first, float apart)
{
    float3 sheet = linkSheet();
    return fineList(uv, linkSlot(uv, sheet.z), sheet, listsAt(uv, sheet), first, apart);
}

float4 anyLinks(float2 uv, float first, float apart)
{
    float3 sheet = linkSheet();
    return anyList(uv, linkSlot(uv, sheet.z), sheet, listsAt(uv, sheet), first, apart);
}

// Of a quarter of a texel.
float4 quarterLinks(float2 uv)
{
    float3 sheet = linkSheet();
    float4 quarters = quartersOf(uv, sheet);
    float2 odd = floor(2.0 * frac(uv * kLinkTexels));
    float2 slot = (2.0 * float2(quarters.y - 1.0, quarters.z) + odd + 0.5) / kLinkTexels + float2(0.0, 1.0);
    return fineList(uv, linkSlot(slot, sheet.z), sheet, quarters.y, 0.0, 1.0);
}

float4 linkedLevel(TG_SAMPLER2D_PARAM(map), float2 uv, float size, float level)
{
    float3 sheet = linkSheet();
    return levelLight(TG_SAMPLER2D_ARG(map), uv, size, level, sheet.x > 0.5 ? 1.0 : 0.0, sheet.y);
}

#define LINKED_LEVEL(name, level, more, links) \
float4 name(TgQuadVarying input) : SV_Target0 \
{ \
    float4 light = 0.0; \
    [branch] if (levelServes(level, input.uv)) \
        light = linkedLevel(TG_SAMPLER2D_ARG(gEntry##level), input.uv, kPyramidSize##level, level) + more + links; \
    return light; \
}
#define COARSER(level) coarser(TG_SAMPLER2D_ARG(gLight##level), input.uv)

LINKED_LEVEL(LinkedLight6PS, 6, 0.0, 0.0)
LINKED_LEVEL(LinkedLight5PS, 5, COARSER(6), 0.0)
LINKED_LEVEL(LinkedLight4PS, 4, COARSER(5), 0.0)
LINKED_LEVEL(LinkedLight3PS, 3, COARSER(4), WIDE_3(anyLinks(input.uv, 0.0, 1.0)))
LINKED_LEVEL(LinkedLight2PS, 2, COARSER(3), WIDE_2(anyLinks(input.uv, 0.0, 1.0)))
LINKED_LEVEL(LinkedLight1PS, 1, COARSER(2), WIDE_1(anyLinks(input.uv, 0.0, 1.0)))
LINKED_LEVEL(LinkedLight0PS, 0, COARSER(1), WIDE_0(anyLinks(input.uv, 0.0, 1.0)))

#define LINKED_STEP(level) PYRAMID_STEP("gLight" level "Map", "LinkedLight" level)
#define LINKED_OR(level, fine) "RenderColorTarget0=gLight" level "Map; Pass=gCoarseLevels?" fine ":LinkedLight" level ";"
#define LINKED_PASS(name) TG_QUAD_PASS(name, TgQuadVS, name##PS, TG_STATE_BUFFER)
#define LINKED_ALL_PASSES \
    REDUCE_PASS(1) REDUCE_PASS(2) REDUCE_PASS(3) REDUCE_PASS(4) REDUCE_PASS(5) REDUCE_PASS(6) \
    LINKED_PASS(LinkedLight6) LINKED_PASS(LinkedLight5) LINKED_PASS(LinkedLight4) LINKED_PASS(LinkedLight3) \
    LINKED_PASS(LinkedLight2) LINKED_PASS(LinkedLight1) LINKED_PASS(LinkedLight0)

#if TEGUMENT_MAP_SIZE >= 2048
LINKED_LEVEL(FineTopPS, 3, 0.0, fineLinks(input.uv, 0.0, 1.0))
#define REDUCE_FEW_SCRIPT REDUCE_SCRIPT("1") REDUCE_SCRIPT("2") REDUCE_SCRIPT("3") REDUCE_SCRIPT("4")
#define REDUCE_REST_SCRIPT REDUCE_SCRIPT("5") REDUCE_SCRIPT("6")
#define LINKED_STEPS(few, rest) \
    few "LoopByCount=gCoarseLevels;" rest LINKED_STEP("6") LINKED_STEP("5") LINKED_STEP("4") "LoopEnd;" \
    LINKED_OR("3", "FineTop") LINKED_STEP("2") LINKED_STEP("1") LINKED_STEP("0")
#define LINKED_PASSES LINKED_ALL_PASSES LINKED_PASS(FineTop)
#elif TEGUMENT_MAP_SIZE >= 1024
LINKED_LEVEL(FineTopPS, 2, 0.0, fineLinks(input.uv, 0.0, 1.0))
#define REDUCE_FEW_SCRIPT REDUCE_SCRIPT("1") REDUCE_SCRIPT("2") REDUCE_SCRIPT("3")
#define REDUCE_REST_SCRIPT REDUCE_SCRIPT("4") REDUCE_SCRIPT("5") REDUCE_SCRIPT("6")
#define LINKED_STEPS(few, rest) \
    few "LoopByCount=gCoarseLevels;" rest LINKED_STEP("6") LINKED_STEP("5") LINKED_STEP("4") LINKED_STEP("3") "LoopEnd;" \
    LINKED_OR("2", "FineTop") LINKED_STEP("1") LINKED_STEP("0")
#define LINKED_PASSES LINKED_ALL_PASSES LINKED_PASS(FineTop)
#else
#if TEGUMENT_MAP_SIZE >= 512
LINKED_LEVEL(FineLightPS, 1, COARSER(2), fineLinks(input.uv, 0.0, 1.0))
#define FINE_LEVELS LINKED_OR("1", "FineLight") LINKED_STEP("0")
#else
LINKED_LEVEL(FineLightPS, 0, COARSER(1), fineLinks(input.uv, 0.0, 1.0))
#define FINE_LEVELS LINKED_STEP("1") LINKED_OR("0", "FineLight")
#endif
LINKED_LEVEL(FineTopPS, 2, 0.0, 0.0)
#define REDUCE_FEW_SCRIPT REDUCE_SCRIPT("1") REDUCE_SCRIPT("2")
#define REDUCE_REST_SCRIPT REDUCE_SCRIPT("3") REDUCE_SCRIPT("4") REDUCE_SCRIPT("5") REDUCE_SCRIPT("6")
#define LINKED_STEPS(few, rest) \
    few "LoopByCount=gCoarseLevels;" rest LINKED_STEP("6") LINKED_STEP("5") LINKED_STEP("4") LINKED_STEP("3") "LoopEnd;" \
    LINKED_OR("2", "FineTop") FINE_LEVELS
#define LINKED_PASSES LINKED_ALL_PASSES LINKED_PASS(FineTop) LINKED_PASS(FineLight)
#endif
#define LINKED_SCRIPT LINKED_STEPS(REDUCE_FEW_SCRIPT, REDUCE_REST_SCRIPT)

#endif
// SPDX-License-Identifier: MIT
