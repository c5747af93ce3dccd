// VPOS, VFACE, depth of a pixel, two targets of which one is bound, screen space derivatives.
float4x4 gMvp : WorldViewProjection;
void mainVS(float4 p : POSITION, float2 t : TEXCOORD0, out float4 o : POSITION, out float2 uv : TEXCOORD0) { o = mul(p, gMvp); uv = t; }
struct Out { float4 c : COLOR0; float4 second : COLOR1; float d : DEPTH; };
Out mainPS(float2 uv : TEXCOORD0, float4 place : VPOS, float face : VFACE)
{
    Out o;
    float2 w = fwidth(uv) + abs(ddx(uv));
    float stripes = fmod(place.x, 8) < 4 ? 1 : 0.6;
    o.c = face > 0 ? float4(uv * stripes, 0.5, 1) : float4(1, 0, 1, 1);
    o.c.b += saturate(w.x);
    o.second = 0;
    o.d = saturate(0.5 + uv.x * 0.25);
    return o;
}
technique T { pass P { CullMode = CCW; VertexShader = compile vs_3_0 mainVS(); PixelShader = compile ps_3_0 mainPS(); } }
