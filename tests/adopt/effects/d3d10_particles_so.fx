// Particles by stream output in one technique, billboards by geometry shaders in the next, and a cheap one that any host draws
cbuffer cb0 { float4x4 g_mWorldViewProj; float4x4 g_mInvView; float g_fTime; };
cbuffer cbImmutable { float3 g_positions[4] = { float3(-1, 1, 0), float3(1, 1, 0), float3(-1, -1, 0), float3(1, -1, 0) }; float2 g_texcoords[4] = { float2(0, 1), float2(1, 1), float2(0, 0), float2(1, 0) }; };
Texture2D g_txDiffuse; SamplerState g_samLinear { Filter = MIN_MAG_MIP_LINEAR; AddressU = Clamp; AddressV = Clamp; };
BlendState AdditiveBlending { AlphaToCoverageEnable = FALSE; BlendEnable[0] = TRUE; SrcBlend = SRC_ALPHA; DestBlend = ONE; BlendOp = ADD; SrcBlendAlpha = ZERO; DestBlendAlpha = ZERO; BlendOpAlpha = ADD; RenderTargetWriteMask[0] = 0x0F; };
DepthStencilState DisableDepth { DepthEnable = FALSE; DepthWriteMask = ZERO; };
struct P { float3 pos : POSITION; float3 vel : NORMAL; float timer : TIMER; uint type : TYPE; };
struct S { float4 pos : SV_Position; float2 tex : TEXTURE0; float4 colour : COLOR; };
P Advance(P i) { return i; }
[maxvertexcount(8)] void GSAdvance(point P i[1], inout PointStream<P> o) { i[0].pos += i[0].vel * g_fTime; o.Append(i[0]); }
[maxvertexcount(4)] void GSShow(point P i[1], inout TriangleStream<S> o)
{
    for (int k = 0; k < 4; k++) { S s; s.pos = mul(float4(i[0].pos + mul(g_positions[k], (float3x3)g_mInvView), 1), g_mWorldViewProj); s.tex = g_texcoords[k]; s.colour = 1; o.Append(s); }
    o.RestartStrip();
}
S VSCheap(float3 pos : POSITION, float3 vel : NORMAL, float2 t : TEXCOORD0) { S s; s.pos = mul(float4(pos + vel * 0.1, 1), g_mWorldViewProj); s.tex = t; s.colour = float4(abs(vel), 1); return s; }
float4 PSShow(S i) : SV_Target { return g_txDiffuse.Sample(g_samLinear, i.tex) * i.colour; }
GeometryShader gsStream = ConstructGSWithSO(CompileShader(gs_4_0, GSAdvance()), "POSITION.xyz; NORMAL.xyz; TIMER.x; TYPE.x");
technique10 AdvanceParticles { pass p0 { SetVertexShader(CompileShader(vs_4_0, Advance())); SetGeometryShader(gsStream); SetPixelShader(NULL); SetDepthStencilState(DisableDepth, 0); } }
technique10 RenderParticles { pass p0 { SetVertexShader(CompileShader(vs_4_0, Advance())); SetGeometryShader(CompileShader(gs_4_0, GSShow())); SetPixelShader(CompileShader(ps_4_0, PSShow())); SetBlendState(AdditiveBlending, float4(0, 0, 0, 0), 0xFFFFFFFF); SetDepthStencilState(DisableDepth, 0); } }
technique10 Cheap { pass p0 { SetVertexShader(CompileShader(vs_4_0, VSCheap())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_4_0, PSShow())); SetBlendState(AdditiveBlending, float4(0, 0, 0, 0), 0xFFFFFFFF); SetDepthStencilState(DisableDepth, 0); } }
