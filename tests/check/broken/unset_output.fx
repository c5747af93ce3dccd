// A member of the output is never set.
#include "../../../hlsl/platform.fxh"
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION) { V o; o.position = float4(position, 1); return o; } //~ fx_2_0 TG3101
float4 PS(V v) : SV_Target0 { return v.uv.xyxy; }
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ fx_4_0 fx_5_0 TG3101, sm5 TG3004
        TG_STATE_BUFFER;
    }
}
#endif
