// Shaders in a state block: without it there is nothing to draw by.
float4x4 gWvp : WORLDVIEWPROJECTION;
void VS(inout float4 p : POSITION, float3 n : NORMAL, out float3 shade : TEXCOORD0) { p = mul(p, gWvp); shade = n * 0.5 + 0.5; }
float4 PS(float3 shade : TEXCOORD0) : COLOR { return float4(shade, 1); }
stateblock gAll = stateblock_state { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); CullMode = NONE; };
technique T { pass P { StateBlock = <gAll>; } }
