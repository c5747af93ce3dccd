// Arrays of shaders, chosen by an expression on a parameter.
int CurNumBones : BONECOUNT = 1;
float4x4 mViewProj : VIEWPROJECTION;
float4x3 mWorldMatrixArray[26] : WORLDMATRIXARRAY;
float4 MaterialDiffuse : MATERIALDIFFUSE = { 0.8f, 0.8f, 0.8f, 1.0f };
struct VS_INPUT { float4 Pos : POSITION; float4 BlendWeights : BLENDWEIGHT; float4 BlendIndices : BLENDINDICES; float3 Normal : NORMAL; };
struct VS_OUTPUT { float4 Pos : POSITION; float4 Diffuse : COLOR; };
VS_OUTPUT VShade(VS_INPUT i, uniform int NumBones)
{
    VS_OUTPUT o;
    float3 Pos = 0, Normal = 0;
    int IndexVector[4] = (int[4])D3DCOLORtoUBYTE4(i.BlendIndices);
    float BlendWeightsArray[4] = (float[4])i.BlendWeights;
    float LastWeight = 0;
    for (int iBone = 0; iBone < NumBones - 1; iBone++) {
        LastWeight = LastWeight + BlendWeightsArray[iBone];
        Pos += mul(i.Pos, mWorldMatrixArray[IndexVector[iBone]]) * BlendWeightsArray[iBone];
        Normal += mul(i.Normal, mWorldMatrixArray[IndexVector[iBone]]) * BlendWeightsArray[iBone];
    }
    LastWeight = 1.0f - LastWeight;
    Pos += mul(i.Pos, mWorldMatrixArray[IndexVector[NumBones - 1]]) * LastWeight;
    Normal += mul(i.Normal, mWorldMatrixArray[IndexVector[NumBones - 1]]) * LastWeight;
    o.Pos = mul(float4(Pos.xyz, 1.0f), mViewProj);
    o.Diffuse.xyz = saturate(normalize(Normal).y * 0.5 + 0.5) * MaterialDiffuse.xyz;
    o.Diffuse.w = 1.0f;
    return o;
}
VertexShader vsArray[4] = { compile vs_2_0 VShade(1), compile vs_2_0 VShade(2), compile vs_2_0 VShade(3), compile vs_2_0 VShade(4) };
technique t0 { pass p0 { VertexShader = (vsArray[CurNumBones]); } }
