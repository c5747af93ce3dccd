// In the manner of the Standard Annotations and Semantics 1.0: everything by address, controls with SasUi
int GlobalParameter : SasGlobal
<
    int3 SasVersion = {1, 1, 0};
    string SasEffectDescription = "lamps by address";
    string SasEffectCompany = "none";
    bool SasUiVisible = false;
>;
struct PointLight { float3 Position; float3 Color; float Range; };
struct DirLight { float3 Direction; float3 Color; };
int cPoint < string SasBindAddress = "Sas.NumPointLights"; > = 1;
int cDir < string SasBindAddress = "Sas.NumDirectionalLights"; >;
PointLight Points[2] < string SasBindAddress = "Sas.PointLight[*]"; > = { { {0.0, 3.0, 2.0}, {1.0, 0.8, 0.6}, 100.0 }, { {2.0, 0.0, 2.0}, {0.2, 0.2, 0.4}, 100.0 } };
DirLight Sun < string SasBindAddress = "Sas.DirectionalLight[0]"; > = { {0.0, -0.7, -0.7}, {0.5, 0.5, 0.5} };
float4 Ambient < string SasUiLabel = "Ambient"; string SasUiControl = "ColorPicker"; > = float4(0.1, 0.1, 0.1, 1);
float4 Diffuse < string SasUiLabel = "Diffuse"; string SasUiControl = "ColorPicker"; float SasUiMin = 0, SasUiMax = 1; int SasUiSteps = 10; > = float4(0.8, 0.6, 0.4, 1);
float Shine < string SasUiLabel = "Shine"; string SasUiControl = "Slider"; float SasUiMin = 1; float SasUiMax = 100; > = 30;
float4x4 World < string SasBindAddress = "Sas.Skeleton.MeshToJointToWorld[0]"; bool SasUiVisible = false; >;
float4x4 View < string SasBindAddress = "Sas.Camera.WorldToView"; >;
float4x4 Proj < string SasBindAddress = "Sas.Camera.Projection"; >;
float3 Eye < string SasBindAddress = "Sas.Camera.Position"; >;
float Now < string SasBindAddress = "Sas.Time.Now"; >;
texture Skin < string SasUiLabel = "Map"; string SasUiControl = "FilePicker"; string SasResourceAddress = "skin.dds"; >;
sampler SkinS = sampler_state { Texture = <Skin>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = LINEAR; };
struct V2P { float4 p : POSITION; float3 n : TEXCOORD0; float3 w : TEXCOORD1; float2 t : TEXCOORD2; };
V2P VS(float3 p : POSITION, float3 n : NORMAL, float2 t : TEXCOORD0)
{
    V2P o;
    o.w = mul(float4(p, 1), World);
    o.n = mul(n, (float3x3)World);
    o.p = mul(mul(float4(o.w, 1), View), Proj);
    o.t = t;
    return o;
}
float4 PS(V2P i) : COLOR
{
    float3 n = normalize(i.n);
    float3 e = normalize(Eye - i.w);
    float3 sum = Ambient.rgb + saturate(dot(n, -Sun.Direction)) * Sun.Color;
    float3 gloss = 0;
    for (int k = 0; k < 2; ++k)
    {
        float3 l = normalize(Points[k].Position - i.w);
        sum += saturate(dot(n, l)) * Points[k].Color;
        gloss += pow(saturate(dot(n, normalize(l + e))), Shine) * Points[k].Color;
    }
    return float4(tex2D(SkinS, i.t).rgb * Diffuse.rgb * sum + gloss, 1);
}
technique TransformAndTexture { pass P0 { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
