// The stages name the same semantics in another order: Direct3D 9 and Vulkan's host join them by name, Direct3D 11 by register.
#include "../../../hlsl/platform.fxh"
struct V { float4 position : SV_Position; float4 a : TEXCOORD0; float4 b : TEXCOORD1; };
V VS(float3 position : POSITION) { V o; o.position = float4(position, 1); o.a = 1; o.b = position.xyzz; return o; }
float4 PS(float4 position : SV_Position, float4 b : TEXCOORD1, float4 a : TEXCOORD0) : SV_Target0 { return a + b; }
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ fx_4_0 fx_5_0 TG3101, sm5 dxil TG3205
        TG_STATE_BUFFER;
    }
}
#endif
