// •\Ž¦: ”¼Šp¶Å, ”\“o, ƒ\ƒtƒg - bytes whose second half is a backslash, none at the end of a line
float4x4 WorldViewProjMatrix : WORLDVIEWPROJECTION; float3 LightDir : DIRECTION < string Object = "Light"; >;
int Loops = 2; int Index; float4 ClearColor = {0, 0, 0.2, 1}; float ClearDepth = 1;
texture Target : RENDERCOLORTARGET < float2 ViewPortRatio = {1, 1}; string Format = "A8R8G8B8"; string Comment = "•`‰ææ"; >;
sampler TargetSamp = sampler_state { texture = <Target>; MINFILTER = LINEAR; MAGFILTER = LINEAR; };
texture Depth : RENDERDEPTHSTENCILTARGET < float2 ViewPortRatio = {1, 1}; string Format = "D24S8"; >;
struct VO { float4 p : POSITION; float3 n : TEXCOORD0; };
VO VS(float4 p : POSITION, float3 n : NORMAL) { VO o; p.xyz *= 1 - 0.25 * Index; o.p = mul(p, WorldViewProjMatrix); o.n = n; return o; } /* ’¸“_ */
float4 PS(VO i) : COLOR { return float4(saturate(dot(normalize(i.n), -LightDir)) * float3(1, 0.5 * Index, 0.3), 0.7); }
void VQ(float4 p : POSITION, float2 t : TEXCOORD0, out float4 o : POSITION, out float2 u : TEXCOORD0) { o = p; u = t; }
float4 PQ(float2 u : TEXCOORD0) : COLOR { return tex2D(TargetSamp, u) + 0.1 * tex2D(TargetSamp, u + 0.05); }
technique T < string Script = "RenderColorTarget0=Target; RenderDepthStencilTarget=Depth; ClearSetColor=ClearColor; ClearSetDepth=ClearDepth; Clear=Color; Clear=Depth;"
 "LoopByCount=Loops; LoopGetIndex=Index; Pass=Object; LoopEnd=; RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Show;"; >
{
    pass Object < string Script = "Draw=Geometry;"; > { AlphaBlendEnable = TRUE; SrcBlend = SRCALPHA; DestBlend = INVSRCALPHA; ZFunc = Always; VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); }
    pass Show < string Script = "Draw=Buffer;"; > { AlphaBlendEnable = FALSE; VertexShader = compile vs_3_0 VQ(); PixelShader = compile ps_3_0 PQ(); }
}
