// Terrain in the manner of small engines: arrays of textures and samplers, fog out of the vertex shader, clip planes, states for blending
#define NUM_LAYERS 4
#define STR(x) #x
matrix World, View, Projection;
float4 LightDir = { 0.3, -0.8, -0.5, 0 }, LightColor = { 1, 0.95, 0.85, 1 }, AmbientLight = { 0.25, 0.25, 0.3, 1 };
float4x4 LightViewProj;
float FogStart = 500, FogEnd = 3000;
float3 FogColor = { 0.6, 0.7, 0.8 };
float2 LayerTiling[NUM_LAYERS] = { float2(8, 8), float2(4, 4), { 6, 6 }, 12, 12 };
texture LayerMap0, LayerMap1, LayerMap2, LayerMap3;
texture BlendMap < string name = "blend.tga"; >;
texture LightMap : TEXTURE1 < string ResourceName = "terrain_light.bmp"; >;
sampler LayerSamplers[NUM_LAYERS] = {
    sampler_state { Texture = <LayerMap0>; MinFilter = Anisotropic; MagFilter = Linear; MipFilter = Linear; MaxAnisotropy = 8; },
    sampler_state { Texture = <LayerMap1>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; },
    sampler_state { Texture = <LayerMap2>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; },
    sampler_state { Texture = <LayerMap3>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; }
};
sampler2D BlendSampler = sampler_state { Texture = (BlendMap); AddressU = Clamp; AddressV = Clamp; MinFilter = Linear; MagFilter = Linear; MipFilter = None; };
sampler LightSampler : register(s5) = sampler_state { texture = <LightMap>; AddressU = Mirror; AddressV = MirrorOnce; };
stateblock OpaqueState = stateblock_state
{
    AlphaBlendEnable = FALSE;
    ZEnable = TRUE;
    CullMode = CCW;
};
struct TerrainVertex
{
    float4 pos : POSITION, normal : NORMAL;
    float2 uv : TEXCOORD0;
};
struct Out
{
    float4 pos : POSITION;
    float4 color : COLOR0;
    float2 uv : TEXCOORD0;
    float4 layers[2] : TEXCOORD1;
    float depth : TEXCOORD4;
    float fog : TEXCOORD5;
};
struct In
{
    float4 color : COLOR0;
    float2 uv : TEXCOORD0;
    float4 layers[2] : TEXCOORD1;
    float fog : TEXCOORD5;
};
Out TerrainVS(TerrainVertex v)
{
    Out o;
    float4 wp = mul(v.pos, World);
    float4 vp = mul(wp, View);
    o.pos = mul(vp, Projection);
    float3 n = mul(v.normal.xyz, World);
    o.color = AmbientLight + LightColor * max(0, dot(normalize(n), -LightDir.xyz));
    o.uv = v.uv;
    for (int i = 0; i < 2; ++i)
        o.layers[i] = float4(v.uv * LayerTiling[i * 2], v.uv * LayerTiling[i * 2 + 1]);
    o.depth = vp.z;
    o.fog = saturate((FogEnd - abs(vp.z)) / (FogEnd - FogStart));
    return o;
}
float4 TerrainPS(in In i, uniform int count, uniform bool useLight) : COLOR
{
    float4 w = tex2D(BlendSampler, i.uv);
    w /= dot(w, 1);
    float4 c = 0;
    c += tex2D(LayerSamplers[0], i.layers[0].xy) * w.r * float4(0.5, 0.8, 0.3, 1);
    c += tex2D(LayerSamplers[1], i.layers[0].zw) * w.g * float4(0.7, 0.6, 0.4, 1);
    if (count > 2) {
        c += tex2D(LayerSamplers[2], i.layers[1].xy) * w.b;
        c += tex2D(LayerSamplers[3], i.layers[1].zw) * w.a;
    }
    c.rgb *= i.color;
    if (useLight) c *= tex2D(LightSampler, i.uv);
    c.rgb = lerp(FogColor, c.rgb, i.fog);
    return c;
}
technique Terrain4 { pass base { StateBlock = (OpaqueState); VertexShader = compile vs_2_0 TerrainVS(); PixelShader = compile ps_2_0 TerrainPS(4, true); FogEnable = false; } }
technique Terrain2 < string fallback = "Terrain1"; float quality = (0.5); >
{
    pass base
    {
        VertexShader = compile vs_2_0 TerrainVS();
        PixelShader = compile ps_2_0 TerrainPS(2, false);
        ClipPlaneEnable = 0x1;
        FogEnable = true; FogColor = 0xff99b3cc; FogVertexMode = LINEAR; FogStart = <FogStart>;
        Wrap0 = U | V;
    }
}
