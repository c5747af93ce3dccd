// Prototypes, overloads, inout, default values, conditions on vectors, several declarators, matrices in rows.
#pragma pack_matrix( row_major )
row_major float4x4 WorldViewProjection : WorldViewProjection;
float4x4 Textures[2]; float factors[4] = { 0.1, 0.2, 0.3, 0.4 }, offset = 0.1; bool flags[2] = { true, false }; int4 counts = int4(1, 2, 3, 4);
float f(float x); float f(float2 x); inline float3 g(inout float3 a, const in float b = 0.5);
static const float kPi = 3.14159265f, kTwoPi = kPi * 2; static const int kCount = 3; static float state = 0;
struct Light { float3 colour; float3 direction; } light = { { 1, 0.9, 0.8 }, { 0.3, 0.8, 0.5 } };
float f(float x) { return x * x; }
float f(float2 x) { return dot(x, x); }
float3 g(inout float3 a, const in float b) { a += b; state += 0.01; return a * b; }
void vs(in float4 p : POSITION0, in float3 n : NORMAL0, out float4 o : POSITION0, out float3 t : TEXCOORD0) { o = mul(p, WorldViewProjection); t = n; }
float4 ps(float3 n : TEXCOORD0) : COLOR0
{
    float3 a = n * 0.5 + 0.5; float4 c = 0;
    for (int i = 0; i < kCount; i++) c.rgb += a * factors[i];
    for (int i = 0; i < counts.x; ++i) c.r += 0.1;
    if (flags[0] && !flags[1]) c.g += f(a.x) + f(a.xy) * 0.1;
    c.rgb += g(a) * (dot(n, light.direction) > 0 ? light.colour : float3(0.1, 0.1, 0.2));
    c.rgb = any(c.rgb > 1) ? saturate(c.rgb) : c.rgb;
    c.a = sin(kTwoPi * offset) + state;
    return c;
}
technique Functions { pass { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); } }
