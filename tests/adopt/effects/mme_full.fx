////////////////////////////////////////////////////////////////////////////////////////////////
//
//  in the manner of an object effect for MikuMikuEffect, shadows and toon included
//
////////////////////////////////////////////////////////////////////////////////////////////////
// 1 if the shadow buffer is 2048
#define SKII1    1500
#define SKII2    8000
#define Toon     3

float4x4 WorldViewProjMatrix      : WORLDVIEWPROJECTION;
float4x4 WorldMatrix              : WORLD;
float4x4 ViewMatrix               : VIEW;
float4x4 LightWorldViewProjMatrix : WORLDVIEWPROJECTION < string Object = "Light"; >;

float3   LightDirection    : DIRECTION < string Object = "Light"; >;
float3   CameraPosition    : POSITION  < string Object = "Camera"; >;

float4   MaterialDiffuse   : DIFFUSE  < string Object = "Geometry"; >;
float3   MaterialAmbient   : AMBIENT  < string Object = "Geometry"; >;
float3   MaterialEmmisive  : EMISSIVE < string Object = "Geometry"; >;
float3   MaterialSpecular  : SPECULAR < string Object = "Geometry"; >;
float    SpecularPower     : SPECULARPOWER < string Object = "Geometry"; >;
float3   MaterialToon      : TOONCOLOR;
float4   EdgeColor         : EDGECOLOR;
float4   GroundShadowColor : GROUNDSHADOWCOLOR;
float3   LightDiffuse      : DIFFUSE   < string Object = "Light"; >;
float3   LightAmbient      : AMBIENT   < string Object = "Light"; >;
float3   LightSpecular     : SPECULAR  < string Object = "Light"; >;
static float4 DiffuseColor  = MaterialDiffuse  * float4(LightDiffuse, 1.0f);
static float3 AmbientColor  = MaterialAmbient  * LightAmbient + MaterialEmmisive;
static float3 SpecularColor = MaterialSpecular * LightSpecular;

float4   TextureAddValue  : ADDINGTEXTURE;
float4   TextureMulValue  : MULTIPLYINGTEXTURE;
float4   SphereAddValue   : ADDINGSPHERETEXTURE;
float4   SphereMulValue   : MULTIPLYINGSPHERETEXTURE;

bool use_texture;
bool use_spheremap;
bool use_subtexture;
bool use_toon;
bool     parthf;
bool     transp;
bool	 spadd;
#define SPA spadd
float    rim_power : CONTROLOBJECT < string name = "(self)"; string item = "RimPower"; >;
float4   ctrl_xyz  : CONTROLOBJECT < string name = "Controller.pmx"; string item = "Center"; >;
bool     ctrl_flag : CONTROLOBJECT < string name = "Controller.pmx"; >;

texture ObjectTexture: MATERIALTEXTURE;
sampler ObjTexSampler = sampler_state {
    texture = <ObjectTexture>;
    MINFILTER = LINEAR;
    MAGFILTER = LINEAR;
    MIPFILTER = LINEAR;
    ADDRESSU  = WRAP;
    ADDRESSV  = WRAP;
};
texture ObjectSphereMap: MATERIALSPHEREMAP;
sampler ObjSphareSampler = sampler_state {
    texture = <ObjectSphereMap>;
    MINFILTER = LINEAR; MAGFILTER = LINEAR; MIPFILTER = LINEAR; ADDRESSU  = WRAP; ADDRESSV  = WRAP;
};
texture ObjectToonTexture: MATERIALTOONTEXTURE;
sampler ObjToonSampler = sampler_state { texture = <ObjectToonTexture>; MINFILTER = LINEAR; MAGFILTER = LINEAR; MIPFILTER = NONE; ADDRESSU  = CLAMP; ADDRESSV  = CLAMP; };

sampler MMDSamp0 : register(s0);
sampler MMDSamp1 : register(s1);
sampler MMDSamp2 : register(s2);

float4 ColorRender_VS(float4 Pos : POSITION) : POSITION
{
    return mul( Pos, WorldViewProjMatrix );
}
float4 ColorRender_PS() : COLOR
{
    return EdgeColor;
}
technique EdgeTec < string MMDPass = "edge"; > {
    pass DrawEdge {
        AlphaBlendEnable = FALSE;
        AlphaTestEnable  = FALSE;
        VertexShader = compile vs_2_0 ColorRender_VS();
        PixelShader  = compile ps_2_0 ColorRender_PS();
    }
}

struct VS_OUTPUT {
    float4 Pos        : POSITION;
    float2 Tex        : TEXCOORD1;
    float3 Normal     : TEXCOORD2;
    float3 Eye        : TEXCOORD3;
    float2 SpTex      : TEXCOORD4;
    float4 Color      : COLOR0;
    float3 Specular   : COLOR1;
};

VS_OUTPUT Basic_VS(float4 Pos : POSITION, float3 Normal : NORMAL, float2 Tex : TEXCOORD0, float2 Tex2 : TEXCOORD1, uniform bool useTexture, uniform bool useSphereMap, uniform bool useToon, uniform bool selfShadow = false)
{
    VS_OUTPUT Out = (VS_OUTPUT)0;
    Out.Pos = mul( Pos, WorldViewProjMatrix );
    Out.Eye = CameraPosition - mul( Pos, WorldMatrix );
    Out.Normal = normalize( mul( Normal, (float3x3)WorldMatrix ) );
    Out.Color.rgb = AmbientColor;
    if ( !useToon ) {
        Out.Color.rgb += max(0,dot( Out.Normal, -LightDirection )) * DiffuseColor.rgb;
    }
    Out.Color.a = DiffuseColor.a;
    Out.Color = saturate( Out.Color );
    Out.Tex = Tex;
    if ( useSphereMap ) {
        float2 NormalWV = mul( Out.Normal, (float3x3)ViewMatrix );
        Out.SpTex.x = NormalWV.x * 0.5f + 0.5f;
        Out.SpTex.y = NormalWV.y * -0.5f + 0.5f;
    }
    float3 HalfVector = normalize( normalize(Out.Eye) + -LightDirection );
    Out.Specular = pow( max(0,dot( HalfVector, Out.Normal )), SpecularPower ) * SpecularColor;
    return Out;
}

float4 Basic_PS(VS_OUTPUT IN, uniform bool useTexture, uniform bool useSphereMap, uniform bool useToon) : COLOR0
{
    float4 Color = IN.Color;
    if ( useTexture ) {
        Color *= tex2D( ObjTexSampler, IN.Tex );
    }
    if ( useSphereMap ) {
        if(spadd) Color.rgb += tex2D(ObjSphareSampler,IN.SpTex).rgb;
        else      Color.rgb *= tex2D(ObjSphareSampler,IN.SpTex).rgb;
    }
    if ( useToon ) {
        float LightNormal = dot( IN.Normal, -LightDirection );
        Color.rgb *= lerp(MaterialToon, float3(1,1,1), saturate(LightNormal * 16 + 0.5));
    }
    Color.rgb += IN.Specular;
    return Color;
}

#define BASIC_TEC(name, mmdpass, tex, sphere, toon) \
    technique name < string MMDPass = mmdpass; bool UseTexture = tex; bool UseSphereMap = sphere; bool UseToon = toon; \
                     string Subset = "0-3,5"; > { \
        pass DrawObject { \
            VertexShader = compile vs_2_0 Basic_VS(tex, sphere, toon); \
            PixelShader  = compile ps_2_0 Basic_PS(tex, sphere, toon); \
        } \
    }

BASIC_TEC(MainTec0, "object", false, false, false)
BASIC_TEC(MainTec1, "object", true, false, false)
BASIC_TEC(MainTec7, "object", true, true, true)
BASIC_TEC(MainTecBS7, "object_ss", true, true, true)

technique ZplotTec < string MMDPass = "zplot"; > {
}
technique ShadowTec < string MMDPass = "shadow"; > {

}
