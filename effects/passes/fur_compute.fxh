// Techniques StrandsCompute and CoatCompute: what the vertex shaders of StrandsSoft and CoatSoft find, found by compute shaders: once for
// the two sides of a ribbon and for the passes that draw it. Pass Roots notes what the vertices of each root hold in a texel of two maps;
// a thread for each strand then notes where its axis runs and how it is lit; the passes that draw look that up. Place of a root in the
// maps: its place in the texture of roots, that row by row holds up to 1,366.
#ifndef TEGUMENT_PASSES_FUR_COMPUTE_FXH
#define TEGUMENT_PASSES_FUR_COMPUTE_FXH

float gRibbonWhole < string UIWidget = "None"; > = 1000000.0; // pass Roots draws all roots, in one segment

#ifdef TEGUMENT_COMPUTE
#define RIBBON_COLUMNS 1366
#define RIBBON_ROOT_ROWS 256
static const float2 kRibbonRootSize = float2(RIBBON_COLUMNS, RIBBON_ROOT_ROWS);
static const float2 kRibbonValueSize = float2(RIBBON_COLUMNS, TEGUMENT_RIBBON_ROWS);
static const float kRibbonTexels = 3.0; // of a root in its texture

// x, y, z of the vertex as stored; its code (tgRibbon).
Texture2D gRibbonRootMap : RENDERCOLORTARGET < int Width = RIBBON_COLUMNS; int Height = RIBBON_ROOT_ROWS; int MipLevels = 1;
    string Format = "A32B32G32R32F"; >;
// Where it is combed to; 1, or 0 where there is no root.
Texture2D gRibbonFlowMap : RENDERCOLORTARGET < int Width = RIBBON_COLUMNS; int Height = RIBBON_ROOT_ROWS; int MipLevels = 1;
    string Format = "A32B32G32R32F"; >;
// Of each row of each strand: the axis in the world, and how far the ribbon's sides are from it, 0: nothing is drawn;
Texture2D gRibbonPlaceMap : RENDERCOLORTARGET < int Width = RIBBON_COLUMNS; int Height = TEGUMENT_RIBBON_ROWS; int MipLevels = 1;
    string Format = "A32B32G32R32F"; >;
// the way there, unit, and half of the width, pixels; the light that it sends, and RibbonVarying's faintness.
Texture2D gRibbonAsideMap : RENDERCOLORTARGET < int Width = RIBBON_COLUMNS; int Height = TEGUMENT_RIBBON_ROWS; int MipLevels = 1;
    string Format = "A16B16G16R16F"; >;
Texture2D gRibbonLightMap : RENDERCOLORTARGET < int Width = RIBBON_COLUMNS; int Height = TEGUMENT_RIBBON_ROWS; int MipLevels = 1;
    string Format = "A16B16G16R16F"; >;
TG_SAMPLER2D(gRibbonPlace, POINT, CLAMP);
TG_SAMPLER2D(gRibbonAside, POINT, CLAMP);
TG_SAMPLER2D(gRibbonLight, POINT, CLAMP);
TG_STORE2D(gRibbonPlaceStore)
TG_STORE2D(gRibbonAsideStore)
TG_STORE2D(gRibbonLightStore)

// Column and row of a root in the maps.
float2 ribbonColumn(float address)
{
    float first = furRootsHeader(6.0).x;
    float row = floor(address / kTgRibbonColumns);
    return float2(floor((address - kTgRibbonColumns * row) / kRibbonTexels + 0.01), row - floor(first / kTgRibbonColumns));
}

// The reverse.
float ribbonAddress(float2 at)
{
    float first = furRootsHeader(6.0).x;
    float row = floor(first / kTgRibbonColumns);
    float column = first - kTgRibbonColumns * row;
    float begin = at.y < 0.5 ? column - kRibbonTexels * floor(column / kRibbonTexels) : 0.0;
    return kTgRibbonColumns * (row + at.y) + kRibbonTexels * at.x + begin;
}

// Segments of a strand: rows of vertices stand closer at its tip, as meshprep/fur/ribbons puts them.
float ribbonSegments()
{
    return floor(gCoatSegments + 0.5);
}

float ribbonAlong(float row)
{
    float t = row / ribbonSegments();
    return floor((kTgRibbonRow - 1.0) * (t + 0.25 * t * (1.0 - t)) + 0.5) / (kTgRibbonRow - 1.0);
}

float ribbonRow(float along)
{
    return floor((2.5 - sqrt(6.25 - 4.0 * along)) * ribbonSegments() + 0.5);
}

struct RootVarying
{
    float4 position : SV_Position;
    float4 place : TEXCOORD0;
    float4 flow : TEXCOORD1;
};

struct RootMaps
{
    float4 flow : SV_Target0;
    float4 place : SV_Target1;
};

// A ribbon spread over its root's texel, whose centre no edge between its triangles meets.
RootVarying RibbonRootsVS(TgVertexInput input)
{
    RootVarying output;
    float2 at = ribbonColumn(input.uv.y) + float2(0.45 + 0.4 * input.tangent.w, 0.15 + 0.8 * tgRibbon(input.uv.x).along);
    output.position = float4(at / kRibbonRootSize * float2(2.0, -2.0) + float2(-1.0, 1.0), 0.5, 1.0);
    if (input.uv.y < kTgRibbonFirst)
        output.position = float4(2.0, 2.0, 2.0, 1.0);
    output.place = float4(input.position, floor(input.uv.x) + 0.5); // interpolation may move it a little
    output.flow = float4(input.tangent.xyz, 1.0);
    return output;
}

RootMaps RibbonRootsPS(RootVarying input)
{
    RootMaps maps;
    maps.place = input.place;
    maps.flow = input.flow;
    return maps;
}

// The vertex that the maps hold; uv.y: 0 where there is none.
TgVertexInput ribbonRootAt(uint2 texel)
{
    TgVertexInput input = (TgVertexInput)0;
    float4 place = gRibbonRootMap.Load(int3(texel, 0));
    float4 flow = gRibbonFlowMap.Load(int3(texel, 0));
    [branch] if (flow.w > 0.5)
    {
        float address = ribbonAddress(float2(texel));
        input.position = place.xyz;
        input.normal = tgSafeNormalize(furRootTexel(tgFurTexel(address, furRootsHeader(2.0).x), 1.0).xyz);
        input.tangent = float4(flow.xyz, 1.0);
        input.uv = float2(floor(place.w), address);
    }
    return input;
}

// As ribbonVarying finds it for both sides.
void ribbonNote(uint2 texel, TgVertexInput input, RibbonFrame frame, RibbonPlace place, float radius, float3 color, float afar)
{
    float3 toEye = frame.toEye - place.offset;
    float pixel = ribbonPixel() * length(toEye);
    float2 width = tgRibbonWidth(radius, pixel);
    float3 aside = furFromAxes(vertexTurned(tgSafeNormalize(cross(place.tangent, toEye)), input));
    gRibbonPlaceStore[texel] = float4(ribbonWorld(frame, place.offset, input), width.x + gFurEdge * pixel);
    gRibbonAsideStore[texel] = float4(aside, width.x / pixel);
    gRibbonLightStore[texel] = float4(color, afar < 0.0 ? -width.y : width.y);
}

// Half of a strand's rows, for those of `underfur`: every second one, and the tip.
float lockRows()
{
    return ceil(0.5 * ribbonSegments()) + 1.0;
}

float lockStrands()
{
    return gCoatChildren + gCoatUnderfur;
}

// number: of the strand among those of its lock, underfur last.
uint2 lockTexel(float2 at, float number, float row)
{
    return uint2(float2(at.x, (at.y * lockStrands() + number) * lockRows() + row) + 0.5);
}

void lockNote(uint2 texel, TgVertexInput input, RibbonFrame frame, float4 ball, float number)
{
    float under = step(gCoatChildren - 0.5, number);
    float child = number - gCoatChildren * under;
    LockShare share = lockShareOf(input, child, under, ribbonPixel() * length(frame.toEye));
    bool drawn = input.uv.y > 0.5 && ribbonDrawn(input, share.rank, share.share) && ribbonSeen(input, frame);
    LockLooks looks = (LockLooks)0;
    [branch] if (drawn)
        looks = lockLooks(input, frame, tgRibbon(input.uv.x), ball, furRootsHeader(2.0).x, child + kLockOfUnderfur * under, under);
    [loop] for (float row = 0.0; row < lockRows(); row += 1.0)
    {
        uint2 at = lockTexel(float2(texel), number, row);
        [branch] if (drawn)
        {
            TgRibbon ribbon = tgRibbon(input.uv.x);
            ribbon.along = max(ribbonAlong(min(2.0 * row, ribbonSegments())), share.begin);
            RibbonPlace place = lockPlace(looks.strand, ribbon.along);
            float3 color = lockColor(looks, ribbon, frame, place.offset, place.tangent, under, false, input);
            float radius = share.width * lockRadius(looks, ribbon.along, under);
            ribbonNote(at, input, frame, place, radius, color, share.afar);
        }
    }
}

static const float kLockThreads = 8.0; // share the strands of a lock

[numthreads(8, 4, 8)]
void LocksCS(uint3 thread : SV_DispatchThreadID)
{
    TgVertexInput input = ribbonRootAt(thread.xy);
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    [branch] if (input.uv.y > 0.5)
        [loop] for (float number = (float)thread.z; number < lockStrands(); number += kLockThreads)
            lockNote(thread.xy, input, frame, ball, number);
}

// What is noted of a vertex.
RibbonVarying ribbonNoted(TgVertexInput input, float2 texel)
{
    RibbonVarying output = ribbonNowhere();
    float4 at = float4((texel + 0.5) / kRibbonValueSize, 0.0, 0.0);
    float4 place = tex2Dlod(gRibbonPlace, at);
    [branch] if (place.w > 0.0)
    {
        float4 aside = tex2Dlod(gRibbonAside, at);
        float4 position = mul(float4(place.xyz + (place.w * input.tangent.w) * aside.xyz, 1.0), gViewProjection);
        position.z = tgFurNearDepth(position.z, position.w);
        output.position = TG_HALF_PIXEL(position, gViewportSize);
        output.color = tex2Dlod(gRibbonLight, at);
        output.edge = float2((aside.w + gFurEdge) * input.tangent.w, aside.w);
    }
    return output;
}

RibbonVarying lockNoted(TgVertexInput input, float number)
{
    RibbonVarying output = ribbonNowhere();
    [branch] if (input.uv.y >= kTgRibbonFirst)
    {
        float row = floor(0.5 * ribbonRow(tgRibbon(input.uv.x).along) + 0.75);
        output = ribbonNoted(input, float2(lockTexel(ribbonColumn(input.uv.y), number, row)));
    }
    return output;
}

RibbonVarying LocksNotedVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return lockNoted(input, TG_LAYER_INDEX(gFurChild));
}

RibbonVarying UnderfurNotedVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return lockNoted(input, gCoatChildren + TG_LAYER_INDEX(gFurChild));
}

// Rows of a strand stand one below the other.
uint2 strandTexel(float2 at, float row)
{
    return uint2(float2(at.x, at.y * (ribbonSegments() + 1.0) + row) + 0.5);
}

RibbonVarying StrandsNotedVS(TgVertexInput input)
{
    RibbonVarying output = ribbonNowhere();
    [branch] if (input.uv.y >= kTgRibbonFirst)
        output = ribbonNoted(input, float2(strandTexel(ribbonColumn(input.uv.y), ribbonRow(tgRibbon(input.uv.x).along))));
    return output;
}

[numthreads(8, 4, 8)]
void StrandsCS(uint3 thread : SV_DispatchThreadID)
{
    TgVertexInput input = ribbonRootAt(thread.xy);
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    RootStrand strand = (RootStrand)0;
    [branch] if (input.uv.y > 0.5)
        strand = rootStrand(input, ball, furRootsHeader(2.0).x);
    [branch] if (input.uv.y > 0.5)
        [loop] for (float row = (float)thread.z; row <= ribbonSegments(); row += kLockThreads)
        {
            uint2 at = strandTexel(float2(thread.xy), row);
            float along = ribbonAlong(row);
            [branch] if (tgRibbonRank(input.uv.y) < gFurShare)
            {
                RibbonPlace place = strandPlace(strand, frame, along);
                float3 color = rootStrandColor(strand, frame, place.offset, along, input);
                ribbonNote(at, input, frame, place, strand.radius * frame.perMm * (1.0 - along) / gFurShare, color, 1.0);
            }
        }
}

#define RIBBON_WHOLE string Share = "gRibbonWhole"; string Segment = "gRibbonWhole"; string SegmentsOf = "gFurLength"; \
    float SegmentFewest = 1.0;
#define NOTES_SCRIPT \
    "RenderColorTarget0=gRibbonFlowMap; RenderColorTarget1=gRibbonRootMap; RenderDepthStencilTarget=;" \
    "ClearSetColor=gClearEmpty; Clear=Color; Pass=Roots; RenderColorTarget1=; Pass=Notes;"
// Rows: what does not fit is an error of the host. Each of a lock's as lockRows, of a strand as strandTexel.
#define NOTED_ROWS string Part = "underfur"; string Rows = "gRibbonPlaceMap"; string RowsMacro = "TEGUMENT_RIBBON_ROWS"; \
    string RowsEach = "gCoatSegments";
#define LOCK_ROWS float RowsScale = 0.5; string RowsStrands = "gCoatChildren"; string RowsMore = "gCoatUnderfur";
// As wide as pixels of the picture: Viewport.
#define NOTES_PASSES(cs, rows) TG_SEEN_PASS(Roots, "underfur", RIBBON_WHOLE, RibbonRootsVS, RibbonRootsPS, TG_STATE_BUFFER) \
    pass Notes < string Script = "Draw=Compute;"; string Threads = "gRibbonRootMap"; string Viewport = ""; NOTED_ROWS rows > \
    { ComputeShader = compile cs_5_0 cs(); }
#define STRANDS_COMPUTE_SCRIPT LIGHT_SCRIPT(SHADOW_MAP_SCRIPT) NOTES_SCRIPT \
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Skin; Pass=Core; Pass=Fringe;" STRANDS_MOTION_SCRIPT
#define STRANDS_COMPUTE_PASSES \
    TG_PART_PASS(ShadowMap, "skin", ShadowMapVS, ShadowMapPS, TG_STATE_TWOSIDED) NOTES_PASSES(StrandsCS, float RowsScale = 1.0;) \
    TG_PART_PASS(Skin, "skin", SkinVS, SkinPS, TG_STATE_SOLID) \
    TG_SEEN_PASS(Core, "strands", RIBBON_REACH STRANDS_CORE, StrandsNotedVS, RibbonSoftCorePS, TG_STATE_STRAND) \
    TG_SEEN_PASS(Fringe, "strands", RIBBON_REACH STRANDS_SHARE, StrandsNotedVS, RibbonSoftFringePS, TG_STATE_FRINGE) \
    STRANDS_MOTION_PASSES
#define COAT_COMPUTE_SCRIPT LIGHT_SCRIPT(OPACITY_SCRIPT) NOTES_SCRIPT \
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Undercoat; Pass=Underfur; Pass=Core; Pass=Fringe;" COAT_MOTION_SCRIPT
#define COAT_COMPUTE_PASSES OPACITY_PASSES NOTES_PASSES(LocksCS, LOCK_ROWS) \
    TG_PART_PASS(Undercoat, "skin", UndercoatVS, UndercoatPS, TG_STATE_SOLID) \
    TG_SEEN_LAYER_PASS(Underfur, "underfur", LOCK_UNDER, "gCoatUnderfur", UnderfurNotedVS, UnderfurSoftPS, TG_STATE_STRAND) \
    TG_SEEN_LAYER_PASS(Core, "underfur", LOCK_CORE, "gCoatChildren", LocksNotedVS, RibbonSoftCorePS, TG_STATE_STRAND) \
    TG_SEEN_LAYER_PASS(Fringe, "underfur", LOCK_SEEN, "gCoatChildren", LocksNotedVS, RibbonSoftFringePS, TG_STATE_FRINGE) \
    COAT_MOTION_PASSES
#endif

#endif
// SPDX-License-Identifier: MIT
