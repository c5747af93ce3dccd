// In the manner of a game engine of the 2000s whose effects have no names: globals by their names alone, entSkin1, vecSunDir
float4x4 matWorldViewProj;
float4x4 matWorld;
float4x4 matWorldInv;
float4x4 matViewInv;
float4 vecSunDir;
float4 vecSunDiffuse;
float4 vecViewPos;
float4 vecLight;
float4 vecDiffuse;
float4 vecFog;
float4 vecTime;
float4 vecSkill41;
float3 vecTint = (0.3, 0.6, 0.9);
texture entSkin1;
texture entSkin2;
texture mtlSkin1;
sampler sTex1 = sampler_state { Texture = <entSkin1>; MipFilter = Linear; MinFilter = linear; MAGFILTER = LINEAR; AddressU = Wrap; Addressv = wrap; };
sampler sTex2 = sampler_state { Texture = <mtlSkin1>; MipFilter = Linear; };
struct out_vs { float4 Pos : POSITION; float Fog : FOG; float2 Tex1 : TEXCOORD0; float3 Normal : TEXCOORD1; float Size : PSIZE; };
out_vs vs(in float4 inPos : POSITION, in float3 inNormal : NORMAL, in float2 inTex : TEXCOORD0)
{
	out_vs Out;
	Out.Pos = mul(inPos, matWorldViewProj);
	Out.Normal = normalize(mul(inNormal, (float3x3)matWorld));
	Out.Tex1 = inTex + vecSkill41.xy * vecTime.w;
	float3 P = mul(inPos, matWorld);
	Out.Fog = 1 - (distance(P, vecViewPos.xyz) - vecFog.x) * vecFog.z;
	Out.Size = 1;
	return Out;
}
float4 ps(out_vs In) : COLOR
{
	float4 base = tex2D(sTex1, In.Tex1);
	float light = saturate(dot(-vecSunDir.xyz, normalize(In.Normal)));
	base.rgb *= light * vecSunDiffuse.rgb + 0.2 * vecTint;
	base.rgb += tex2Dbias(sTex2, float4(In.Tex1 * 2, 0, 1)).rgb * 0.1;
	base.a = 1;
	return base;
}
technique
{
	pass
	{
		zWriteEnable = true;
		AlphaBlendEnable = false;
		FogEnable = False;
		Lighting = false;
		VertexShader = compile vs_2_0 vs();
		PixelShader = compile ps_2_0 ps();
	}
}
technique fallback { pass one { } }
