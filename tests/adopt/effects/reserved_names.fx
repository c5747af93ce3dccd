// Names that later compilers keep for themselves, types by template, globals that code writes.
typedef vector<float, 3> Vec3;
matrix<float, 4, 4> WorldViewProj : WorldViewProjection;
float4x4 World : World;
float point = 0.5;
float4 line = float4(0.2, 0.6, 1, 1);
float3 sample = float3(1, 0.5, 0.25);
half3 precise = half3(0, 1, 0);
float4 accumulated;
struct V2P { float4 pass : POSITION; Vec3 linear : TEXCOORD0; };
V2P VS(in float4 pos : POSITION, in float3 n : NORMAL)
{
    V2P this_out = (V2P)0;
    this_out.pass = mul(pos, WorldViewProj);
    this_out.linear = mul(n, (float3x3)World);
    return this_out;
}
void add(Vec3 sample) { accumulated.rgb += sample; }
half4 PS(V2P interface) : COLOR
{
    double3 n = normalize(interface.linear);
    accumulated = line * (n.y * point + point);
    add(sample * max(n.x, 0));
    return half4(accumulated.rgb, 1);
}
technique { pass { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
