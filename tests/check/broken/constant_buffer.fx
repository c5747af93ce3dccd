// A constant buffer that Direct3D packs more tightly than SPIR-V: gC lies behind gB[1] there, in a register of its own here;
// glslang 15 packs it as Direct3D does, which the validator refuses.
#include "../../../hlsl/platform.fxh"
cbuffer Scene
{
    float gA;
    float3 gB[2];
    float gC;
};
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
float4 PS(V v) : SV_Target0 { return gA + gB[1].xyzz + gC + v.uv.xyxy; }
#ifdef FX_TECHNIQUES
technique T
{
    pass P
    {
        VertexShader = compile TG_VS_MODEL VS();
        PixelShader = compile TG_PS_MODEL PS(); //~ sm5 TG3204, may spirv-glslang TG3003
        TG_STATE_BUFFER;
    }
}
#endif
