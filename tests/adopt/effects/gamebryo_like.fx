// In the manner of an engine with attributes in annotations: NTM, hidden = true, partitions of bones, asm for old devices
float4x4 WorldViewProj : WORLDVIEWPROJECTION;
float4x4 SkinWorld : SKINNED;
float4x3 SkinBone[20] : SKINBONEMATRIX3 < bool hidden = true; >;
float4 g_Ambient : ATTRIBUTE < float min = 0.0f; float max = 1.0f; > = { 0.25, 0.2, 0.2, 1 };
float3 Direction : GLOBAL = { 0.0f, 0.7f, 0.7f };
texture BaseMap < string NTM = "base"; bool hidden = true; int NTMIndex = 0; >;
texture GlowMap < string NTM = "shader", Usage = "glow"; int NTMIndex = 1; >;
sampler BaseSampler = sampler_state { Texture = (BaseMap); MIPFILTER = LINEAR; MINFILTER = LINEAR; MAGFILTER = LINEAR; ADDRESSU = WRAP; ADDRESSV = WRAP; };
sampler GlowSampler = sampler_state { Texture = (GlowMap); ADDRESSU = MIRROR; ADDRESSV = MIRRORONCE; };
struct VS_INPUT { float4 Pos : POSITION; float3 Nrm : NORMAL; float4 Weights : BLENDWEIGHT; int4 Bones : BLENDINDICES; float2 Tex : TEXCOORD0; };
struct VS_OUTPUT { float4 Pos : POSITION; float2 Tex : TEXCOORD0; half4 Light : TEXCOORD1; };
VS_OUTPUT VS_Skin(VS_INPUT In)
{
    VS_OUTPUT Out;
    float weight4 = 1.0f - In.Weights[0] - In.Weights[1] - In.Weights[2];
    float4x3 bone = SkinBone[In.Bones[0]] * In.Weights[0];
    bone += SkinBone[In.Bones[1]] * In.Weights[1];
    bone += SkinBone[In.Bones[2]] * In.Weights[2];
    bone += SkinBone[In.Bones[3]] * weight4;
    float4 p = float4(mul(In.Pos, bone), 1);
    Out.Pos = mul(p, WorldViewProj);
    Out.Tex = In.Tex;
    Out.Light = g_Ambient + saturate(dot(mul(In.Nrm, (float3x3)bone), normalize(Direction)));
    return Out;
}
half4 PS_Glow(VS_OUTPUT In) : COLOR { half4 base = tex2D(BaseSampler, In.Tex); return base * In.Light + tex2D(GlowSampler, In.Tex) * 0.1h; }
technique GlowOld < string description = "for devices of 2001"; bool UsesNiRenderState = true; bool implementation = 1; >
{
    pass P0
    {
        VertexShader = asm
        {
            vs_1_1
            dcl_position v0
            dcl_texcoord0 v1
            m4x4 oPos, v0, c0
            mov oT0, v1
        };
        PixelShader = asm { ps_1_1
            tex t0
            mov r0, t0 };
        VertexShaderConstant[0] = <WorldViewProj>;
        Texture[0] = <BaseMap>;
    }
}
technique GlowSkin < string shadername = "GlowSkin"; string VBHints = "NiHardwareSkinned"; int BonesPerPartition = 20; bool UsesNiLightState = false; >
{
    pass P0 { VertexShader = compile vs_2_0 VS_Skin(); PixelShader = compile ps_2_0 PS_Glow(); AlphaTestEnable = true; AlphaFunc = Greater; AlphaRef = 8; StencilEnable = false; }
}
