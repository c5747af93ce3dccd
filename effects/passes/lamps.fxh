// Lamps beside the light of the workspace (TEGUMENT_LAMPS), and what of them is seen. Each that throws a shadow (TEGUMENT_LAMP_SHADOWS)
// draws the mesh into a shadow map of its own, fitted to the mesh's bounding sphere; pass LampsSeen then asks all maps once for each texel
// of the skin, so that whatever is lit afterwards reads one texel; passes LampBlocks say where that is settled without a tap. Techniques
// begin with LAMPS_SCRIPT and LAMPS_PASSES; without lamps both are empty.
#ifndef TEGUMENT_PASSES_LAMPS_FXH
#define TEGUMENT_PASSES_LAMPS_FXH

#if TEGUMENT_LAMP_SHADOWS
float3 gLampBody : BOUNDINGCENTER < string UIWidget = "None"; >;
float gLampBodyRadius : BOUNDINGSPHERESIZE < string UIWidget = "None"; >;

Texture2D gLampDepthMap : RENDERDEPTHSTENCILTARGET < SQUARE_DEPTH(TEGUMENT_SHADOW_SIZE) >;
Texture2D gLampsSeenMap : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_MAP_SIZE, "A16B16G16R16F") bool Keeps = true; >;
TG_SAMPLER2D(gLampsSeen, LINEAR, CLAMP);

TgLampView lampView(int i)
{
    float3 up = tgWorldNormal(float3(0.0, 1.0, 0.0));
    return tgLampView(gLampPlace[i], gLampBody, gLampBodyRadius, up, tgWorldNormal(float3(1.0, 0.0, 0.0)));
}

struct LampDepthVarying
{
    float4 position : SV_Position;
    float depth : TEXCOORD0; // mm
};

LampDepthVarying lampDepth(TgVertexInput stored, int i)
{
    LampDepthVarying output;
    TgLampView view = lampView(i);
    float3 world = tgWorldPosition(meshVertex(stored).position);
    output.position = TG_HALF_PIXEL(tgLampClip(view, world), gViewportSize);
    output.depth = tgMillimetres(tgLampDepth(view, world));
    return output;
}

float4 LampDepthPS(LampDepthVarying input) : SV_Target0
{
    return float4(input.depth, 0.0, 0.0, 1.0);
}

// With the texels' alpha, so that what lies between charts does not count.
float3 lampsSeen(float2 uv)
{
    float4 texel = tex2Dlod(gLampsSeen, float4(uv, 0.0, 0.0));
    return texel.w > 0.0 ? texel.rgb / texel.w : 1.0;
}

// Of each lamp the place in its map, times w in zw: mm away from it along its axis, mm across a texel of the map; its right.
struct LampsSeenVarying
{
    float4 position : SV_Position;
    float3 world : TEXCOORD0; // world units
    float3 normal : TEXCOORD1;
    float4 place[TEGUMENT_LAMP_SHADOWS] : TEXCOORD2;
    float3 right[TEGUMENT_LAMP_SHADOWS] : TEXCOORD5;
    float2 uv : TEXCOORD8;
};

LampsSeenVarying LampsSeenVS(TgVertexInput stored)
{
    TgMeshInput input = meshVertex(stored);
    LampsSeenVarying output;
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(input.uv, 0.0), gViewportSize);
    output.uv = input.uv;
    output.world = tgWorldPosition(input.position);
    output.normal = tgWorldNormal(input.normal);
    [unroll] for (int i = 0; i < TEGUMENT_LAMP_SHADOWS; i++)
    {
        TgLampView view = lampView(i);
        float4 clip = tgLampClip(view, output.world);
        float footprint = tgShadowFootprint(1.0, tgMillimetres(view.spread));
        output.place[i] = float4(clip.xy * footprint, tgMillimetres(tgLampDepth(view, output.world)), clip.w * footprint);
        output.right[i] = view.right;
    }
    return output;
}

// Radius of the shadow's filter: so many texels of the skin, which it covers (a disc of 0.56 has the variance of 4 x 4 taps over the
// texel); at least and at most so many texels of the shadow map.
static const float3 kLampFilter = float3(0.56, 1.7, 13.0);

struct LampReceiver
{
    float4 place; // as it comes from the vertices
    float depth;  // mm, less tolerance
    float2 slope;
    float cosine; // N.L of the mesh
    float texel;  // mm across a texel of the skin
    float2 way;   // of the filter's first tap: another from texel to texel of the skin
};

#if TEGUMENT_SOFT_SHADOWS
// The lamp has its radius; what hides it is taken to be no nearer to it than it is wide.
float lampOpen(TG_SAMPLER2D_PARAM(map), TG_SAMPLER2D_PARAM(blocks), int i, LampReceiver r)
{
    bool near = gLampPlace[i].w > 0.5;
    float radius = gLampAxis[i].w;
    float2 size = near ? float2(tgMillimetres(radius), 1.0) : float2(radius * rsqrt(max(1.0 - radius * radius, 0.1)), 0.0);
    float nearest = max(tgMillimetres(lampView(i).near), 2.0 * size.x * size.y);
    return tgShadowSoft(TG_SAMPLER2D_ARG(map), TG_SAMPLER2D_ARG(blocks), tgShadowCoordinate(r.place), r.depth, r.slope, r.place.w, size,
                        nearest, r.way);
}
#else
// The lamp is a point. Seen from it a texel of the skin is as much smaller as it is turned away.
float lampOpen(TG_SAMPLER2D_PARAM(map), TG_SAMPLER2D_PARAM(blocks), int i, LampReceiver r)
{
    float2 size = float2(0.0, gLampPlace[i].w > 0.5 ? 1.0 : 0.0);
    float radius = clamp(kLampFilter.x * r.texel * saturate(r.cosine) / r.place.w, kLampFilter.y, kLampFilter.z);
    return tgShadowDiscSpared(TG_SAMPLER2D_ARG(map), TG_SAMPLER2D_ARG(blocks), tgShadowCoordinate(r.place), r.depth, r.slope, size, radius,
                              float2(1.0, 0.0));
}
#endif

// Behind a lamp, w < 0, all is beyond its map, which is lit.
float lampSeen(TG_SAMPLER2D_PARAM(map), TG_SAMPLER2D_PARAM(blocks), int i, LampsSeenVarying input, float3 normal, LampReceiver r)
{
    float3 toLight = tgSafeNormalize(tgLampVector(gLampPlace[i], input.world));
    float3 axis = tgLampAxis(gLampPlace[i], gLampBody);
    float3 right = input.right[i];
    r.place = input.place[i];
    r.slope = tgShadowPlanarSlope(normal, right, cross(right, axis), toLight, axis, r.place.w);
    float tolerance = gShadowTolerance * (kTgDepthInMillimetres ? 1.0 : tgMillimetres(2.0 * gLampBodyRadius));
    r.depth = r.place.z - tolerance - abs(r.slope.x) - abs(r.slope.y);
    r.cosine = dot(normal, toLight);
    // Where the surface turns away from the lamp, no map need say so.
    float seen = tgShadowPlanarHorizon(r.cosine);
    [branch] if (seen > 0.0)
        seen *= lampOpen(TG_SAMPLER2D_ARG(map), TG_SAMPLER2D_ARG(blocks), i, r);
    return seen;
}

#define LAMP_BLOCKS ((TEGUMENT_SHADOW_SIZE + 7) / 8)
#define LAMP_SHADOW(number, i) \
Texture2D gLampShadow##number##Map : RENDERCOLORTARGET < SQUARE_TARGET(TEGUMENT_SHADOW_SIZE, "R32F") >; \
Texture2D gLampBlocks##number##Map : RENDERCOLORTARGET < SQUARE_TARGET(LAMP_BLOCKS, "A32B32G32R32F") >; \
TG_SAMPLER2D(gLampShadow##number, POINT, CLAMP); \
TG_SAMPLER2D(gLampBlocks##number, POINT, CLAMP); \
LampDepthVarying LampShadow##number##VS(TgVertexInput stored) \
{ \
    return lampDepth(stored, i); \
} \
float4 LampBlocks##number##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return tgShadowBlock(TG_SAMPLER2D_ARG(gLampShadow##number), floor(input.uv * kTgBlocks)); \
}
#define LAMP_SHADOW_SCRIPT(number) \
    "RenderColorTarget0=gLampShadow" number "Map; RenderDepthStencilTarget=gLampDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=LampShadow" number ";" \
    "RenderColorTarget0=gLampBlocks" number "Map; RenderDepthStencilTarget=; Pass=LampBlocks" number ";"
#define LAMP_SHADOW_PASS(number) \
    TG_MESH_PASS(LampShadow##number, LampShadow##number##VS, LampDepthPS, TG_STATE_TWOSIDED) \
    TG_QUAD_PASS(LampBlocks##number, TgQuadVS, LampBlocks##number##PS, TG_STATE_BUFFER)

LAMP_SHADOW(1, 0)
#if TEGUMENT_LAMP_SHADOWS > 1
LAMP_SHADOW(2, 1)
#endif
#if TEGUMENT_LAMP_SHADOWS > 2
LAMP_SHADOW(3, 2)
#endif

float4 LampsSeenPS(LampsSeenVarying input) : SV_Target0
{
    LampReceiver r = (LampReceiver)0;
    float3 normal = tgSafeNormalize(input.normal);
    r.texel = tgMillimetres(length(ddx(input.world)));
    r.way = tgSoftWay(2.0 * kTgPi * tgSoftNoise(input.uv * kTgMapSize));
    float4 seen = 1.0;
    seen.x = lampSeen(TG_SAMPLER2D_ARG(gLampShadow1), TG_SAMPLER2D_ARG(gLampBlocks1), 0, input, normal, r);
#if TEGUMENT_LAMP_SHADOWS > 1
    seen.y = lampSeen(TG_SAMPLER2D_ARG(gLampShadow2), TG_SAMPLER2D_ARG(gLampBlocks2), 1, input, normal, r);
#endif
#if TEGUMENT_LAMP_SHADOWS > 2
    seen.z = lampSeen(TG_SAMPLER2D_ARG(gLampShadow3), TG_SAMPLER2D_ARG(gLampBlocks3), 2, input, normal, r);
#endif
    return seen;
}

#define LAMPS_SEEN_SCRIPT \
    "RenderColorTarget0=gLampsSeenMap; RenderDepthStencilTarget=; ClearSetColor=gClearEmpty; Clear=Color; Pass=LampsSeen;"
#define LAMPS_SEEN_PASS TG_MESH_PASS(LampsSeen, LampsSeenVS, LampsSeenPS, TG_STATE_BUFFER)
#if TEGUMENT_LAMP_SHADOWS == 1
#define LAMPS_SCRIPT LAMP_SHADOW_SCRIPT("1") LAMPS_SEEN_SCRIPT
#define LAMPS_PASSES LAMP_SHADOW_PASS(1) LAMPS_SEEN_PASS
#elif TEGUMENT_LAMP_SHADOWS == 2
#define LAMPS_SCRIPT LAMP_SHADOW_SCRIPT("1") LAMP_SHADOW_SCRIPT("2") LAMPS_SEEN_SCRIPT
#define LAMPS_PASSES LAMP_SHADOW_PASS(1) LAMP_SHADOW_PASS(2) LAMPS_SEEN_PASS
#else
#define LAMPS_SCRIPT LAMP_SHADOW_SCRIPT("1") LAMP_SHADOW_SCRIPT("2") LAMP_SHADOW_SCRIPT("3") LAMPS_SEEN_SCRIPT
#define LAMPS_PASSES LAMP_SHADOW_PASS(1) LAMP_SHADOW_PASS(2) LAMP_SHADOW_PASS(3) LAMPS_SEEN_PASS
#endif
#else
#define LAMPS_SCRIPT ""
#define LAMPS_PASSES

float3 lampsSeen(float2 uv)
{
    return 1.0;
}
#endif

#endif
// SPDX-License-Identifier: MIT
