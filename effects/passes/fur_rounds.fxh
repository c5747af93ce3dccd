// Passes CoatEnd and Behind: fur in two rounds. Layers are blended from the skin outwards and write depth. Where a fringe of a near part
// covers a pixel only a little, all further layers of a coat behind it would fail the depth test. So CoatEnd draws where the nearest coat
// ends, which is where its outermost layer turns away from the eye first; pass Behind draws all that lies beyond, and the pass of the
// layers what is left, over it. Any such depth, pixel by pixel, gives an order that is right between the rounds, so that nothing is lost
// where a coat is crumpled and ends too early.
#ifndef TEGUMENT_PASSES_FUR_ROUNDS_FXH
#define TEGUMENT_PASSES_FUR_ROUNDS_FXH

Texture2D gCoatEndMap : RENDERCOLORTARGET < PICTURE_TARGET("R32F") >;
Texture2D gCoatEndDepthMap : RENDERDEPTHSTENCILTARGET < PICTURE_DEPTH >;
TG_SAMPLER2D(gCoatEnd, POINT, CLAMP);

static const float kFurNear = 1.0; // the rounds, as vertex shaders hand them on
static const float kFurBehind = -1.0;

// In the loop if gFurFringes is 1. The map is cleared in any case: 0 is no end.
#define ROUNDS_SCRIPT(skin, layers) \
    "RenderColorTarget0=gCoatEndMap; RenderDepthStencilTarget=gCoatEndDepthMap;" \
    "ClearSetColor=gClearEmpty; ClearSetDepth=gClearFar; Clear=Color;" \
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=" skin ";" \
    "LoopByCount=gFurFringes; RenderColorTarget0=gCoatEndMap; RenderDepthStencilTarget=gCoatEndDepthMap; Clear=Depth; Pass=CoatEnd;" \
    "RenderColorTarget0=; RenderDepthStencilTarget=;" TG_LAYER_SCRIPT("gFurLayers", "gFurLayer", "Behind") "LoopEnd;" \
    TG_LAYER_SCRIPT("gFurLayers", "gFurLayer", layers)

// Planes are fitted to the mesh: what the coat has beyond the far one ends the coat, too, and some devices would clip it.
float4 furEndPosition(float4 position)
{
    return float4(position.xy, min(position.z, 0.999999 * position.w), position.w);
}

// Below 0 what belongs to the other round. nearness: 1 / distance from the eye, as CoatEnd wrote it; pixel: its centre.
float furInRound(float nearness, float2 pixel, float round)
{
    return (nearness - tex2Dlod(gCoatEnd, float4(pixel / gViewportSize, 0.0, 0.0)).x) * round;
}

#endif
// SPDX-License-Identifier: MIT
