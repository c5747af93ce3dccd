// The passes of PyramidLinked as compute shaders, but for ShadowMap: a thread for each texel of a map. What the picture shows is drawn
// once, without shading, into gPlaceMap, and lit by pass Final from there. Pixel shaders run on a part of some chips; these run on all. The
// same chips write targets slowly, byte by byte: gPlaceMap has eight of them, and depth is read from where it is tested.
#ifndef TEGUMENT_PASSES_PYRAMID_COMPUTE_FXH
#define TEGUMENT_PASSES_PYRAMID_COMPUTE_FXH

float4x4 gViewProjectionInverse : VIEWPROJECTIONINVERSE < string UIWidget = "None"; >;

#ifdef TEGUMENT_COMPUTE
// u, v, and the mesh's normal as a point of an octahedron, both brought to 0..1. A normal of the atlas would be as coarse as its texels.
Texture2D gPlaceMap : RENDERCOLORTARGET < PICTURE_TARGET("A16B16G16R16") >;
// 1: nothing is seen.
Texture2D gPlaceDepthMap : RENDERDEPTHSTENCILTARGET < float2 ViewportRatio = { 1.0, 1.0 }; string Format = "D32F"; >;
// For the normal map's frame, whose direction changes little from texel to texel.
Texture2D gAtlasTangentMap < string Producer = "Atlas.fx/gAtlasTangentMap"; string ResourceName = "atlas_tangent.dds"; >;
TG_SAMPLER2D(gPlace, POINT, CLAMP);
TG_SAMPLER2D(gPlaceDepth, POINT, CLAMP);
TG_SAMPLER2D(gAtlasTangent, LINEAR, CLAMP);
TG_STORE_PICTURE(gPictureStore)
TG_STORE2D(gEntry0Store)
TG_STORE2D(gEntry1Store)
TG_STORE2D(gEntry2Store)
TG_STORE2D(gEntry3Store)
TG_STORE2D(gEntry4Store)
TG_STORE2D(gEntry5Store)
TG_STORE2D(gEntry6Store)
TG_STORE2D(gLight0Store)
TG_STORE2D(gLight1Store)
TG_STORE2D(gLight2Store)
TG_STORE2D(gLight3Store)
TG_STORE2D(gLight4Store)
TG_STORE2D(gLight5Store)
TG_STORE2D(gLight6Store)

TgQuadVarying texelAt(uint3 thread, float size)
{
    TgQuadVarying input;
    input.position = float4(0.0, 0.0, 0.0, 1.0);
    input.uv = (thread.xy + 0.5) / size;
    return input;
}

// store: what of the map is written; size: its side.
#define PYRAMID_CS(name, store, size) \
[numthreads(8, 8, 1)] \
void name##CS(uint3 thread : SV_DispatchThreadID) \
{ \
    store[thread.xy] = name##PS(texelAt(thread, size)); \
}

// A level and its links: four threads share the list of a texel, for with one each they would wait for memory most of the time. links: the
// light of some of them.
static const float kLinkThreads = 4.0;
groupshared float3 gLinkSums[8 * 8 * 4];

#define PYRAMID_LINKS_CS(name, level, more, links) \
[numthreads(8, 8, 4)] \
void name##CS(uint3 thread : SV_DispatchThreadID, uint inGroup : SV_GroupIndex) \
{ \
    TgQuadVarying input = texelAt(thread, kPyramidSize##level); \
    bool lit = levelServes(level, input.uv); \
    gLinkSums[inGroup] = 0.0; \
    [branch] if (lit) \
        gLinkSums[inGroup] = links(input.uv, thread.z, kLinkThreads).rgb; \
    GroupMemoryBarrierWithGroupSync(); \
    [branch] if (thread.z == 0) \
    { \
        float4 light = 0.0; \
        [branch] if (lit) \
        { \
            light = linkedLevel(TG_SAMPLER2D_ARG(gEntry##level), input.uv, kPyramidSize##level, level) + more; \
            light.rgb += gLinkSums[inGroup] + gLinkSums[inGroup + 64] + gLinkSums[inGroup + 128] + gLinkSums[inGroup + 192]; \
        } \
        gLight##level##Store[thread.xy] = light; \
    } \
}

PYRAMID_CS(Entry, gEntry0Store, kPyramidSize0)

// Three reductions in one pass: a group makes 4 x 4 texels of the last map, and shares what these need of the two before, 10 x 10 and 22 x
// 22.
static const uint kFirstSide = 22;
static const uint kSecondSide = 10;
static const uint kReduceThreads = 8 * 8;
groupshared float4 gFirstReduced[22 * 22];
groupshared float4 gSecondReduced[10 * 10];

// What tgPyramidReduce reads of a finer map: `at`, in its texels, and 3 x 3 more.
float2 reducedFrom(int2 texel, float size, float finer)
{
    return (texel + 0.5) * (finer / size) - 1.25;
}

// tgPyramidReduce of a map that is shared, from its texel `origin` on.
#define SHARED_REDUCE(name, map, side) \
float4 name(int2 texel, float size, float finer, int2 origin) \
{ \
    float4 sum = 0.0; \
    [unroll] for (int tap = 0; tap < 4; tap++) \
    { \
        float2 at = reducedFrom(texel, size, finer) + 1.5 * float2(tap % 2, tap / 2); \
        float2 part = frac(at); \
        uint2 corner = uint2(int2(floor(at)) - origin); \
        uint first = corner.y * side + corner.x; \
        sum += lerp(lerp(map[first], map[first + 1], part.x), lerp(map[first + side], map[first + side + 1], part.x), part.y); \
    } \
    return 0.25 * sum; \
}
SHARED_REDUCE(secondReduced, gFirstReduced, kFirstSide)
SHARED_REDUCE(thirdReduced, gSecondReduced, kSecondSide)

// Whether a group writes this texel of a map of which it has so many along a side.
bool reducesTexel(int2 texel, int2 group, int along)
{
    return all(texel >= group * along) && all(texel < (group + 1) * along);
}

#define PYRAMID_REDUCE_CS(name, from, first, second, third) \
[numthreads(8, 8, 1)] \
void name##CS(uint3 inMap : SV_GroupID, uint inGroup : SV_GroupIndex) \
{ \
    int2 group = int2(inMap.xy); \
    int2 origin2 = int2(floor(reducedFrom(4 * group, kPyramidSize##third, kPyramidSize##second))); \
    int2 origin1 = int2(floor(reducedFrom(origin2, kPyramidSize##second, kPyramidSize##first))); \
    [loop] for (uint i = inGroup; i < kFirstSide * kFirstSide; i += kReduceThreads) \
    { \
        int2 texel = origin1 + int2(i % kFirstSide, i / kFirstSide); \
        float2 uv = (clamp(texel, 0, int(kPyramidSize##first) - 1) + 0.5) / kPyramidSize##first; \
        gFirstReduced[i] = tgPyramidReduce(TG_SAMPLER2D_ARG(gEntry##from), uv, kPyramidSize##from); \
        [branch] if (reducesTexel(texel, group, 16)) \
            gEntry##first##Store[texel] = gFirstReduced[i]; \
    } \
    GroupMemoryBarrierWithGroupSync(); \
    [loop] for (uint k = inGroup; k < kSecondSide * kSecondSide; k += kReduceThreads) \
    { \
        int2 texel = origin2 + int2(k % kSecondSide, k / kSecondSide); \
        int2 within = clamp(texel, 0, int(kPyramidSize##second) - 1); \
        gSecondReduced[k] = secondReduced(within, kPyramidSize##second, kPyramidSize##first, origin1); \
        [branch] if (reducesTexel(texel, group, 8)) \
            gEntry##second##Store[texel] = gSecondReduced[k]; \
    } \
    GroupMemoryBarrierWithGroupSync(); \
    [branch] if (inGroup < 16) \
    { \
        int2 texel = 4 * group + int2(inGroup % 4, inGroup / 4); \
        gEntry##third##Store[texel] = thirdReduced(texel, kPyramidSize##third, kPyramidSize##second, origin2); \
    } \
}
PYRAMID_REDUCE_CS(ReduceFine, 0, 1, 2, 3)
PYRAMID_REDUCE_CS(ReduceCoarse, 3, 4, 5, 6)
PYRAMID_CS(LinkedLight6, gLight6Store, kPyramidSize6)
PYRAMID_CS(LinkedLight5, gLight5Store, kPyramidSize5)
PYRAMID_CS(LinkedLight4, gLight4Store, kPyramidSize4)
// The level with the links is as large as their map, or the base where that is smaller.
#if TEGUMENT_MAP_SIZE >= 2048
PYRAMID_LINKS_CS(LinkedLight3, 3, COARSER(4), anyLinks)
PYRAMID_CS(LinkedLight2, gLight2Store, kPyramidSize2)
PYRAMID_CS(LinkedLight1, gLight1Store, kPyramidSize1)
PYRAMID_CS(LinkedLight0, gLight0Store, kPyramidSize0)
PYRAMID_LINKS_CS(FineTop, 3, 0.0, fineLinks)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight3Map")
#else
PYRAMID_CS(LinkedLight3, gLight3Store, kPyramidSize3)
#if TEGUMENT_MAP_SIZE >= 1024
PYRAMID_LINKS_CS(LinkedLight2, 2, COARSER(3), anyLinks)
PYRAMID_CS(LinkedLight1, gLight1Store, kPyramidSize1)
PYRAMID_CS(LinkedLight0, gLight0Store, kPyramidSize0)
PYRAMID_LINKS_CS(FineTop, 2, 0.0, fineLinks)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight2Map")
#else
PYRAMID_CS(LinkedLight2, gLight2Store, kPyramidSize2)
PYRAMID_CS(FineTop, gLight2Store, kPyramidSize2)
#if TEGUMENT_MAP_SIZE >= 512
PYRAMID_LINKS_CS(LinkedLight1, 1, COARSER(2), anyLinks)
PYRAMID_CS(LinkedLight0, gLight0Store, kPyramidSize0)
PYRAMID_LINKS_CS(FineLight, 1, COARSER(2), fineLinks)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight2Map") TG_COMPUTE_PASS(FineLight, FineLightCS, "gLight1Map")
#else
PYRAMID_CS(LinkedLight1, gLight1Store, kPyramidSize1)
PYRAMID_LINKS_CS(LinkedLight0, 0, COARSER(1), anyLinks)
PYRAMID_LINKS_CS(FineLight, 0, COARSER(1), fineLinks)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight2Map") TG_COMPUTE_PASS(FineLight, FineLightCS, "gLight0Map")
#endif
#endif
#endif

struct PlaceVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 normal : TEXCOORD1;
};

PlaceVarying PlaceVS(TgVertexInput stored)
{
    SurfaceVarying surface = SurfaceVS(stored);
    PlaceVarying output;
    output.position = surface.position;
    output.uv = surface.uv;
    output.normal = surface.normal;
    return output;
}

// A unit vector as a point of the square -1..1: on the octahedron |x| + |y| + |z| = 1 whose lower half is folded over the upper one
// (Meyer et al. 2010, "On Floating-Point Normal Vectors").
float2 folded(float2 p)
{
    return (1.0 - abs(p.yx)) * float2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
}

float2 octahedral(float3 n)
{
    n /= max(abs(n.x) + abs(n.y) + abs(n.z), 1e-20);
    return n.z < 0.0 ? folded(n.xy) : n.xy;
}

float3 fromOctahedral(float2 p)
{
    float z = 1.0 - abs(p.x) - abs(p.y);
    return normalize(float3(z < 0.0 ? folded(p) : p, z));
}

float4 PlacePS(PlaceVarying input) : SV_Target0
{
    return float4(input.uv, 0.5 + 0.5 * octahedral(input.normal));
}

// pixel: counted from the upper left; depth: 0..1.
float3 placeWorld(uint2 pixel, float depth)
{
    float2 clip = float2(2.0, -2.0) * (pixel + 0.5) / gViewportSize + float2(-1.0, 1.0);
    float4 world = mul(float4(clip, depth, 1.0), gViewProjectionInverse);
    return world.xyz / world.w;
}

// From uv to that of a neighbouring pixel; far where there is none.
static const float2 kNoNeighbour = float2(1.0, 1.0);

float2 placeStep(int2 pixel, float2 uv)
{
    bool within = all(pixel >= 0) && all(pixel < int2(gViewportSize));
    int3 at = int3(clamp(pixel, int2(0, 0), int2(gViewportSize) - 1), 0);
    return within && gPlaceDepthMap.Load(at).x < 1.0 ? gPlaceMap.Load(at).xy - uv : kNoNeighbour;
}

// Squared length of the step between two neighbours: of their mean, or where they differ of the shorter, for the other leads over the
// border of a chart or to another body.
float stepBetween(float2 after, float2 before)
{
    float2 mean = 0.5 * (after - before);
    float least = min(dot(after, after), dot(before, before));
    float most = max(dot(after, after), dot(before, before));
    return most < 2.0 * least ? dot(mean, mean) : least < 1.0 ? least : 0.0;
}

// Of a pixel in the map, the longer side.
float placeFootprint(int2 pixel, float2 uv)
{
    float along = stepBetween(placeStep(pixel + int2(1, 0), uv), placeStep(pixel - int2(1, 0), uv));
    float down = stepBetween(placeStep(pixel + int2(0, 1), uv), placeStep(pixel - int2(0, 1), uv));
    return sqrt(max(max(along, down), 1e-20));
}

// With the normal map. normal: the mesh's.
float3 placeNormal(float3 normal, float2 uv, float2 right)
{
    float4 tangent = tex2Dlod(gAtlasTangent, float4(uv, 0.0, 0.0));
    float4 world = tgWorldTangent(float4(tgSafeNormalize(tangent.xyz), tangent.w < 0.0 ? -1.0 : 1.0));
    return tgSurfaceNormal(normal, world, tex2Dgrad(gNormal, uv, right, right.yx).xyz);
}

// From a place to the nearer one of two neighbouring pixels: the other may be of another facet, or of another body.
float3 placeWay(int2 pixel, float3 world, float depth, int2 way)
{
    int2 last = int2(gViewportSize) - 1;
    int2 after = clamp(pixel + way, int2(0, 0), last);
    int2 before = clamp(pixel - way, int2(0, 0), last);
    float next = gPlaceDepthMap.Load(int3(after, 0)).x;
    float previous = gPlaceDepthMap.Load(int3(before, 0)).x;
    bool forwards = abs(next - depth) < abs(previous - depth);
    return forwards ? placeWorld(after, next) - world : world - placeWorld(before, previous);
}

[numthreads(8, 8, 1)]
void FinalCS(uint3 thread : SV_DispatchThreadID)
{
    float depth = gPlaceDepthMap.Load(int3(thread.xy, 0)).x;
    [branch] if (depth < 1.0)
    {
        float4 place = gPlaceMap.Load(int3(thread.xy, 0));
        float2 right = float2(placeFootprint(thread.xy, place.xy), 0.0);
        FinalVarying surface;
        surface.position = float4(0.0, 0.0, 0.0, 1.0);
        surface.uv = place.xy;
        surface.world = placeWorld(thread.xy, depth);
        surface.normal = fromOctahedral(2.0 * place.zw - 1.0);
        surface.tangent = 0.0; // what it is for, the normal knows
        float3 normal = placeNormal(surface.normal, place.xy, right);
        LitPoint p = finalPoint(surface, normal, tex2Dgrad(gSkin, place.xy, right, right.yx));
        LOBES_AT(p, tex2Dgrad(gNormal, place.xy, right, right.yx).xyz)
        float3 along = placeWay(thread.xy, surface.world, depth, int2(1, 0));
        float3 across = placeWay(thread.xy, surface.world, depth, int2(0, 1));
        gPictureStore[thread.xy] = finalColour(surface, p, facetNormal(p, along, across));
    }
}

#define COMPUTE_LEVEL_PASS(name, map) TG_COMPUTE_PASS(name, name##CS, map)
#define COMPUTE_PASSES \
    COMPUTE_LEVEL_PASS(Entry, "gEntry0Map") COMPUTE_LEVEL_PASS(ReduceFine, "gEntry2Map") \
    COMPUTE_LEVEL_PASS(ReduceCoarse, "gEntry5Map") COMPUTE_LEVEL_PASS(LinkedLight6, "gLight6Map") \
    COMPUTE_LEVEL_PASS(LinkedLight5, "gLight5Map") COMPUTE_LEVEL_PASS(LinkedLight4, "gLight4Map") \
    COMPUTE_LEVEL_PASS(LinkedLight3, "gLight3Map") COMPUTE_LEVEL_PASS(LinkedLight2, "gLight2Map") \
    COMPUTE_LEVEL_PASS(LinkedLight1, "gLight1Map") COMPUTE_LEVEL_PASS(LinkedLight0, "gLight0Map") FINE_COMPUTE_PASSES
#if TEGUMENT_MAP_SIZE >= 2048
#define COMPUTE_SCRIPT LINKED_STEPS("Pass=ReduceFine; Pass=ReduceCoarse;", "")
#else
#define COMPUTE_SCRIPT LINKED_STEPS("Pass=ReduceFine;", "Pass=ReduceCoarse;")
#endif
#define PLACE_SCRIPT \
    "RenderColorTarget0=gPlaceMap; RenderDepthStencilTarget=gPlaceDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=Place; Pass=Final;"
#define PLACE_PASSES \
    TG_MESH_PASS(Place, PlaceVS, PlacePS, TG_STATE_SOLID) \
    pass Final < string Script = "Draw=Compute;"; string Threads = "gPlaceMap"; > { ComputeShader = compile cs_5_0 FinalCS(); }
#endif

#endif
// SPDX-License-Identifier: MIT
