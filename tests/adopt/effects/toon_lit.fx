// lit(), powers of what may be negative, directions of zero, two techniques, an outline.
float4x4 WorldViewProj : WORLDVIEWPROJ;
float4x4 WorldIT : WORLDIT;
float4x4 ViewInv : VIEWI;
float3 LightPos : POSITION < string Object = "PointLight"; string Space = "World"; > = { 100, 100, 100 };
float4 SurfColor : DIFFUSE < string UIWidget = "color"; > = { 0.9, 0.6, 0.3, 1 };
float Shininess : SPECULARPOWER < string UIWidget = "slider"; > = 24;
struct A { float4 p : POSITION; float3 n : NORMAL; };
struct B { float4 h : POSITION; float3 n : TEXCOORD0; float3 l : TEXCOORD1; float3 v : TEXCOORD2; };
B vsToon(A a) { B b; b.h = mul(a.p, WorldViewProj); b.n = mul(float4(a.n, 0), WorldIT).xyz; b.l = LightPos - a.p.xyz; b.v = ViewInv[3].xyz - a.p.xyz; return b; }
float4 psToon(B b) : COLOR { float3 n = normalize(b.n), l = normalize(b.l), h = normalize(l + normalize(b.v)); float4 t = lit(dot(n, l), dot(n, h), Shininess); float3 none = normalize(n - n); float edge = pow(dot(n, h) - 0.2, 2); return float4(floor(t.y * 4) / 4 * SurfColor.rgb + t.z + none + edge * 0.05 + 0.1, 1); }
float4 vsLine(A a) : POSITION { return mul(float4(a.p.xyz + a.n * 0.03, 1), WorldViewProj); }
float4 psLine() : COLOR { return float4(0.1, 0.1, 0.1, 1); }
technique Toon { pass Line { CullMode = CW; VertexShader = compile vs_1_1 vsLine(); PixelShader = compile ps_1_1 psLine(); } pass Fill { CullMode = CCW; VertexShader = compile vs_2_0 vsToon(); PixelShader = compile ps_2_0 psToon(); } }
