// Passes PrePass1 and PrePass2: depth 1 in the texture-space depth target where nothing shows. The script clears it to 0 in any case.
#ifndef TEGUMENT_PASSES_CULL_FXH
#define TEGUMENT_PASSES_CULL_FXH

Texture2D gUnwrapDepthMap : RENDERDEPTHSTENCILTARGET < SQUARE_DEPTH(TEGUMENT_MAP_SIZE) >;

// The map with the depth target of the prepasses beside it, both cleared; the passes to draw follow. map, clear: strings.
#define UNWRAP_SCRIPT(map, clear) \
    "RenderColorTarget0=" map "; RenderDepthStencilTarget=gUnwrapDepthMap;" \
    "ClearSetColor=" clear "; ClearSetDepth=gClearNear; Clear=Color; Clear=Depth;"

struct CullVarying
{
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float4 clip : TEXCOORD1;
    float3 normal : TEXCOORD2;
    float3 toEye : TEXCOORD3;
};

// A black texel survives while a coloured one is this near (texels): the seams' repair writes there.
static const float kRepairRadius = 2.0;

bool blackAround(float2 uv)
{
    bool black = true;
    [unroll] for (int j = -1; j <= 1; j++)
        [unroll] for (int i = -1; i <= 1; i++)
            black = black && tgCullBlack(tex2Dlod(gSkin, float4(uv + float2(i, j) * kRepairRadius / kTgMapSize, 0.0, 0.0)).rgb);
    return black;
}

// slack: share of N.V by which a point may face away and still count as visible.
bool facesAway(CullVarying input, float slack)
{
    return tgCullBackFace(tgSafeNormalize(input.normal), tgSafeNormalize(input.toEye), slack);
}

// Equations 41 and 42 in the form of the setting.
bool outsidePoint(CullVarying input)
{
    return tgCullOutsideView(input.clip);
}

bool hiddenPoint(CullVarying input)
{
    return (kTgCullFrustum && outsidePoint(input)) || (kTgCullBackFaces && facesAway(input, 0.0));
}

CullVarying cullVarying(TgMeshInput input)
{
    CullVarying output;
    float3 world = tgWorldPosition(input.position);
    output.clip = mul(float4(world, 1.0), gViewProjection);
    output.normal = tgWorldNormal(input.normal);
    output.toEye = gCameraPosition - world;
    output.position = float4(0.0, 0.0, 0.0, 1.0);
    output.uv = input.uv;
    return output;
}

TgQuadVarying PrePass1VS(TgQuadInput input)
{
    TgQuadVarying output = TgQuadVS(input);
    output.position.z = 1.0;
    return output;
}

float4 PrePass1PS(TgQuadVarying input) : SV_Target0
{
    clip(kTgCullBlack && blackAround(input.uv) ? 1.0 : -1.0);
    return 0.0;
}

// Setting seed culls whole vertices, by their depth; corrected culls fragments.
CullVarying PrePass2VS(TgVertexInput input)
{
    CullVarying output = cullVarying(meshVertex(input));
    float z = kTgCullPerPixel || hiddenPoint(output) ? 1.0 : 0.0;
    output.position = TG_HALF_PIXEL(tgUnwrapPosition(output.uv, z), gViewportSize);
    return output;
}

float4 PrePass2PS(CullVarying input) : SV_Target0
{
    clip(!kTgCullPerPixel || hiddenPoint(input) ? 1.0 : -1.0);
    return 0.0;
}

#endif
// SPDX-License-Identifier: MIT
