#ifndef _ENGINE_HLSL_
#define _ENGINE_HLSL_
#include "./shaderModel.hlsl"
static float M_HALFPI_F   = 1.57079632679489661923f;
static float M_PI_F       = 3.14159265358979323846f;
float getDistanceSqrd(float3 a, float3 b) { float3 d = a - b; return dot(d, d); }
float3 expandNormal(float3 n) { return n * 2.0 - 1.0; }
float square(float x) { return x * x; }
float2 square(float2 x) { return x * x; }
float3x3 quatToMat( float4 quat )
{
   float xs = quat.x * 2.0; float ys = quat.y * 2.0; float zs = quat.z * 2.0;
   float3x3 mat;
   mat[0][0] = 1.0 - (quat.y * ys + quat.z * zs); mat[0][1] = quat.x * ys - quat.w * zs; mat[0][2] = quat.x * zs + quat.w * ys;
   mat[1] = float3(quat.x * ys + quat.w * zs, 1.0 - (quat.x * xs + quat.z * zs), quat.y * zs - quat.w * xs);
   mat[2].xyz = float3(quat.x * zs - quat.w * ys, quat.y * zs + quat.w * xs, 1.0 - (quat.x * xs + quat.y * ys));
   return mat;
}
#endif
