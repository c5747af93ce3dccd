// A post chain in the manner of a game engine: luminance that is adapted in place, bloom that reads what it writes, a curve in a picture of one dimension
#define USE_ADAPTATION
#if defined(USE_ADAPTATION) && !defined(NO_HDR)
#  define HDR 1
#else
#  define HDR 0
#endif
uniform float4x4 worldViewProj : WORLDVIEWPROJECTION;
uniform extern float4 viewportSize : VIEWPORTPIXELSIZE;
const uniform float exposure = 1.2;
uniform const float adaptRate = 0.04f;
float frameTime : ELAPSEDTIME = 0.016;
texture sceneRT : RENDERCOLORTARGET < float2 ViewPortRatio = { 1, 1 }; string Format = "A16B16G16R16F"; >;
texture adaptRT : RENDERCOLORTARGET < int2 Dimensions = { 1, 1 }; string Format = "R16F"; >;
texture bloomRT : RENDERCOLORTARGET < float2 ViewPortRatio = { 0.5, 0.5 }; string Format = "A8R8G8B8"; int MipLevels = 1; >;
texture depthRT : RENDERDEPTHSTENCILTARGET < float2 ViewPortRatio = { 1, 1 }; string Format = "D24X8"; >;
texture1D toneCurve < string ResourceName = "curve.png"; >;
sampler2D scene = sampler_state { Texture = <sceneRT>; MinFilter = Linear; MagFilter = Linear; AddressU = Clamp; AddressV = Clamp; };
sampler2D adapt = sampler_state { Texture = <adaptRT>; MinFilter = Point; MagFilter = Point; AddressU = Clamp; AddressV = Clamp; };
sampler2D bloom = sampler_state { Texture = <bloomRT>; MinFilter = Linear; MagFilter = Linear; AddressU = Clamp; AddressV = Clamp; };
sampler1D curve = sampler_state { Texture = <toneCurve>; MinFilter = Linear; MagFilter = Linear; AddressU = Clamp; };
float4 white = { 1, 1, 1, 1 };
float4 clearTo = { 0.1, 0.12, 0.15, 1 };
float one = 1;
void meshVS(float4 p : POSITION, float3 n : NORMAL, float2 uv : TEXCOORD0, out float4 op : POSITION, out float3 on : TEXCOORD0, out float2 ouv : TEXCOORD1)
{
    op = mul(p, worldViewProj);
    on = n;
    ouv = uv;
}
half4 meshPS(half3 n : TEXCOORD0, half2 uv : TEXCOORD1) : COLOR
{
    half3 base = (frac(uv.x * 12) > 0.5) != (frac(uv.y * 6) > 0.5) ? half3(1, 0.5, 0.25) : half3(0.3, 0.4, 0.9);
    half d = dot(normalize(n), normalize(half3(0.3, 0.6, 0.7)));
    return half4(base * max(d, 0.1) * 3, 1);
}
struct quad_t { float4 hpos : POSITION; float2 uv : TEXCOORD0; };
quad_t quadVS(float4 p : POSITION, float2 uv : TEXCOORD0)
{
    quad_t o;
    o.hpos = float4(p.xy, 0, 1);
    o.hpos.xy += float2(-1, 1) / viewportSize.xy;
    o.uv = uv;
    return o;
}
float4 adaptPS(quad_t q) : COLOR
{
    float sum = 0;
    for (float y = 0.1; y < 1; y += 0.2)
        for (float x = 0.1; x < 1; x += 0.2)
            sum += dot(tex2Dlod(scene, float4(x, y, 0, 0)).rgb, float3(0.3, 0.6, 0.1));
    float last = tex2D(adapt, float2(0.5, 0.5)).r;
    return lerp(last, sum / 25, 1 - exp(-adaptRate * 60)) + 0.1;
}
float4 bloomPS(quad_t q, uniform float2 dir) : COLOR
{
    float4 c = 0;
    [unroll(5)]
    for (int i = -2; i <= 2; i++)
        c += tex2D(bloom, q.uv + dir * i / viewportSize.xy * 2) * (3 - abs(i)) / 9.0f;
    return c;
}
float4 brightPS(quad_t q) : COLOR { return max(tex2D(scene, q.uv) - 1, 0); }
float4 tonePS(quad_t q) : COLOR
{
    float3 c = tex2D(scene, q.uv).rgb + tex2D(bloom, q.uv).rgb;
#if HDR
    c *= exposure / (1 + tex2D(adapt, 0.5).r);
#endif
    c = c / (1 + c);
    return float4(tex1D(curve, c.r).r, tex1D(curve, c.g).r, tex1D(curve, c.b).r, 1);
}
technique Post < string Script = "RenderColorTarget0=sceneRT; RenderDepthStencilTarget=depthRT; ClearSetColor=clearTo; ClearSetDepth=one; Clear=Color; Clear=Depth; Pass=mesh;"
    "RenderDepthStencilTarget=; RenderColorTarget0=adaptRT; Pass=adaptation; RenderColorTarget0=bloomRT; Pass=bright; Pass=bloomH; Pass=bloomV; RenderColorTarget0=; Pass=tone;"; >
{
    pass mesh { VertexShader = compile vs_2_a meshVS(); PixelShader = compile ps_2_b meshPS(); ZEnable = TRUE; ZWriteEnable = TRUE; CullMode = CCW; }
    pass adaptation < string Script = "Draw=Buffer;"; > { VertexShader = compile vs_3_0 quadVS(); PixelShader = compile ps_3_0 adaptPS(); ZEnable = 0; CullMode = 1; }
    pass bright < string Script = "Draw=Buffer;"; > { VertexShader = compile vs_3_0 quadVS(); PixelShader = compile ps_3_0 brightPS(); ZEnable = false; CullMode = None; }
    pass bloomH < string Script = "Draw=Buffer;"; > { VertexShader = compile vs_3_0 quadVS(); PixelShader = compile ps_3_0 bloomPS(float2(1, 0)); ZEnable = false; CullMode = None; }
    pass bloomV < string Script = "Draw=Buffer;"; > { VertexShader = compile vs_3_0 quadVS(); PixelShader = compile ps_3_0 bloomPS(float2(0, 1)); ZEnable = false; CullMode = None; }
    pass tone < string Script = "Draw=Buffer;"; > { VertexShader = compile vs_3_0 quadVS(); PixelShader = compile ps_3_0 tonePS(); ZEnable = false; CullMode = None; }
}
