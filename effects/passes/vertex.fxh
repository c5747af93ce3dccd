// Where every pass that draws the mesh takes its vertices from. An engine that skins, morphs or instances defines the hook before it
// includes the effect (docs/your-engine.md); without it a vertex is drawn as it is stored.
//   TEGUMENT_VERTEX_STREAMS             what its vertices hold besides: members of a struct, with semantics
//   TEGUMENT_VERTEX_HOOK(rest, input)   TgMeshInput: the vertex to draw, in the space that gWorld leads out of;
//                                       rest: TgMeshInput, as stored; input: TgVertexInput, with the streams
//   TEGUMENT_VERTEX_TURN(input)         float3x3: how the pose turns directions there, dir * M; read by fur alone
//   TEGUMENT_VERTEX_HOOK_BEFORE(rest, input), TEGUMENT_VERTEX_TURN_BEFORE(input)
//                                       the same in the frame before, for motion vectors (TEGUMENT_MOTION); without them nothing bends
#ifndef TEGUMENT_PASSES_VERTEX_FXH
#define TEGUMENT_PASSES_VERTEX_FXH

#ifndef TEGUMENT_VERTEX_STREAMS
#define TEGUMENT_VERTEX_STREAMS
#endif
#ifndef TEGUMENT_VERTEX_HOOK
#define TEGUMENT_VERTEX_HOOK(rest, input) rest
#endif

struct TgVertexInput
{
    float3 position : POSITION;
    float3 normal : NORMAL;
    float4 tangent : TANGENT;
    float2 uv : TEXCOORD0;
    TEGUMENT_VERTEX_STREAMS
};

TgMeshInput vertexAtRest(TgVertexInput input)
{
    TgMeshInput rest;
    rest.position = input.position;
    rest.normal = input.normal;
    rest.tangent = input.tangent;
    rest.uv = input.uv;
    return rest;
}

// The vertex to draw.
TgMeshInput meshVertex(TgVertexInput input)
{
    return TEGUMENT_VERTEX_HOOK(vertexAtRest(input), input);
}

// Directions in the mesh's axes, from the rest pose into the one that is drawn, and back.
#ifdef TEGUMENT_VERTEX_TURN
float3 vertexTurned(float3 atRest, TgVertexInput input)
{
    return mul(atRest, TEGUMENT_VERTEX_TURN(input));
}

float3 vertexTurnedBack(float3 posed, TgVertexInput input)
{
    return mul(TEGUMENT_VERTEX_TURN(input), posed);
}
#else
float3 vertexTurned(float3 atRest, TgVertexInput input)
{
    return atRest;
}

float3 vertexTurnedBack(float3 posed, TgVertexInput input)
{
    return posed;
}
#endif

#if TEGUMENT_MOTION
// As they were in the frame before.
#ifndef TEGUMENT_VERTEX_HOOK_BEFORE
#define TEGUMENT_VERTEX_HOOK_BEFORE(rest, input) TEGUMENT_VERTEX_HOOK(rest, input)
#ifdef TEGUMENT_VERTEX_TURN
#define TEGUMENT_VERTEX_TURN_BEFORE(input) TEGUMENT_VERTEX_TURN(input)
#endif
#endif
TgMeshInput meshVertexBefore(TgVertexInput input)
{
    return TEGUMENT_VERTEX_HOOK_BEFORE(vertexAtRest(input), input);
}

#ifdef TEGUMENT_VERTEX_TURN_BEFORE
float3 vertexTurnedBefore(float3 atRest, TgVertexInput input)
{
    return mul(atRest, TEGUMENT_VERTEX_TURN_BEFORE(input));
}

float3 vertexTurnedBackBefore(float3 posed, TgVertexInput input)
{
    return mul(TEGUMENT_VERTEX_TURN_BEFORE(input), posed);
}
#else
float3 vertexTurnedBefore(float3 atRest, TgVertexInput input)
{
    return atRest;
}

float3 vertexTurnedBackBefore(float3 posed, TgVertexInput input)
{
    return posed;
}
#endif
#endif

#endif
// SPDX-License-Identifier: MIT
