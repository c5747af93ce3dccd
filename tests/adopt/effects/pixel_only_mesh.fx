// A pixel shader on a mesh that the fixed-function vertex pipeline places.
texture tBase : TEXTURE0;
sampler sBase = sampler_state { Texture = <tBase>; MinFilter = Linear; MagFilter = Linear; };
float4 tint : COLOR = { 1, 0.8, 0.5, 1 };
float4 main(float2 uv : TEXCOORD0, float4 diffuse : COLOR0) : COLOR { return tex2D(sBase, uv) * diffuse * tint; }
technique T { pass P { Texture[0] = <tBase>; ZEnable = TRUE; PixelShader = compile ps_1_1 main(); } }
