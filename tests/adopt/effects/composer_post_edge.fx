// A scene effect in the manner of FX Composer: the scene below goes through a target of its own.
float Script : STANDARDSGLOBAL < string UIWidget = "none"; string ScriptClass = "scene"; string ScriptOrder = "postprocess"; string ScriptOutput = "color"; string Script = "Technique=Edges;"; > = 0.8;
float4 gClearColor < string UIWidget = "Color"; string UIName = "Background"; > = { 0.2, 0.4, 0.6, 1.0 };
float gClearDepth < string UIWidget = "none"; > = 1.0;
float NPixels < string UIName = "Pixels Steps"; string UIWidget = "slider"; float UIMin = 1.0f; float UIMax = 5.0f; float UIStep = 0.5f; > = 1.5f;
float2 QuadScreenSize : VIEWPORTPIXELSIZE < string UIWidget = "None"; >;
texture gSceneTexture : RENDERCOLORTARGET < float2 ViewPortRatio = { 1.0, 1.0 }; int MipLevels = 1; string Format = ("A8R8G8B8"); string UIWidget = "None"; >;
sampler2D gSceneSampler = sampler_state { texture = <gSceneTexture>; AddressU = Clamp; AddressV = Clamp; MipFilter = POINT; MinFilter = LINEAR; MagFilter = LINEAR; };
texture gDepthBuffer : RENDERDEPTHSTENCILTARGET < float2 ViewPortRatio = { 1.0, 1.0 }; string Format = ("D24S8"); string UIWidget = "None"; >;
struct QuadVertexOutput { float4 Position : POSITION; float2 UV : TEXCOORD0; };
QuadVertexOutput ScreenQuadVS(float3 Position : POSITION, float3 TexCoord : TEXCOORD0)
{
    QuadVertexOutput OUT = (QuadVertexOutput)0;
    OUT.Position = float4(Position, 1);
    OUT.UV = TexCoord.xy + 0.5 / QuadScreenSize;
    return OUT;
}
float4 edgesPS(QuadVertexOutput IN) : COLOR
{
    float2 ox = float2(NPixels / QuadScreenSize.x, 0.0);
    float4 c = tex2D(gSceneSampler, IN.UV);
    float4 e = abs(tex2D(gSceneSampler, IN.UV + ox) - tex2D(gSceneSampler, IN.UV - ox));
    return c + e + float4(IN.UV, 0, 0) * 0.3;
}
technique Edges < string Script = "RenderColorTarget0=gSceneTexture;" "RenderDepthStencilTarget=gDepthBuffer;" "ClearSetColor=gClearColor;" "ClearSetDepth=gClearDepth;" "Clear=Color;" "Clear=Depth;" "ScriptExternal=color;" "Pass=post;"; >
{
    pass post < string Script = "RenderColorTarget0=;" "RenderDepthStencilTarget=;" "Draw=Buffer;"; > { VertexShader = compile vs_3_0 ScreenQuadVS(); ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; CullMode = None; PixelShader = compile ps_3_0 edgesPS(); }
}
