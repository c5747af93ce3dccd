// Direct3D 11: buffers, state objects in an array, arguments, a group.
cbuffer PerObject : register(b0) { row_major float4x4 gWorld; float4x4 gWorldViewProj; float4 gTint : COLOR = { 0.9, 0.7, 0.4, 1 }; };
cbuffer PerFrame { float3 gLightDirection = { 0.3, 0.8, 0.5 }; float pad; };
Texture2D gDiffuseMap < string UIName = "diffuse"; >;
SamplerState gLinear { Filter = ANISOTROPIC; MaxAnisotropy = 4; AddressU = WRAP; AddressV = WRAP; };
RasterizerState gRasters[2] { { FillMode = SOLID; CullMode = BACK; MultisampleEnable = TRUE; }, { FillMode = WIREFRAME; CullMode = NONE; } };
int gRaster = 0;
BlendState gOpaque { BlendEnable[0] = FALSE; RenderTargetWriteMask[0] = 0x0F; };
DepthStencilState gDepth { DepthEnable = TRUE; DepthWriteMask = ALL; DepthFunc = LESS_EQUAL; };
struct VertexIn { float3 posL : POSITION; float3 normalL : NORMAL; float2 tex : TEXCOORD; };
struct VertexOut { float4 posH : SV_POSITION; float3 normalW : NORMAL; float2 tex : TEXCOORD; };
VertexOut VS(VertexIn vin) { VertexOut vout; vout.posH = mul(float4(vin.posL, 1.0f), gWorldViewProj); vout.normalW = mul(float4(vin.normalL, 0), gWorld).xyz; vout.tex = vin.tex; return vout; }
float4 PS(VertexOut pin, uniform int gLights, uniform bool gUseTexture) : SV_Target
{
    float3 n = normalize(pin.normalW);
    float4 c = gTint;
    if (gUseTexture) c *= gDiffuseMap.Sample(gLinear, pin.tex);
    [unroll] for (int i = 0; i < gLights; ++i) c.rgb *= saturate(dot(n, normalize(gLightDirection))) + 0.2;
    return c;
}
fxgroup g0 {
    technique11 Light1Tex { pass P0 { SetVertexShader(CompileShader(vs_5_0, VS())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_5_0, PS(1, true))); SetRasterizerState(gRasters[gRaster]); SetBlendState(gOpaque, float4(0, 0, 0, 0), 0xFFFFFFFF); SetDepthStencilState(gDepth, gRaster); } }
    technique11 Plain { pass P0 { SetVertexShader(CompileShader(vs_5_0, VS())); SetPixelShader(CompileShader(ps_5_0, PS(2, false))); } }
}
