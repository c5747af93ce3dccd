//++++++++++++++++++++++++++++++++++++++++++++
// In the manner of the effects that injectors of post processing read
//++++++++++++++++++++++++++++++++++++++++++++
#define APPLYGAMECOLORCORRECTION
#ifndef POSTPROCESS
 #define POSTPROCESS	2
#endif
float	EAdaptationMinV2
<
	string UIName="Min adaptation";
	string UIWidget="Spinner";
	float UIMin=0.0;
	float UIMax=5.0;
> = {0.05};
float	EAdaptationMaxV2={0.125};
float	EToneMappingCurveV2=6.0;
float	EIntensityContrastV2=1.3;
float	EColorSaturationV2=1.4;
float	EToneMappingOversaturationV2=60.0;

//x=generic timer in range 0..1, period of 16777216 ms (4.6 hours), w=frame time elapsed (in seconds)
float4	Timer;
//x=Width, y=1/Width, z=ScreenScaleY, w=1/ScreenScaleY
float4	ScreenSize;
float4	tempF1; //0,1,2,3
float4	tempInfo1;
float	ENightDayFactor;

texture2D texs0;//color
texture2D texs3;//bloom
texture2D texs4;//adaptation
sampler2D _s0 = sampler_state
{
	Texture   = <texs0>;
	MinFilter = POINT;//
	MagFilter = POINT;//
	MipFilter = NONE;//LINEAR;
	AddressU  = Clamp;
	AddressV  = Clamp;
	SRGBTexture=FALSE;
	MaxMipLevel=0;
	MipMapLodBias=0;
};
sampler2D _s3 = sampler_state
{
	Texture   = <texs3>;
	MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = NONE;
	AddressU  = Clamp; AddressV  = Clamp; SRGBTexture=FALSE; MaxMipLevel=0; MipMapLodBias=0;
};
sampler2D _s4 = sampler_state
{
	Texture   = <texs4>;
	MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = NONE;
	AddressU  = Clamp; AddressV  = Clamp; SRGBTexture=FALSE; MaxMipLevel=0; MipMapLodBias=0;
};

struct VS_OUTPUT_POST
{
	float4 vpos  : POSITION;
	float2 txcoord0 : TEXCOORD0;
};
struct VS_INPUT_POST
{
	float3 pos  : POSITION;
	float2 txcoord0 : TEXCOORD0;
};
VS_OUTPUT_POST VS_Quad(VS_INPUT_POST IN)
{
	VS_OUTPUT_POST OUT;

	OUT.vpos=float4(IN.pos.x,IN.pos.y,IN.pos.z,1.0);

	OUT.txcoord0.xy=IN.txcoord0.xy;

	return OUT;
}

float4 PS_D6EC7DD1(VS_OUTPUT_POST IN, float2 vPos : VPOS) : COLOR
{
	float4 _oC0=0.0; //output
	float4 _c6=float4(0, 0, 0, 0);
	float4 _c7=float4(0.212500006, 0.715399981, 0.0720999986, 1.0);
	float4 r0;
	float4 r1;
	float4 r11;
	float4 _v0=0.0;
	_v0.xy=IN.txcoord0.xy;
	r1=tex2D(_s0, _v0.xy); //color
	r11=r1; //my bypass
	_oC0.xyz=r1.xyz; //for future use without game color corrections
#ifdef APPLYGAMECOLORCORRECTION
	r0.x=dot(r1, _c7);
	r0=r0.x-r1*_c6.x;
	r1.w=max(r0.x, 0.000001);
	_oC0.rgb=lerp(_oC0.rgb, r1.rgb*(1.0+0.25*r1.w), 0.5);
#endif
	float4 color=_oC0;
	float4 Adaptation=tex2D(_s4, 0.5);
	float grayadaptation=max(max(Adaptation.x, Adaptation.y), Adaptation.z);
	grayadaptation=max(grayadaptation, 0.0);
	grayadaptation=min(grayadaptation, 50.0);
	float4 xcolorbloom=tex2D(_s3, _v0.xy);
	color.xyz+=xcolorbloom.xyz*0.3;
#if (POSTPROCESS==1)
	color.xyz=color.xyz/(grayadaptation*EAdaptationMaxV2+EAdaptationMinV2);
#elif (POSTPROCESS==2)
	color.xyz=color.xyz/(grayadaptation*EAdaptationMaxV2+EAdaptationMinV2);
	color.xyz=max(color.xyz, 0.0);
	float3 xncol=normalize(color.xyz);
	float3 scl=color.xyz/xncol.xyz;
	scl=pow(scl, EIntensityContrastV2);
	xncol.xyz=pow(xncol.xyz, EColorSaturationV2);
	color.xyz=scl*xncol.xyz;
	float lumamax=EToneMappingOversaturationV2;
	color.xyz=(color.xyz * (1.0 + color.xyz/lumamax))/(color.xyz + EToneMappingCurveV2);
#endif
	_oC0.w=1.0;
	_oC0.xyz=color.xyz;
	if (vPos.x<0) _oC0=tempF1*tempInfo1+ENightDayFactor*Timer.x;
	return _oC0;
}

//switch between vanilla and mine
technique Shader_D6EC7DD1 <string UIName="ENBSeries";>
{
	pass p0
	{
		VertexShader  = compile vs_3_0 VS_Quad();
		PixelShader  = compile ps_3_0 PS_D6EC7DD1();

		ColorWriteEnable=ALPHA|RED|GREEN|BLUE;
		ZEnable=FALSE;
		ZWriteEnable=FALSE;
		CullMode=NONE;
		AlphaTestEnable=FALSE;
		AlphaBlendEnable=FALSE;
		SRGBWRITEENABLE=FALSE;
	}
}

//original shader of post processing
technique Shader_ORIGINALPOSTPROCESS <string UIName="Vanilla";> //do not modify
{
	pass p0
	{
		VertexShader  = compile vs_3_0 VS_Quad();
		PixelShader=
	asm
	{
		ps_3_0
		def c6, 0, 0, 0, 0
		dcl_texcoord v0.xy
		dcl_2d s0
		texld r0, v0, s0
		mov oC0, r0
	};
		ColorWriteEnable=ALPHA|RED|GREEN|BLUE;
		ZEnable=FALSE;
	}
}
