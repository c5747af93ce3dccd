//--------------------------------------------------------------//
// Toon_Gooch: in the manner of a RenderMonkey export, two passes and a target between them
//--------------------------------------------------------------//
//--------------------------------------------------------------//
// Model
//--------------------------------------------------------------//
string Toon_Gooch_Model_Model : ModelData = "..\\..\\..\\Program Files\\Examples\\Media\\Models\\Teapot.3ds";

texture renderTexture_Tex : RenderColorTarget
<
   float2 ViewportRatio={1.0,1.0};
   string Format="D3DFMT_A8R8G8B8";
   float  ClearDepth=1.000000;
   int    ClearColor=-16777216;
>;
float4x4 matWorldViewProjection : WorldViewProjection;
float4x4 matViewProjectionInverse : ViewProjectionInverse;
float4   vLightPosition
<
   string UIName = "vLightPosition";
   string UIWidget = "Direction";
   bool UIVisible =  true;
   float4 UIMin = float4( -10.00, -10.00, -10.00, -10.00 );
   float4 UIMax = float4( 10.00, 10.00, 10.00, 10.00 );
   bool Normalize =  false;
> = float4( -2.60, 5.10, 4.30, 1.00 );
float4 vViewPosition : ViewPosition;
float4 cWarm < string UIName = "cWarm"; string UIWidget = "Color"; bool UIVisible =  true; > = float4( 0.87, 0.74, 0.29, 1.00 );
float4 cCool < string UIName = "cCool"; string UIWidget = "Color"; bool UIVisible =  true; > = float4( 0.12, 0.20, 0.78, 1.00 );
float fExponent < string UIName = "fExponent"; string UIWidget = "Numeric"; bool UIVisible =  true; float UIMin = 1.00; float UIMax = 128.00; > = float( 24.00 );

struct VS_INPUT
{
   float4 Position : POSITION0;
   float3 Normal   : NORMAL0;
};

struct VS_OUTPUT
{
   float4 Position : POSITION0;
   float3 Normal   : TEXCOORD0;
   float3 ToLight  : TEXCOORD1;
   float3 ToEye    : TEXCOORD2;
};

VS_OUTPUT Toon_Gooch_Model_Vertex_Shader_vs_main( VS_INPUT Input )
{
   VS_OUTPUT Output;
   Output.Position = mul( Input.Position, matWorldViewProjection );
   Output.Normal   = Input.Normal;
   Output.ToLight  = vLightPosition - Input.Position;
   Output.ToEye    = vViewPosition - Input.Position;
   return( Output );
}

float4 Toon_Gooch_Model_Pixel_Shader_ps_main( float3 Normal : TEXCOORD0, float3 ToLight : TEXCOORD1, float3 ToEye : TEXCOORD2 ) : COLOR0
{
   float3 n = normalize( Normal );
   float3 l = normalize( ToLight );
   float  t = dot( n, l ) * 0.5 + 0.5;
   float3 r = reflect( -l, n );
   float  s = pow( saturate( dot( r, normalize( ToEye ) ) ), fExponent );
   return float4( lerp( cCool, cWarm, t ).rgb + s, 1 );
}

//--------------------------------------------------------------//
// Outline
//--------------------------------------------------------------//
string Toon_Gooch_Outline_ScreenAlignedQuad : ModelData = "..\\Models\\ScreenAlignedQuad.3ds";
float fInverseViewportWidth : ViewportWidthInverse;
float fInverseViewportHeight : ViewportHeightInverse;

void Toon_Gooch_Outline_Vertex_Shader_vs_main( in float4 inPosition : POSITION, out float4 outPosition : POSITION, out float2 outTexcoord : TEXCOORD0 )
{
   inPosition.xy = sign( inPosition.xy );
   outPosition = float4( inPosition.xy, 0.0f, 1.0f );
   outTexcoord = (float2( outPosition.x, -outPosition.y ) + 1.0f) / 2.0f;
}
sampler RT = sampler_state
{
   Texture = (renderTexture_Tex);
   ADDRESSU = CLAMP;
   ADDRESSV = CLAMP;
   MAGFILTER = POINT;
   MINFILTER = POINT;
};
const float4 samples[4] = {
    0.0f, -1.0f, 0.0f, -1.0f,
    -1.0f, 0.0f, 0.0f, -1.0f,
    1.0f, 0.0f, 0.0f, 1.0f,
    0.0f, 1.0f, 0.0f, 1.0f
};
float4 Toon_Gooch_Outline_Pixel_Shader_ps_main( float2 texCoord : TEXCOORD0 ) : COLOR
{
   float4 sum = 0;
   for ( int i = 0; i < 4; i++ )
      sum += samples[i].w * tex2D( RT, texCoord + 2 * samples[i].xy * float2( fInverseViewportWidth, fInverseViewportHeight ) );
   float edge = 1 - saturate( length( sum.rgb ) );
   return tex2D( RT, texCoord ) * edge;
}

//--------------------------------------------------------------//
// Technique Section for Toon_Gooch
//--------------------------------------------------------------//
technique Toon_Gooch
{
   pass Model
   <
      string Script = "RenderColorTarget0 = renderTexture_Tex;"
                      "ClearColor = (0, 0, 0, 1);"
                      "ClearDepth = 1.000000;";
   >
   {
      CULLMODE = CCW;
      VertexShader = compile vs_2_0 Toon_Gooch_Model_Vertex_Shader_vs_main();
      PixelShader = compile ps_2_0 Toon_Gooch_Model_Pixel_Shader_ps_main();
   }

   pass Outline
   {
      ZENABLE = FALSE;
      CULLMODE = NONE;

      VertexShader = compile vs_1_1 Toon_Gooch_Outline_Vertex_Shader_vs_main();
      PixelShader = compile ps_2_0 Toon_Gooch_Outline_Pixel_Shader_ps_main();
   }
}
