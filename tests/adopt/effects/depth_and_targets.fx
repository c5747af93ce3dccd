// Two passes with a target between them, smaller than the picture, and a depth of its own; the second covers the picture.
float4x4 wvp : WorldViewProjection; float4x4 world : World;
float4 clearColour = { 0.1, 0.2, 0.3, 1 }; float clearDepth = 1;
texture smallMap : RENDERCOLORTARGET < int Width = 128; int Height = 128; string Format = "R5G6B5"; >;
texture smallDepth : RENDERDEPTHSTENCILTARGET < int width = 128, height = 128; string format = "D24X8"; >;
sampler smallSampler = sampler_state { Texture = (smallMap); MinFilter = LINEAR; MagFilter = POINT; AddressU = CLAMP; AddressV = CLAMP; };
void sceneVS(float4 p : POSITION, float3 n : NORMAL, out float4 o : POSITION, out float3 c : COLOR0) { o = mul(p, wvp); c = mul(n, (float3x3)world) * 0.5 + 0.5; }
float4 scenePS(float3 c : COLOR0) : COLOR { return float4(c, 1); }
void quadVS(float4 p : POSITION, float2 t : TEXCOORD0, out float4 o : POSITION, out float2 u : TEXCOORD0) { o = p; u = t; }
float4 quadPS(float2 u : TEXCOORD0) : COLOR { return tex2D(smallSampler, u).bgra; }
technique T < string Script = "Pass=Scene;Pass=Show;"; > {
    pass Scene < string Script = "RenderColorTarget0=smallMap;RenderDepthStencilTarget=smallDepth;ClearSetColor=clearColour;ClearSetDepth=clearDepth;Clear=Color;Clear=Depth;Draw=Geometry;"; > { ZEnable = TRUE; VertexShader = compile vs_2_0 sceneVS(); PixelShader = compile ps_2_0 scenePS(); }
    pass Show < string Script = "RenderColorTarget0=;RenderDepthStencilTarget=;Draw=Buffer;"; > { ZEnable = FALSE; VertexShader = compile vs_2_0 quadVS(); PixelShader = compile ps_2_0 quadPS(); }
}
