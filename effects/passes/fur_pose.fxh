// With TEGUMENT_FUR_POSE=1: strands on a body that bends. A texture as large as that of the roots says where each root's triangle has taken
// it (`tegument fur pose`, docs/design/fur.md "Bodies that bend"); the skin's vertices come posed. By the vertex hook: an engine that
// defines its own wins.
#ifndef TEGUMENT_PASSES_FUR_POSE_FXH
#define TEGUMENT_PASSES_FUR_POSE_FXH

#include "fur_roots_map.fxh"
#include "fur_roots_texture.fxh"

Texture2D gFurPoseMap < float4 Fallback = { 0.0, 0.0, 0.0, 0.0 }; string UIName = "Pose of the roots";
    string UIHelp = "from tegument fur pose; none: at rest"; >;
TG_SAMPLER2D(gFurPose, POINT, CLAMP);

// Number 0: how far the root has moved, in the unit of vertices; 1: how its triangle has turned, a quaternion. Skin has none.
float4 furPoseTexel(TG_SAMPLER2D_PARAM(pose), float address, float number)
{
    float2 texel = tgFurTexel(address, furRootsHeader(2.0).x);
    float4 stored = TG_TEX2DLOD(pose, float4(texel.x + number / kTgFurRootsWidth, texel.y, 0.0, 0.0));
    return address >= kTgRibbonFirst ? stored : float4(0.0, 0.0, 0.0, 0.0);
}

// Zeros turn nothing.
float3 furPoseTurned(float3 v, float4 turn)
{
    return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
}

float3x3 furPoseMatrix(TG_SAMPLER2D_PARAM(pose), float address)
{
    float4 turn = furPoseTexel(TG_SAMPLER2D_ARG(pose), address, 1.0);
    return float3x3(furPoseTurned(float3(1.0, 0.0, 0.0), turn), furPoseTurned(float3(0.0, 1.0, 0.0), turn),
                    furPoseTurned(float3(0.0, 0.0, 1.0), turn));
}

TgMeshInput furPosed(TG_SAMPLER2D_PARAM(pose), TgMeshInput rest)
{
    float4 turn = furPoseTexel(TG_SAMPLER2D_ARG(pose), rest.uv.y, 1.0);
    rest.position += furPoseTexel(TG_SAMPLER2D_ARG(pose), rest.uv.y, 0.0).xyz;
    rest.normal = furPoseTurned(rest.normal, turn);
    rest.tangent.xyz = furPoseTurned(rest.tangent.xyz, turn);
    return rest;
}

#ifndef TEGUMENT_VERTEX_HOOK
#define TEGUMENT_VERTEX_HOOK(rest, input) furPosed(TG_SAMPLER2D_ARG(gFurPose), rest)
#define TEGUMENT_VERTEX_TURN(input) furPoseMatrix(TG_SAMPLER2D_ARG(gFurPose), (input).uv.y)
#if TEGUMENT_MOTION
Texture2D gFurPoseBeforeMap < float4 Fallback = { 0.0, 0.0, 0.0, 0.0 }; string UIName = "Pose of the frame before"; >;
TG_SAMPLER2D(gFurPoseBefore, POINT, CLAMP);
#define TEGUMENT_VERTEX_HOOK_BEFORE(rest, input) furPosed(TG_SAMPLER2D_ARG(gFurPoseBefore), rest)
#define TEGUMENT_VERTEX_TURN_BEFORE(input) furPoseMatrix(TG_SAMPLER2D_ARG(gFurPoseBefore), (input).uv.y)
#endif
#endif

#endif
// SPDX-License-Identifier: MIT
