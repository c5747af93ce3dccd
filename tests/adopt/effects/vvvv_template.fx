//@author: nobody
//@help: in the manner of a visual language's template: tW, tVP, colour semantics, texture transforms
//@tags: template
// --------------------------------------------------------------------------------------------------
// PARAMETERS:
// --------------------------------------------------------------------------------------------------
//transforms
float4x4 tW: WORLD;        //the models world matrix
float4x4 tV: VIEW;         //view matrix as set via Renderer (EX9)
float4x4 tP: PROJECTION;
float4x4 tWVP: WORLDVIEWPROJECTION;
//light properties
float3 lDir <string uiname="Light Direction";> = {0, -5, 2};
float4 lAmb  : COLOR <String uiname="Ambient Color";>  = {0.15, 0.15, 0.15, 1};
float4 lDiff : COLOR <String uiname="Diffuse Color";>  = {0.85, 0.45, 0.35, 1};
float4 lSpec : COLOR <String uiname="Specular Color";> = {0.35, 0.35, 0.35, 1};
float lPower <String uiname="Power"; float uimin=0.0;> = 25.0;
//texture
texture Tex <string uiname="Texture";>;
sampler Samp = sampler_state    //sampler for doing the texture-lookup
{
    Texture   = (Tex);          //apply a texture to the sampler
    MipFilter = LINEAR;         //sampler states
    MinFilter = LINEAR;
    MagFilter = LINEAR;
};
float4x4 tTex: TEXTUREMATRIX <string uiname="Texture Transform";>;
float4x4 tColor <string uiname="Color Transform";>;
//the data structure: "vertexshader to pixelshader"
struct vs2ps
{
    float4 PosWVP: POSITION;
    float4 TexCd : TEXCOORD0;
    float3 LightDirV: TEXCOORD1;
    float3 NormV: TEXCOORD2;
    float3 ViewDirV: TEXCOORD3;
};
vs2ps VS(
    float4 PosO: POSITION,
    float3 NormO: NORMAL,
    float4 TexCd : TEXCOORD0)
{
    vs2ps Out = (vs2ps)0;
    Out.LightDirV = normalize(-mul(lDir, tV));
    Out.NormV = normalize(mul(mul(NormO, (float3x3)tW),(float3x3)tV).xyz);
    float4 PosV = mul(mul(PosO, tW), tV);
    Out.PosWVP  = mul(PosO, tWVP);
    Out.TexCd = mul(TexCd, tTex);
    Out.ViewDirV = -normalize(PosV);
    return Out;
}
float Alpha = 1;
float4 PS(vs2ps In): COLOR
{
    lAmb.a = 1;
    float3 n = normalize(In.NormV);
    float3 amb = lAmb.rgb;
    float3 diff = saturate(dot(n, In.LightDirV)) * lDiff.rgb;
    float3 R = normalize(2 * dot(n, In.LightDirV) * n - In.LightDirV);
    float3 spec = pow(max(dot(R, normalize(In.ViewDirV)),0), lPower*.2) * lSpec.rgb;
    float4 col = tex2D(Samp, In.TexCd.xy);
    col.rgb *= (amb + diff) + spec;
    col = mul(col, tColor);
    col.a *= Alpha;
    return col;
}
technique TPhongDirectional
{
    pass P0
    {
        //Wrap0 = U;  // useful when mesh is round like a sphere
        Wrap0 = U;
        VertexShader = compile vs_1_1 VS();
        PixelShader = compile ps_2_0 PS();
    }
}
technique TFixedFunction
{
    pass P0
    {
        //transforms
        WorldTransform[0]   = (tW);
        ViewTransform       = (tV);
        ProjectionTransform = (tP);
        //texturing
        Sampler[0] = (Samp);
        TextureTransform[0] = (tTex);
        TexCoordIndex[0] = 0;
        TextureTransformFlags[0] = COUNT2;
        //lighting
        NormalizeNormals = true;
        LightEnable[0]   = TRUE;
        Lighting         = TRUE;
        SpecularEnable   = TRUE;
        LightType[0]     = DIRECTIONAL;
        LightAmbient[0]  = {0.15, 0.15, 0.15, 1};
        LightDiffuse[0]  = (lDiff);
        LightDirection[0] = {0, -5, 2};
        MaterialAmbient  = {1, 1, 1, 1};
        MaterialDiffuse  = {1, 1, 1, 1};
        MaterialPower    = (lPower);
        //shading
        ShadeMode = GOURAUD;
        VertexShader = NULL;
        PixelShader  = NULL;
    }
}
