// A post effect of MikuMikuEffect: offscreen target, viewport size, time, two techniques by a script.
float Script : STANDARDSGLOBAL < string ScriptOutput = "color"; string ScriptClass = "scene"; string ScriptOrder = "postprocess"; > = 0.8;
float Extent < string UIName = "Extent"; string UIWidget = "Numeric"; bool UIVisible = true; float UIMin = 0.00; float UIMax = 0.01; > = float(0.0007);
float2 ViewportSize : VIEWPORTPIXELSIZE;
float time : TIME; float Tr : CONTROLOBJECT < string name = "(self)"; string item = "Tr"; >;
static float2 ViewportOffset = (float2(0.5, 0.5) / ViewportSize);
static float2 SampStep = (float2(Extent, Extent) / ViewportSize * ViewportSize.y);
float4 ClearColor = { 0.4, 0.3, 0.6, 0 }; float ClearDepth = 1.0;
texture2D DepthBuffer : RENDERDEPTHSTENCILTARGET < float2 ViewPortRatio = { 1.0, 1.0 }; string Format = "D24S8"; >;
texture2D ScnMap : RENDERCOLORTARGET < float2 ViewPortRatio = { 1.0, 1.0 }; int MipLevels = 1; string Format = "A16B16G16R16F"; >;
sampler2D ScnSamp = sampler_state { texture = <ScnMap>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = LINEAR; AddressU = CLAMP; AddressV = CLAMP; };
struct VS_OUTPUT { float4 Pos : POSITION; float2 Tex : TEXCOORD0; };
VS_OUTPUT VS_passDraw(float4 Pos : POSITION, float4 Tex : TEXCOORD0) { VS_OUTPUT Out = (VS_OUTPUT)0; Out.Pos = Pos; Out.Tex = Tex.xy + ViewportOffset; return Out; }
float4 PS_passX(float2 Tex : TEXCOORD0) : COLOR { float4 c = tex2D(ScnSamp, Tex); c += tex2D(ScnSamp, Tex + float2(SampStep.x, 0)); c.rgb *= 0.5; float2 d = Tex - 0.5; c.rgb *= 1 - dot(d, d) * 1.5; c.r += sin(Tex.y * 60 + time) * 0.1; return c; }
technique Gauss < string Script = "RenderColorTarget0=ScnMap; RenderDepthStencilTarget=DepthBuffer; ClearSetColor=ClearColor; ClearSetDepth=ClearDepth; Clear=Color; Clear=Depth; ScriptExternal=Color; RenderColorTarget0=; RenderDepthStencilTarget=; ClearSetColor=ClearColor; Clear=Color; Clear=Depth; Pass=Gaussian_X;"; >
{
    pass Gaussian_X < string Script = "Draw=Buffer;"; > { AlphaBlendEnable = false; AlphaTestEnable = false; VertexShader = compile vs_2_0 VS_passDraw(); PixelShader = compile ps_2_0 PS_passX(); }
}
