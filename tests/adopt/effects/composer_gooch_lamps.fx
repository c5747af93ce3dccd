/* In the manner of a material of FX Composer: lamps by Object, both for 9 and 10, templates chosen by macros, structures of lamps */
#define FLIP_TEXTURE_Y
float Script : STANDARDSGLOBAL < string UIWidget = "none"; string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color"; string Script = "Technique=Technique?Main:Untextured;"; > = 0.8;
float4x4 gWorldITXf : WorldInverseTranspose < string UIWidget="None"; >;
float4x4 gWvpXf : WorldViewProjection < string UIWidget="None"; >;
float4x4 gWorldXf : World < string UIWidget="None"; >;
float4x4 gViewIXf : ViewInverse < string UIWidget="None"; >;
float3 gLamp0Pos : POSITION < string Object = "PointLight0"; string UIName = "Lamp 0 Position"; string Space = ("World"); > = {-0.5f,2.0f,1.25f};
float3 gLamp0Color : SPECULAR < string UIName = "Lamp 0"; string Object = "Pointlight0"; string UIWidget = "Color"; > = {1.0f,1.0f,1.0f};
float3 gLiteColor < string UIName = "Bright Surface"; string UIWidget = "Color"; > = {0.8f, 0.5f, 0.1f};
float3 gDarkColor < string UIName = "Dark Surface"; string UIWidget = "Color"; > = {0.0f, 0.0f, 0.0f};
float3 gWarmColor < string UIName = "Gooch Warm Tone"; string UIWidget = "Color"; > = {0.5f, 0.4f, 0.05f};
float3 gCoolColor < string UIName = "Gooch Cool Tone"; string UIWidget = "Color"; > = {0.05f, 0.05f, 0.6f};
float gSpecExpon < string UIWidget = "slider"; float UIMin = 1.0; float UIMax = 128.0; float UIStep = 1.0; string UIName = "Specular Exponent"; > = 40.0;
float gGlossTop < string UIWidget = "slider"; float UIMin = 0.2, UIMax = 1.0, UIStep = 0.05; > = 0.7;
float gGlossDrop < string UIWidget = "slider"; float UIMin = 0.0, UIMax = 1.0, UIStep = 0.05; > = 0.2;
struct appdata { float3 Position : POSITION; float4 UV : TEXCOORD0; float4 Normal : NORMAL; float4 Tangent : TANGENT0; float4 Binormal : BINORMAL0; };
struct vertexOutput { float4 HPosition : POSITION; float2 UV : TEXCOORD0; float3 LightVec : TEXCOORD1; float3 WorldNormal : TEXCOORD2; float3 WorldTangent : TEXCOORD3; float3 WorldBinormal : TEXCOORD4; float3 WorldView : TEXCOORD5; };
vertexOutput goochVS(appdata IN, uniform float4x4 WorldITXf, uniform float4x4 WorldXf, uniform float4x4 ViewIXf, uniform float4x4 WvpXf, uniform float3 LampPos)
{
    vertexOutput OUT = (vertexOutput)0;
    OUT.WorldNormal = mul(IN.Normal,WorldITXf).xyz;
    OUT.WorldTangent = mul(IN.Tangent,WorldITXf).xyz;
    OUT.WorldBinormal = mul(IN.Binormal,WorldITXf).xyz;
    float4 Po = float4(IN.Position.xyz,1);
    float3 Pw = mul(Po,WorldXf).xyz;
    OUT.LightVec = (LampPos - Pw);
#ifdef FLIP_TEXTURE_Y
    OUT.UV = float2(IN.UV.x,(1.0-IN.UV.y));
#else
    OUT.UV = IN.UV.xy;
#endif
    OUT.WorldView = normalize(ViewIXf[3].xyz - Pw);
    OUT.HPosition = mul(Po,WvpXf);
    return OUT;
}
float glossy_drop(float v, uniform float top, uniform float bot, uniform float drop) { return (drop + smoothstep(bot, top, v) * (1.0 - drop)); }
void gooch_shared(vertexOutput IN, uniform float3 LampColor, out float3 Diff, out float3 Spec)
{
    float3 Ln = normalize(IN.LightVec);
    float3 Vn = normalize(IN.WorldView);
    float3 Nn = normalize(IN.WorldNormal);
    float3 Hn = normalize(Vn + Ln);
    float hdn = pow(max(0, dot(Hn, Nn)), gSpecExpon);
    hdn *= glossy_drop(hdn, gGlossTop, gGlossTop - 0.2, gGlossDrop);
    Spec = hdn * LampColor;
    float mixer = 0.5 * (dot(Ln, Nn) + 1.0);
    Diff = lerp(gDarkColor, gLiteColor, mixer) + lerp(gCoolColor, gWarmColor, mixer);
}
float4 goochPS(vertexOutput IN, uniform float3 LampColor) : COLOR
{
    float3 diffContrib;
    float3 specContrib;
    gooch_shared(IN, LampColor, diffContrib, specContrib);
    float4 litV = lit(dot(normalize(IN.LightVec), normalize(IN.WorldNormal)), dot(normalize(IN.WorldNormal), normalize(IN.WorldView)), 4);
    return float4(diffContrib + specContrib * litV.x, 1);
}
technique Main < string Script = "Pass=p0;"; > {
    pass p0 < string Script = "Draw=geometry;"; > {
        VertexShader = compile vs_3_0 goochVS(gWorldITXf, gWorldXf, gViewIXf, gWvpXf, gLamp0Pos);
        ZEnable = true; ZWriteEnable = true; ZFunc = LessEqual; AlphaBlendEnable = false; CullMode = None;
        PixelShader = compile ps_3_0 goochPS(gLamp0Color);
    }
}
technique Untextured < string Script = "Pass=p0;"; > {
    pass p0 < string Script = "Draw=geometry;"; > {
        VertexShader = compile vs_2_0 goochVS(gWorldITXf, gWorldXf, gViewIXf, gWvpXf, gLamp0Pos);
        PixelShader = compile ps_2_a goochPS(float3(1, 0.5, 0.25));
    }
}
