// A stream of displaced vertices, kept by a shader object; beside it the plain technique. Multisampling and scissor in the state
matrix gWorld; matrix gView; matrix gProj; float gTime; float4 gDeep = float4(0, 0.2, 0.4, 1);
TextureCube gSky; SamplerState gSmooth { Filter = MIN_MAG_MIP_LINEAR; };
RasterizerState gStates[2] { { CullMode = NONE; FillMode = SOLID; ScissorEnable = FALSE; DepthClipEnable = TRUE; MultisampleEnable = TRUE; AntialiasedLineEnable = FALSE; }, { CullMode = BACK; FillMode = WIREFRAME; DepthBias = 1; SlopeScaledDepthBias = 0.5; } };
struct VO { float4 p : SV_Position; float3 n : NORMAL; float3 w : TEXCOORD0; };
VO VS(float3 p : POSITION, float3 n : NORMAL) { VO o; float4 w = mul(float4(p + n * 0.05 * sin(p.x * 12 + gTime), 1), gWorld); o.p = mul(mul(w, gView), gProj); o.n = mul(float4(n, 0), gWorld).xyz; o.w = w.xyz; return o; }
VertexShader gVS = CompileShader(vs_4_0, VS());
float3 gEyePos;
float4 PS(VO i) : SV_Target { float3 n = normalize(i.n), e = normalize(i.w - gEyePos); return lerp(gDeep, gSky.Sample(gSmooth, reflect(e, n)), 0.2 + 0.8 * pow(1 - saturate(dot(-e, n)), 2)); }
technique10 Keep { pass P { SetVertexShader(gVS); SetGeometryShader(ConstructGSWithSO(gVS, "SV_Position.xyzw; NORMAL.xyz")); SetPixelShader(NULL); } }
technique10 Show { pass P { SetVertexShader(gVS); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_4_0, PS())); SetRasterizerState(gStates[0]); } }
