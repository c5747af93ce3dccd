/*********************************************************************
   In the manner of a post process of FX Composer 2: scene first (ScriptExternal), quads by macros, targets at a fraction of the view
*********************************************************************/
float Script : STANDARDSGLOBAL <
    string UIWidget = "none";
    string ScriptClass = "scene";
    string ScriptOrder = "postprocess";
    string ScriptOutput = "color";
    string Script = "Technique=Technique?Bloom:Bloom_ps30:Passthrough;";
> = 0.8; // version #
float4 gClearColor < string UIWidget = "color"; string UIName = "Background"; > = {0.1,0.1,0.2,1.0};
float gClearDepth <string UIWidget = "none";> = 1.0;
#define DECLARE_QUAD_TEX(TexName,SampName,PixFmt) texture TexName : RENDERCOLORTARGET < float2 ViewPortRatio = {1.0,1.0}; int MipLevels = 1; string Format = (PixFmt); >; sampler2D SampName = sampler_state { texture = <TexName>; AddressU = Clamp; AddressV = Clamp; MagFilter = Linear; MinFilter = Linear; MipFilter = Point; };
#define DECLARE_SIZED_QUAD_TEX(TexName,SampName,PixFmt,Multiple) texture TexName : RENDERCOLORTARGET < float2 ViewPortRatio = {Multiple,Multiple}; int MipLevels = 1; string Format = (PixFmt) ; string UIWidget = "None"; >; sampler2D SampName = sampler_state { texture = <TexName>; AddressU = Clamp; AddressV = Clamp; MagFilter = Linear; MinFilter = Linear; MipFilter = Point; };
#define DECLARE_QUAD_DEPTH_BUFFER(TextureName,PixelFormat) texture TextureName : RENDERDEPTHSTENCILTARGET < float2 ViewPortRatio = {1.0,1.0}; string Format = (PixelFormat); string UIWidget = "None"; >;
DECLARE_QUAD_TEX(ScnTexture,ScnSamp,"X8R8G8B8")
DECLARE_SIZED_QUAD_TEX(Blur1,Blur1Samp,"A16B16G16R16F",0.25)
DECLARE_SIZED_QUAD_TEX(Blur2,Blur2Samp,"A16B16G16R16F",0.25)
DECLARE_QUAD_DEPTH_BUFFER(DepthBuffer,"D24S8")
float2 QuadScreenSize : VIEWPORTPIXELSIZE < string UIWidget = "None"; >;
float Sceneness < string UIName = "Original Scene"; string UIWidget = "slider"; float UIMin = 0.0f; float UIMax = 1.0f, UIStep = 0.1f; > = 0.7f;
float Glowness < string UIWidget = "slider"; float UIMin = 0.0f, UIMax = 2.0f, UIStep = 0.1f; > = 0.9f;
static float2 QuadTexelOffsets = float2(0.5/QuadScreenSize.x, 0.5/QuadScreenSize.y);
struct QuadVertexOutput { float4 Position : POSITION; float2 UV : TEXCOORD0; };
QuadVertexOutput ScreenQuadVS2(float3 Position : POSITION, float3 TexCoord : TEXCOORD0, uniform float2 TexelOffsets)
{
    QuadVertexOutput OUT = (QuadVertexOutput)0;
    OUT.Position = float4(Position, 1);
    OUT.UV = float2(TexCoord.xy+TexelOffsets);
    return OUT;
}
QuadVertexOutput ScreenQuadVS(float3 Position : POSITION, float3 TexCoord : TEXCOORD0) { return ScreenQuadVS2(Position, TexCoord, QuadTexelOffsets); }
static const half gWeights[7] = { 0.0702, 0.1311, 0.1907, 0.2160, 0.1907, 0.1311, 0.0702 };
half4 blurPS(QuadVertexOutput IN, uniform sampler2D SrcSamp, uniform half2 dir) : COLOR
{
    half4 c = 0;
    for (int i = 0; i < 7; i++) c += gWeights[i] * tex2D(SrcSamp, IN.UV + dir * (i - 3) * 8 / QuadScreenSize);
    return c;
}
half4 mixPS(QuadVertexOutput IN) : COLOR { return Sceneness * tex2D(ScnSamp, IN.UV) + Glowness * pow(tex2D(Blur2Samp, IN.UV), 2.0h); }
half4 passPS(QuadVertexOutput IN) : COLOR { return tex2D(ScnSamp, IN.UV); }
#define SCENE "RenderColorTarget0=ScnTexture;" "RenderDepthStencilTarget=DepthBuffer;" "ClearSetColor=gClearColor;" "ClearSetDepth=gClearDepth;" "Clear=Color;" "Clear=Depth;" "ScriptExternal=color;"
technique Bloom < string Script = SCENE "Pass=A;" "Pass=B;" "Pass=C;"; > {
    pass A < string Script = "RenderColorTarget0=Blur1;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; >
    { cullmode = none; ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; VertexShader = compile vs_3_0 ScreenQuadVS(); PixelShader = compile ps_3_0 blurPS(ScnSamp, half2(1, 0)); }
    pass B < string Script = "RenderColorTarget0=Blur2;" "Draw=Buffer;"; >
    { cullmode = none; ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; VertexShader = compile vs_3_0 ScreenQuadVS(); PixelShader = compile ps_3_0 blurPS(Blur1Samp, half2(0, 1)); }
    pass C < string Script = "RenderColorTarget0=;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; >
    { cullmode = none; ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; VertexShader = compile vs_3_0 ScreenQuadVS(); PixelShader = compile ps_3_0 mixPS(); }
}
technique Passthrough < string Script = SCENE "Pass=P;"; > {
    pass P < string Script = "RenderColorTarget0=;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; >
    { ZEnable = false; VertexShader = compile vs_3_0 ScreenQuadVS(); PixelShader = compile ps_3_0 passPS(); }
}
technique Bloom_ps30 < string Script = SCENE "Pass=P;"; > {
    pass P < string Script = "RenderColorTarget0=;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; >
    { ZEnable = false; VertexShader = compile vs_3_0 ScreenQuadVS(); PixelShader = compile ps_3_0 passPS(); }
}
