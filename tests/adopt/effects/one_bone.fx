// A bone's number among the texture coordinates.
float4x4 World, View, Projection;
float4x4 Bones[20];
struct Vertex { float4 p : POSITION0; float2 uv : TEXCOORD0; int2 bone : TEXCOORD1; };
void VS(Vertex vertex, out float4 p : POSITION0, out float2 uv : TEXCOORD0)
{
    p = mul(mul(mul(mul(vertex.p, Bones[vertex.bone.x]), World), View), Projection);
    uv = vertex.uv;
}
float4 PS(float2 uv : TEXCOORD0) : COLOR0 { return float4(uv, 0, 1); }
technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
