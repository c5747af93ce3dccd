// In the manner of effects for a BASIC of the 2000s: XFile, BIMG, matrices as `matrix`, scalars and vectors by angle
string XFile = "sphere.x";   // model
int    BCLR = 0xff202080;    // background colour
string BIMG = "back.jpg";
float3 lightDir : Direction < string UIDirectional = "Light Direction"; > = {0.577f, -0.577f, 0.577f};
vector lightAmbient : Ambient < string UIWidget = "color"; > = {0.4f, 0.4f, 0.45f, 1.0f};
vector <float, 4> materialDiffuse : Diffuse = {1.0f, 0.9f, 0.7f, 1.0f};
matrix <float, 4, 4> World : World;
matrix View : View;
matrix Projection : Projection;
matrix WorldViewProj : WorldViewProjection;
texture Tex0 : DiffuseMap < string type = "2D"; string name = "tiger.bmp"; >;
sampler LinearSamp0 = sampler_state { texture = <Tex0>; AddressU = Wrap; AddressV = Wrap; MIPFILTER = LINEAR; MINFILTER = LINEAR; MAGFILTER = LINEAR; };
typedef vector <float, 3> float3_t;
struct VS_OUTPUT { vector Pos : POSITION; vector <float, 2> Tex : TEXCOORD0; float3_t Col : COLOR0; };
VS_OUTPUT VS(vector Pos : POSITION, float3_t Norm : NORMAL, float2 Tex : TEXCOORD0)
{
    VS_OUTPUT Out = (VS_OUTPUT) 0;
    float3_t L = -lightDir;
    float3_t N = normalize(mul(Norm, (matrix <float, 3, 3>) World));
    Out.Pos = mul(Pos, WorldViewProj);
    Out.Tex = Tex;
    Out.Col = lightAmbient + materialDiffuse * max(0, dot(N, L));
    return Out;
}
vector PS(float2 Tex : TEXCOORD0, float3_t Col : COLOR0) : COLOR { return tex2D(LinearSamp0, Tex) * vector(Col, 1); }
technique dx9textured
{
    pass P0
    {
        // transforms
        WorldTransform[0] = <World>; ViewTransform = <View>; ProjectionTransform = <Projection>;
        // render states
        CullMode = <1>;
        ZEnable = (1);
        LightEnable[0] = false; Lighting = TRUE; SpecularEnable = FALSE;
        Texture[0] = <Tex0>;
        MinFilter[0] = Linear; MagFilter[0] = Linear; MipFilter[0] = Linear;
        ColorOp[0] = Modulate; ColorArg1[0] = Texture; ColorArg2[0] = Diffuse; ColorOp[1] = Disable;
        VertexShader = compile vs_1_1 VS();
        PixelShader = compile ps_2_0 PS();
    }
}
