/*********************************************************************
  A scene effect in the manner of FX Composer's library: three quads, macros from a header whose name is written in another case
*********************************************************************/
#ifdef _3DSMAX_
int ParamID = 0x0003;
#endif /* _3DSMAX_ */
float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "scene";
    string ScriptOrder = "postprocess";
    string ScriptOutput = "color";
    string Script = "Technique=Technique?Glow_7Tap:Glow_5Tap;";
> = 0.8; // version #
float4 gClearColor <
    string UIWidget = "Color";
    string UIName = "Background";
> = {0,0.05,0.1,0};
float gClearDepth <string UIWidget = "none";> = 1.0;

#include "INC\\quad.fxh"

float gGlowSpan <
    string UIWidget = "slider";
    float UIMin = 0.2f;
    float UIMax = 8.0f;
    float UIStep = 0.5f;
    string UIName = "Glow Span";
> = 2.5f;
float3 gGlowCol <string UIName = "Glow"; string UIWidget = "Color";> = {1.0f, 0.8f, 0.5f};

DECLARE_QUAD_TEX(gScnMap,gScnSamp,"A8R8G8B8")
DECLARE_SIZED_QUAD_TEX(gGlowMap1,gGlowSamp1,"A8R8G8B8",0.5)
DECLARE_SIZED_QUAD_TEX(gGlowMap2,gGlowSamp2,"A8R8G8B8",0.5)
DECLARE_QUAD_DEPTH_BUFFER(DepthBuffer,"D24S8")

#define WT_0 1.0
#define WT_1 0.8
#define WT_2 0.6
#define WT_3 0.4
#define WT_NORMALIZE (WT_0+2.0*(WT_1+WT_2+WT_3))
#define KW(n) (WT_##n/WT_NORMALIZE)

struct OneTexelVertex {
    QuadReal4 Position	: POSITION;
    QuadReal2 UV	: TEXCOORD0;
    QuadReal2 Step	: TEXCOORD1;
};
OneTexelVertex VS_Blur(QuadReal3 Position : POSITION, QuadReal3 TexCoord : TEXCOORD0, uniform QuadReal2 Direction)
{
    OneTexelVertex OUT = (OneTexelVertex)0;
    OUT.Position = QuadReal4(Position, 1);
    OUT.UV = TexCoord.xy + QuadTexelOffsets() / QuadScreenSize;
    OUT.Step = Direction * gGlowSpan / QuadScreenSize;
    return OUT;
}
half4 PS_Blur(OneTexelVertex IN, uniform sampler2D SrcSamp, uniform const int Taps) : COLOR
{
    half4 c = tex2D(SrcSamp, IN.UV) * KW(0);
    for (int i = 1; i <= Taps; i++) {
	half w = i == 1 ? KW(1) : (i == 2 ? KW(2) : KW(3));
	c += (tex2D(SrcSamp, IN.UV + i * IN.Step) + tex2D(SrcSamp, IN.UV - i * IN.Step)) * w;
    }
    return c;
}
half4 PS_Comp(QuadVertexOutput IN) : COLOR
{
    half4 scn = tex2D(gScnSamp, IN.UV);
    half3 glow = gGlowCol * tex2D(gGlowSamp2, IN.UV).xyz;
    return half4(scn.xyz + glow * glow, scn.w);
}

#define GLOW(NAME, TAPS) technique NAME < \
    string Script = "RenderColorTarget0=gScnMap;" \
	"RenderDepthStencilTarget=DepthBuffer;" \
	"ClearSetColor=gClearColor;" \
	"ClearSetDepth=gClearDepth;" \
	"Clear=Color;" \
	"Clear=Depth;" \
	"ScriptExternal=color;" \
	"Pass=BlurH;" "Pass=BlurV;" "Pass=Comp;"; > { \
    pass BlurH < string Script = "RenderColorTarget0=gGlowMap1;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; > { \
	cullmode = none; ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; \
	VertexShader = compile vs_2_0 VS_Blur(float2(1, 0)); \
	PixelShader  = compile ps_2_a PS_Blur(gScnSamp, TAPS); } \
    pass BlurV < string Script = "RenderColorTarget0=gGlowMap2;" "Draw=Buffer;"; > { \
	cullmode = none; ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; \
	VertexShader = compile vs_2_0 VS_Blur(QuadReal2(0, 1)); \
	PixelShader  = compile ps_2_a PS_Blur(gGlowSamp1, TAPS); } \
    pass Comp < string Script= "RenderColorTarget0=;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; > { \
	cullmode = none; ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; \
	VertexShader = compile vs_2_0 ScreenQuadVS(); \
	PixelShader  = compile ps_2_0 PS_Comp(); } }

GLOW(Glow_7Tap, 3)
GLOW(Glow_5Tap, 2)
