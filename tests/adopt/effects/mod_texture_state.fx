//
// In the manner of shaders for a multiplayer modification: textureState, createNormals, states of the stage before it
//
#include "inc/Mod/mod-helper.fxh"
float3 sSkyColor = float3(0.2, 0.3, 0.5);
float sStrength < float UIMin = 0, UIMax = 1; > = 0.5;
sampler Sampler0 = sampler_state
{
    Texture         = (gTexture0);
    MinFilter       = Linear;
    MagFilter       = Linear;
    MipFilter       = Linear;
    SRGBTexture     = false;
};
struct VSInput
{
    float3 Position : POSITION0;
    float3 Normal : NORMAL0;
    float4 Diffuse : COLOR0;
    float2 TexCoord : TEXCOORD0;
};
struct PSInput
{
    float4 Position : POSITION0;
    float4 Diffuse : COLOR0;
    float2 TexCoord : TEXCOORD0;
    float DistFade : TEXCOORD1;
};
PSInput VertexShaderFunction(VSInput VS)
{
    PSInput PS = (PSInput)0;
    MTFixUpNormal( VS.Normal );
    PS.Position = MTCalcScreenPosition ( VS.Position );
    PS.TexCoord = VS.TexCoord;
    PS.Diffuse = MTCalcBuildingDiffuse( VS.Diffuse );
    float3 worldPosition = MTCalcWorldPosition( VS.Position );
    PS.DistFade = MTUnlerp ( 10, 3, distance( gCameraPosition, worldPosition ) );
    return PS;
}
float4 PixelShaderFunction(PSInput PS) : COLOR0
{
    float4 texel = tex2D(Sampler0, PS.TexCoord);
    float4 finalColor = texel * PS.Diffuse;
    finalColor.rgb = lerp(finalColor.rgb, sSkyColor, sStrength * saturate(1 - PS.DistFade));
    return finalColor;
}
technique tec0
{
    pass P0
    {
        SRGBWriteEnable = FALSE;
        VertexShader = compile vs_2_0 VertexShaderFunction();
        PixelShader = compile ps_2_0 PixelShaderFunction();
    }
}
// Fallback
technique fallback
{
    pass P0
    {
        // Just draw normally
        Texture[0] = (gTexture0);
        ColorOp[0] = Modulate;
    }
}
