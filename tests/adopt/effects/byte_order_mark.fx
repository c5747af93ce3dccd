// A byte order mark, and a comment in another code page: ƒtƒ@ƒCƒ‹
#define STRINGS(x) #x
#define SIZE 4
string Title = STRINGS(SIZE);
float4x4 MatWorldViewProj : WORLDVIEWPROJECTION;
const int N = SIZE;
float4 offsets[N] = { float4(1, 0, 0, 0), float4(0, 1, 0, 0), float4(0, 0, 1, 0), float4(1, 1, 0, 0) };
float3 lumaWeights = (0.299f, 0.587f, 0.114f);
static const float weights[] = { 0.1, 0.2, 0.3, 0.4 };
float4 kernel[] = { float4(1, 0, 0, 0), float4(0, 1, 0, 0) };
float4 VS(float4 p : POSITION, float3 n : NORMAL, out float3 o : TEXCOORD0) : POSITION { o = n; return mul(p, MatWorldViewProj); }
float4 PS(float3 n : TEXCOORD0) : COLOR { float4 sum = 0; for (int i = 0; i < N; ++i) sum += offsets[i] * weights[i] * abs(n.y); return sum + kernel[1] * 0.2 + lumaWeights.x + n.xyzz * 0.2; }
technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
