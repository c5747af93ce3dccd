// Arcs of more than one: Direct3D 9 computes them by a root, and roots are of absolute values.
float4x4 gWvp : WORLDVIEWPROJECTION;

struct Seen { float4 place : POSITION; float3 at : TEXCOORD0; float3 bent : TEXCOORD1; };

Seen VS(float4 p : POSITION, float3 n : NORMAL)
{
    Seen seen;
    seen.place = mul(p, gWvp);
    seen.at = p.xyz;
    seen.bent = asin(n * 1.5) / acos(-1);
    return seen;
}

float4 PS(Seen seen) : COLOR { return float4(acos(seen.at.y * 2) / acos(-1), seen.bent.xy * 0.5 + 0.5, 1); }

technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
