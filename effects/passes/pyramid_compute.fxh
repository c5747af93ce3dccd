// The passes of PyramidLinked as compute shaders, but for ShadowMap: a thread for each texel of a map. What the picture shows is drawn
// once, without shading, into gPlaceMap and gPlaceNormalMap, and lit by pass Final from there. Pixel shaders run on a part of some chips;
// these run on all.
#ifndef TEGUMENT_PASSES_PYRAMID_COMPUTE_FXH
#define TEGUMENT_PASSES_PYRAMID_COMPUTE_FXH

float4x4 gViewProjectionInverse : VIEWPROJECTIONINVERSE < string UIWidget = "None"; >;

#ifdef TEGUMENT_COMPUTE
// u, v, distance from the eye in world units, step of u and v from pixel to pixel; 0: nothing is seen.
Texture2D gPlaceMap : RENDERCOLORTARGET < PICTURE_TARGET("A32B32G32R32F") >;
// The normals there, with the normal map and the mesh's own, each as a point of an octahedron: a map of texels would be too coarse.
Texture2D gPlaceNormalMap : RENDERCOLORTARGET < PICTURE_TARGET("A32B32G32R32F") >;
Texture2D gPlaceDepthMap : RENDERDEPTHSTENCILTARGET < PICTURE_DEPTH >;
TG_SAMPLER2D(gPlace, POINT, CLAMP);
TG_SAMPLER2D(gPlaceNormal, POINT, CLAMP);
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

QuadVarying texelAt(uint3 thread, float size)
{
    QuadVarying input;
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

// The same where a chart is near; 16 texels of the base from any, nothing reads a level.
#define PYRAMID_CHARTS_CS(name, store, size) \
[numthreads(8, 8, 1)] \
void name##CS(uint3 thread : SV_DispatchThreadID) \
{ \
    QuadVarying input = texelAt(thread, size); \
    float4 light = 0.0; \
    [branch] if (tex2Dlod(gAtlasMetric, float4(input.uv, 0.0, 0.0)).w > 0.5) \
        light = name##PS(input); \
    store[thread.xy] = light; \
}

// Texels that no chart covers have nothing to light.
[numthreads(8, 8, 1)]
void EntryCS(uint3 thread : SV_DispatchThreadID)
{
    float2 uv = texelAt(thread, kPyramidSize0).uv;
    float4 light = 0.0;
    [branch] if (tex2Dlod(gAtlasPosition, float4(uv, 0.0, 0.0)).w > 0.0)
        light = entryLight(uv, tex2Dgrad(gSkin, uv, float2(1.0 / kPyramidSize0, 0.0), float2(0.0, 1.0 / kPyramidSize0)));
    gEntry0Store[thread.xy] = light;
}

PYRAMID_CS(Reduce1, gEntry1Store, kPyramidSize1)
PYRAMID_CS(Reduce2, gEntry2Store, kPyramidSize2)
PYRAMID_CS(Reduce3, gEntry3Store, kPyramidSize3)
PYRAMID_CS(Reduce4, gEntry4Store, kPyramidSize4)
PYRAMID_CS(Reduce5, gEntry5Store, kPyramidSize5)
PYRAMID_CS(Reduce6, gEntry6Store, kPyramidSize6)
PYRAMID_CS(LinkedLight6, gLight6Store, kPyramidSize6)
PYRAMID_CS(LinkedLight5, gLight5Store, kPyramidSize5)
PYRAMID_CS(LinkedLight4, gLight4Store, kPyramidSize4)
PYRAMID_CS(LinkedLight3, gLight3Store, kPyramidSize3)
PYRAMID_CHARTS_CS(LinkedLight2, gLight2Store, kPyramidSize2)
PYRAMID_CHARTS_CS(LinkedLight1, gLight1Store, kPyramidSize1)
PYRAMID_CHARTS_CS(LinkedLight0, gLight0Store, kPyramidSize0)
#if TEGUMENT_MAP_SIZE >= 2048
PYRAMID_CS(FineTop, gLight3Store, kPyramidSize3)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight3Map")
#elif TEGUMENT_MAP_SIZE >= 1024
PYRAMID_CHARTS_CS(FineTop, gLight2Store, kPyramidSize2)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight2Map")
#else
PYRAMID_CHARTS_CS(FineTop, gLight2Store, kPyramidSize2)
#if TEGUMENT_MAP_SIZE >= 512
PYRAMID_CHARTS_CS(FineLight, gLight1Store, kPyramidSize1)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight2Map") TG_COMPUTE_PASS(FineLight, FineLightCS, "gLight1Map")
#else
PYRAMID_CHARTS_CS(FineLight, gLight0Store, kPyramidSize0)
#define FINE_COMPUTE_PASSES TG_COMPUTE_PASS(FineTop, FineTopCS, "gLight2Map") TG_COMPUTE_PASS(FineLight, FineLightCS, "gLight0Map")
#endif
#endif

struct PlaceVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float3 toEye : TEXCOORD1; // world units
    float3 normal : TEXCOORD2;
    float4 tangent : TEXCOORD3;
};

struct PlaceOutput
{
    float4 place : SV_Target0;
    float4 normals : SV_Target1;
};

PlaceVarying PlaceVS(VertexInput stored)
{
    SurfaceVarying surface = SurfaceVS(stored);
    PlaceVarying output;
    output.position = surface.position;
    output.uv = surface.uv;
    output.toEye = gCameraPosition - surface.world;
    output.normal = surface.normal;
    output.tangent = surface.tangent;
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
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    return n.z < 0.0 ? folded(n.xy) : n.xy;
}

float3 fromOctahedral(float2 p)
{
    float z = 1.0 - abs(p.x) - abs(p.y);
    return normalize(float3(z < 0.0 ? folded(p) : p, z));
}

PlaceOutput PlacePS(PlaceVarying input)
{
    PlaceOutput output;
    float2 right = ddx(input.uv);
    float2 down = ddy(input.uv);
    float3 normal = tgSurfaceNormal(input.normal, input.tangent, tex2D(gNormal, input.uv).xyz);
    output.place = float4(input.uv, length(input.toEye), sqrt(max(max(dot(right, right), dot(down, down)), 1e-20)));
    output.normals = float4(octahedral(normal), octahedral(tgSafeNormalize(input.normal)));
    return output;
}

// pixel: counted from the upper left.
float3 placeWorld(uint2 pixel, float distance)
{
    float2 clip = float2(2.0, -2.0) * (pixel + 0.5) / gViewportSize + float2(-1.0, 1.0);
    float4 far = mul(float4(clip, 1.0, 1.0), gViewProjectionInverse);
    return gCameraPosition + distance * tgSafeNormalize(far.xyz / far.w - gCameraPosition);
}

[numthreads(8, 8, 1)]
void FinalCS(uint3 thread : SV_DispatchThreadID)
{
    float4 place = gPlaceMap.Load(int3(thread.xy, 0));
    [branch] if (place.w > 0.0)
    {
        float2 right = float2(place.w, 0.0);
        float4 normals = gPlaceNormalMap.Load(int3(thread.xy, 0));
        FinalVarying surface;
        surface.position = float4(0.0, 0.0, 0.0, 1.0);
        surface.uv = place.xy;
        surface.world = placeWorld(thread.xy, place.z);
        surface.normal = fromOctahedral(normals.zw);
        surface.tangent = 0.0; // what it is for, the normal knows
        LitPoint p = finalPoint(surface, fromOctahedral(normals.xy), tex2Dgrad(gSkin, surface.uv, right, right.yx));
        gPictureStore[thread.xy] = finalColour(surface, p);
    }
}

#define COMPUTE_LEVEL_PASS(name, map) TG_COMPUTE_PASS(name, name##CS, map)
#define COMPUTE_PASSES \
    COMPUTE_LEVEL_PASS(Entry, "gEntry0Map") COMPUTE_LEVEL_PASS(Reduce1, "gEntry1Map") COMPUTE_LEVEL_PASS(Reduce2, "gEntry2Map") \
    COMPUTE_LEVEL_PASS(Reduce3, "gEntry3Map") COMPUTE_LEVEL_PASS(Reduce4, "gEntry4Map") COMPUTE_LEVEL_PASS(Reduce5, "gEntry5Map") \
    COMPUTE_LEVEL_PASS(Reduce6, "gEntry6Map") COMPUTE_LEVEL_PASS(LinkedLight6, "gLight6Map") \
    COMPUTE_LEVEL_PASS(LinkedLight5, "gLight5Map") COMPUTE_LEVEL_PASS(LinkedLight4, "gLight4Map") \
    COMPUTE_LEVEL_PASS(LinkedLight3, "gLight3Map") COMPUTE_LEVEL_PASS(LinkedLight2, "gLight2Map") \
    COMPUTE_LEVEL_PASS(LinkedLight1, "gLight1Map") COMPUTE_LEVEL_PASS(LinkedLight0, "gLight0Map") FINE_COMPUTE_PASSES
#define PLACE_SCRIPT \
    "RenderColorTarget0=gPlaceMap; RenderColorTarget1=gPlaceNormalMap; RenderDepthStencilTarget=gPlaceDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=Place; RenderColorTarget1=; Pass=Final;"
#define PLACE_PASSES \
    TG_MESH_PASS(Place, PlaceVS, PlacePS, TG_STATE_SOLID) \
    pass Final < string Script = "Draw=Compute;"; string Threads = "gPlaceMap"; > { ComputeShader = compile cs_5_0 FinalCS(); }
#endif

#endif
