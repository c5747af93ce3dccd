// ŠÂ‹« : sphere map and toon, macros that draw whole techniques, Shift-JIS
#define MAT(n) static const float3 Mat##n = float3(n, n * 0.5, 0.25) / 3
#define STR(x) #x
MAT(1); MAT(2);
#define CAT(a, b) a##b
float4x4 WorldViewProjMatrix : WORLDVIEWPROJECTION; float4x4 WorldMatrix : WORLD;
float3 LightDirection : DIRECTION < string Object = "Light"; >;
float3 CameraPosition : POSITION < string Object = "Camera"; >;
float4 MaterialDiffuse : DIFFUSE < string Object = "Geometry"; >;
texture MatcapTex < String ResourceName = (CAT("maps/", "matcap.bmp")); string UIName = STR(MAT); >;
sampler MatcapSamp = sampler_state { texture = <MatcapTex>; MINFILTER = LINEAR; MAGFILTER = LINEAR; ADDRESSU = CLAMP; ADDRESSV = CLAMP; };
bool use_subtexture; bool parthf; bool transp; bool opadd;
struct O { float4 p : POSITION; float3 n : TEXCOORD0; float3 e : TEXCOORD1; };
O VS(float4 p : POSITION, float3 n : NORMAL) { O o; o.p = mul(p, WorldViewProjMatrix); o.n = mul(n, (float3x3)WorldMatrix); o.e = CameraPosition - mul(p, WorldMatrix).xyz; return o; }
float4 PS(O i, uniform bool cap) : COLOR {
    float3 n = normalize(i.n);
    float3 c = Mat1 + Mat2 * saturate(dot(n, -LightDirection));
    if (cap) c *= tex2D(MatcapSamp, n.xy * float2(0.5, -0.5) + 0.5).rgb + 0.3;
    return float4(c * MaterialDiffuse.rgb, MaterialDiffuse.a);
}
#define TEC(name, pass_, cap) technique name < string MMDPass = pass_; > { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(cap); } }
TEC(A, "object", true)
TEC(B, "object_ss", false)
