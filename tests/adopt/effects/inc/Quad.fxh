// What an exporter of scene effects put beside its files.
#ifndef _QUAD_FXH
#define _QUAD_FXH
#ifdef QUAD_REAL
typedef half QuadReal;
typedef half2 QuadReal2;
typedef half4 QuadReal4;
#else
#define QuadReal float
#define QuadReal2 float2
#define QuadReal3 float3
#define QuadReal4 float4
#endif
#define DECLARE_QUAD_TEX(TexName,SampName,PixFmt) texture TexName : RENDERCOLORTARGET < \
    float2 ViewPortRatio = {1.0,1.0}; \
    int MipLevels = 1; \
    string Format = PixFmt ; \
    string UIWidget = "None"; \
>; \
sampler SampName = sampler_state { \
    texture = <TexName>; \
    AddressU  = CLAMP; \
    AddressV = CLAMP; \
    MipFilter = NONE; \
    MinFilter = LINEAR; \
    MagFilter = LINEAR; \
};
#define DECLARE_SIZED_QUAD_TEX(TexName,SampName,PixFmt,Multiple) texture TexName : RENDERCOLORTARGET < \
    float2 ViewPortRatio = {Multiple,Multiple}; string Format = (PixFmt); > ; \
sampler SampName = sampler_state { texture = <TexName>; AddressU = CLAMP; AddressV = CLAMP; MipFilter = POINT; MinFilter = LINEAR; MagFilter = LINEAR; };
#define DECLARE_QUAD_DEPTH_BUFFER(TexName,PixFmt) texture TexName : RENDERDEPTHSTENCILTARGET < \
    float2 ViewPortRatio = {1.0,1.0}; string Format = (PixFmt); string UIWidget = "None"; >;
QuadReal2 QuadScreenSize : VIEWPORTPIXELSIZE < string UIName="Screen Size"; string UIWidget="None"; >;
bool QuadTexOffset = true;
QuadReal QuadTexelOffsets() { return (QuadTexOffset ? 0.5 : 0); }
struct QuadVertexOutput {
    QuadReal4 Position	: POSITION;
    QuadReal2 UV	: TEXCOORD0;
};
QuadVertexOutput ScreenQuadVS(QuadReal3 Position : POSITION, QuadReal3 TexCoord : TEXCOORD0)
{
    QuadVertexOutput OUT;
    QuadReal2 off = QuadReal2(QuadTexelOffsets()/(QuadScreenSize.x),QuadTexelOffsets()/(QuadScreenSize.y));
    OUT.Position = QuadReal4(Position, 1);
    OUT.UV = QuadReal2(TexCoord.xy+off);
    return OUT;
}
#endif /* _QUAD_FXH */
