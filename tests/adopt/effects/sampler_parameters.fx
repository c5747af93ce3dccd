// Samplers as parameters of functions; one plain `sampler` whose kind only its use tells; a texture of one dimension.
float4x4 wvp : WORLDVIEWPROJECTION;
float3 lightDir : DIRECTION < string Object = "DirectionalLight"; string Space = "World"; > = { 0.5, -0.7, -0.5 };
texture diffuseTexture : DiffuseMap < string ResourceName = "default.dds"; >;
texture normalTexture : NormalMap < string ResourceName = "default_normal.dds"; >;
texture rampTexture < string ResourceType = "1D"; >;
texture cubeTexture < string ResourceType = "Cube"; >;
sampler diffuseSampler = sampler_state { texture = <diffuseTexture>; MinFilter = linear; MagFilter = linear; MipFilter = linear; };
sampler2D normalSampler = sampler_state { texture = <normalTexture>; MinFilter = linear; MagFilter = linear; MipFilter = none; };
sampler1D rampSampler = sampler_state { texture = <rampTexture>; AddressU = clamp; MinFilter = linear; MagFilter = linear; };
sampler cubeSampler = sampler_state { texture = <cubeTexture>; MinFilter = linear; MagFilter = linear; };
float4 fetch(sampler s, float2 uv) { return tex2D(s, uv); }
float4 twice(sampler s, float2 uv, float scale = 2) { return fetch(s, uv * scale); }
float3 environment(sampler s, float3 r) { return texCUBE(s, r).rgb; }
struct V { float4 p : POSITION; float2 uv : TEXCOORD0; float3 n : TEXCOORD1; float3 t : TEXCOORD2; float3 b : TEXCOORD3; };
V vs(float4 p : POSITION, float2 uv : TEXCOORD0, float3 n : NORMAL, float3 t : TANGENT, float3 b : BINORMAL)
{
    V o = (V)0; o.p = mul(p, wvp); o.uv = uv; o.n = n; o.t = t; o.b = b; return o;
}
float4 ps(V i) : COLOR
{
    float3 m = fetch(normalSampler, i.uv).xyz * 2 - 1;
    float3 n = normalize(m.x * i.t + m.y * i.b + m.z * i.n);
    float l = saturate(dot(n, -normalize(lightDir)));
    float4 c = twice(diffuseSampler, i.uv);
    c.rgb *= tex1D(rampSampler, l).rgb * 0.8 + 0.2;
    c.rgb += environment(cubeSampler, n) * 0.2 + tex2Dlod(normalSampler, float4(i.uv, 0, 0)).b * 0.01;
    return c;
}
technique bump { pass p0 { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); } }
