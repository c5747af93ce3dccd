// In the manner of a renderer of 2011: classes with methods, groups of techniques, tessellation beside the plain way
cbuffer PerFrame : register(b0) { float4x4 gViewProj : packoffset(c0); float3 gEye : packoffset(c4); float gAspect : packoffset(c4.w); };
cbuffer PerObject : register(b1) { row_major float4x4 gWorld; float4x4 gWorldInvTranspose; };
class Surface
{
    float3 albedo;
    float gloss;
    float3 shade(float3 n, float3 l, float3 v) { return albedo * saturate(dot(n, l)) + gloss * pow(saturate(dot(n, normalize(l + v))), 32); }
};
struct Ramp { float4 low; float4 high; float4 at(float t) { return lerp(low, high, t); } };
Texture2D gAlbedoMap : register(t0);
SamplerState gAniso : register(s0) { Filter = ANISOTROPIC; MaxAnisotropy = 4; };
RasterizerState gRasters[2] { { FillMode = Solid; CullMode = None; FrontCounterClockwise = false; }, { FillMode = WireFrame; CullMode = None; MultisampleEnable = true; } };
BlendState gBlends[2] { { BlendEnable[0] = FALSE; }, { BlendEnable[0] = TRUE; SrcBlend[0] = SRC_ALPHA; DestBlend[0] = INV_SRC_ALPHA; BlendOp[0] = ADD; RenderTargetWriteMask[0] = 0x0F; AlphaToCoverageEnable = false; } };
int gMode = 0;
struct In { float3 p : POSITION; float3 n : NORMAL; float2 t : TEXCOORD; };
struct Out { float4 h : SV_Position; float3 w : POSITION; float3 n : NORMAL; float2 t : TEXCOORD; };
Out VS(In i) { Out o; o.w = mul(float4(i.p, 1), gWorld).xyz; o.h = mul(float4(o.w, 1), gViewProj); o.n = mul(i.n, (float3x3)gWorldInvTranspose); o.t = i.t; return o; }
float4 PS(Out i) : SV_Target
{
    Surface s;
    s.albedo = gAlbedoMap.Sample(gAniso, i.t).rgb;
    s.gloss = 0.4;
    Ramp r = { float4(0.1, 0.05, 0, 1), float4(0.3, 0.4, 0.5, 1) };
    float3 n = normalize(i.n);
    return float4(s.shade(n, normalize(float3(-0.3, 0.5, 0.8)), normalize(gEye - i.w)), 1) + r.at(n.y * 0.5 + 0.5) * 0.5;
}
struct Patch { float edge[3] : SV_TessFactor; float inside : SV_InsideTessFactor; };
Patch ConstantHS(InputPatch<Out, 3> p, uint id : SV_PrimitiveID) { Patch o; o.edge[0] = o.edge[1] = o.edge[2] = 4; o.inside = 4; return o; }
[domain("tri")] [partitioning("integer")] [outputtopology("triangle_cw")] [outputcontrolpoints(3)] [patchconstantfunc("ConstantHS")]
Out HS(InputPatch<Out, 3> p, uint i : SV_OutputControlPointID, uint id : SV_PrimitiveID) { return p[i]; }
[domain("tri")] Out DS(Patch f, float3 b : SV_DomainLocation, const OutputPatch<Out, 3> p) { Out o; o.w = p[0].w * b.x + p[1].w * b.y + p[2].w * b.z; o.h = mul(float4(o.w, 1), gViewProj); o.n = p[0].n; o.t = p[0].t; return o; }
technique11 Tessellated { pass P0 { SetVertexShader(CompileShader(vs_5_0, VS())); SetHullShader(CompileShader(hs_5_0, HS())); SetDomainShader(CompileShader(ds_5_0, DS())); SetPixelShader(CompileShader(ps_5_0, PS())); } }
technique11 Plain { pass P0 { SetVertexShader(CompileShader(vs_5_0, VS())); SetHullShader(NULL); SetDomainShader(NULL); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_5_0, PS())); SetRasterizerState(gRasters[gMode]); SetBlendState(gBlends[gMode], float4(0, 0, 0, 0), 0xffffffff); } }
