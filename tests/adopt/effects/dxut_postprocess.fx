//-----------------------------------------------------------------------------
// File: PP_*.fx
// Desc: in the manner of the SDK's samples of post processing: kernels in pixels, annotations for their conversion
//-----------------------------------------------------------------------------
texture g_txSrcColor;
texture g_txSrcNormal;
texture g_txSceneColor;
shared float4x4 g_mProj;

sampler2D g_samSrcColor =
sampler_state
{
    Texture = <g_txSrcColor>;
    AddressU = Clamp;
    AddressV = Clamp;
    MinFilter = Point;
    MagFilter = Linear;
    MipFilter = Linear;
};
sampler2D g_samSceneColor = sampler_state { Texture = <g_txSceneColor>; AddressU = Clamp; AddressV = Clamp; MinFilter = Point; MagFilter = Point; MipFilter = Point; };

static const int g_cKernelSize = 13;

float2 PixelKernel[g_cKernelSize] =
{
    { -6, 0 },
    { -5, 0 },
    { -4, 0 },
    { -3, 0 },
    { -2, 0 },
    { -1, 0 },
    {  0, 0 },
    {  1, 0 },
    {  2, 0 },
    {  3, 0 },
    {  4, 0 },
    {  5, 0 },
    {  6, 0 },
};

float2 TexelKernel[g_cKernelSize]
<
    string ConvertPixelsToTexels = "PixelKernel";
>;

static const float BlurWeights[g_cKernelSize] =
{
    0.002216,
    0.008764,
    0.026995,
    0.064759,
    0.120985,
    0.176033,
    0.199471,
    0.176033,
    0.120985,
    0.064759,
    0.026995,
    0.008764,
    0.002216,
};
float BloomScale
<
    string UIName = "Bloom Scale";
    float UIMin = 0.0f;
    float UIMax = 10.0f;
    float UIStep = 0.05f;
> = 0.4f;

// Used to convert from RGB to luminance
static const float3 LuminanceVector = float3( 0.2125f, 0.7154f, 0.0721f );
static const float2 PixelOffset = float2( 1.0f / 512, 1.0f / 512 );
static const float3x3 Sepia = { 0.393f, 0.349f, 0.272f,
                                0.769f, 0.686f, 0.534f,
                                0.189f, 0.168f, 0.131f };

float4 PostProcessPS( float2 Tex : TEXCOORD0 ) : COLOR0
{
    float4 Color = 0;

    for (int i = 0; i < g_cKernelSize; i++)
    {
        Color += tex2D( g_samSrcColor, Tex + TexelKernel[i].xy ) * BlurWeights[i];
    }

    float Luminance = dot( Color.rgb, LuminanceVector );
    return float4( mul( Color.rgb, Sepia ) * BloomScale * ( 0.5 + Luminance ), 1 );
}
float4 CombinePS( float2 Tex : TEXCOORD0, float2 Tex2 : TEXCOORD1 ) : COLOR0
{
    float3 ColorOrig = tex2D( g_samSceneColor, Tex2 );
    ColorOrig += tex2D( g_samSrcColor, Tex );
    return float4( ColorOrig * 0.5, 1.0f );
}

technique PostProcess
<
    string Parameter0 = "BloomScale";
    float4 Parameter0Def = float4( 1.5f, 0, 0, 0 );
    int Parameter0Size = 1;
    string Parameter0Desc = " (float)";
>
{
    pass p0
    <
        float fScaleX = 1.0f;
        float fScaleY = 1.0f;
        bool bFiltered = true;
    >
    {
        VertexShader = null;
        PixelShader = compile ps_2_0 PostProcessPS();
        ZEnable = false;
    }
    pass p1
    {
        VertexShader = NULL;
        PixelShader = compile ps_2_0 CombinePS();
        ZEnable = false;
        AlphaBlendEnable = true;
        SrcBlend = SrcAlpha;
        DestBlend = One;
        BlendOp = Add;
    }
}
