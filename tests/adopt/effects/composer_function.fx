// Textures that the effect computes itself, in the manner of FX Composer: by a function named in an annotation, and by a texture shader
float4x4 WvpXf : WorldViewProjection < string UIWidget="None"; >;
float4x4 WorldITXf : WorldInverseTranspose < string UIWidget="None"; >;
float4x4 WorldXf : World;
float4x4 ViewIXf : ViewInverse;
float3 Lamp0Pos : POSITION < string Object = "PointLight0"; string UIName = "Lamp 0 Position"; string Space = "World"; > = {-0.5f,2.0f,1.25f};
#define NOISE_SIZE 64
#define STRIPE_SIZE 256
float4 make_stripes(float2 Pos : POSITION, float ps : PSIZE) : COLOR
{
    float v = 0;
    float nx = Pos.x + ps; // keep the last column full-on, always
    v = nx > Pos.y;
    return float4(v.xxxx);
}
texture StripeTex <
    string function = "make_stripes";
    string UIWidget = "None";
    float2 Dimensions = { STRIPE_SIZE, STRIPE_SIZE };
>;
sampler2D StripeSampler = sampler_state { Texture = <StripeTex>; MinFilter = Linear; MipFilter = Linear; MagFilter = Linear; AddressU = Wrap; AddressV = Clamp; };
float4 shadingFunc(float2 dotLNVN : POSITION, float2 texelSize : PSIZE) : COLOR
{
    float d = dotLNVN.x * 2 - 1;
    return float4(saturate(d) * 0.9 + 0.1, floor(saturate(d) * 4) / 4, pow(dotLNVN.y, 8), 1);
}
texture ShadeTex < string ResourceType = "2D"; string function = "shadingFunc"; int width = 64; int height = 64; >;
sampler ShadeSampler = sampler_state { Texture = <ShadeTex>; MinFilter = Linear; MagFilter = Linear; MipFilter = None; AddressU = Clamp; AddressV = Clamp; };
float4 normalCube(float3 Pos : POSITION) : COLOR { return float4(normalize(Pos) * 0.5 + 0.5, 1); }
texture NormTex < string ResourceType = "Cube"; string function = "normalCube"; int width = 32; >;
samplerCUBE NormSampler = sampler_state { Texture = <NormTex>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
void std_VS(float4 p : POSITION, float3 n : NORMAL, float2 uv : TEXCOORD0, out float4 op : POSITION, out float2 ouv : TEXCOORD0, out float3 on : TEXCOORD1, out float3 ol : TEXCOORD2, out float3 ov : TEXCOORD3)
{
    op = mul(p, WvpXf);
    on = mul(float4(n, 0), WorldITXf).xyz;
    float3 pw = mul(p, WorldXf).xyz;
    ol = Lamp0Pos - pw;
    ov = ViewIXf[3].xyz - pw;
    ouv = uv;
}
float4 std_PS(float2 uv : TEXCOORD0, float3 n : TEXCOORD1, float3 l : TEXCOORD2, float3 v : TEXCOORD3) : COLOR
{
    n = texCUBE(NormSampler, n).xyz * 2 - 1;
    l = normalize(l);
    float nl = dot(n, l) * 0.5 + 0.5;
    float nh = dot(n, normalize(l + normalize(v)));
    float4 shade = tex2D(ShadeSampler, float2(nl, nh));
    float stripe = tex2D(StripeSampler, float2(uv.x * 20, nl)).x;
    return float4(shade.xyy * lerp(float3(0.9, 0.5, 0.2), float3(0.2, 0.4, 0.9), stripe) + shade.z, 1);
}
technique Main < string Script = "Pass=p0;"; >
{
    pass p0 < string Script = "Draw=geometry;"; > { VertexShader = compile vs_2_0 std_VS(); ZEnable = true; ZWriteEnable = true; ZFunc = LessEqual; AlphaBlendEnable = false; CullMode = None; PixelShader = compile ps_2_a std_PS(); }
}
