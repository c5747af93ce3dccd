// XNA's shader of sprites, with its half pixel and a matrix that nobody sets.
float2 ViewportSize : register(c0);
float4x4 MatrixTransform : register(c2);
sampler TextureSampler : register(s0);
void SpriteVertexShader(inout float4 position : POSITION0, inout float4 color : COLOR0, inout float2 texCoord : TEXCOORD0)
{
    position = mul(position, transpose(MatrixTransform));
    position.xy -= 0.5;
    position.xy /= ViewportSize;
    position.xy *= float2(2, -2);
    position.xy -= float2(1, -1);
}
float4 Main(float4 color : COLOR0, float2 texCoord : TEXCOORD0) : COLOR0 { return tex2D(TextureSampler, texCoord) * float4(color.rg, 0.5, 1); }
technique Sprites { pass P { VertexShader = compile vs_3_0 SpriteVertexShader(); PixelShader = compile ps_3_0 Main(); } }
