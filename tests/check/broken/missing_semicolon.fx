// A semicolon is missing between two statements.
#include "../../../hlsl/platform.fxh"
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(V v) : SV_Target0 { float4 c = v.uv.xyxy return c; } //~ fx_2_0 fx_4_0 fx_5_0 sm5 TG3101, else TG3001
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS();
        TG_STATE_BUFFER;
    }
}
#endif
