// A spot light with a picture in it: projective fetches of each spelling, alpha from expressions, structure with initial values
struct Spot { float3 colour; float angle; float4x4 view; };
Spot gSpot < string Object = "SpotLight"; string UIName = "Spot"; > = { { 1, 0.9, 0.7 }, 0.6, { 0.4,0,0,0, 0,0.4,0,0, 0,0,0.2,0, 0.2,0.2,0.5,1 } };
float gOpacity = 0.8; bool gTwoSided = true; int gRef = 16; float gThreshold = pow(0.5, 2); int gWrap = 3;
texture Cookie < string name = ("cookie.tga"); string TextureType = "2D"; int width = 256, height = 256; >;
sampler CookieSampler = sampler_state { texture = (Cookie); AddressU = <gWrap>; AddressV = (gWrap); AddressW = CLAMP; MINFILTER = LINEAR; MAGFILTER = LINEAR; MIPFILTER = LINEAR; };
float4x4 wvp : WorldViewProjection; float4x4 world : World;
void VS(in float4 p : POSITION, in float3 n : NORMAL, out float4 op : POSITION, out float4 proj : TEXCOORD0, out float3 on : TEXCOORD1) { op = mul(p, wvp); proj = mul(mul(p, world), gSpot.view); on = n; }
float4 PS(float4 proj : TEXCOORD0, float3 n : TEXCOORD1, float face : VFACE) : COLOR
{
    float4 c = tex2Dproj(CookieSampler, proj.xyzw);
    c += tex2Dproj(CookieSampler, float4(proj.xy, 0, max(proj.w, 0.1))) * 0.5;
    c += tex2Dlod(CookieSampler, float4(proj.xy / proj.w, 0, 3)) * 0.25;
    c.rgb *= gSpot.colour * saturate(gSpot.angle + n.z) * (face > 0 ? 1 : 0.5);
    c.a = gOpacity;
    return c;
}
technique Lit
{
    pass P
    {
        AlphaBlendEnable = (gOpacity < 1.0); SrcBlend = (gOpacity > 0.9 ? 2 : 5); DestBlend = InvSrcAlpha;
        AlphaTestEnable = <gTwoSided>; AlphaRef = (gRef / 2); AlphaFunc = GreaterEqual;
        CullMode = (gTwoSided ? 1 : 3);
        VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS();
    }
}
