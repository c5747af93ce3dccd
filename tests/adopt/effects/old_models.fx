// Shader model 1: assembly beside functions, fixed-function stages, constants by register; the second technique is drawn by --technique.
float4x4 mWVP : WORLDVIEWPROJECTION; float4 lightDirection = { 0.5, 0.7, 0.5, 0 };
texture tex0 < string name = "tiger.bmp"; >;
struct VO { float4 pos : POSITION; float4 diff : COLOR0; float4 spec : COLOR1; float2 uv : TEXCOORD0; };
VO v(float4 p : POSITION, float3 n : NORMAL, float2 uv : TEXCOORD0) { VO o; o.pos = mul(p, mWVP); o.diff = dot(n, lightDirection.xyz) * 2; o.spec = o.diff * o.diff * o.diff; o.uv = uv; return o; }
sampler s0 = sampler_state { Texture = <tex0>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
float4 p(VO i) : COLOR { return tex2D(s0, i.uv) * i.diff + i.spec * 0.3; }
technique tHlsl { pass p0 { VertexShader = compile vs_1_1 v(); PixelShader = compile ps_1_1 p(); FogEnable = FALSE; SpecularEnable = FALSE; TexCoordIndex[0] = 0; AddressU[0] = Wrap; } }
technique tAsm { pass p0 { VertexShaderConstant[0] = <mWVP>; Texture[0] = <tex0>; Sampler[0] = <s0>; VertexShader = asm { vs_1_1
 dcl_position v0
 m4x4 oPos, v0, c0 }; ColorOp[0] = SelectArg1; ColorArg1[0] = Texture; ColorOp[1] = Disable; MaterialDiffuse = { 1, 1, 1, 1 }; LightEnable[0] = TRUE; } }
