// Seventeen samplers; shader models 3 to 5 have sixteen.
#include "../../../hlsl/platform.fxh"
Texture2D g0Map;
TG_SAMPLER2D(g0, LINEAR, CLAMP);
Texture2D g1Map;
TG_SAMPLER2D(g1, LINEAR, CLAMP);
Texture2D g2Map;
TG_SAMPLER2D(g2, LINEAR, CLAMP);
Texture2D g3Map;
TG_SAMPLER2D(g3, LINEAR, CLAMP);
Texture2D g4Map;
TG_SAMPLER2D(g4, LINEAR, CLAMP);
Texture2D g5Map;
TG_SAMPLER2D(g5, LINEAR, CLAMP);
Texture2D g6Map;
TG_SAMPLER2D(g6, LINEAR, CLAMP);
Texture2D g7Map;
TG_SAMPLER2D(g7, LINEAR, CLAMP);
Texture2D g8Map;
TG_SAMPLER2D(g8, LINEAR, CLAMP);
Texture2D g9Map;
TG_SAMPLER2D(g9, LINEAR, CLAMP);
Texture2D g10Map;
TG_SAMPLER2D(g10, LINEAR, CLAMP);
Texture2D g11Map;
TG_SAMPLER2D(g11, LINEAR, CLAMP);
Texture2D g12Map;
TG_SAMPLER2D(g12, LINEAR, CLAMP);
Texture2D g13Map;
TG_SAMPLER2D(g13, LINEAR, CLAMP);
Texture2D g14Map;
TG_SAMPLER2D(g14, LINEAR, CLAMP);
Texture2D g15Map;
TG_SAMPLER2D(g15, LINEAR, CLAMP);
Texture2D g16Map;
TG_SAMPLER2D(g16, LINEAR, CLAMP); //~ fx_4_0 fx_5_0 sm5 TG3101
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(V v) : SV_Target0
{
    float4 c = 0;
    c += tex2D(g0, v.uv);
    c += tex2D(g1, v.uv);
    c += tex2D(g2, v.uv);
    c += tex2D(g3, v.uv);
    c += tex2D(g4, v.uv);
    c += tex2D(g5, v.uv);
    c += tex2D(g6, v.uv);
    c += tex2D(g7, v.uv);
    c += tex2D(g8, v.uv);
    c += tex2D(g9, v.uv);
    c += tex2D(g10, v.uv);
    c += tex2D(g11, v.uv);
    c += tex2D(g12, v.uv);
    c += tex2D(g13, v.uv);
    c += tex2D(g14, v.uv);
    c += tex2D(g15, v.uv);
    c += tex2D(g16, v.uv);
    return c;
}
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ fx_2_0 TG3101
        TG_STATE_BUFFER;
    }
}
#endif
