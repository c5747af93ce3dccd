// In the manner of the large deferred packages for MikuMikuEffect: settings in files of other endings, targets in several formats, a loop
#include "inc/ray/ray.conf"
#include "inc/ray/controller.fxsub"

float4x4 matWorld : WORLD;
float4x4 matView : VIEW;
float4x4 matViewInverse : VIEWINVERSE;
float4x4 matProject : PROJECTION;
float4x4 matProjectInverse : PROJECTIONINVERSE;
float4x4 matWorldViewProject : WORLDVIEWPROJECTION;
float3 CameraPosition : POSITION<string Object = "Camera";>;
float3 MainLightDirection : DIRECTION<string Object = "Light";>;
float time : TIME;
float elapsed : ELAPSEDTIME;
float2 MousePositionNDC : MOUSEPOSITION;
float2 ViewportSize : VIEWPORTPIXELSIZE;
static float2 ViewportOffset = (float2(0.5,0.5)/ViewportSize);
static float2 ViewportOffset2 = (float2(1.0,1.0)/ViewportSize);
static float ViewportAspect = ViewportSize.x / ViewportSize.y;
static const float3 LumaWeights = {0.299, 0.587, 0.114};
static const float PI = 3.1415926535f;

const float4 BackColor = float4(0,0,0,0);
const float ClearDepth = 1.0;
const int ClearStencil = 0;
int BloomIndex = 0;
int BloomCount = 3;

float Script : STANDARDSGLOBAL<
	string ScriptOutput = "color";
	string ScriptClass = "scene";
	string ScriptOrder = "postprocess";
> = 0.8;

shared texture2D ScnMap : RENDERCOLORTARGET<
	float2 ViewportRatio = {1.0, 1.0};
	bool AntiAlias = false;
	string Format = "X8R8G8B8";
	int Miplevels = 1;
>;
sampler ScnSamp = sampler_state {
	texture = <ScnMap>;
	MinFilter = NONE;   MagFilter = NONE;   MipFilter = NONE;
	AddressU  = CLAMP;  AddressV = CLAMP;
};
texture2D DepthMap : RENDERDEPTHSTENCILTARGET<
	float2 ViewportRatio = {1.0, 1.0};
	string Format = "D24S8";
>;
texture2D ShadingMap : RENDERCOLORTARGET<float2 ViewPortRatio={1.0, 1.0}; string Format="A16B16G16R16F";>;
sampler ShadingSamp = sampler_state { texture = <ShadingMap>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = NONE; AddressU = CLAMP; AddressV = CLAMP; };
texture2D BloomMap : RENDERCOLORTARGET<float2 ViewPortRatio={0.25, 0.25}; string Format="A2B10G10R10";>;
sampler BloomSamp = sampler_state { texture = <BloomMap>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = NONE; AddressU = BORDER; AddressV = BORDER; BorderColor = float4(0, 0, 0, 0); };
texture2D LumaMap : RENDERCOLORTARGET<int Width = 64; int Height = 64; int Miplevels = 0; string Format="R16F";>;
sampler LumaSamp = sampler_state { texture = <LumaMap>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = LINEAR; AddressU = CLAMP; AddressV = CLAMP; };
texture MaterialMap : OFFSCREENRENDERTARGET<
	string Description = "Material cache map for ray";
	float2 ViewportRatio = {1.0, 1.0};
	string Format = "A32B32G32R32F";
	float4 ClearColor = { 0, 0, 0, 0 };
	float ClearDepth = 1.0;
	bool AntiAlias = false;
	int Miplevels = 1;
	string DefaultEffect =
		"self = hide;"
		"*.pmd = materials/material.fx;"
		"* = hide;";
>;
sampler MaterialSamp = sampler_state { texture = <MaterialMap>; MinFilter = POINT; MagFilter = POINT; MipFilter = NONE; AddressU = CLAMP; AddressV = CLAMP; };

inline float luminance(float3 rgb) { return dot(rgb, LumaWeights); }
inline float4 srgb2linear(float4 c) { c.rgb = pow(c.rgb, 2.2); return c; }
float3 ACESFilm(float3 x)
{
	const float A = 2.51f;
	const float B = 0.03f;
	const float C = 2.43f;
	const float D = 0.59f;
	const float E = 0.14f;
	return saturate((x * (A * x + B)) / (x * (C * x + D) + E));
}
void ScreenSpaceQuadVS(
	in float4 Position : POSITION,
	in float4 Texcoord : TEXCOORD,
	out float4 oTexcoord : TEXCOORD0,
	out float4 oPosition : POSITION)
{
	oTexcoord = Texcoord;
	oTexcoord.zw = oTexcoord.xy * ViewportSize;
	oPosition = Position;
}
void ScreenSpaceQuadOffsetVS(in float4 Position : POSITION, in float4 Texcoord : TEXCOORD, out float4 oTexcoord : TEXCOORD0, out float4 oPosition : POSITION, uniform float2 offset)
{
	oTexcoord = Texcoord + float4(offset, 0, 0);
	oPosition = Position;
}
float4 ShadingPS(in float4 coord : TEXCOORD0, in float4 screenPosition : SV_Position) : COLOR
{
	float4 albedo = srgb2linear(tex2Dlod(ScnSamp, float4(coord.xy, 0, 0)));
	float4 material = tex2Dlod(MaterialSamp, float4(coord.xy, 0, 0));
	return float4(albedo.rgb * mSunIntensity * 0.5 + material.rgb * 0.1, luminance(albedo.rgb));
}
float4 BloomPS(in float2 coord : TEXCOORD0) : COLOR
{
	float4 c = tex2D(ShadingSamp, coord);
	return max(0, c - mBloomThreshold) / (1 + BloomIndex);
}
float4 LumaPS(in float2 coord : TEXCOORD0) : COLOR0
{
	return luminance(tex2D(ShadingSamp, coord).rgb);
}
float4 HDRTonemappingPS(in float4 coord : TEXCOORD0) : COLOR
{
	float4 color = tex2D(ShadingSamp, coord.xy);
	color.rgb += tex2D(BloomSamp, coord.xy).rgb;
	float average = tex2Dlod(LumaSamp, float4(0.5, 0.5, 0, 6)).r;
#if TONEMAP_OPERATOR > 1
	color.rgb = ACESFilm(color.rgb * mExposure / (0.5 + average));
#endif
	return float4(pow(color.rgb, 1 / 2.2), 1);
}

technique DeferredLighting<
	string Script =
	"RenderColorTarget=ScnMap;"
	"RenderDepthStencilTarget=DepthMap;"
	"ClearSetStencil=ClearStencil;"
	"ClearSetColor=BackColor;"
	"ClearSetDepth=ClearDepth;"
	"Clear=Color;"
	"Clear=Depth;"
	"ScriptExternal=Color;"

	"RenderDepthStencilTarget=;"
	"RenderColorTarget=ShadingMap;  Clear=Color; Pass=Shading;"
#if BLOOM_MODE
	"RenderColorTarget=BloomMap;"
	"Clear=Color;"
	"LoopByCount=BloomCount;"
	"LoopGetIndex=BloomIndex;"
	"Pass=Bloom;"
	"LoopEnd=;"
#endif
	"RenderColorTarget=LumaMap; Pass=Luma;"
	"RenderColorTarget=;"
	"Pass=Final;"
;>
{
	pass Shading<string Script= "Draw=Buffer;";>{
		AlphaBlendEnable = false; AlphaTestEnable = false;
		ZEnable = false; ZWriteEnable = false;
		VertexShader = compile vs_3_0 ScreenSpaceQuadVS();
		PixelShader  = compile ps_3_0 ShadingPS();
	}
	pass Bloom<string Script= "Draw=Buffer;";>{
		AlphaBlendEnable = true; AlphaTestEnable = false; SrcBlend = ONE; DestBlend = ONE;
		ZEnable = false; ZWriteEnable = false;
		VertexShader = compile vs_3_0 ScreenSpaceQuadOffsetVS(ViewportOffset2);
		PixelShader  = compile ps_3_0 BloomPS();
	}
	pass Luma<string Script= "Draw=Buffer;";>{
		AlphaBlendEnable = false; ZEnable = false; ZWriteEnable = false;
		VertexShader = compile vs_3_0 ScreenSpaceQuadOffsetVS(float2(0.5, 0.5) / 64);
		PixelShader  = compile ps_3_0 LumaPS();
	}
	pass Final<string Script= "Draw=Buffer;";>{
		AlphaBlendEnable = false; AlphaTestEnable = false;
		ZEnable = false; ZWriteEnable = false;
		VertexShader = compile vs_3_0 ScreenSpaceQuadVS();
		PixelShader  = compile ps_3_0 HDRTonemappingPS();
	}
}
