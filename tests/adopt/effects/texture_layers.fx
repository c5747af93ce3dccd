// Direct3D 10.1 and 11: textures of layers and of samples, typed buffers, streams of other names.
float4x4 g_mWorldViewProj;
Texture2DArray Layers < string UIName = "layers"; >;
Texture2DArray<float3> Normals;
Texture2DMS<float4, 4> Resolved;
Texture2DArray Cascades;
Buffer<float4> Rows;
SamplerState Linear { Filter = MIN_MAG_MIP_LINEAR; };
SamplerComparisonState Less { Filter = COMPARISON_MIN_MAG_LINEAR_MIP_POINT; ComparisonFunc = LESS; };
struct In { float3 p : POS; float3 n : NORM; float2 t : TEX; };
struct Out { float4 p : SV_Position; float3 n : NORM; float2 t : TEX; };
Out VS(In i) {
    Out o;
    float4 row = Rows.Load(8);
    o.p = mul(float4(i.p * row.x, 1), g_mWorldViewProj);
    o.n = i.n;
    o.t = i.t;
    return o;
}
float4 PS(Out i) : SV_Target {
    float w, h, layers;
    Layers.GetDimensions(w, h, layers);
    float3 n = Normals.SampleLevel(Linear, float3(i.t, 1), 0);
    float lit = Cascades.SampleCmpLevelZero(Less, float3(i.t, 2), 0.5);
    return Layers.Sample(Linear, float3(i.t, layers - 1)) * (0.5 + 0.5 * lit) + Resolved.Load(int2(i.t * 4), 2) * 0.1 + float4(n, 0) * 0.1;
}
technique10 T { pass P { SetVertexShader(CompileShader(vs_4_1, VS())); SetGeometryShader(NULL); SetPixelShader(CompileShader(ps_4_1, PS())); } }
