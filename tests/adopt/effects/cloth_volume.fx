// Volumes and vertex textures in the manner of later Direct3D 9
float4x4 gWorldXf : WORLD; float4x4 gViewProj : VIEWPROJECTION; float gTime : TIME;
texture3D gNoise3 < string ResourceName = "noiseL8_32x32x32.dds"; string ResourceType = "3D"; string TextureType = "VOLUME"; >;
texture gNoiseFn < string ResourceType = "VOLUME"; string function = "fill"; float3 Dimensions = { 32, 32, 32 }; >;
texture gHeight < string ResourceType = "2D"; >;
sampler3D sNoise = sampler_state { Texture = <gNoise3>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; AddressU = Wrap; AddressV = Wrap; AddressW = Wrap; };
sampler sFill = sampler_state { Texture = <gNoiseFn>; MinFilter = Linear; MagFilter = Linear; MipFilter = Linear; };
sampler2D sHeight = sampler_state { Texture = <gHeight>; MinFilter = Point; MagFilter = Point; MipFilter = None; };
float4 fill(float3 p : POSITION) : COLOR { return float4(frac(p * 4), 1); }
struct v2f { float4 pos : POSITION; float3 obj : TEXCOORD0; float3 nrm : TEXCOORD1; };
v2f vs(float4 p : POSITION, float3 n : NORMAL, float2 uv : TEXCOORD0)
{
    v2f o;
    float h = tex2Dlod(sHeight, float4(uv, 0, 0)).r * 0.05;
    float4 w = mul(float4(p.xyz + n * h, 1), gWorldXf);
    o.pos = mul(w, gViewProj);
    o.obj = p.xyz * 0.5 + 0.5;
    o.nrm = n;
    return o;
}
float turbulence(float3 p, int octaves)
{
    float sum = 0, scale = 1;
    while (octaves-- > 0)
    {
        sum += abs(tex3D(sNoise, p * scale).r * 2 - 1) / scale;
        scale *= 2;
    }
    return sum;
}
float4 ps(v2f i) : COLOR
{
    float t = turbulence(i.obj + gTime * 0.01, 4);
    float m = sin(i.obj.x * 20 + t * 5) * 0.5 + 0.5;
    float4 cells = tex3D(sFill, i.obj);
    float4 more = tex3Dlod(sNoise, float4(i.obj, 1));
    return float4(lerp(float3(0.9, 0.85, 0.8), float3(0.2, 0.25, 0.4), m) * (dot(normalize(i.nrm), float3(0, 0.6, 0.8)) * 0.5 + 0.5) * (0.7 + 0.3 * cells.rgb) + more.rgb * 0.05, 1);
}
technique Marble { pass { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); CullMode = CCW; FillMode = Solid; ShadeMode = Gouraud; } }
