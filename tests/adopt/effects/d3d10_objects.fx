// Direct3D 10: objects with methods, comparison, integers between stages, sizes, a vertex's number.
matrix WorldViewProjection; Texture2D shadowMap; TextureCube skyMap; Texture2D<float4> colourMap;
SamplerComparisonState shadowSampler { Filter = COMPARISON_MIN_MAG_LINEAR_MIP_POINT; AddressU = BORDER; AddressV = BORDER; ComparisonFunc = LESS; };
SamplerState linearSampler { Filter = MIN_MAG_MIP_LINEAR; AddressU = Wrap; AddressV = Wrap; };
tbuffer tb { float4 extra[2]; };
struct VSIn { float3 pos : POSITION; float3 n : NORMAL; uint id : SV_VertexID; };
struct PSIn { float4 pos : SV_POSITION; float3 n : TEXCOORD0; nointerpolation uint id : IDENT; };
PSIn VS(VSIn i) { PSIn o; o.pos = mul(float4(i.pos, 1), WorldViewProjection); o.n = i.n; o.id = i.id / 512; return o; }
float4 PS(PSIn i) : SV_TARGET0
{
    uint w, h; colourMap.GetDimensions(w, h);
    float lit = shadowMap.SampleCmpLevelZero(shadowSampler, i.n.xy, 0.2);
    float4 c = colourMap.Load(int3(uint2(i.pos.xy) % uint2(w, h), 0)) * 0.5 + skyMap.Sample(linearSampler, i.n) * 0.3;
    return c + (i.id & 1) * 0.1 + lit * 0.1;
}
float4 Depth(PSIn i) : SV_Target { return i.n.xyzz * 0.5 + 0.5; }
technique10 Render { pass P0 { SetVertexShader(CompileShader(vs_4_0, VS())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_4_0, PS())); } }
technique10 Other { pass P0 { SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, Depth())); } pass P1 { SetPixelShader(NULL); SetVertexShader(CompileShader(vs_4_0, VS())); } }
