// Two textures on one register.
#include "../../../hlsl/platform.fxh"
Texture2D gAMap : register(t0);
Texture2D gBMap : register(t0); //~ fx_4_0 fx_5_0 sm5 TG3101
TG_SAMPLER2D(gA, POINT, CLAMP);
TG_SAMPLER2D(gB, POINT, CLAMP);
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(V v) : SV_Target0 { return tex2D(gA, v.uv) + tex2D(gB, v.uv); }
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ dxil TG3001
        TG_STATE_BUFFER;
    }
}
#endif
