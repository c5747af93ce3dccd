// In the manner of a sample that shows shadow volumes: stencil of both faces in one pass, two more for devices without
float4   g_vAmbient = { 0.2f, 0.2f, 0.3f, 1.0f };
float3   g_vLightView;
float4   g_vLightColor = float4( 1, 0.9, 0.8, 1 );
float4x4 g_mWorldView;
float4x4 g_mProj;
float4x4 g_mWorldViewProjection;
texture  g_txScene;
float4   g_vMatColor = float4(1, 1, 1, 1);
float    g_fFarClip = 10;
int      g_nRef = 1;
sampler g_samScene = sampler_state { Texture = <g_txScene>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
void VertSceneAmbient( float4 vPos : POSITION, float2 vTex0 : TEXCOORD0, out float4 oPos : POSITION, out float2 oTex0 : TEXCOORD0 )
{
    oPos = mul( vPos, g_mWorldViewProjection );
    oTex0 = vTex0;
}
float4 PixSceneAmbient( float2 Tex0 : TEXCOORD0 ) : COLOR0 { return g_vMatColor * tex2D( g_samScene, Tex0 ) * g_vAmbient; }
void VertScene( float4 vPos : POSITION, float3 vNormal : NORMAL, float2 vTex0 : TEXCOORD0, out float4 oPos : POSITION,
                out float4 ViewPos : TEXCOORD0, out float3 ViewNormal : TEXCOORD1, out float2 oTex0 : TEXCOORD2, out float4 oDiffuse : TEXCOORD3 )
{
    ViewPos = mul( vPos, g_mWorldView );
    oPos = mul( ViewPos, g_mProj );
    ViewNormal = normalize( mul( vNormal, (float3x3)g_mWorldView ) );
    oTex0 = vTex0;
    oDiffuse = g_vLightColor;
}
float4 PixScene( float4 ViewPos : TEXCOORD0, float3 ViewNormal : TEXCOORD1, float2 Tex0 : TEXCOORD2, float4 Diffuse : TEXCOORD3 ) : COLOR0
{
    float3 PixelToLight = g_vLightView - ViewPos;
    float LenSq = dot( PixelToLight, PixelToLight );
    return Diffuse * saturate( dot( ViewNormal, PixelToLight / sqrt( LenSq ) ) ) * tex2D( g_samScene, Tex0 );
}
void VertShadowVolume( float4 vPos : POSITION, float3 vNormal : NORMAL, out float4 oPos : POSITION )
{
    float3 N = mul( vNormal, (float3x3)g_mWorldView );
    float4 PosView = mul( vPos, g_mWorldView );
    float3 LightVecView = PosView - g_vLightView;
    if( dot( N, -LightVecView ) < 0.0f )
    {
        if( PosView.z > g_vLightView.z )
            PosView.xyz += LightVecView * ( g_fFarClip - PosView.z ) / LightVecView.z;
        else
            PosView = float4( LightVecView, 0.0f );
    }
    oPos = mul( PosView, g_mProj );
}
float4 PixShadowVolume() : COLOR0 { return float4( 1, 1, 0, 0.2 ); }
technique RenderScene
{
    pass Ambient
    {
        VertexShader = compile vs_2_0 VertSceneAmbient();
        PixelShader  = compile ps_2_0 PixSceneAmbient();
        StencilEnable = false; ZFunc = LessEqual; AlphaBlendEnable = false;
    }
    pass Volume
    {
        VertexShader = compile vs_2_0 VertShadowVolume();
        PixelShader  = compile ps_2_0 PixShadowVolume();
        CullMode = None;
        AlphaBlendEnable = true; SrcBlend = Zero; DestBlend = One;
        ZWriteEnable = false; ZFunc = Less;
        StencilEnable = true; TwoSidedStencilMode = true;
        StencilRef = <g_nRef>; StencilMask = 0xFFFFFFFF; StencilWriteMask = 0xFFFFFFFF;
        StencilFunc = Always; StencilZFail = Incr; StencilPass = Keep;
        Ccw_StencilFunc = Always; Ccw_StencilZFail = Decr; Ccw_StencilPass = Keep;
    }
    pass Lit
    {
        VertexShader = compile vs_2_0 VertScene();
        PixelShader  = compile ps_2_0 PixScene();
        ZEnable = true; ZFunc = LessEqual; ZWriteEnable = true; CullMode = CW;
        TwoSidedStencilMode = false;
        StencilEnable = true; StencilRef = (g_nRef); StencilFunc = Greater; StencilPass = Keep;
        AlphaBlendEnable = true; BlendOp = Add; SrcBlend = One; DestBlend = One;
    }
}
