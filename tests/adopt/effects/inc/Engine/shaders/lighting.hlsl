#ifndef ENGINE_SHADERGEN
#line 1 "lighting.hlsl"
uniform float4 inLightPos[3];
uniform float4 inLightInvRadiusSq;
uniform float4 inLightColor[4];
uniform float4 ambient = float4(0.2, 0.2, 0.25, 1);
#endif
#include "engine.hlsl"
float3 toneLight(in float4 c) { return c.rgb * c.a; }
