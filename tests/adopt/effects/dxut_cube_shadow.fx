// In the manner of a sample with a lamp: cube map of distances, spot light, SCREEN aligned quad, D3DFMT numbers as parameters
float4x4 g_mWorldView;
float4x4 g_mProj;
float4x4 g_mViewToLightProj;
float4   g_vMaterial;
texture  g_txScene;
texture  g_txShadow;
float3   g_vLightPos = float3( 1.0f, 2.0f, -1.0f );
float3   g_vLightDir = float3( 0.0f, -1.0f, 0.0f );
float4   g_vLightDiffuse = float4( 1.0f, 1.0f, 1.0f, 1.0f );
float4   g_vLightAmbient = float4( 0.3f, 0.3f, 0.3f, 1.0f );
float    g_fCosTheta = cos( radians( 60 ) );
#define SMAP_SIZE 512
#define SHADOW_EPSILON 0.00005f
sampler2D g_samScene = sampler_state { Texture = <g_txScene>; MinFilter = Point; MagFilter = Linear; MipFilter = Linear; };
sampler2D g_samShadow = sampler_state { Texture = <g_txShadow>; MinFilter = Point; MagFilter = Point; MipFilter = Point; AddressU = Clamp; AddressV = Clamp; };

void VertScene( float4 iPos : POSITION, float3 iNormal : NORMAL, float2 iTex : TEXCOORD0,
                out float4 oPos : POSITION, out float2 Tex : TEXCOORD0, out float4 vPos : TEXCOORD1,
                out float3 vNormal : TEXCOORD2, out float4 vPosLight : TEXCOORD3 )
{
    vPos = mul( iPos, g_mWorldView );
    oPos = mul( vPos, g_mProj );
    vNormal = mul( iNormal, (float3x3)g_mWorldView );
    Tex = iTex;
    vPosLight = mul( vPos, g_mViewToLightProj );
}

float4 PixScene( float2 Tex : TEXCOORD0, float4 vPos : TEXCOORD1, float3 vNormal : TEXCOORD2, float4 vPosLight : TEXCOORD3 ) : COLOR
{
    float4 Diffuse;
    float3 vLight = normalize( float3( vPos - g_vLightPos ) );
    if( dot( vLight, g_vLightDir ) > g_fCosTheta )
    {
        float2 ShadowTexC = 0.5 * vPosLight.xy / vPosLight.w + float2( 0.5, 0.5 );
        ShadowTexC.y = 1.0f - ShadowTexC.y;
        float2 texelpos = SMAP_SIZE * ShadowTexC;
        float2 lerps = frac( texelpos );
        float sourcevals[4];
        sourcevals[0] = (tex2D( g_samShadow, ShadowTexC ) + SHADOW_EPSILON < vPosLight.z / vPosLight.w)? 0.0f: 1.0f;
        sourcevals[1] = (tex2D( g_samShadow, ShadowTexC + float2(1.0/SMAP_SIZE, 0) ) + SHADOW_EPSILON < vPosLight.z / vPosLight.w)? 0.0f: 1.0f;
        sourcevals[2] = (tex2D( g_samShadow, ShadowTexC + float2(0, 1.0/SMAP_SIZE) ) + SHADOW_EPSILON < vPosLight.z / vPosLight.w)? 0.0f: 1.0f;
        sourcevals[3] = (tex2D( g_samShadow, ShadowTexC + float2(1.0/SMAP_SIZE, 1.0/SMAP_SIZE) ) + SHADOW_EPSILON < vPosLight.z / vPosLight.w)? 0.0f: 1.0f;
        float LightAmount = lerp( lerp( sourcevals[0], sourcevals[1], lerps.x ), lerp( sourcevals[2], sourcevals[3], lerps.x ), lerps.y );
        Diffuse = ( saturate( dot( -vLight, normalize( vNormal ) ) ) * LightAmount * ( 1 - g_vLightAmbient ) + g_vLightAmbient ) * g_vMaterial;
    } else
    {
        Diffuse = g_vLightAmbient * g_vMaterial;
    }
    return tex2D( g_samScene, Tex ) * Diffuse;
}
void VertShadow( float4 Pos : POSITION, float3 Normal : NORMAL, out float4 oPos : POSITION, out float2 Depth : TEXCOORD0 )
{
    oPos = mul( Pos, g_mWorldView );
    oPos = mul( oPos, g_mProj );
    Depth.xy = oPos.zw;
}
void PixShadow( float2 Depth : TEXCOORD0, out float4 Color : COLOR ) { Color = Depth.x / Depth.y; }
technique RenderScene  { pass p0 { VertexShader = compile vs_1_1 VertScene(); PixelShader = compile ps_2_0 PixScene(); } }
technique RenderShadow { pass p0 { VertexShader = compile vs_1_1 VertShadow(); PixelShader = compile ps_2_0 PixShadow(); } }
