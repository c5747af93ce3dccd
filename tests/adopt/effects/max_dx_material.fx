// In the manner of a DirectX material of a modelling program: ParamID, map channels, techniques for its viewport
string ParamID = "0x0001";
float Script : STANDARDSGLOBAL < string UIWidget = "none"; string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color"; string Script = "Technique=Technique?No_Parallax:Parallax;"; > = 0.8;
int texcoord1 : Texcoord < int Texcoord = 1; int MapChannel = 0; string UIWidget = "None"; >;
int texcoord0 : Texcoord < int Texcoord = 0; int MapChannel = 1; >;
float4 k_a < string UIName = "Ambient"; > = float4( 0.1f, 0.1f, 0.12f, 1.0f );
float4 k_d < string UIName = "Diffuse"; > = float4( 0.67f, 0.67f, 0.87f, 1.0f );
float4 k_s < string UIName = "Specular"; > = float4( 0.21f, 0.21f, 0.11f, 1.0f );
int n < string UIName = "Specular Power"; string UIType = "IntSpinner"; float UIMin = 0.0f; float UIMax = 50.0f; > = 15;
bool g_TopDiffuseEnable < string UIName = "Top Diffuse Color Enable"; > = true;
bool g_AlphaVertex < string UIName = "Vertex Alpha"; > = false;
float3 lightDir : Direction < string UIName = "Light Direction"; string Object = "TargetLight"; int RefID = 0; > = {-0.577, -0.577, 0.577};
float4 lightColor : LightColor < string Object = "LightPosition"; int LightRef = 0; > = float4( 1.0f, 1.0f, 1.0f, 1.0f );
texture g_TopTexture : DiffuseMap < string UIName = "Top Diffuse Map"; int Texcoord = 0; int MapChannel = 1; >;
sampler2D g_TopSampler = sampler_state { Texture = <g_TopTexture>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
float4x4 WorldViewProj : WORLDVIEWPROJ;
float4x4 World : WORLD;
float4x4 WorldIT : WORLDIT;
float4x4 ViewI : VIEWI;
struct VSIn { float4 Position : POSITION; float3 Normal : NORMAL; float2 UV0 : TEXCOORD0; float3 Colour : TEXCOORD1; float3 Alpha : TEXCOORD2; float3 T : TANGENT; float3 B : BINORMAL; };
struct VSOut { float4 Position : POSITION; float2 UV0 : TEXCOORD0; float3 LightDir : TEXCOORD1; float3 Normal : TEXCOORD2; float3 ViewDir : TEXCOORD3; float4 Colour : COLOR0; };
VSOut VS( VSIn vsIn, uniform bool parallax )
{
	VSOut o = (VSOut)0;
	o.Position = mul( vsIn.Position, WorldViewProj );
	float3x3 objToTangent = float3x3( vsIn.T, -vsIn.B, vsIn.Normal );
	o.Colour.rgb = vsIn.Colour.rgb;
	o.Colour.a = g_AlphaVertex ? vsIn.Alpha.x : 1;
	o.Normal = mul( vsIn.Normal, WorldIT );
	float4 world = mul( vsIn.Position, World );
	o.ViewDir = ViewI[3] - world.xyz;
	o.LightDir = -lightDir;
	o.UV0 = vsIn.UV0 + (parallax ? mul( objToTangent, o.ViewDir ).xy * 0.02 : 0);
	return o;
}
float4 PS( VSOut psIn ) : COLOR
{
	float4 diffuse = g_TopDiffuseEnable ? tex2D( g_TopSampler, psIn.UV0 ) : k_d;
	float3 N = normalize( psIn.Normal ), L = normalize( psIn.LightDir ), V = normalize( psIn.ViewDir );
	float3 H = normalize( L + V );
	float4 c = lit( dot( N, L ), dot( N, H ), n );
	return float4( (k_a + lightColor * (diffuse * c.y * k_d + c.z * k_s)).rgb, diffuse.a * psIn.Colour.a );
}
technique Parallax { pass p0 { VertexShader = compile vs_2_0 VS( true ); ZEnable = true; CullMode = CW; AlphaBlendEnable = (g_AlphaVertex); DestBlend = InvSrcAlpha; SrcBlend = SrcAlpha; PixelShader = compile ps_2_0 PS(); } }
technique No_Parallax { pass p0 { VertexShader = compile vs_2_0 VS( false ); ZEnable = true; CullMode = CW; AlphaBlendEnable = g_AlphaVertex; PixelShader = compile ps_2_0 PS(); } }
