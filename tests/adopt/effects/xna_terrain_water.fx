// In the manner of a tutorial for XNA: one file for ground and water, constants with xName, clip planes, billboards, techniques with years
//------- Constants --------
float4x4 xView;
float4x4 xReflectionView;
float4x4 xProjection;
float4x4 xWorld;
float3 xLightDirection;
float xAmbient;
bool xEnableLighting;
float xWaveLength;
float xWaveHeight;
float3 xCamPos;
float xTime;
float3 xWindDirection;
float xWindForce;
float4 ClipPlane0;
bool Clipping;
//------- Texture Samplers --------
Texture xTexture;
sampler TextureSampler = sampler_state { texture = <xTexture> ; magfilter = LINEAR; minfilter = LINEAR; mipfilter=LINEAR; AddressU = mirror; AddressV = mirror;};Texture xTexture0;
sampler TextureSampler0 = sampler_state { texture = <xTexture0> ; magfilter = LINEAR; minfilter = LINEAR; mipfilter=LINEAR; AddressU = wrap; AddressV = wrap;};Texture xWaterBumpMap;
sampler WaterBumpMapSampler = sampler_state { texture = <xWaterBumpMap> ; magfilter = LINEAR; minfilter = LINEAR; mipfilter=LINEAR; AddressU = mirror; AddressV = mirror;};
//------- Technique: Textured --------
struct TVertexToPixel
{
float4 Position     : POSITION;
float4 Color        : COLOR0;
float LightingFactor: TEXCOORD0;
float2 TextureCoords: TEXCOORD1;
float4 clipDistances : TEXCOORD2;
};
struct TPixelToFrame { float4 Color : COLOR0; };
TVertexToPixel TexturedVS( float4 inPos : POSITION, float3 inNormal: NORMAL, float2 inTexCoords: TEXCOORD0)
{
    TVertexToPixel Output = (TVertexToPixel)0;
    float4x4 preViewProjection = mul (xView, xProjection);
    float4x4 preWorldViewProjection = mul (xWorld, preViewProjection);
    Output.Position = mul(inPos, preWorldViewProjection);
    Output.TextureCoords = inTexCoords;
    float3 Normal = normalize(mul(normalize(inNormal), xWorld));
    Output.LightingFactor = 1;
    if (xEnableLighting)
        Output.LightingFactor = saturate(dot(Normal, -xLightDirection));
    Output.clipDistances = dot(mul(inPos, xWorld), ClipPlane0);
    return Output;
}
TPixelToFrame TexturedPS(TVertexToPixel PSIn)
{
    TPixelToFrame Output = (TPixelToFrame)0;
    if (Clipping) clip(PSIn.clipDistances);
    Output.Color = tex2D(TextureSampler, PSIn.TextureCoords);
    Output.Color.rgb *= saturate(PSIn.LightingFactor + xAmbient);
    return Output;
}
technique Textured_2_0 { pass Pass0 { VertexShader = compile vs_2_0 TexturedVS(); PixelShader  = compile ps_2_0 TexturedPS(); } }
struct WVertexToPixel { float4 Position : POSITION; float4 ReflectionMapSamplingPos : TEXCOORD1; float2 BumpMapSamplingPos : TEXCOORD2; float4 Position3D : TEXCOORD4; };
WVertexToPixel WaterVS(float4 inPos : POSITION, float2 inTex: TEXCOORD)
{
    WVertexToPixel Output = (WVertexToPixel)0;
    float4x4 preWorldViewProjection = mul (xWorld, mul (xView, xProjection));
    Output.Position = mul(inPos, preWorldViewProjection);
    Output.ReflectionMapSamplingPos = mul(inPos, mul (xWorld, mul (xReflectionView, xProjection)));
    Output.Position3D = mul(inPos, xWorld);
    float3 windDir = normalize(xWindDirection);
    float3 perpDir = cross(xWindDirection, float3(0,1,0));
    float2 rotatedTexCoords = float2(dot(inTex, windDir.xz), dot(inTex, perpDir.xz));
    Output.BumpMapSamplingPos = (rotatedTexCoords.xy + float2(0, xTime*xWindForce))/(xWaveLength + 0.1);
    return Output;
}
float4 WaterPS(WVertexToPixel PSIn) : COLOR0
{
    float4 bumpColor = tex2D(WaterBumpMapSampler, PSIn.BumpMapSamplingPos);
    float2 perturbation = xWaveHeight*(bumpColor.rg - 0.5f)*2.0f;
    float2 ProjectedTexCoords = float2(1, -1) * PSIn.ReflectionMapSamplingPos.xy/PSIn.ReflectionMapSamplingPos.w/2.0f + 0.5f;
    float4 reflectiveColor = tex2D(TextureSampler0, ProjectedTexCoords + perturbation);
    float3 eyeVector = normalize(xCamPos - PSIn.Position3D);
    float3 normalVector = (bumpColor.rbg-0.5f)*2.0f;
    return lerp(reflectiveColor, float4(0.3f, 0.3f, 0.5f, 1.0f), saturate(dot(eyeVector, normalVector)));
}
technique Water { pass Pass0 { VertexShader = compile vs_2_0 WaterVS(); PixelShader = compile ps_2_0 WaterPS(); } }
