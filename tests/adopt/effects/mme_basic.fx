float4x4 WorldViewProjMatrix : WORLDVIEWPROJECTION;
float4x4 WorldMatrix : WORLD;
float3 LightDirection : DIRECTION < string Object = "Light"; >;
float3 CameraPosition : POSITION < string Object = "Camera"; >;
float4 MaterialDiffuse : DIFFUSE < string Object = "Geometry"; >;
float3 MaterialAmbient : AMBIENT < string Object = "Geometry"; >;
float SpecularPower : SPECULARPOWER < string Object = "Geometry"; >;
float3 LightDiffuse : DIFFUSE < string Object = "Light"; >;
float4 tr : CONTROLOBJECT < string name = "ctrl.pmd"; string item = "x"; >;
bool use_texture; bool use_toon;
static float4 DiffuseColor = MaterialDiffuse * float4(LightDiffuse, 1.0f);
texture ObjectTexture: MATERIALTEXTURE;
sampler ObjTexSampler = sampler_state { texture = <ObjectTexture>; MINFILTER = LINEAR; MAGFILTER = LINEAR; };
struct VS_OUTPUT { float4 Pos : POSITION; float2 Tex : TEXCOORD1; float3 Normal : TEXCOORD2; float3 Eye : TEXCOORD3; float4 Color : COLOR0; };
VS_OUTPUT Basic_VS(float4 Pos : POSITION, float3 Normal : NORMAL, float2 Tex : TEXCOORD0, uniform bool useTexture) {
    VS_OUTPUT Out = (VS_OUTPUT)0;
    Out.Pos = mul(Pos, WorldViewProjMatrix);
    Out.Eye = CameraPosition - mul(Pos, WorldMatrix);
    Out.Normal = normalize(mul(Normal, (float3x3)WorldMatrix));
    Out.Color.rgb = saturate(max(0, dot(Out.Normal, -LightDirection)) * DiffuseColor.rgb + 0.1);
    Out.Color.a = DiffuseColor.a;
    Out.Tex = Tex;
    return Out;
}
float4 Basic_PS(VS_OUTPUT IN, uniform bool useTexture) : COLOR0 {
    float3 HalfVector = normalize(normalize(IN.Eye) + -LightDirection);
    float3 Specular = pow(max(0, dot(HalfVector, normalize(IN.Normal))), SpecularPower);
    float4 Color = IN.Color; if (useTexture) Color *= tex2D(ObjTexSampler, IN.Tex);
    Color.rgb += Specular; return Color;
}
technique MainTec < string MMDPass = "object"; bool UseTexture = true; > { pass DrawObject { VertexShader = compile vs_2_0 Basic_VS(true); PixelShader = compile ps_2_0 Basic_PS(true); } }
technique Shadow < string MMDPass = "shadow"; > { }
