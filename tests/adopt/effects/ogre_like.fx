// In the manner of programs for an engine whose materials name the parameters: uniforms of the entry point, handed over by technique
float4x4 worldViewProj_param : WORLDVIEWPROJECTION;
float4x4 world : WORLD;
float4 light_position_object_space = {2, 3, 4, 1};
float4 lightDiffuse = {1, 0.95, 0.9, 1};
sampler2D diffuseMap : register(s0);
void main_vp(float4 position : POSITION, float3 normal : NORMAL, float2 uv : TEXCOORD0,
    out float4 oPosition : POSITION, out float2 oUv : TEXCOORD0, out float4 oColour : COLOR,
    uniform float4x4 worldViewProj, uniform float4 lightPosition, uniform float4 lightDiffuse_)
{
    oPosition = mul(worldViewProj, position);
    float3 lightDir = normalize(lightPosition.xyz - (position.xyz * lightPosition.w));
    oColour = lightDiffuse_ * max(dot(lightDir, normal), 0.0);
    oUv = uv;
}
float4 main_fp(float2 uv : TEXCOORD0, float4 colour : COLOR, uniform sampler2D map) : COLOR
{
    return tex2D(map, uv) * (colour + 0.15);
}
technique Main { pass P0 { VertexShader = compile vs_1_1 main_vp(worldViewProj_param, light_position_object_space, lightDiffuse); PixelShader = compile ps_2_0 main_fp(diffuseMap); } }
