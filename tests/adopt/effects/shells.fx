// One function for many passes, each with other arguments; a blended stack.
float4x4 WorldViewProjection : WORLDVIEWPROJECTION;
float4x4 gIT : WORLDINVERSETRANSPOSE;
float FurLength = 0.2;
struct vertout { float4 HPOS : POSITION; float2 T0 : TEXCOORD0; float3 normal : TEXCOORD1; float layer : TEXCOORD2; };
vertout shell(float3 p : POSITION, float3 n : NORMAL, float2 uv : TEXCOORD0, uniform float layer) { vertout o; o.HPOS = mul(float4(p + n * layer * FurLength, 1), WorldViewProjection); o.T0 = uv * float2(80, 40); o.normal = mul(n, (float3x3)gIT); o.layer = layer; return o; }
float4 fur(vertout i, uniform bool base) : COLOR { float2 d = frac(i.T0) - 0.5; float a = base ? 1 : step(length(d), 0.5 * (1 - i.layer)); float l = 0.5 + 0.5 * normalize(i.normal).y; return float4(float3(0.7, 0.5, 0.3) * (0.4 + i.layer) * l, a); }
technique Fur {
    pass Base { CullMode = CCW; AlphaBlendEnable = FALSE; VertexShader = compile vs_2_0 shell(0); PixelShader = compile ps_2_0 fur(true); }
    pass S1 { AlphaBlendEnable = TRUE; SrcBlend = SrcAlpha; DestBlend = InvSrcAlpha; VertexShader = compile vs_2_0 shell(0.25); PixelShader = compile ps_2_0 fur(false); }
    pass S2 { AlphaBlendEnable = TRUE; SrcBlend = SrcAlpha; DestBlend = InvSrcAlpha; VertexShader = compile vs_2_0 shell(0.5); PixelShader = compile ps_2_0 fur(false); }
    pass S3 { AlphaBlendEnable = TRUE; SrcBlend = SrcAlpha; DestBlend = InvSrcAlpha; VertexShader = compile vs_2_0 shell(0.75); PixelShader = compile ps_2_0 fur(false); }
}
