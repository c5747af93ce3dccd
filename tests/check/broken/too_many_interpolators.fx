// Eleven vectors between the stages; shader model 3 has ten.
#include "../../../hlsl/platform.fxh"
struct V
{
    float4 position : SV_Position;
    float4 t0 : TEXCOORD0;
    float4 t1 : TEXCOORD1;
    float4 t2 : TEXCOORD2;
    float4 t3 : TEXCOORD3;
    float4 t4 : TEXCOORD4;
    float4 t5 : TEXCOORD5;
    float4 t6 : TEXCOORD6;
    float4 t7 : TEXCOORD7;
    float4 t8 : TEXCOORD8;
    float4 t9 : TEXCOORD9;
    float4 t10 : TEXCOORD10;
};
V VS(float3 position : POSITION, float2 uv : TEXCOORD0)
{
    V o;
    o.position = float4(position, 1);
    o.t0 = uv.xyxy + 0;
    o.t1 = uv.xyxy + 1;
    o.t2 = uv.xyxy + 2;
    o.t3 = uv.xyxy + 3;
    o.t4 = uv.xyxy + 4;
    o.t5 = uv.xyxy + 5;
    o.t6 = uv.xyxy + 6;
    o.t7 = uv.xyxy + 7;
    o.t8 = uv.xyxy + 8;
    o.t9 = uv.xyxy + 9;
    o.t10 = uv.xyxy + 10;
    return o;
}
float4 PS(V v) : SV_Target0
{
    return v.t0 * v.t1 * v.t2 * v.t3 * v.t4 * v.t5 * v.t6 * v.t7 * v.t8 * v.t9 * v.t10; //~ fx_2_0 TG3101
}
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
