//-----------------------------------------------------------------------------
// In the manner of the stock effects of a framework of 2010: macros, registers, 6 shaders chosen by ShaderIndex
//-----------------------------------------------------------------------------

#include "inc\xna\Macros.fxh"

DECLARE_TEXTURE(Texture, 0);

BEGIN_CONSTANTS

    float4 DiffuseColor             _vs(c0)  _ps(c1)  _cb(c0);
    float3 EmissiveColor            _vs(c1)  _ps(c2)  _cb(c1);
    float3 SpecularColor            _vs(c2)  _ps(c3)  _cb(c2);
    float  SpecularPower            _vs(c3)  _ps(c4)  _cb(c2.w);

    float3 DirLight0Direction       _vs(c4)  _ps(c5)  _cb(c3);
    float3 DirLight0DiffuseColor    _vs(c5)  _ps(c6)  _cb(c4);
    float3 DirLight0SpecularColor   _vs(c6)  _ps(c7)  _cb(c5);

    float3 EyePosition              _vs(c13) _ps(c14) _cb(c12);

    float3 FogColor                          _ps(c0)  _cb(c13);
    float4 FogVector                _vs(c14)          _cb(c14);

    float4x4 World                  _vs(c19)          _cb(c15);
    float3x3 WorldInverseTranspose  _vs(c23)          _cb(c19);

MATRIX_CONSTANTS

    float4x4 WorldViewProj          _vs(c15)          _cb(c0);

END_CONSTANTS

#include "inc/xna/structures.fxh"

CommonOut ComputeLit(float4 position, float3 normal, uniform bool specular)
{
    CommonOut vout;
    float4 pos_ws = mul(position, World);
    float3 eye = normalize(EyePosition - pos_ws.xyz);
    float3 n = normalize(mul(normal, WorldInverseTranspose));
    float d = dot(-DirLight0Direction, n);
    float zeroL = step(0, d);
    float3 h = normalize(eye - DirLight0Direction);
    vout.Pos_ps = mul(position, WorldViewProj);
    vout.Diffuse = float4(zeroL * d * DirLight0DiffuseColor * DiffuseColor.rgb + EmissiveColor, DiffuseColor.a);
    vout.Specular = specular ? pow(max(dot(h, n), 0) * zeroL, SpecularPower) * DirLight0SpecularColor * SpecularColor : 0;
    vout.FogFactor = saturate(dot(position, FogVector));
    return vout;
}
VSOutputTx VSLit(VSInputNmTx vin)
{
    VSOutputTx vout;
    CommonOut cout = ComputeLit(vin.Position, vin.Normal, true);
    SetCommonVSOutputParams;
    vout.TexCoord = vin.TexCoord;
    return vout;
}
VSOutputTx VSPlain(VSInputNmTx vin)
{
    VSOutputTx vout;
    CommonOut cout = ComputeLit(vin.Position, vin.Normal, false);
    SetCommonVSOutputParams;
    vout.TexCoord = vin.TexCoord;
    return vout;
}
float4 PSTx(PSInputTx pin) : SV_Target0
{
    float4 color = SAMPLE_TEXTURE(Texture, pin.TexCoord) * pin.Diffuse;
    color.rgb += pin.Specular.rgb * color.a;
    color.rgb = lerp(color.rgb, FogColor * color.a, pin.Specular.w);
    return color;
}
float4 PSNoFog(PSInputTx pin) : SV_Target0
{
    float4 color = SAMPLE_TEXTURE(Texture, pin.TexCoord) * pin.Diffuse;
    color.rgb += pin.Specular.rgb * color.a;
    return color;
}

VertexShader VSArray[3] =
{
    compile vs_2_0 VSPlain(),
    compile vs_2_0 VSLit(),
    compile vs_2_0 VSLit(),
};
int VSIndices[4] = { 0, 0, 1, 2 };
PixelShader PSArray[2] =
{
    compile ps_2_0 PSTx(),
    compile ps_2_0 PSNoFog(),
};
int PSIndices[4] = { 0, 1, 0, 1 };
int ShaderIndex = 2;

Technique BasicEffect
{
    Pass
    {
        VertexShader = (VSArray[VSIndices[ShaderIndex]]);
        PixelShader  = (PSArray[PSIndices[ShaderIndex]]);
    }
}
