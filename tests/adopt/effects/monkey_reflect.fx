// As RenderMonkey exports: names with prefixes, a cube map, states in capitals.
float4x4 view_proj_matrix : ViewProjection;
float4 view_position;
float4x4 inv_world_matrix : WorldInverse;
float reflectance < string UIName = "reflectance"; string UIWidget = "Numeric"; bool UIVisible = true; float UIMin = 0.00; float UIMax = 1.00; > = float(0.60);
texture environment_Tex < string ResourceName = ".\\Snow.dds"; >;
samplerCUBE environment = sampler_state { Texture = (environment_Tex); ADDRESSU = CLAMP; ADDRESSV = CLAMP; ADDRESSW = CLAMP; MAGFILTER = LINEAR; MINFILTER = LINEAR; MIPFILTER = LINEAR; };
struct VS_OUTPUT { float4 Pos : POSITION; float3 normal : TEXCOORD0; float3 viewVec : TEXCOORD1; };
VS_OUTPUT Reflect_Pass_0_Vertex_Shader_vs_main(float4 Pos : POSITION, float3 normal : NORMAL)
{
    VS_OUTPUT Out;
    Out.Pos = mul(Pos, view_proj_matrix);
    Out.normal = normal;
    Out.viewVec = view_position - Pos;
    return Out;
}
float4 Reflect_Pass_0_Pixel_Shader_ps_main(float3 normal : TEXCOORD0, float3 viewVec : TEXCOORD1) : COLOR
{
    normal = normalize(normal);
    float3 reflVec = 2 * dot(normal, normalize(viewVec)) * normal - normalize(viewVec);
    return reflectance * texCUBE(environment, reflVec) + 0.1;
}
technique Reflect { pass Pass_0 { ZENABLE = TRUE; CULLMODE = CCW; VertexShader = compile vs_1_1 Reflect_Pass_0_Vertex_Shader_vs_main(); PixelShader = compile ps_2_0 Reflect_Pass_0_Pixel_Shader_ps_main(); } }
