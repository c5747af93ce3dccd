// RenderMonkey-like fullscreen
float4 vViewport; float sepiaAmount = 0.7;
sampler Texture0;
struct VS_OUT { float4 Pos : POSITION; float2 tex : TEXCOORD0; };
VS_OUT vs_main(float4 inPos : POSITION) { VS_OUT o; inPos.xy = sign(inPos.xy); o.Pos = float4(inPos.xy, 0, 1); o.tex = (float2(o.Pos.x, -o.Pos.y) + 1) / 2; return o; }
float4 ps_main(float2 tex : TEXCOORD0) : COLOR { half4 c = tex2D(Texture0, tex); half g = dot(c.rgb, half3(0.3, 0.59, 0.11)); return lerp(c, half4(g * half3(1.2, 1.0, 0.8), 1), sepiaAmount) * float4(tex, 1, 1); }
technique Sepia { pass Single_Pass { VertexShader = compile vs_1_1 vs_main(); PixelShader = compile ps_2_0 ps_main(); CULLMODE = NONE; ZENABLE = FALSE; } }
