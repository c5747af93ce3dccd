// Alpha test, state values from parameters, two sided.
float4x4 matWorldViewProjection : WORLDVIEWPROJECTION;
int g_nCull = 1;
bool g_bTest = true;
float g_fOpacity = 1;
texture LeafTexture < string name = "leaf.dds"; >;
sampler Leaf = sampler_state { Texture = <LeafTexture>; MinFilter = Anisotropic; MagFilter = Linear; MipFilter = Linear; MaxAnisotropy = 8; };
struct V { float4 p : POSITION; float2 t : TEXCOORD0; };
V vs_main(float4 p : POSITION, float2 t : TEXCOORD0) { V o; o.p = mul(p, matWorldViewProjection); o.t = t * 8; return o; }
float4 ps_main(float2 t : TEXCOORD0) : COLOR0 { float2 d = frac(t) - 0.5; return float4(tex2D(Leaf, t).rgb, 1 - 2 * length(d)); }
technique Leaves { pass P0 { AlphaTestEnable = <g_bTest>; AlphaRef = 64; AlphaFunc = GreaterEqual; AlphaBlendEnable = (g_fOpacity < 0.99); CullMode = (g_nCull); VertexShader = compile vs_2_0 vs_main(); PixelShader = compile ps_2_0 ps_main(); } }
