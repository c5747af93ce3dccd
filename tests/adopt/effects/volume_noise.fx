// Marble by a volume that some tool was to fill.
float4x4 wvp : WORLDVIEWPROJECTION;
texture noiseVolume < string ResourceType = "VOLUME"; string function = "make_noise"; int3 Dimensions = { 32, 32, 32 }; >;
sampler3D noiseSampler = sampler_state { Texture = <noiseVolume>; MinFilter = LINEAR; MagFilter = LINEAR; AddressU = WRAP; AddressV = WRAP; AddressW = WRAP; };
void vs(float4 p : POSITION, out float4 o : POSITION, out float3 t : TEXCOORD0) { o = mul(p, wvp); t = p.xyz * 0.2 + 0.5; }
float4 ps(float3 t : TEXCOORD0) : COLOR { float4 n = tex3D(noiseSampler, t) + tex3Dlod(noiseSampler, float4(t * 2, 0)) * 0.5; return float4(sin(t.x * 20 + n.x * 3) * 0.5 + 0.5, n.yz * 0.5, 1); }
technique Marble { pass P { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); } }
