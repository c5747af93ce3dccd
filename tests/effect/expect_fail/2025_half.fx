// expect: 2025_half.fx(2,7): error TG2025: 'gTint' is a global half4; write float
half4 gTint = { 1, 1, 1, 1 };
float4 VS(float4 p : POSITION) : POSITION { return p; }
float4 PS() : COLOR { return 1; }
technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
