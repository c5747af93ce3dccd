struct VertexIn
{
   float3 pos     : POSITION;
   float3 normal  : NORMAL;
   float2 uv0     : TEXCOORD0;
   float2 uv1     : TEXCOORD1;
   float3 T       : TANGENT;
   float3 B       : BINORMAL;
};
