// The matrix of an instance in its own stream, as XNA's samples have it.
float4x4 View;
float4x4 Projection;
struct Vertex { float4 p : POSITION0; float3 n : NORMAL0; float4x4 instance : BLENDWEIGHT; };
struct Seen { float4 p : POSITION0; float3 n : TEXCOORD0; };
Seen VS(Vertex vertex)
{
    float4x4 world = transpose(vertex.instance);
    Seen seen = { mul(mul(mul(vertex.p, world), View), Projection), mul(vertex.n, (float3x3)world) };
    return seen;
}
float4 PS(Seen seen) : COLOR0 { return float4(seen.n * 0.5 + 0.5, 1); }
technique Instanced { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
