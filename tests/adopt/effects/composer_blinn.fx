// FX Composer style
string ParamID = "0x003";
float Script : STANDARDSGLOBAL < string UIWidget = "none"; string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color"; string Script = "Technique=Technique?Textured:Plain;"; > = 0.8;
float4x4 WvpXf : WorldViewProjection < string UIWidget="None"; >;
float4x4 WorldXf : World < string UIWidget="None"; >;
float4x4 WorldITXf : WorldInverseTranspose < string UIWidget="None"; >;
float4x4 ViewIXf : ViewInverse < string UIWidget="None"; >;
float3 Lamp0Pos : Position < string Object = "PointLight0"; string UIName = "Lamp 0 Position"; string Space = "World"; > = {-0.5f,2.0f,1.25f};
float3 Lamp0Color : Specular < string UIName = "Lamp 0"; string Object = "Pointlight0"; string UIWidget = "Color"; > = {1.0f,1.0f,1.0f};
float3 AmbiColor : Ambient < string UIName = "Ambient Light"; string UIWidget = "Color"; > = {0.07f,0.07f,0.07f};
float Ks < string UIWidget = "slider"; float UIMin = 0.0; float UIMax = 1.0; float UIStep = 0.05; > = 0.4;
float Eccentricity < string UIWidget = "slider"; float UIMin = 0.0; float UIMax = 1.0; > = 0.3;
texture ColorTexture : DIFFUSE < string ResourceName = "default_color.dds"; string UIName = "Diffuse Texture"; string ResourceType = "2D"; >;
sampler2D ColorSampler = sampler_state { Texture = <ColorTexture>; MinFilter = Linear; MipFilter = Linear; MagFilter = Linear; AddressU = Wrap; AddressV = Wrap; };
struct appdata { float3 Position : POSITION; float4 UV : TEXCOORD0; float4 Normal : NORMAL; float4 Tangent : TANGENT0; float4 Binormal : BINORMAL0; };
struct vertexOutput { float4 HPosition : POSITION; float2 UV : TEXCOORD0; float3 LightVec : TEXCOORD1; float3 WorldNormal : TEXCOORD2; float3 WorldView : TEXCOORD5; };
vertexOutput std_VS(appdata IN) {
    vertexOutput OUT = (vertexOutput)0;
    OUT.WorldNormal = mul(IN.Normal, WorldITXf).xyz;
    float4 Po = float4(IN.Position.xyz, 1);
    float3 Pw = mul(Po, WorldXf).xyz;
    OUT.LightVec = (Lamp0Pos - Pw);
    OUT.UV = IN.UV.xy;
    OUT.WorldView = normalize(ViewIXf[3].xyz - Pw);
    OUT.HPosition = mul(Po, WvpXf);
    return OUT;
}
void blinn(vertexOutput IN, float3 c, out float3 D, out float3 S) {
    float3 Ln = normalize(IN.LightVec), Nn = normalize(IN.WorldNormal), Vn = normalize(IN.WorldView);
    float3 Hn = normalize(Vn + Ln);
    float4 l = lit(dot(Ln, Nn), dot(Hn, Nn), 30);
    D = l.y * c; S = l.y * l.z * Ks * c;
}
float4 std_PS(vertexOutput IN, uniform bool textured) : COLOR {
    float3 d, s; blinn(IN, Lamp0Color, d, s);
    float3 c = textured ? tex2D(ColorSampler, IN.UV * 4).rgb : float3(1, .5, .2);
    return float4(s + c * (d + AmbiColor), 1);
}
technique Plain < string Script = "Pass=p0;"; > { pass p0 < string Script = "Draw=geometry;"; > { VertexShader = compile vs_2_0 std_VS(); ZEnable = true; ZWriteEnable = true; CullMode = CCW; PixelShader = compile ps_2_a std_PS(false); } }
technique Textured < string Script = "Pass=p0;"; > { pass p0 < string Script = "Draw=geometry;"; > { VertexShader = compile vs_2_0 std_VS(); ZEnable = true; CullMode = None; PixelShader = compile ps_2_a std_PS(true); } }
