// Linear light: SRGBTexture in samplers, SRGBWriteEnable from a parameter, VFACE and VPOS, state block, sampler of a function argument
bool gLinear = true;
texture Albedo : DIFFUSE < string ResourceName = "albedo.dds"; string ResourceType = "2D"; >;
sampler2D AlbedoS = sampler_state { Texture = (Albedo); SRGBTexture = TRUE; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
sampler2D MaskS = sampler_state { Texture = (Albedo); SRGBTexture = <gLinear>; };
stateblock common = stateblock_state { CullMode = None; SRGBWriteEnable = TRUE; };
float4x4 WorldViewProjection : WorldViewProjection; float4x4 WorldI : WorldInverse; float3 Lamp : POSITION < string Object = "PointLight"; string Space = "World"; > = { 3, 3, 3 };
static float3 LampO = mul(float4(Lamp, 1), WorldI).xyz;
struct VO { float4 p : POSITION; float2 t : TEXCOORD0; float3 n : TEXCOORD1; float3 o : TEXCOORD2; };
VO VS(float4 p : POSITION, float3 n : NORMAL, float2 t : TEXCOORD0) { VO v = (VO)0; v.p = mul(p, WorldViewProjection); v.t = t; v.n = n; v.o = p.xyz; return v; }
float3 sampled(sampler2D s, float2 t) { return tex2D(s, t).rgb; }
float4 PS(VO v, float2 at : VPOS, float side : VFACE) : COLOR0
{
    float3 n = normalize(v.n) * sign(side), l = normalize(LampO - v.o);
    float stripes = fmod(floor(at.x / 8) + floor(at.y / 8), 2) * 0.1 + 0.9;
    return float4(lerp(sampled(AlbedoS, v.t), sampled(MaskS, v.t * 2), 0.25) * saturate(dot(n, l)) * stripes, 1);
}
technique Linear < string Script = "Pass=P;"; > { pass P < string Script = "Draw=geometry;"; > { SRGBWriteEnable = <gLinear>; CullMode = None; VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
