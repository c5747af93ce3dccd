// Likewise into a target of another size, which a second pass shows.
float2 gSize : VIEWPORTPIXELSIZE;
texture gHalf : RENDERCOLORTARGET < float2 ViewportRatio = { 0.5, 0.5 }; >;
sampler2D gHalves = sampler_state { Texture = <gHalf>; MinFilter = POINT; MagFilter = POINT; };
struct Corner { float4 p : POSITION; float2 uv : TEXCOORD0; };
Corner VS(Corner corner)
{
    float2 share = (corner.p.xy - 0.5) / gSize;
    corner.p = float4(share.x * 2 - 1, 1 - share.y * 2, 0, 1);
    return corner;
}
float4 Write(float2 uv : TEXCOORD0) : COLOR { return float4(uv.x > 0.5, uv.y > 0.25, 0.25, 1); }
float4 Show(float2 uv : TEXCOORD0) : COLOR { return tex2D(gHalves, uv).bgra; }
technique T < string Script = "RenderColorTarget0=gHalf; Pass=A; RenderColorTarget0=; Pass=B;"; >
{
    pass A < string Script = "Draw=buffer;"; > { ZEnable = FALSE; VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 Write(); }
    pass B < string Script = "Draw=buffer;"; > { ZEnable = FALSE; VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 Show(); }
}
