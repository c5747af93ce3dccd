// Functions of hlsl/ for engines that take no whole effect: make.py turns each pixel shader's GLSL ES into a function of four vectors.
#include "hlsl/platform.fxh"
#include "hlsl/workspace.fxh"
#include "hlsl/specular.fxh"
#include "hlsl/fur.fxh"

struct Arguments
{
    float4 a : TEXCOORD0;
    float4 b : TEXCOORD1;
    float4 c : TEXCOORD2;
    float4 d : TEXCOORD3;
};

struct FunctionVarying
{
    float4 position : SV_Position;
    Arguments arguments;
};

FunctionVarying FunctionVS(float3 position : POSITION)
{
    FunctionVarying output;
    output.position = float4(position, 1.0);
    output.arguments.a = output.arguments.b = output.arguments.c = output.arguments.d = position.xyzz;
    return output;
}

// a: normal, b: to the light, c: to the eye, d: roughness, intensity. What skin mirrors.
float4 skin_specular(Arguments v) : SV_Target0
{
    float mirrored = tgKelemenSpecular(v.a.xyz, v.b.xyz, v.c.xyz, v.d.x, v.d.y);
    return float4(mirrored, mirrored, mirrored, 1.0);
}

// a: alpha of the fur map, height of the layer 0..1, taper, softness; b: layers. What the layer covers.
float4 fur_coverage(Arguments v) : SV_Target0
{
    float coverage = tgFurCoverage(v.a.x, v.a.y, v.a.z, v.a.w);
    return float4(coverage, tgFurLayerCoverage(coverage, v.b.x), 0.0, 1.0);
}

// a: normal, height; b: where strands hang; c: to the light; d: to the eye, exponent. Along the strand: diffuse, mirrored.
float4 fur_light(Arguments v) : SV_Target0
{
    float3 strand = tgFurTangent(v.a.xyz, v.b.xyz, v.a.w);
    return float4(tgFurDiffuse(strand, v.c.xyz, v.b.w), tgFurSpecular(strand, v.c.xyz, v.d.xyz, v.d.w), 0.0, 1.0);
}

// a: height, cosine of normal and light, density, thickness of the coat; b: multiple. Light that reaches this height; light from all sides.
float4 fur_shadow(Arguments v) : SV_Target0
{
    return float4(tgFurTransmittance(v.a.x, v.a.y, v.a.z, v.a.w), tgFurFill(v.a.x, v.a.z, v.b.x), 0.0, 1.0);
}

float Script : STANDARDSGLOBAL < string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color";
    string Script = "Technique=Functions;"; > = 0.8;

#ifdef FX_TECHNIQUES
technique Functions
{
    TG_MESH_PASS(SkinSpecular, FunctionVS, skin_specular, TG_STATE_SOLID)
    TG_MESH_PASS(FurCoverage, FunctionVS, fur_coverage, TG_STATE_SOLID)
    TG_MESH_PASS(FurLight, FunctionVS, fur_light, TG_STATE_SOLID)
    TG_MESH_PASS(FurShadow, FunctionVS, fur_shadow, TG_STATE_SOLID)
}
#endif
