// In the manner of a sample with geometry shaders: one technique that explodes triangles, stream output for particles, a plain one
cbuffer cbEveryFrame { matrix World; matrix WorldViewProjection; float Time; };
cbuffer cbFixed { float3 LightDir[2] = { float3(0.3, 0.5, 0.8), float3(-0.8, 0.2, 0.5) }; float4 LightColor[2] = { float4(1, 0.9, 0.8, 1), float4(0.1, 0.1, 0.3, 1) }; };
int gRef = 1;
Texture2D g_txDiffuse;
SamplerState samLinear { Filter = MIN_MAG_MIP_LINEAR; AddressU = Wrap; AddressV = Wrap; };
DepthStencilState Depths[2] { { DepthEnable = true; DepthFunc = LESS_EQUAL; }, { DepthEnable = true; DepthWriteMask = ZERO; StencilEnable = true; FrontFaceStencilPass = INCR; } };
RasterizerState Rasters[2] { { CullMode = None; MultisampleEnable = TRUE; }, { CullMode = Back; MultisampleEnable = FALSE; } };
struct GSIn { float4 Pos : POS; float3 Norm : NORMAL; float2 Tex : TEXCOORD0; };
struct PSIn { float4 Pos : SV_POSITION; float3 Norm : TEXCOORD0; float2 Tex : TEXCOORD1; };
GSIn VS(float4 pos : POSITION, float3 n : NORMAL, float2 t : TEXCOORD0) { GSIn o; o.Pos = pos; o.Norm = n; o.Tex = t; return o; }
PSIn PlainVS(float4 pos : POSITION, float3 n : NORMAL, float2 t : TEXCOORD0) { PSIn o; o.Pos = mul(pos, WorldViewProjection); o.Norm = mul(n, (float3x3)World); o.Tex = t; return o; }
[maxvertexcount(12)]
void GS(triangle GSIn input[3], inout TriangleStream<PSIn> TriStream)
{
    float3 face = normalize(cross(input[1].Pos.xyz - input[0].Pos.xyz, input[2].Pos.xyz - input[0].Pos.xyz));
    [unroll] for (int i = 0; i < 3; i++)
    {
        PSIn o;
        o.Pos = mul(input[i].Pos + float4(face * 0.1 * Time, 0), WorldViewProjection);
        o.Norm = face;
        o.Tex = input[i].Tex;
        TriStream.Append(o);
    }
    TriStream.RestartStrip();
}
float4 PS(PSIn i) : SV_Target
{
    float4 c = 0;
    for (int k = 0; k < 2; k++) c += saturate(dot(normalize(LightDir[k]), normalize(i.Norm)) * LightColor[k]);
    c.a = 1;
    return g_txDiffuse.Sample(samLinear, i.Tex) * c;
}
GeometryShader Stream = ConstructGSWithSO(CompileShader(gs_4_0, GS()), "SV_POSITION.xyzw; TEXCOORD0.xyz");
technique10 Explode { pass p0 { SetVertexShader(CompileShader(vs_4_0, VS())); SetGeometryShader(CompileShader(gs_4_0, GS())); SetPixelShader(CompileShader(ps_4_0, PS())); SetDepthStencilState(Depths[1], gRef); } }
technique10 Gather { pass p0 { SetVertexShader(CompileShader(vs_4_0, VS())); SetGeometryShader(Stream); SetPixelShader(NULL); SetDepthStencilState(Depths[0], 0); } }
technique10 Plain { pass p0 { SetVertexShader(CompileShader(vs_4_0, PlainVS())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_4_0, PS())); SetRasterizerState(Rasters[gRef]); SetDepthStencilState(Depths[0], gRef); SetBlendState(NULL, float4(0, 0, 0, 0), 0xffffffff); } }
