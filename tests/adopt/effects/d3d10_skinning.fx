//--------------------------------------------------------------------------------------
// In the manner of the SDK's samples for Direct3D 10: bones in a constant buffer, a texture buffer, a texture or a buffer
//--------------------------------------------------------------------------------------
#ifndef MAX_BONE_MATRICES
#define MAX_BONE_MATRICES 255
#endif
#define FETCH_CONSTANTBUFFER 0
#define FETCH_TEXTUREBUFFER 1
#define FETCH_BUFFER 3

DepthStencilState DisableDepth
{
    DepthEnable = FALSE;
    DepthWriteMask = ZERO;
};
DepthStencilState EnableDepth
{
    DepthEnable = TRUE;
    DepthWriteMask = ALL;
    DepthFunc = LESS_EQUAL;
};
BlendState NoBlending
{
    AlphaToCoverageEnable = FALSE;
    BlendEnable[0] = FALSE;
    RenderTargetWriteMask[0] = 0x0F;
};
RasterizerState Solid { FillMode = SOLID; CullMode = BACK; FrontCounterClockwise = FALSE; MultisampleEnable = TRUE; };

cbuffer cb0 : register(b0)
{
    float4x4 g_mWorldViewProj;
    float4x4 g_mWorld;
};
cbuffer cbUserChange
{
    float3 g_vLightPos;
    float3 g_vEyePt;
};
cbuffer cbImmutable
{
    float4 g_directional1 = float4( 0.992, 1.0, 0.880, 0.0 );
    float4 g_directional2 = float4( 0.595, 0.6, 0.528, 0.0 );
    float4 g_ambient = float4(0.525,0.474,0.474,0.0);
    float4 g_objectspecular[] = { float4( 1, 1, 1, 24 ), float4( 0.4, 0.4, 0.9, 8 ) };
};
cbuffer cbAnimMatrices
{
    matrix g_mConstBoneWorld[MAX_BONE_MATRICES];
};
tbuffer tbAnimMatrices
{
    matrix g_mTexBoneWorld[MAX_BONE_MATRICES];
};
Buffer<float4> g_BoneBufferVar;
Texture2D g_txDiffuse;
Texture2D g_txNormal;
SamplerState g_samLinear
{
    Filter = ANISOTROPIC;
    AddressU = Wrap;
    AddressV = Wrap;
};

struct VSSkinnedIn
{
    float3 Pos	: POSITION;
    float4 Weights : WEIGHTS;
    uint4  Bones : BONES;
    float3 Norm : NORMAL;
    float2 Tex	: TEXCOORD;
    float3 Tan : TANGENT;
};
struct PSSkinnedIn
{
    float4 Pos	: SV_Position;
    float3 vPos : POSWORLD;
    float3 Norm : NORMAL;
    float2 Tex	: TEXTURE;
    float3 Tangent : TANGENT;
};
struct SkinnedInfo { float4 Pos; float3 Norm; float3 Tan; };

matrix FetchBoneTransform( uint iBone, uniform int iFetchType )
{
    matrix mret;
    if( FETCH_CONSTANTBUFFER == iFetchType )
        mret = g_mConstBoneWorld[ iBone ];
    else if( FETCH_TEXTUREBUFFER == iFetchType )
        mret = g_mTexBoneWorld[ iBone ];
    else
    {
        iBone *= 4;
        float4 row1 = g_BoneBufferVar.Load( iBone );
        float4 row2 = g_BoneBufferVar.Load( iBone + 1 );
        float4 row3 = g_BoneBufferVar.Load( iBone + 2 );
        float4 row4 = g_BoneBufferVar.Load( iBone + 3 );
        mret = float4x4( row1, row2, row3, row4 );
    }
    return mret;
}
SkinnedInfo SkinVert( VSSkinnedIn Input, uniform int iFetchType )
{
    SkinnedInfo Output = (SkinnedInfo)0;
    float4 Pos = float4(Input.Pos,1);
    if (Input.Weights.x <= 0) { Output.Pos = Pos; Output.Norm = Input.Norm; Output.Tan = Input.Tan; return Output; }
    uint iBone = Input.Bones.x;
    matrix m = FetchBoneTransform( iBone, iFetchType );
    Output.Pos += Input.Weights.x * mul( Pos, m );
    Output.Norm += Input.Weights.x * mul( Input.Norm, (float3x3)m );
    Output.Tan += Input.Weights.x * mul( Input.Tan, (float3x3)m );
    return Output;
}
PSSkinnedIn VSSkinnedmain(VSSkinnedIn input, uniform int iFetchType )
{
    PSSkinnedIn output;
    SkinnedInfo vSkinned = SkinVert( input, iFetchType );
    output.Pos = mul( vSkinned.Pos, g_mWorldViewProj );
    output.vPos = mul( vSkinned.Pos, g_mWorld );
    output.Norm = normalize( mul( vSkinned.Norm, (float3x3)g_mWorld ) );
    output.Tangent = normalize( mul( vSkinned.Tan, (float3x3)g_mWorld ) );
    output.Tex = input.Tex;
    return output;
}
float4 PSSkinnedmain(PSSkinnedIn input) : SV_Target
{
    float4 diffuse = g_txDiffuse.Sample( g_samLinear, input.Tex );
    float3 Norm = g_txNormal.Sample( g_samLinear, input.Tex );
    Norm *= 2;
    Norm -= float3(1,1,1);
    float3 lightDir = normalize( g_vLightPos - input.vPos );
    float3 viewDir = normalize( g_vEyePt - input.vPos );
    float3 BiNorm = normalize( cross( input.Norm, input.Tangent ) );
    float3x3 BTNMatrix = float3x3( BiNorm, input.Tangent, input.Norm );
    Norm = normalize( mul( Norm, BTNMatrix ) );
    float lightAmt = saturate( dot( lightDir, Norm ) );
    float3 halfAngle = normalize( viewDir + lightDir );
    float4 spec = saturate( pow( dot( halfAngle, Norm ), g_objectspecular[1].w ) );
    return lightAmt.xxxx * g_directional1 * diffuse + g_objectspecular[1] * spec + g_ambient * diffuse;
}

technique10 RenderConstantBuffer
{
    pass P0
    {
        SetVertexShader( CompileShader( vs_4_0, VSSkinnedmain( FETCH_CONSTANTBUFFER ) ) );
        SetGeometryShader( NULL );
        SetPixelShader( CompileShader( ps_4_0, PSSkinnedmain() ) );
        SetBlendState( NoBlending, float4( 0.0f, 0.0f, 0.0f, 0.0f ), 0xFFFFFFFF );
        SetDepthStencilState( EnableDepth, 0 );
        SetRasterizerState( Solid );
    }
}
VertexShader vsBuffer = CompileShader( vs_4_0, VSSkinnedmain( FETCH_TEXTUREBUFFER ) );
technique10 RenderTextureBuffer
{
    pass P0
    {
        SetVertexShader( vsBuffer );
        SetGeometryShader( NULL );
        SetPixelShader( CompileShader( ps_4_0, PSSkinnedmain() ) );
        SetDepthStencilState( EnableDepth, 0 );
    }
}
technique10 RenderBuffer
{
    pass P0
    {
        SetVertexShader( CompileShader( vs_4_0, VSSkinnedmain( FETCH_BUFFER ) ) );
        SetGeometryShader( NULL );
        SetPixelShader( CompileShader( ps_4_0, PSSkinnedmain() ) );
        SetDepthStencilState( EnableDepth, 0 );
    }
}
