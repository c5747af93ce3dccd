// A panorama by angles, of directions that are not normalized.
float4x4 gWvp : WORLDVIEWPROJECTION;
texture gMap;
sampler2D gMaps = sampler_state { Texture = (gMap); MinFilter = LINEAR; MagFilter = LINEAR; };

void VS(inout float4 p : POSITION, out half3 to : TEXCOORD0) { to = p.xyz * 1.8; p = mul(p, gWvp); }
float2 angles(half3 to) { return float2(atan2(to.z, to.x), acos(to.y)) / float2(6.2832, 3.1416); }
float4 PS(half3 to : TEXCOORD0) : COLOR { return tex2Dlod(gMaps, float4(angles(to), 0, 0)); }

technique T { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
