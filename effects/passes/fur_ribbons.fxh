// Ribbons (`tegument fur strands`, docs/design/fur.md): a vertex stands on its strand's root and holds its place along the strand;
// here it goes to its place in space, beside the axis, so that the ribbon faces the eye. All light is found at vertices; pixels know how
// far they are from the axis. Lengths along the mesh's axes at rest, in units of the world.
#ifndef TEGUMENT_PASSES_FUR_RIBBONS_FXH
#define TEGUMENT_PASSES_FUR_RIBBONS_FXH

// centroid: with several samples a pixel, light would be taken at the pixel's centre, outside of a triangle that is narrower than a pixel,
// far beyond what its corners hold. The distance from the axis is the same plane everywhere, and is taken at the centre.
struct RibbonVarying
{
    float4 position : SV_Position;
    centroid float4 color : TEXCOORD0; // and tgRibbonWidth's faintness, below 0 where all of the strand is fringe
    float2 edge : TEXCOORD1; // distance from the axis, half of the width: with the faintness what tgRibbonCoverage asks for
};

float3 ribbonEdge(RibbonVarying input)
{
    return float3(input.edge, abs(input.color.w));
}

// A root where it stands in the world, and what is seen from it.
struct RibbonFrame
{
    float3 world;
    float3 toEye;   // not unit, as the next
    float3 toLight; // of parallel light: against its rays
    float perMm;    // world units in a mm of the roots' mesh
};

// A place on a strand.
struct RibbonPlace
{
    float3 offset;  // from the root
    float3 tangent; // unit
};

// Nothing of the vertex's triangles is drawn.
RibbonVarying ribbonNowhere()
{
    RibbonVarying output;
    output.position = float4(2.0, 2.0, 2.0, 1.0);
    output.color = 0.0;
    output.edge = 0.0;
    return output;
}

// Not skin, where a host draws all parts of a mesh, and not one of the strands that are left out: rank as of tgRibbonRank.
bool ribbonDrawn(TgVertexInput input, float rank, float share)
{
    return input.uv.y >= kTgRibbonFirst && rank < share;
}

// 1, or 0 where light is parallel. A factor, for shader model 3 has no slot left for two choices.
float ribbonPointLight()
{
    return tgLightParallel() ? 0.0 : 1.0;
}

// ball: of the roots' mesh.
RibbonFrame ribbonFrame(TgVertexInput input, float4 ball)
{
    RibbonFrame frame;
    frame.world = tgWorldPosition(meshVertex(input).position);
    frame.toEye = strandsAxes(gCameraPosition - frame.world, input);
    float near = ribbonPointLight();
    frame.toLight = strandsAxes(near * (gLightPosition - frame.world) - (1.0 - near) * tgLightRays(), input);
    frame.perMm = gMeshRadius / max(ball.w, 1e-20);
    return frame;
}

// From this place of the strand to the light, not unit: parallel light comes to all of them from where it comes to the root.
float3 ribbonToLight(RibbonFrame frame, float3 offset)
{
    return frame.toLight - ribbonPointLight() * offset;
}

// Least cosine of a root's normal and the way to the eye: what looks further away is hidden. Over the horizon of a ball of radius R strands
// of the length K R reach at -sqrt(1 - 1 / (1 + K)^2), leaning ones as if they were half as long again; a body bends as a ball of a quarter
// of the mesh's radius. As the host's horizonOf.
float ribbonHorizon()
{
    float away = 1.0 + 1.5 * max(4.0 * abs(gFurLength), 0.28);
    return -sqrt(1.0 - 1.0 / (away * away));
}

// Roots that look away by more than a strand reaches over the horizon are left out before anything is read.
bool ribbonSeen(TgVertexInput input, RibbonFrame frame)
{
    return dot(input.normal, frame.toEye) > ribbonHorizon() * length(frame.toEye);
}

float3 ribbonWorld(RibbonFrame frame, float3 offset, TgVertexInput input)
{
    return frame.world + furFromAxes(vertexTurned(offset, input));
}

// Across a pixel at distance 1.
float ribbonPixel()
{
    return 2.0 * tan(0.5 * gCameraFov) / gViewportSize.x;
}

// offset: of the axis from the root; tangent: of the axis, unit; radius: that is drawn there.
RibbonVarying ribbonVarying(TgVertexInput input, RibbonFrame frame, float3 offset, float3 tangent, float radius, float3 color)
{
    float3 toEye = frame.toEye - offset;
    float pixel = ribbonPixel() * length(toEye);
    float2 width = tgRibbonWidth(radius, pixel);
    float drawn = (width.x + gFurEdge * pixel) * input.tangent.w;
    float3 aside = tgSafeNormalize(cross(tangent, toEye));
    float4 position = mul(float4(ribbonWorld(frame, offset + drawn * aside, input), 1.0), gViewProjection);
    position.z = tgFurNearDepth(position.z, position.w);
    RibbonVarying output;
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    output.color = float4(color, width.y);
    output.edge = float2(drawn, width.x) / pixel;
    return output;
}

static const float kRibbonReach = 4.0; // no strand is further from its root, lengths of the coat: strands lie and stray

// Pass Core has nothing of a strand that is narrower than gRibbonThin from its root on. radius: there, as it is drawn. As the host's Least.
bool ribbonThin(RibbonFrame frame, float radius)
{
    float nearest = length(frame.toEye) - kRibbonReach * abs(gFurLength) * gMeshRadius;
    return 2.0 * radius < gRibbonThin * ribbonPixel() * nearest;
}

#define RIBBON_REACH string Reach = "gFurLength"; float ReachScale = 4.0;
#define RIBBON_SHARE string Share = "gFurShare"; string Segment = "gRibbonSegment"; string SegmentsOf = "gFurLength";

static const float kRibbonFaint = 0.004; // less an 8-bit target would not show

// Where a strand is narrower than gRibbonThin its coverage is a mean over the pixel: there it hides nothing, and all of it is fringe.
float ribbonCore(RibbonVarying input, float cut)
{
    return input.color.w < gRibbonThin ? -1.0 : tgRibbonCoverage(ribbonEdge(input)) - cut;
}

// Share of a pixel that pass Core leaves to pass Fringe; below 0: none that shows.
float ribbonFringe(RibbonVarying input, float cut)
{
    float coverage = tgRibbonCoverage(ribbonEdge(input));
    return coverage < cut || input.color.w < gRibbonThin ? coverage - kRibbonFaint : -1.0;
}

// Covered by half and more, as opaque.
float4 RibbonCorePS(RibbonVarying input) : SV_Target0
{
    clip(ribbonCore(input, 0.5));
    return float4(input.color.rgb, 1.0);
}

// What pass Core leaves.
float4 RibbonFringePS(RibbonVarying input) : SV_Target0
{
    float left = ribbonFringe(input, 0.5);
    clip(left);
    return float4(input.color.rgb, left + kRibbonFaint);
}

// Covered by gFurCut and more, blended over what is there.
float4 RibbonSoftCorePS(RibbonVarying input) : SV_Target0
{
    float covered = ribbonCore(input, gFurCut);
    clip(covered);
    return float4(input.color.rgb, covered + gFurCut);
}

float4 RibbonSoftFringePS(RibbonVarying input) : SV_Target0
{
    float left = ribbonFringe(input, gFurCut);
    clip(left);
    return float4(input.color.rgb, left + kRibbonFaint);
}

#endif
// SPDX-License-Identifier: MIT
