// In the manner of an engine with numbered lights in semantics: LIGHTDIR0_DIRECTION, LIGHTPOINT0_COLOR, FOGSTART
float4x4 matWorldViewProj : WORLDVIEWPROJECTION;
float4x4 matWorldIT : WORLDINVERSETRANSPOSE;
float4x4 matWorld : WORLD;
float3 viewPosition : CAMERAPOSITION;
float3 materialDiffuse : DIFFUSE;
float3 materialEmissive : EMISSIVE;
float3 materialSpecular : SPECULAR;
float materialPower : SPECULARPOWER;
float3 dirLightDir : LIGHTDIR0_DIRECTION;
float3 dirLightColor : LIGHTDIR0_COLOR;
int pointLightCount : LIGHTPOINT_NUM;
float3 pointLightPos : LIGHTPOINT0_POSITION;
float3 pointLightColor : LIGHTPOINT0_COLOR;
float pointLightRange : LIGHTPOINT0_RANGE;
float3 fogColor : FOGCOLOR;
float fogDensity : FOGDENSITY;
float fogStart : FOGSTART;
float fogEnd : FOGEND;
int fogType : FOGTYPE;
texture texTexture : TEXTURE0;
sampler sampTexture = sampler_state { Texture = (texTexture); };
texture texNormal : TEXTURE1;
sampler sampNormal = sampler_state { Texture = (texNormal); MinFilter = ANISOTROPIC; MipFilter = LINEAR; MaxAnisotropy = (4 * 2); MipMapLodBias = -0.5; };
#define FOG_TYPE_NONE    0
#define FOG_TYPE_EXP     1
#define FOG_TYPE_LINEAR  3
struct VS_IN { float4 position : POSITION; float3 normal : NORMAL; float2 uv : TEXCOORD; float3 tangent : TANGENT; float3 binormal : BINORMAL; };
struct VS_OUT { float4 position : POSITION; float2 uv : TEXCOORD0; float3 light : TEXCOORD1; float3 view : TEXCOORD2; float fog : TEXCOORD3; };
#define	PS_IN VS_OUT
VS_OUT VS(VS_IN IN)
{
	VS_OUT OUT;
	OUT.position = mul(IN.position, matWorldViewProj);
	float3x3 tbn = transpose(mul(float3x3(IN.tangent, IN.binormal, IN.normal), (float3x3)matWorldIT));
	float3 p = mul(IN.position, matWorld).xyz;
	OUT.light = mul(-dirLightDir, tbn);
	OUT.view = mul(viewPosition - p, tbn);
	OUT.uv = IN.uv;
	if (fogType == FOG_TYPE_NONE) OUT.fog = 1.0;
	else if (fogType == FOG_TYPE_EXP) OUT.fog = 1 / exp(distance(viewPosition, p) * fogDensity);
	else OUT.fog = saturate((fogEnd - distance(viewPosition, p)) / (fogEnd - fogStart));
	return OUT;
}
float4 PS(PS_IN IN) : COLOR
{
	float3 n = normalize(tex2D(sampNormal, IN.uv).xyz * 2 - 1), l = normalize(IN.light), h = normalize(l + normalize(IN.view));
	float3 lightSum = saturate(dot(n, l)) * dirLightColor + 0.15 * pointLightColor;
	float3 c = tex2D(sampTexture, IN.uv).rgb * (materialDiffuse * lightSum + materialEmissive) + materialSpecular * pow(saturate(dot(n, h)), materialPower);
	return float4(lerp(fogColor, c, IN.fog), 1);
}
technique perPixel { pass pass0 { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); AlphaRef = 128; AlphaFunc = Greater; } }
