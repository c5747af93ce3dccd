// In the manner of an engine of many small includes, with #line, guards, # with spaces and continued macros
#	include "inc\Engine\shaders\structs.fxh"
 # include "inc/Engine/Shaders/Lighting.hlsl"
#pragma warning( disable : 3571 )
#pragma pack_matrix( row_major )
uniform float4x4 modelview : WORLDVIEWPROJECTION;
uniform float3 eyePos : CAMERAPOSITION;
ENGINE_UNIFORM_SAMPLER2D(diffuseMap, 0);
ENGINE_UNIFORM_SAMPLER2D(bumpMap, 1);
#define ADD_ONE(acc, \
                value)   \
    acc \
    += value
ConnectData mainV( VertexIn IN )
{
   ConnectData OUT;
   OUT.hpos = mul(modelview, float4(IN.pos, 1));
   OUT.outTexCoord = IN.uv0;
   OUT.worldToTangent[0] = IN.T;
   OUT.worldToTangent[1] = IN.B;
   OUT.worldToTangent[2] = IN.normal;
   OUT.toEye = eyePos - IN.pos;
   return OUT;
}
float3 tangentToWorld(float3 n, float3x3 m) { return mul(n, m); }
float4 mainP( ConnectData IN ) : TARGET0
{
   float4 OUT = ENGINE_TEX2D(diffuseMap, IN.outTexCoord);
   float3 bump = expandNormal(tex2D(bumpMap, IN.outTexCoord).xyz);
   float3 n = normalize(tangentToWorld(bump, IN.worldToTangent));
   n = mul(quatToMat(float4(0, 0, 0, 1)), n);
   float3 l = normalize(float3(1, 1, 1)), colour = toneLight(ambient);
   ADD_ONE(colour, saturate(dot(n, l)));
   OUT.rgb *= colour / square(1.0) + square(float2(0, 0)).xyx * M_PI_F;
   return OUT;
}
technique Terrain { pass P0 { VertexShader = compile vs_3_0 mainV(); PixelShader = compile ps_3_0 mainP(); } }
