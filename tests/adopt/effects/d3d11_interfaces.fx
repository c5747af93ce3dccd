// Classes that implement an interface: light and material as methods, buffers with packed offsets; a technique without them is shown
interface iLight { float3 shade(float3 n); };
class cHemi : iLight { float3 sky; float3 ground; float3 shade(float3 n) { return lerp(ground, sky, n.y * 0.5 + 0.5); } };
class cSun : iLight { float3 towards; float3 shade(float3 n) { return saturate(dot(n, towards)) * float3(1, 0.9, 0.7); } };
cbuffer cbView : register(b0) { float4x4 gWVP : packoffset(c0) < string note = "all in one"; >; float3 gTint : packoffset(c4.x); float gTime : packoffset(c4.w); };
tbuffer tbMore { float4 gMore = float4(0.1, 0, 0.05, 1); };
Texture2D<float4> gMap; SamplerState gLinear { Filter = MIN_MAG_LINEAR_MIP_POINT; AddressU = Mirror; AddressV = Border; BorderColor = float4(1, 0, 0, 1); MinLOD = 0; MaxLOD = 8; };
int gRef = 2; DepthStencilState gDepth { DepthEnable = TRUE; StencilEnable = TRUE; StencilReadMask = 0xff; FrontFaceStencilFunc = ALWAYS; FrontFaceStencilPass = REPLACE; BackFaceStencilFunc = NEVER; };
struct VO { float4 h : SV_POSITION; float3 n : NORMAL; float2 t : TEXCOORD; };
VO VS(float4 p : POSITION, float3 n : NORMAL, float2 t : TEXCOORD) { VO o = (VO)0; o.h = mul(p, gWVP); o.n = n; o.t = t; return o; }
float4 PS(VO i) : SV_TARGET
{
    cHemi hemi; hemi.sky = float3(0.3, 0.4, 0.6); hemi.ground = float3(0.2, 0.1, 0);
    cSun sun; sun.towards = normalize(float3(-0.27, 0.53, 0.8));
    float3 n = normalize(i.n);
    return float4(gMap.Sample(gLinear, i.t * 1.5).rgb * (hemi.shade(n) + sun.shade(n)) + gMore.rgb, 1);
}
fxgroup g0 { technique11 Lit < int priority = 1; > { pass P0 { SetVertexShader(CompileShader(vs_5_0, VS())); SetPixelShader(CompileShader(ps_5_0, PS())); SetDepthStencilState(gDepth, gRef); } } }
