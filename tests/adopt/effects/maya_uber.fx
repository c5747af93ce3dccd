//**************************************************************************/
// In the manner of Maya's shaders for Direct3D 11: buffers by frequency, many annotations, lights by objects of numbered names
//**************************************************************************/
#ifdef _XSI_
#define MIPMAPLODBIAS 0
#endif
#define ROW_MAJOR row_major
#define _USE_OGL 0
string ParamID = "0x003";
#define ROUGHNESS_BITS 5.0

cbuffer UpdatePerFrame : register(b0)
{
	float4x4 viewInv 		: ViewInverse 			< string UIWidget = "None"; >;
	float4x4 view			: View				< string UIWidget = "None"; >;
	float4x4 prj			: Projection			< string UIWidget = "None"; >;
	float4x4 viewPrj		: ViewProjection		< string UIWidget = "None"; >;

	// A shader may wish to do different actions when Maya is rendering the preview swatch (e.g. disable displacement)
	bool IsSwatchRender 		: MayaSwatchRender 		< string UIWidget = "None"; > = false;

	// If the user enables viewport gamma correction in Maya's global viewport rendering settings, the shader should not do gamma again
	bool MayaFullScreenGamma 	: MayaGammaCorrection 		< string UIWidget = "None"; > = false;
}
cbuffer UpdatePerObject : register(b1)
{
	float4x4 World			: World				< string UIWidget = "None"; >;
	float4x4 WorldView		: WorldView			< string UIWidget = "None"; >;
	float4x4 WorldIT		: WorldInverseTranspose		< string UIWidget = "None"; >;
	float4x4 WorldViewProj		: WorldViewProjection		< string UIWidget = "None"; >;
	bool LinearSpaceLighting
	<
		string UIGroup = "Lighting";
		string UIName = "Linear Space Lighting";
		int UIOrder = 10;
	> = true;
	float Opacity : OPACITY
	<
		string UIGroup = "Opacity";
		string UIWidget = "Slider";
		float UIMin = 0.0;
		float UIMax = 1.0;
		float UISoftMin = 0.0;
		float UIStep = 0.001;
		string UIName = "Opacity";
		int UIOrder = 220;
	> = 1.0;
	float3 DiffuseColor <string UIName = "Diffuse Color"; string UIWidget = "ColorPicker";> = {0.9f, 0.6f, 0.3f };
	float SpecPower : SPECULARPOWER <string UIFieldNames ="0:Phong:Blinn"; float UIMin = 0.0; float UISoftMax = 100.000; float UIMax = 1000;> = 20.000;
	int MaterialType <string UIFieldNames = "Blinn:Phong"; string UIName = "BRDF";> = 0;
} //end UpdatePerObject cbuffer

cbuffer UpdateLights : register(b2)
{
	// ---------------------------------------------
	// Light 0 GROUP
	// ---------------------------------------------
	bool light0Enable : LIGHTENABLE
	<
		string Object = "Light 0";	// UI Group for lights, auto-closed
		string UIName = "Enable Light 0";
		int UIOrder = 20;
	> = true;
	int light0Type : LIGHTTYPE
	<
		string Object = "Light 0";
		string UIName = "Light 0 Type";
		string UIFieldNames ="None:Default:Spot:Point:Directional:Ambient";
		float UIMin = 0;
		float UIMax = 5;
		float UIStep = 1;
	> = 2;
	float3 light0Pos : POSITION
	<
		string Object = "Light 0";
		string UIName = "Light 0 Position";
		string Space = "World";
		int RefID = 0;
	> = {100.0f, 100.0f, 100.0f};
	float3 light0Color : LIGHTCOLOR
	<
		string Object = "Light 0";
		string UIName = "Light 0 Color";
		string UIWidget = "Color";
	> = { 1.0f, 1.0f, 1.0f};
	float light0Intensity : LIGHTINTENSITY
	<
		string Object = "Light 0";
		string UIName = "Light 0 Intensity";
		float UIMin = 0.0;
		float UIMax = 99999;
		float UIStep = 0.01;
	> = { 1.0f };
	float3 light0Dir : DIRECTION
	<
		string Object = "Light 0";
		string Space = "World";
	> = {100.0f, 100.0f, 100.0f};
	float light0ConeAngle : HOTSPOT < string Object = "Light 0"; string UIName = "Light 0 ConeAngle"; float UIMin = 0; float UIMax = 1.571; > = { 0.46f };
	float light0Falloff : FALLOFF < string Object = "Light 0"; > = { 0.7f };
	float light0AttenScale : DECAYRATE < string Object = "Light 0"; > = {0.0};
	bool light0ShadowOn : SHADOWFLAG < string Object = "Light 0"; string UIWidget = "None"; > = true;
	float4x4 light0Matrix : SHADOWMAPMATRIX < string Object = "Light 0"; string UIWidget = "None"; >;
} //end lights cbuffer


Texture2D light0ShadowMap : SHADOWMAP < string Object = "Light 0"; string UIWidget = "None"; >;
Texture2D DiffuseTexture
<
	string UIGroup = "Diffuse";
	string ResourceName = "";
	string UIWidget = "FilePicker";
	string UIName = "Diffuse Map";
	string ResourceType = "2D";
	int mipmaplevels = 0;
	int UIOrder = 201;
	int UVEditorOrder = 1;
>;
TextureCube DiffuseCubeMap : environment < string ResourceName = ""; string UIWidget = "FilePicker"; string ResourceType = "Cube"; int mipmaplevels = 0; >;
SamplerState MMMLWWWSampler
{
	Filter = MIN_MAG_MIP_LINEAR;
	AddressU = WRAP;
	AddressV = WRAP;
	AddressW = WRAP;
};
SamplerState CubeMapSampler
{
	Filter = ANISOTROPIC;
	AddressU = Clamp;
	AddressV = Clamp;
	AddressW = Clamp;
};
SamplerComparisonState ShadowSampler
{
	Filter = COMPARISON_MIN_MAG_LINEAR_MIP_POINT;
	ComparisonFunc = LESS;
};

struct APPDATA
{
	float3 position		: POSITION;
	float2 texCoord0	: TEXCOORD0;
	float2 texCoord1	: TEXCOORD1;
	float3 normal		: NORMAL;
	float3 binormal		: BINORMAL;
	float3 tangent		: TANGENT;
};
struct SHADERDATA
{
	float4 position			: SV_Position;
	float2 texCoord0		: TEXCOORD0;
	float3 worldNormal   		: NORMAL;
	float4 worldTangent 		: TANGENT;
	float3 worldPosition		: TEXCOORD4;
	float clipped : SV_ClipDistance;
};

struct lightOut
{
	float	Specular;
	float3	Color;
};
SHADERDATA vt(APPDATA IN)
{
	SHADERDATA OUT = (SHADERDATA)0;
	float4 Po = float4(IN.position.xyz, 1);
	OUT.position = mul(Po, WorldViewProj);
	OUT.texCoord0 = float2(IN.texCoord0.x, 1.0 - IN.texCoord0.y);
	OUT.worldNormal = normalize(mul(IN.normal, (float3x3)WorldIT));
	OUT.worldTangent.xyz = mul(IN.tangent, (float3x3)WorldIT);
	OUT.worldTangent.w = dot(cross(IN.normal, IN.tangent), IN.binormal) < 0 ? -1 : 1;
	OUT.worldPosition = mul(Po, World).xyz;
	OUT.clipped = 1;
	return OUT;
}
lightOut CalculateLight(float3 n, float3 wp, float3 v)
{
	lightOut OUT;
	OUT.Specular = 0.0;
	OUT.Color = float3(0, 0, 0);
	[branch]
	if (light0Enable)
	{
		bool isDirectionalLight = (light0Type == 4);
		float3 lightDir = isDirectionalLight ? -light0Dir : light0Pos - wp;
		float3 l = normalize(lightDir);
		float atten = light0AttenScale > 0.0 ? 1.0 / pow(length(lightDir), light0AttenScale) : 1.0;
		OUT.Color = saturate(dot(n, l)) * light0Color * light0Intensity * atten;
		OUT.Specular = MaterialType == 0 ? pow(saturate(dot(n, normalize(l + v))), SpecPower) : pow(saturate(dot(reflect(-l, n), v)), SpecPower);
	}
	return OUT;
}
float4 f(SHADERDATA IN, bool FrontFace : SV_IsFrontFace) : SV_Target
{
	float gammaCorrection = lerp(1.0, 2.2, LinearSpaceLighting);
	float3 n = FrontFace ? normalize(IN.worldNormal) : -normalize(IN.worldNormal);
	float3 v = normalize(viewInv[3].xyz - IN.worldPosition);
	lightOut l = CalculateLight(n, IN.worldPosition, v);
	float3 albedo = pow(DiffuseTexture.Sample(MMMLWWWSampler, IN.texCoord0).rgb, gammaCorrection) * pow(DiffuseColor, gammaCorrection);
	float3 ambient = DiffuseCubeMap.SampleLevel(CubeMapSampler, float3(n.x, n.y, n.z), ROUGHNESS_BITS).rgb * 0.3;
	float3 result = albedo * (l.Color + ambient) + l.Specular;
	result = MayaFullScreenGamma ? result : pow(result, 1 / gammaCorrection);
	return float4(result, Opacity);
}

RasterizerState WireframeCullFront
{
	CullMode = Front;
	FillMode = WIREFRAME;
};
BlendState PMAlphaBlending
{
	AlphaToCoverageEnable = FALSE;
	BlendEnable[0] = TRUE;
	SrcBlend = ONE;
	DestBlend = INV_SRC_ALPHA;
	BlendOp = ADD;
	SrcBlendAlpha = ONE;
	DestBlendAlpha = INV_SRC_ALPHA;
	BlendOpAlpha = ADD;
	RenderTargetWriteMask[0] = 0x0F;
};

/**
 \brief Technique with tessellation off
*/
technique11 TessellationOFF
<
	bool overridesDrawState = false;	// we do not supply our own render state settings
	int isTransparent = 3;
	// objects with clipped pixels need to be flagged as isTransparent to avoid the occluding underlying geometry since Maya renders the object with flat shading when computing depth
	string transparencyTest = "Opacity < 1.0 || (UseDiffuseTexture && UseDiffuseTextureAlpha) || UseOpacityMaskTexture";
	// 'VariableNameAsAttributeName = false' can be used to tell Maya's DX11ShaderNode to use the UIName annotation
	bool VariableNameAsAttributeName = false;
#ifdef _MAYA_
	bool supportsAdvancedTransparency = true;
#endif
>
{
	pass P0
	<
		string drawContext = "colorPass";	// tell maya during what draw context this shader should be active, in this case 'Color'
	>
	{
		SetVertexShader(CompileShader(vs_5_0, vt()));
		SetHullShader(NULL);
		SetDomainShader(NULL);
		SetGeometryShader(NULL);
		SetPixelShader(CompileShader(ps_5_0, f()));
		SetBlendState(PMAlphaBlending, float4(0, 0, 0, 0), 0xFFFFFFFF);
	}
}
