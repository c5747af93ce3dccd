// In the manner of a tutorial for XNA: normals and depth into two targets, ambient light, edges; parameters that the game sets
float4x4 World;
float4x4 View;
float4x4 Projection;
texture Texture;
bool TextureEnabled = true;
float3 LightDirection = normalize(float3(1, 1, 1));
float ToonThresholds[2] = { 0.8, 0.4 };
float ToonBrightnessLevels[3] = { 1.3, 0.9, 0.5 };
sampler Sampler = sampler_state
{
    Texture = (Texture);
    MinFilter = Linear;
    MagFilter = Linear;
    MipFilter = Linear;
    AddressU = Wrap;
    AddressV = Wrap;
};
struct VertexShaderInput { float4 Position : POSITION0; float3 Normal : NORMAL0; float2 TextureCoordinate : TEXCOORD0; };
struct LightingVertexShaderOutput { float4 Position : POSITION0; float2 TextureCoordinate : TEXCOORD0; float LightAmount : TEXCOORD1; };
struct NormalDepthVertexShaderOutput { float4 Position : POSITION0; float4 Color : COLOR0; };
LightingVertexShaderOutput LightingVertexShader(VertexShaderInput input)
{
    LightingVertexShaderOutput output;
    output.Position = mul(mul(mul(input.Position, World), View), Projection);
    output.TextureCoordinate = input.TextureCoordinate;
    float3 worldNormal = mul(input.Normal, World);
    output.LightAmount = dot(worldNormal, LightDirection);
    return output;
}
float4 ToonPixelShader(LightingVertexShaderOutput input) : COLOR0
{
    float4 color = TextureEnabled ? tex2D(Sampler, input.TextureCoordinate) : 0;
    float light;
    if (input.LightAmount > ToonThresholds[0])
        light = ToonBrightnessLevels[0];
    else if (input.LightAmount > ToonThresholds[1])
        light = ToonBrightnessLevels[1];
    else
        light = ToonBrightnessLevels[2];
    color.rgb *= light;
    return color;
}
NormalDepthVertexShaderOutput NormalDepthVertexShader(VertexShaderInput input)
{
    NormalDepthVertexShaderOutput output;
    output.Position = mul(mul(mul(input.Position, World), View), Projection);
    float3 worldNormal = mul(input.Normal, World);
    output.Color.rgb = (worldNormal + 1) / 2;
    output.Color.a = output.Position.z / output.Position.w;
    return output;
}
float4 NormalDepthPixelShader(float4 color : COLOR0) : COLOR0 { return color; }
technique Toon { pass P0 { VertexShader = compile vs_1_1 LightingVertexShader(); PixelShader = compile ps_2_0 ToonPixelShader(); } }
technique NormalDepth { pass P0 { VertexShader = compile vs_1_1 NormalDepthVertexShader(); PixelShader = compile ps_1_1 NormalDepthPixelShader(); } }
