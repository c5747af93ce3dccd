//**************************************************************//
//  In the manner of an export from RenderMonkey 1.6: groups and passes become names, states in capitals
//**************************************************************//
//--------------------------------------------------------------//
// Fire Effect Group
//--------------------------------------------------------------//
//--------------------------------------------------------------//
// Fire
//--------------------------------------------------------------//
//--------------------------------------------------------------//
// Background
//--------------------------------------------------------------//
string Fire_Effect_Group_Fire_Background_Screen_AlignedQuad : ModelData = "..\\..\\Media\\Models\\ScreenAlignedQuad.3ds";

float4 top
<
   string UIName = "top";
   string UIWidget = "Color";
   bool UIVisible =  true;
> = float4( 0.10, 0.20, 0.60, 1.00 );
float4 bottom
<
   string UIName = "bottom";
   string UIWidget = "Color";
   bool UIVisible =  true;
> = float4( 0.40, 0.20, 0.05, 1.00 );
float time_0_X : Time0_X
<
   string UIName = "time_0_X";
   bool UIVisible =  false;
>;
struct Fire_Effect_Group_Fire_Background_Vertex_Shader_VS_OUTPUT { float4 pos : POSITION0; float2 texCoord : TEXCOORD0; };
Fire_Effect_Group_Fire_Background_Vertex_Shader_VS_OUTPUT Fire_Effect_Group_Fire_Background_Vertex_Shader_main( float4 inPos: POSITION )
{
   Fire_Effect_Group_Fire_Background_Vertex_Shader_VS_OUTPUT o = (Fire_Effect_Group_Fire_Background_Vertex_Shader_VS_OUTPUT) 0;
   inPos.xy = sign( inPos.xy);
   o.pos = float4( inPos.xy, 0.0f, 1.0f);
   o.texCoord.x = 0.5 * (1 + inPos.x - 1/128);
   o.texCoord.y = 0.5 * (1 - inPos.y - 1/128);
   return o;
}
float4 Fire_Effect_Group_Fire_Background_Pixel_Shader_main( float2 texCoord : TEXCOORD0 ) : COLOR { return lerp( top, bottom, texCoord.y ); }
//--------------------------------------------------------------//
// Ball
//--------------------------------------------------------------//
string Fire_Effect_Group_Fire_Ball_Sphere : ModelData = "..\\..\\Media\\Models\\Sphere.3ds";
float4x4 matViewProjection : ViewProjection;
float4x4 matView : View;
float4 view_position : ViewPosition;
float noiseScale
<
   string UIName = "noiseScale";
   string UIWidget = "Numeric";
   bool UIVisible =  true;
   float UIMin = -1.00;
   float UIMax = 6.00;
> = float( 3.00 );
struct VS_OUTPUT { float4 Pos: POSITION; float2 uv : TEXCOORD0; float3 pos: TEXCOORD1; float3 normal : TEXCOORD2; };
VS_OUTPUT Fire_Effect_Group_Fire_Ball_Vertex_Shader_main( float4 Pos: POSITION, float3 normal: NORMAL, float2 uv: TEXCOORD0 )
{
   VS_OUTPUT Out;
   Out.Pos = mul( matViewProjection, Pos );
   Out.uv = uv; Out.pos = Pos.xyz; Out.normal = mul( matView, normal );
   return Out;
}
texture Flame_Tex
<
   string ResourceName = "..\\..\\..\\Program Files\\ATI\\Media\\Textures\\Flame.tga";
>;
sampler Flame = sampler_state
{
   Texture = (Flame_Tex);
   ADDRESSU = CLAMP;
   ADDRESSV = CLAMP;
   MAGFILTER = LINEAR;
   MINFILTER = LINEAR;
   MIPFILTER = NONE;
};
texture Noise_Tex < string ResourceName = "..\\..\\Media\\Textures\\NoiseVolume.dds"; >;
sampler Noise = sampler_state { Texture = (Noise_Tex); MAGFILTER = LINEAR; MINFILTER = LINEAR; MIPFILTER = LINEAR; };
float4 Fire_Effect_Group_Fire_Ball_Pixel_Shader_main( float2 uv : TEXCOORD0, float3 pos: TEXCOORD1, float3 normal : TEXCOORD2 ) : COLOR
{
   float n = tex3D( Noise, pos * noiseScale / 4 + float3( 0, 0, time_0_X * 0.3 ) ).x;
   float4 f = tex2D( Flame, float2( 0.5, saturate( n ) ) );
   return float4( f.rgb * float3( 1, 0.6, 0.2 ) * ( 0.4 + saturate( abs( normalize( normal ).z ) ) ), 1 );
}
//--------------------------------------------------------------//
// Technique Section for Fire Effect Group
//--------------------------------------------------------------//
technique Fire
{
   pass Background
   {
      CULLMODE = NONE;
      ZENABLE = FALSE;
      ZWRITEENABLE = FALSE;
      VertexShader = compile vs_1_1 Fire_Effect_Group_Fire_Background_Vertex_Shader_main();
      PixelShader = compile ps_2_0 Fire_Effect_Group_Fire_Background_Pixel_Shader_main();
   }
   pass Ball
   {
      CULLMODE = CCW;
      ZENABLE = TRUE;
      ZWRITEENABLE = TRUE;
      ALPHABLENDENABLE = TRUE;
      SRCBLEND = ONE;
      DESTBLEND = INVSRCCOLOR;
      VertexShader = compile vs_1_1 Fire_Effect_Group_Fire_Ball_Vertex_Shader_main();
      PixelShader = compile ps_2_0 Fire_Effect_Group_Fire_Ball_Pixel_Shader_main();
   }
}
