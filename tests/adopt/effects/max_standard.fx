/******************************************************************************
 In the manner of the material shaders of 3ds Max: both a Direct3D 9 and a Direct3D 10 technique, widgets of the material editor
******************************************************************************/
string ParamID = "0x0001"; // the parser that 3ds Max takes

int texcoord0 : Texcoord
<
	int Texcoord = 0;
	int MapChannel = 1;
	string UIWidget = "None";
>;
int texcoord1 : Texcoord
<
	int Texcoord = 1;
	int MapChannel = -2;
	string UIWidget = "None";
>;
bool g_DiffuseEnable <
	string UIName = "Diffuse Map Enable";
> = true;
bool g_FlipY <
	string gui = "slider";
	string UIName = "Flip Normal Y";
> = false;
Texture2D <float4> g_TopDiffuseTexture : DiffuseMap<
	string UIName = "Top Diffuse Map ";
	string ResourceName = "tree-512.dds";
	int Texcoord = 0;
	int MapChannel = 1;
>;
Texture2D <float4> g_NormalTexture : NormalMap<
	string UIName = "Normal Map";
	int Texcoord = 0;
>;
float4 k_a  <
	string UIName = "Ambient";
	string UIWidget = "color";
> = float4( 0.1f, 0.1f, 0.1f, 1.0f );
float4 k_d  <
	string UIName = "Diffuse";
	string UIWidget = "color";
> = float4( 0.8f, 0.47f, 0.47f, 1.0f );
float4 k_s  <
	string UIName = "Specular";
	string UIWidget = "color";
> = float4( 1.0f, 1.0f, 1.0f, 1.0f );
int n<
	string UIName = "Specular Power";
	string UIWidget = "slider";
	float UIMin = 0.0f;
	float UIMax = 50.0f;
>  = 15;
float g_BumpHeight <
	string UIName = "Bump Height";
	string UIWidget = "slider";
	float UIMin = 0.0f; float UIMax = 2.0f; float UIStep = 0.1f;
> = 0.5f;
float4 lightDir : Direction <
	string UIName = "Light Direction";
	string Object = "TargetLight";
	int refID = 0;
> = {-0.577, -0.577, 0.577,1.0};
float4 lightCol : LightColor <
	string UIName = "Light Colour";
	int LightRef = 0;
> = float4(1, 1, 1, 1);

float4x4 wvp : WorldViewProjection < string UIWidget="None"; >;
float4x4 worldI : WorldInverse < string UIWidget="None"; >;
float4x4 worldIT : WorldInverseTranspose < string UIWidget="None"; >;
float4x4 viewInv : ViewInverse < string UIWidget="None"; >;
float4x4 world : World < string UIWidget="None"; >;

SamplerState g_TopDiffuseSampler
{
	MinFilter = Linear;
	MagFilter = Linear;
	MipFilter = Linear;
	AddressU = Wrap;
	AddressV = Wrap;
};

struct VSIn
{
	float4 Position	: POSITION;
	float3 Normal	: NORMAL;
	float3 Tangent	: TANGENT;
	float3 BiNormal	: BINORMAL;
	float2 UV0	: TEXCOORD0;
	float3 Colour	: TEXCOORD1;
	float3 Alpha	: TEXCOORD2;
	float3 Illum	: TEXCOORD3;
};
struct VSOut
{
	float4 Position : SV_Position;
	float4 UV0 : TEXCOORD0;
	float3 LightDir : TEXCOORD1;
	float3 Normal : TEXCOORD2;
	float3 ViewDir : TEXCOORD3;
};

VSOut VS(VSIn vsIn)
{
	VSOut vsOut;
	vsOut.Position = mul(vsIn.Position, wvp);
	vsOut.UV0.xy = vsIn.UV0;
	vsOut.UV0.zw = 0;
	float3x3 objToTangent;
	objToTangent[0] = vsIn.BiNormal;
	objToTangent[1] = vsIn.Tangent;
	objToTangent[2] = vsIn.Normal;
	float4 worldPos = mul(vsIn.Position, world);
	float3 lightVec = mul(-lightDir.xyz, (float3x3)worldI);
	vsOut.LightDir = mul(objToTangent, lightVec);
	vsOut.Normal = mul(vsIn.Normal, (float3x3)worldIT);
	vsOut.ViewDir = mul(objToTangent, mul(viewInv[3].xyz - worldPos.xyz, (float3x3)worldI));
	return vsOut;
}

float4 PS( VSOut psIn ) : SV_Target
{
	float4 diff = k_d;
	if (g_DiffuseEnable)
		diff *= g_TopDiffuseTexture.Sample(g_TopDiffuseSampler, psIn.UV0.xy);
	float3 nn = g_NormalTexture.Sample(g_TopDiffuseSampler, psIn.UV0.xy).xyz * 2.0 - 1.0;
	if (g_FlipY) nn.y = -nn.y;
	nn.xy *= g_BumpHeight;
	nn = normalize(nn);
	float3 l = normalize(psIn.LightDir);
	float3 v = normalize(psIn.ViewDir);
	float3 h = normalize(l + v);
	float4 lighting = lit(dot(nn, l), dot(nn, h), n);
	return float4((k_a + diff * lighting.y * lightCol + k_s * lighting.z * lightCol).rgb, diff.a);
}

RasterizerState DataCulling
{
	FillMode = SOLID;
	CullMode = BACK;
	FrontCounterClockwise = false;
};
DepthStencilState Depth
{
	DepthEnable = true;
	DepthFunc = 4;//LESSEQUAL
	StencilEnable = false;
	StencilReadMask = 0xFF;
	StencilWriteMask = 0x00;
};
BlendState DataBlend
{
	AlphaToCoverageEnable = false;
	BlendEnable[0] = false;
};

technique11 Simple_11 <
	string script = "Pass=p0;";
>
{
	pass P0 <
		string script = "Draw=Geometry;";
	>
	{
		SetRasterizerState(DataCulling);
		SetDepthStencilState(Depth, 0);
		SetBlendState(DataBlend, float4(0.0f, 0.0f, 0.0f, 0.0f), 0xFFFFFFFF);
		SetVertexShader(CompileShader(vs_5_0,VS()));
		SetHullShader(NULL);
		SetDomainShader(NULL);
		SetGeometryShader( NULL );
		SetPixelShader(CompileShader(ps_5_0,PS()));
	}
}
technique10 Simple_10
{
	pass P0
	{
		SetVertexShader(CompileShader(vs_4_0,VS()));
		SetGeometryShader( NULL );
		SetPixelShader(CompileShader(ps_4_0,PS()));
	}
}
