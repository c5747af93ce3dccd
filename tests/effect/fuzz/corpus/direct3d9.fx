float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;
float3 gLight < string UIName = "Light" " direction"; float UIMin = -1; > = { 0, -1, 0 };
texture gSkinMap : DIFFUSE < string ResourceName = "skin.dds"; >;
sampler2D gSkin = sampler_state
{
    Texture = <gSkinMap>;
    MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = NONE;
    AddressU = WRAP; AddressV = CLAMP; BorderColor = 0xff00ff00;
};
struct Varying { float4 position : POSITION; float2 uv : TEXCOORD0; };
Varying MeshVS(float4 p : POSITION, float2 t : TEXCOORD0, uniform int n)
{
    Varying o; o.position = mul(p, gWorldViewProjection) * n; o.uv = t; return o;
}
float4 SkinPS(Varying i) : COLOR0 { return tex2D(gSkin, i.uv) * saturate(dot(gLight, gLight)); }
technique Main
{
    pass Lit
    {
        VertexShader = compile vs_3_0 MeshVS(2);
        PixelShader = compile ps_3_0 SkinPS();
        ZEnable = TRUE; CullMode = CW; AlphaBlendEnable = TRUE; SrcBlend = SRCALPHA; ColorWriteEnable = RED | GREEN;
    }
}
