////////////////////////////////////////////////////////////////////////////////////////////////
//  In the manner of a post effect for MME with controllers, offscreen targets and shared textures
////////////////////////////////////////////////////////////////////////////////////////////////
float Script : STANDARDSGLOBAL <
    string ScriptOutput = "color";
    string ScriptClass = "sceneorobject";
    string ScriptOrder = "postprocess";
> = 0.8;
float Strength : CONTROLOBJECT < string name = "(self)"; string item = "Si"; >;
float4 CtrlXYZ : CONTROLOBJECT < string name = "Ctrl.x"; string item = "XYZ"; >;
bool   Exists  : CONTROLOBJECT < string name = "Ctrl.x"; >;
float4x4 CtrlBone : CONTROLOBJECT < string name = "(self)"; string item = "Center"; >;
float  morph : CONTROLOBJECT < string name = "(OffscreenOwner)"; string item = "Blur+"; >;
float2 ViewportSize : VIEWPORTPIXELSIZE;
static float2 ViewportOffset = (float2(0.5,0.5)/ViewportSize);
static float2 SampStep = (float2(2,2)/ViewportSize*(1 + Strength));
float time : TIME < bool SyncInEditMode = false; >;
float elapsed_time1 : ELAPSEDTIME;
float4 MouseXY : MOUSEPOSITION;
float4 ClearColor = {1,1,1,0};
float ClearDepth  = 1.0;
texture2D DepthBuffer : RENDERDEPTHSTENCILTARGET <
    float2 ViewPortRatio = {1.0,1.0};
    string Format = "D24S8";
>;
texture2D ScnMap : RENDERCOLORTARGET <
    float2 ViewPortRatio = {1.0,1.0};
    int MipLevels = 1;
    string Format = "A8R8G8B8" ;
>;
sampler2D ScnSamp = sampler_state {
    texture = <ScnMap>;
    MinFilter = LINEAR;
    MagFilter = LINEAR;
    AddressU  = CLAMP;
    AddressV = CLAMP;
};
shared texture2D SharedBlur : RENDERCOLORTARGET < float2 ViewPortRatio = {0.5,0.5}; int MipLevels = 0; string Format = "A16B16G16R16F"; bool AntiAlias = true; >;
sampler2D BlurSamp = sampler_state { texture = <SharedBlur>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = LINEAR; AddressU = CLAMP; AddressV = CLAMP; };
texture MaskRT: OFFSCREENRENDERTARGET <
    string Description = "mask for post";
    float2 ViewPortRatio = {1.0,1.0};
    float4 ClearColor = { 0, 0, 0, 1 };
    float ClearDepth = 1.0;
    bool AntiAlias = true;
    string DefaultEffect =
        "self = hide;"
        "* = none;";
>;
sampler MaskSamp = sampler_state { texture = <MaskRT>; MinFilter = POINT; MagFilter = POINT; MipFilter = NONE; AddressU = CLAMP; AddressV = CLAMP; };
struct VS_OUTPUT { float4 Pos : POSITION; float2 Tex : TEXCOORD0; };
VS_OUTPUT VS_Draw( float4 Pos : POSITION, float4 Tex : TEXCOORD0 ) {
    VS_OUTPUT Out = (VS_OUTPUT)0;
    Out.Pos = Pos;
    Out.Tex = Tex + ViewportOffset;
    return Out;
}
float4 PS_Blur( float2 Tex: TEXCOORD0 ) : COLOR {
    float4 Color = 0;
    float n = 0;
    for (int i = -3; i <= 3; i++) { Color += tex2D( ScnSamp, Tex + float2(i, 0) * SampStep ) * (4 - abs(i)); n += 4 - abs(i); }
    return Color / n;
}
float4 PS_Mix( float2 Tex: TEXCOORD0 ) : COLOR {
    float4 scene = tex2D( ScnSamp, Tex );
    float4 blur = tex2Dlod( BlurSamp, float4(Tex, 0, 1) );
    float mask = 1 - tex2D( MaskSamp, Tex ).r;
    float4 c = lerp(scene, blur, saturate(0.5 + morph) * mask);
    if (Exists) c.rgb += CtrlXYZ.xyz + CtrlBone._41_42_43;
    return c;
}
technique Gaussian <
    string Script =
        "RenderColorTarget0=ScnMap;"
        "RenderDepthStencilTarget=DepthBuffer;"
        "ClearSetColor=ClearColor;"
        "ClearSetDepth=ClearDepth;"
        "Clear=Color;"
        "Clear=Depth;"
        "ScriptExternal=Color;"
        "RenderColorTarget0=SharedBlur;"
        "RenderDepthStencilTarget=DepthBuffer;"
        "ClearSetColor=ClearColor;ClearSetDepth=ClearDepth;Clear=Color;Clear=Depth;"
        "Pass=Blur;"
        "RenderColorTarget0=;"
        "RenderDepthStencilTarget=;"
        "Pass=Mix;"
    ;
> {
    pass Blur < string Script= "Draw=Buffer;"; > {
        AlphaBlendEnable = FALSE;
        VertexShader = compile vs_3_0 VS_Draw();
        PixelShader  = compile ps_3_0 PS_Blur();
    }
    pass Mix < string Script= "Draw=Buffer;"; > {
        AlphaBlendEnable = FALSE;
        VertexShader = compile vs_3_0 VS_Draw();
        PixelShader  = compile ps_3_0 PS_Mix();
    }
}
