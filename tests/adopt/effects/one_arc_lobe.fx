// The angle between a normal and a lamp that is brighter than one, as Oren and Nayar's light has it.
float4x4 gWvp : WORLDVIEWPROJECTION;
float3 gLamp = { 0.9, 0.9, 0.9 };

void VS(inout float4 p : POSITION, float3 n : NORMAL, out float2 lit : TEXCOORD0)
{
    p = mul(p, gWvp);
    lit = float2(dot(n, gLamp), n.z);
}
float4 PS(float2 lit : TEXCOORD0) : COLOR
{
    float2 angle = acos(lit);
    float alpha = max(angle.x, angle.y), beta = min(angle.x, angle.y);
    return saturate(lit.x) * (0.6 + 0.3 * sin(alpha) * tan(min(beta, 1.2))) * float4(1, 0.8, 0.6, 1);
}

technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
