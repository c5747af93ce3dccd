// Saved by an editor that adds a byte order mark and CRLF: cel shading of 2012, structures with methods, packed offsets, two targets' worth of states
cbuffer Camera : register(b0)
{
    float4x4 WorldViewProjection : packoffset(c0);
    float4x4 World : packoffset(c4);
    float3 CameraPosition : packoffset(c8.x);
    float Bands : packoffset(c8.w) = 3;
};
struct Cel
{
    float3 bright; float3 dark;
    float3 shade(float amount) { return lerp(dark, bright, floor(saturate(amount) * Bands) / Bands); }
};
Texture2D Skin; SamplerState Clamped { Filter = MIN_MAG_MIP_POINT; AddressU = CLAMP; AddressV = CLAMP; };
RasterizerState Solid { CullMode = NONE; FillMode = SOLID; MultisampleEnable = TRUE; };
struct VO { float4 p : SV_Position; float3 n : NORMAL; float2 t : TEXCOORD0; float3 w : TEXCOORD1; };
VO VS(float3 p : POSITION, float3 n : NORMAL, float2 t : TEXCOORD0) { VO o; o.p = mul(float4(p, 1), WorldViewProjection); o.n = mul(n, (float3x3)World); o.t = t; o.w = mul(float4(p, 1), World).xyz; return o; }
float4 PS(VO i) : SV_Target
{
    Cel cel;
    cel.bright = float3(1, 0.8, 0.5); cel.dark = float3(0.25, 0.1, 0.3);
    float3 n = normalize(i.n);
    float rim = 1 - saturate(dot(n, normalize(CameraPosition - i.w)));
    return float4(cel.shade(dot(n, normalize(float3(-0.3, 0.5, 0.8)))) * Skin.Sample(Clamped, i.t).rgb + step(0.8, rim) * 0.4, 1);
}
technique11 Cel11 { pass P { SetRasterizerState(Solid); SetVertexShader(CompileShader(vs_5_0, VS())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_5_0, PS())); } }
