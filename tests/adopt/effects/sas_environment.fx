// Addresses of every kind: camera, time, joints, ambient and environment, with both generations of annotations
float4x4 WorldView < string SasBindAddress = "Sas.Skeleton.MeshToJointToWorld[0]"; >; float4x4 V < string SasBindAddress = "Sas.Camera.WorldToView"; >; float4x4 P < string SasBindAddress = "Sas.Camera.Projection"; >; float3 E < string SasBindAddress = "Sas.Camera.Position"; >;
float3 A < string SasBindAddress = "Sas.AmbientLight[0].Color"; > = { 0.15, 0.1, 0.1 }; struct Dir { float3 Color; float3 Direction; }; Dir D < string SasBindAddress = "Sas.DirectionalLight[0]"; > = { { 1.0, 1.0, 1.0 }, { 0.0, -1.0, 0.0 } };
float T < string SasBindAddress = "Sas.Time.Now"; >; texture EnvMap < string SasBindAddress = "Sas.EnvironmentMap"; string SasUiLabel = "Environment"; >; samplerCUBE EnvS = sampler_state { Texture = <EnvMap>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
float Fresnel < string SasUiControl = "Slider"; string UIWidget = "Slider"; float UIMin = 0, UIMax = 1, UIStep = 0.01; > = 0.4;
struct VO { float4 p : POSITION; float3 n : TEXCOORD0; float3 w : TEXCOORD1; };
VO VS(float4 p : POSITION, float3 n : NORMAL) { VO o; float4 w = mul(p, WorldView); o.p = mul(mul(w, V), P); o.n = mul(n, (float3x3)WorldView); o.w = w.xyz; return o; }
float4 PS(VO i) : COLOR { float3 n = normalize(i.n), e = normalize(E - i.w); float3 c = A + saturate(dot(n, -D.Direction)) * D.Color * 0.5; return float4(lerp(c, texCUBElod(EnvS, float4(reflect(-e, n), 1)).rgb, Fresnel), 1); }
technique Env { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
