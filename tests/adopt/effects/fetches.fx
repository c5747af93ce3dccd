// Every fetch of Direct3D 9, by level, by bias, projected, with gradients, and an array of samplers.
float4x4 wvp : WVP;
texture a; texture b; texture e < string type = "CUBE"; >;
sampler2D both[2] = { sampler_state { Texture = <a>; MinFilter = LINEAR; }, sampler_state { Texture = <b>; MinFilter = POINT; } };
sampler2D one = sampler_state { texture = <a>; MipFilter = LINEAR; MinFilter = LINEAR; MagFilter = LINEAR; MipMapLodBias = -1; AddressU = MIRROR; AddressV = BORDER; BorderColor = 0xff0000ff; };
samplerCUBE cube = sampler_state { texture = <e>; };
sampler1D thin = sampler_state { texture = <b>; };
struct V { float4 p : POSITION; float4 t[2] : TEXCOORD0; float3x3 m : TEXCOORD3; };
V vs(float4 p : POSITION, float4 t : TEXCOORD0, float3 n : NORMAL) { V v; v.p = mul(p, wvp); v.t[0] = t; v.t[1] = float4(t.xy, 0, 2); v.m = float3x3(n, n.yzx, n.zxy); return v; }
float4 ps(V v) : COLOR
{
    float4 c = tex2D(both[0], v.t[0]) * 0.3 + tex2D(both[1], v.t[0].yx) * 0.2;
    c += tex2Dbias(one, float4(v.t[0].xy, 0, 1)) * 0.1 + tex2Dlod(one, float4(v.t[0].xy, 0, 2)) * 0.1 + tex2Dproj(one, v.t[1]) * 0.1;
    c += tex2Dgrad(one, v.t[0].xy, ddx(v.t[0].xy), ddy(v.t[0].xy)) * 0.1 + tex2D(one, v.t[0].xy, ddx(v.t[0].xy), ddy(v.t[0].xy)) * 0.1;
    c += texCUBE(cube, v.m[0]) * 0.2 + texCUBElod(cube, float4(v.m[1], 1)) * 0.1 + texCUBEbias(cube, float4(v.m[2], 1)) * 0.05;
    c += tex1D(thin, v.t[0].x) * 0.1 + tex1Dlod(thin, v.t[0]) * 0.05;
    return c;
}
technique T { pass P { VertexShader = compile vs_3_0 vs(); PixelShader = compile ps_3_0 ps(); } }
