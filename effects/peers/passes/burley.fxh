// Pass Gather: the light of gLightMap gathered over a disc into gScatterMap.
#ifndef TEGUMENT_PEERS_PASSES_BURLEY_FXH
#define TEGUMENT_PEERS_PASSES_BURLEY_FXH

float3 gBurleyDistance < string UIName = "Scattering distance d"; float UIMin = 0.001; float UIMax = 5.0;
    string UIHelp = "mm, for each colour; light travels 3 d on average"; > = { 0.451, 0.104, 0.070 };
float gBurleyTurn < UI_SLIDER("Turn from pixel to pixel", 0.0, 1.0, 0.01)
    string UIHelp = "0: the same pattern everywhere, which shows as bands instead of noise"; > = 1.0;

float4 gather(float2 uv, int count)
{
    float2 frustum = tgScreenFrustum(gProjection);
    float3 axisU = float3(1.0, 0.0, 0.0);
    float3 axisV = float3(0.0, 1.0, 0.0);
    if (!kTgPeersAsPrinted)
    {
        float3 down = tgScreenTangent(TG_SAMPLER2D_ARG(gDepth), uv, float2(0.0, 1.0 / gViewportSize.y), frustum);
        axisU = tgSafeNormalize(tgScreenTangent(TG_SAMPLER2D_ARG(gDepth), uv, float2(1.0 / gViewportSize.x, 0.0), frustum));
        axisV = cross(tgSafeNormalize(cross(axisU, down)), axisU);
    }
    return tgBurleyGather(TG_SAMPLER2D_ARG(gLight), TG_SAMPLER2D_ARG(gDepth), uv, gViewportSize, frustum, axisU, axisV, gBurleyDistance,
                        gBurleyTurn, count);
}

#define BURLEY_STEP(samples) \
float4 Gather##samples##PS(TgQuadVarying input) : SV_Target0 \
{ \
    return gather(input.uv, samples); \
}

BURLEY_STEP(20)
BURLEY_STEP(40)
BURLEY_STEP(80)

#endif
// SPDX-License-Identifier: MIT
