float Script : STANDARDSGLOBAL < string ScriptClass = "scene"; string Script = "Technique=gFast?Quick:Slow;"; > = 0.8;
bool gFast = false;
int gTimes = 3;
float gIndex;
float4 gBlack = 0;
Texture2D gMap : RENDERCOLORTARGET < string Format = "A16B16G16R16F"; float2 ViewportRatio = { 0.5, 0.5 }; int MipLevels = 1; >;
Texture2D gDepth : RENDERDEPTHSTENCILTARGET < int Width = 64; string Format = "D24S8"; >;
technique Quick { pass P { } }
technique Slow < string Script =
    "RenderColorTarget0=gMap; RenderDepthStencilTarget=gDepth; ClearSetColor=gBlack; Clear=Color; Clear=Depth;"
    "ScriptExternal=Color; LoopByCount=gTimes; LoopGetIndex=gIndex; Pass=P; LoopEnd; RenderColorTarget0=; Pass=P"; >
{
    pass P < string Script = "RenderColorTarget1=gMap; Draw=Buffer;"; string Instances = "gTimes"; > { ZFunc = GREATER; }
}
