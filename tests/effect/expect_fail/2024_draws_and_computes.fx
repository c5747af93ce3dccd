// expect: 2024_draws_and_computes.fx(7,31): error TG2024: pass P has a compute shader, and its script says Draw=Buffer; Draw=Compute for a compute shader, Draw=Geometry or Draw=Buffer for the others
[numthreads(1, 1, 1)]
void CS() {}

technique11 T
{
    pass P < string Script = "Draw=Buffer;"; > { ComputeShader = compile cs_5_0 CS(); }
}
