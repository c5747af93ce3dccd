// With TEGUMENT_MOTION=1: passes SkinMotion and Motion, where everything was in the frame before. gMotionMap holds by how many pixels what
// a pixel shows has moved since, right and down. Of a strand its axis counts, where at least half of its ribbon's pixel is covered. Without
// the switch nothing of this is compiled, drawn or allocated.
#ifndef TEGUMENT_PASSES_FUR_MOTION_FXH
#define TEGUMENT_PASSES_FUR_MOTION_FXH

#if TEGUMENT_MOTION
float4x4 gPreviousWorld : PREVIOUSWORLD < string UIWidget = "None"; >;
float4x4 gPreviousViewProjection : PREVIOUSVIEWPROJECTION < string UIWidget = "None"; >;
float3 gCoatWindChange < string UIName = "Change of the wind"; string UIHelp = "since the frame before, as the wind"; > = { 0.0, 0.0, 0.0 };
float gTimeStep : ELAPSEDTIME < string UIWidget = "None"; string UIHelp = "since the frame before, seconds"; > = 0.0;

Texture2D gMotionMap : RENDERCOLORTARGET < PICTURE_TARGET("G16R16F") >;
Texture2D gMotionDepthMap : RENDERDEPTHSTENCILTARGET < PICTURE_DEPTH >;

// Pixels, right and down.
float2 motionOf(float4 now, float4 before)
{
    float2 moved = now.xy / now.w - before.xy / max(before.w, 1e-6 * now.w); // what was behind the eye comes from far away
    return moved * float2(0.5, -0.5) * gViewportSize;
}

struct SkinMotionVarying
{
    float4 position : SV_Position;
    float4 now : TEXCOORD0;    // in clip space
    float4 before : TEXCOORD1;
};

SkinMotionVarying SkinMotionVS(TgVertexInput input)
{
    SkinMotionVarying output;
    output.now = mul(float4(tgWorldPosition(meshVertex(input).position), 1.0), gViewProjection);
    output.before = mul(float4(tgWorldPosition(meshVertexBefore(input).position, gPreviousWorld), 1.0), gPreviousViewProjection);
    float4 position = output.now;
    position.z = tgFurNearDepth(position.z, position.w);
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    return output;
}

float4 SkinMotionPS(SkinMotionVarying input) : SV_Target0
{
    return float4(motionOf(input.now, input.before), 0.0, 1.0);
}

// A direction of the world in the axes of the mesh at rest, and a way from a root in the world, as they were.
float3 strandsAxesBefore(float3 v, TgVertexInput stored)
{
    return vertexTurnedBackBefore(tgMeshAxes(v, gPreviousWorld), stored);
}

float3 ribbonWorldBefore(float3 offset, TgVertexInput input)
{
    float3 v = vertexTurnedBefore(offset, input);
    return tgWorldPosition(meshVertexBefore(input).position, gPreviousWorld) + furFromAxes(v, gPreviousWorld);
}

// offset: of the axis from the root now, before: then.
RibbonVarying ribbonMoved(TgVertexInput input, RibbonFrame frame, RibbonPlace place, float radius, float3 before)
{
    float4 now = mul(float4(ribbonWorld(frame, place.offset, input), 1.0), gViewProjection);
    float4 then = mul(float4(ribbonWorldBefore(before, input), 1.0), gPreviousViewProjection);
    return ribbonVarying(input, frame, place.offset, place.tangent, radius, float3(motionOf(now, then), 0.0));
}

RibbonVarying StrandsMotionVS(TgVertexInput input)
{
    RibbonVarying output = ribbonNowhere();
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    [branch] if (ribbonDrawn(input, tgRibbonRank(input.uv.y), gFurShare))
    {
        RootStrand strand = rootStrand(input, ball, furRootsHeader(2.0).x);
        float along = tgRibbon(input.uv.x).along;
        RibbonPlace place = strandPlace(strand, frame, along);
        RootStrand before = strand;
        before.lean += strandsAxesBefore(furHang(), input) - strandsAxes(furHang(), input);
        float radius = strandRadius(strand, frame, along);
        output = ribbonMoved(input, frame, place, radius, strandPlace(before, frame, along).offset);
    }
    return output;
}

RibbonVarying LocksMotionVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    RibbonVarying output = ribbonNowhere();
    float child = TG_LAYER_INDEX(gFurChild);
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    LockShare share = lockShareOf(input, child, 0.0, ribbonPixel() * length(frame.toEye));
    [branch] if (ribbonDrawn(input, share.rank, share.share) && ribbonSeen(input, frame))
    {
        TgRibbon ribbon = tgRibbon(input.uv.x);
        ribbon.along = max(ribbon.along, share.begin);
        LockLooks looks = lockLooks(input, frame, ribbon, ball, furRootsHeader(2.0).x, child, 0.0);
        RibbonPlace place = lockPlace(looks.strand, ribbon.along);
        float3 wind = strandsAxesBefore(gCoatWind - gCoatWindChange, input);
        float3 blown = lockBlownBy(looks, input, wind, gTime - gTimeStep) - lockBlown(looks, input);
        LockStrand before = looks.strand;
        before.stray += (blown - before.normal * dot(blown, before.normal)) * before.height;
        float radius = share.width * lockRadius(looks, ribbon.along, 0.0);
        output = ribbonMoved(input, frame, place, radius, lockPlace(before, ribbon.along).offset);
    }
    return output;
}

float4 RibbonMotionPS(RibbonVarying input) : SV_Target0
{
    clip(input.edge.y - abs(input.edge.x));
    return float4(input.color.rg, 0.0, 1.0);
}

#define MOTION_SCRIPT "RenderColorTarget0=gMotionMap; RenderDepthStencilTarget=gMotionDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color; Clear=Depth; Pass=SkinMotion;"
#define STRANDS_MOTION_SCRIPT MOTION_SCRIPT "Pass=Motion;"
#define COAT_MOTION_SCRIPT MOTION_SCRIPT TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Motion")
#define STRANDS_MOTION_PASSES TG_PART_PASS(SkinMotion, "skin", SkinMotionVS, SkinMotionPS, TG_STATE_SOLID) \
    TG_SEEN_PASS(Motion, "strands", RIBBON_REACH STRANDS_SHARE, StrandsMotionVS, RibbonMotionPS, TG_STATE_TWOSIDED)
#define COAT_MOTION_PASSES TG_PART_PASS(SkinMotion, "skin", SkinMotionVS, SkinMotionPS, TG_STATE_SOLID) \
    TG_SEEN_LAYER_PASS(Motion, "underfur", LOCK_SEEN, "gCoatChildren", LocksMotionVS, RibbonMotionPS, TG_STATE_TWOSIDED)
#else
#define STRANDS_MOTION_SCRIPT ""
#define COAT_MOTION_SCRIPT ""
#define STRANDS_MOTION_PASSES
#define COAT_MOTION_PASSES
#endif

#endif
// SPDX-License-Identifier: MIT
