// Waves in the vertex shader: an array of structures with names, loops over uniform counts, a sky.
struct Wave { float freq; float amp; float phase; float2 dir; };
Wave wave[2] = { { 3.0, 0.03, 0.5, float2(-1, 0) }, { 6.0, 0.015, 1.3, float2(-0.7, 0.7) } };
float4x4 worldMatrix : World < string UIWidget = "none"; >;
float4x4 wvpMatrix : WorldViewProjection < string UIWidget = "none"; >;
float4x4 viewInverseMatrix : ViewInverse < string UIWidget = "none"; >;
float time : Time < string UIWidget = "none"; >;
float4 deepColor : Diffuse < string UIName = "Deep Water"; string UIWidget = "Color"; > = { 0.0f, 0.1f, 0.3f, 1.0f };
float4 shallowColor : Diffuse < string UIName = "Shallow Water"; string UIWidget = "Color"; > = { 0.0f, 0.5f, 0.5f, 1.0f };
texture cubeTexture : Environment < string ResourceName = "CloudyHills_cubemap2.dds"; string ResourceType = "Cube"; >;
samplerCUBE envMap = sampler_state { Texture = <cubeTexture>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
struct a2v { float4 Position : POSITION; float2 TexCoord : TEXCOORD0; float3 Normal : NORMAL; };
struct v2f { float4 Position : POSITION; float3 normal : TEXCOORD1; float3 eye : TEXCOORD2; };
float evaluateWave(Wave w, float2 pos, float t) { return w.amp * sin(dot(w.dir, pos) * w.freq + t * w.phase); }
v2f BumpReflectWaveVS(a2v IN, uniform float4x4 WorldViewProj, uniform float4x4 World, uniform float4x4 ViewIT, uniform float t)
{
    v2f OUT; float4 P = IN.Position; float y = 0;
    for (int i = 0; i < 2; i++) y += evaluateWave(wave[i], P.xz, t);
    P.xyz += IN.Normal * y;
    OUT.Position = mul(P, WorldViewProj); OUT.normal = mul(float4(normalize(IN.Normal + float3(y, 0, -y) * 8), 0), World).xyz; OUT.eye = ViewIT[3].xyz - mul(P, World).xyz;
    return OUT;
}
float4 OceanPS20(v2f IN, uniform samplerCUBE EnvironmentMap) : COLOR
{
    float3 N = normalize(IN.normal), E = normalize(IN.eye);
    float4 reflection = texCUBE(EnvironmentMap, reflect(-E, N));
    float facing = 1.0 - max(dot(E, N), 0);
    return lerp(deepColor, shallowColor, facing) + reflection * pow(facing, 2.0);
}
technique ReflectBump { pass p0 { VertexShader = compile vs_1_1 BumpReflectWaveVS(wvpMatrix, worldMatrix, viewInverseMatrix, time); CullMode = None; PixelShader = compile ps_2_0 OceanPS20(envMap); } }
