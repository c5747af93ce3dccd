// Water of a game of 2006: projected reflections, biased and graded fetches, sampler states from parameters and expressions
struct { float4 deep; float3 shallow; float2 scale; } gWater < string UIName = "Water"; > = { 0, 0.1, 0.2, 1,  0.2, 0.5, 0.6,  4, 3 };
struct Wave { float amplitude; float2 direction; } ;
Wave gWaves[2] < String UIName = "Waves"; > = { { 0.02, float2(1, 0) }, { 0.01, float2(0.5, 0.8) } };
int gFilter = 2; int gAddress = 3; float gBias = 0.5; float4 gEdge = { 0.1, 0.2, 0.3, 1 }; float2 gTexel = (1, 1);
float4x4 matWVP : WORLDVIEWPROJECTION; float4x4 matW : WORLD; float3 eye : CAMERAPOSITION; float time : TIME;
static const float kTurn = cos(radians(30)), kSide = sin(radians(30));
texture tReflect < string ResourceName = ("reflect.dds"); >; texture tBump < string ResourceName = ("bump.dds"); string ResourceType = ("2D"); >;
sampler2D sReflect = sampler_state { Texture = <tReflect>; MinFilter = <gFilter>; MagFilter = (gFilter); MipFilter = gFilter; AddressU = (gAddress); AddressV = <gAddress>; MipMapLodBias = (gBias * 0.5); BorderColor = <gEdge>; };
sampler2D sBump = sampler_state { Texture = (tBump); MaxAnisotropy = (2 * gFilter); MinFilter = Anisotropic; AddressU = Border; BorderColor = 0xff8080ff; };
struct V { float4 p : POSITION; float4 s : TEXCOORD0; float2 t : TEXCOORD1; float3 e : TEXCOORD2; float3 n : NORMAL; };
V VS(float4 p : POSITION, float3 n : NORMAL, float2 t : TEXCOORD0)
{
    V o;
    for (int i = 0; i < 2; i++) p.xyz += n * gWaves[i].amplitude * sin(dot(p.xz, gWaves[i].direction) * 10 + time);
    o.p = mul(p, matWVP);
    o.s = float4(o.p.x + o.p.w, o.p.w - o.p.y, 0, 2 * o.p.w);
    o.t = mul(t * gWater.scale, float2x2(kTurn, kSide, -kSide, kTurn));
    o.e = eye - mul(p, matW).xyz; o.n = n;
    return o;
}
float4 PS(V i) : COLOR
{
    float3 b = tex2Dgrad(sBump, i.t, ddx(i.t), ddy(i.t)).xyz * 2 - 1;
    float4 r = tex2Dproj(sReflect, i.s + float4(b.xy * 0.05 * i.s.w, 0, 0));
    r += 0.25 * tex2Dbias(sReflect, float4(i.t * gTexel, 0, 2));
    float f = pow(1 - saturate(dot(normalize(i.e), normalize(i.n + b * 0.2))), 3);
    return lerp(lerp(gWater.deep, float4(gWater.shallow, 1), f), r, 0.3 + 0.5 * f);
}
technique Water { pass P { VertexShader = compile vs_3_0 VS(); PixelShader = compile ps_3_0 PS(); } }
