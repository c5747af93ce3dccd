// DXSAS 1.0: what the host gives by address.
int GlobalParameter : SasGlobal < int3 SasVersion = { 1, 0, 0 }; string SasEffectDescription = "lamps"; >;
float4x4 World < string SasBindAddress = "Sas.Skeleton.MeshToJointToWorld[0]"; >;
float4x4 View < string SasBindAddress = "Sas.Camera.WorldToView"; >;
float4x4 Proj < string SasBindAddress = "Sas.Camera.Projection"; >;
float3 Eye < string SasBindAddress = "Sas.Camera.Position"; >;
struct PointLight { float3 Position; float3 Color; float Range; };
PointLight gLamps[2] < string SasBindAddress = "Sas.PointLight[0]"; > = { { 2, 2, 3, 1, 0.9, 0.8, 10 }, { -3, 1, 2, 0.2, 0.3, 0.6, 10 } };
float3 Ambient < string SasBindAddress = "Sas.AmbientLight[0].Color"; bool SasUiVisible = false; > = { 0.1, 0.1, 0.1 };
void vs(float3 p : POSITION, float3 n : NORMAL, out float4 o : POSITION, out float3 wp : TEXCOORD0, out float3 wn : TEXCOORD1)
{
    float4 w = mul(float4(p, 1), World);
    o = mul(mul(w, View), Proj);
    wp = w;
    wn = mul(n, (float3x3)World);
}
float4 ps(float3 wp : TEXCOORD0, float3 wn : TEXCOORD1) : COLOR
{
    float3 n = normalize(wn), sum = Ambient;
    for (int i = 0; i < 2; i++) {
        float3 l = gLamps[i].Position - wp;
        float f = saturate(1 - length(l) / gLamps[i].Range);
        sum += gLamps[i].Color * saturate(dot(n, normalize(l))) * f * 2;
    }
    return float4(sum, 1);
}
technique T { pass { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); } }
