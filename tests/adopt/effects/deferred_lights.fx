// A deferred renderer in the manner of a hobby engine: four targets at once, depth in a float target, lights over the stencil
float4x4 world : World; float4x4 view : View; float4x4 proj : Projection; float4x4 viewProjInv : ViewProjectionInverse;
float3 eye : CameraPosition; float3 lightPos; float4 lightColour = { 1, 0.9, 0.7, 3 }; float lightRadius = 12;
texture diffuseMap : DIFFUSE; texture normalMap : NORMAL; texture specularMap : SPECULAR;
texture rtColor : RENDERCOLORTARGET < float2 Dimensions = { 256, 256 }; string Format = "A8R8G8B8"; >;
texture rtNormal : RENDERCOLORTARGET < float2 Dimensions = { 256, 256 }; string Format = "A2R10G10B10"; >;
texture rtDepth : RENDERCOLORTARGET < float2 Dimensions = { 256, 256 }; string Format = "R32F"; >;
texture rtDS : RENDERDEPTHSTENCILTARGET < float2 Dimensions = { 512, 512 }; string Format = "D24S8"; >;
texture rtLight : RENDERCOLORTARGET < float2 Dimensions = { 256, 256 }; string Format = "A16B16G16R16F"; >;
#define SAMPLER(s, t, f) sampler s = sampler_state { Texture = <t>; MinFilter = f; MagFilter = f; MipFilter = f; AddressU = Clamp; AddressV = Clamp; }
SAMPLER(sDiffuse, diffuseMap, Linear);
SAMPLER(sNormalMap, normalMap, Linear);
SAMPLER(sColor, rtColor, Point);
SAMPLER(sNormal, rtNormal, Point);
SAMPLER(sDepth, rtDepth, Point);
SAMPLER(sLight, rtLight, Point);
struct GIn { float3 p : POSITION; float3 n : NORMAL; float3 t : TANGENT; float3 b : BINORMAL; float2 uv : TEXCOORD; };
struct GMid { float4 hp : POSITION; float2 uv : TEXCOORD0; float3x3 tbn : TEXCOORD1; float2 zw : TEXCOORD4; };
struct GOut { half4 colour : COLOR0; half4 normal : COLOR1; float4 depth : COLOR2; };
GMid GVS(GIn i)
{
    GMid o;
    o.hp = mul(mul(mul(float4(i.p, 1), world), view), proj);
    o.uv = i.uv;
    o.tbn = mul(float3x3(i.t, i.b, i.n), (float3x3)world);
    o.zw = o.hp.zw;
    return o;
}
GOut GPS(GMid i)
{
    GOut o;
    o.colour = tex2D(sDiffuse, i.uv);
    float3 n = tex2D(sNormalMap, i.uv).xyz * 2 - 1;
    o.normal = float4(normalize(mul(n, i.tbn)) * 0.5 + 0.5, 1);
    o.depth = i.zw.x / i.zw.y;
    return o;
}
struct Quad { float4 p : POSITION; float2 uv : TEXCOORD0; };
Quad QVS(float3 p : POSITION, float2 uv : TEXCOORD0) { Quad o = { float4(p, 1), uv }; return o; }
float4 LPS(Quad q, uniform bool specular) : COLOR0
{
    float4 colour = tex2D(sColor, q.uv);
    float3 n = normalize(tex2D(sNormal, q.uv).xyz * 2 - 1);
    float z = tex2D(sDepth, q.uv).x;
    clip(z <= 0 ? -1 : 1);
    float4 wp = mul(float4(q.uv.x * 2 - 1, 1 - q.uv.y * 2, z, 1), viewProjInv);
    wp.xyz /= wp.w;
    float3 l = lightPos - wp.xyz;
    float att = saturate(1 - dot(l, l) / (lightRadius * lightRadius));
    l = normalize(l);
    float3 h = normalize(l + normalize(eye - wp.xyz));
    float s = 0;
    [flatten] if (specular) s = pow(saturate(dot(n, h)), 40);
    return float4((colour.rgb * saturate(dot(n, l)) + s) * lightColour.rgb * (0.4 + 0.6 * att), 1);
}
float4 CPS(Quad q) : COLOR { return tex2D(sLight, q.uv) + tex2D(sColor, q.uv) * 0.1; }
technique Deferred < string Script = "Pass=G;Pass=L;Pass=C;"; >
{
    pass G < string Script = "RenderColorTarget0=rtColor;RenderColorTarget1=rtNormal;RenderColorTarget2=rtDepth;RenderDepthStencilTarget=rtDS;Clear=Color0;Clear=Color1;Clear=Color2;Clear=Depth;Draw=Geometry;"; >
    {
        VertexShader = compile vs_3_0 GVS(); PixelShader = compile ps_3_0 GPS();
        ZEnable = true; ZWriteEnable = true; ZFunc = LessEqual; CullMode = CCW; AlphaBlendEnable = false;
        StencilEnable = true; StencilFunc = ALWAYS; StencilPass = REPLACE; StencilRef = 1; StencilMask = 0xFFFFFFFF; StencilWriteMask = 0xFFFFFFFF;
    }
    pass L < string Script = "RenderColorTarget0=rtLight;RenderDepthStencilTarget=rtDS;RenderColorTarget1=;RenderColorTarget2=;Clear=Color0;Draw=Buffer;"; >
    {
        VertexShader = compile vs_3_0 QVS(); PixelShader = compile ps_3_0 LPS(true);
        ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = true; SrcBlend = One; DestBlend = One; CullMode = None;
        StencilEnable = true; StencilFunc = EQUAL; StencilRef = 1; StencilPass = KEEP; ScissorTestEnable = false;
    }
    pass C < string Script = "RenderColorTarget0=;RenderDepthStencilTarget=;Draw=Buffer;"; >
    {
        VertexShader = compile vs_3_0 QVS(); PixelShader = compile ps_3_0 CPS();
        ZEnable = false; ZWriteEnable = false; AlphaBlendEnable = false; CullMode = None; StencilEnable = false;
    }
}
