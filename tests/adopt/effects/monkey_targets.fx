// In the manner of an export from RenderMonkey with renderable textures: targets by annotations, clear commands in the pass
string Post_Scene_Model : ModelData = "teapot.3ds";
float4x4 matViewProjection : ViewProjection;
float4x4 view_proj_matrix;
float fInverseViewportWidth : ViewportWidthInverse;
float fInverseViewportHeight : ViewportHeightInverse;
texture renderTexture_Tex : RenderColorTarget
<
   float2 ViewportRatio={1.0,1.0};
   string Format="D3DFMT_A8R8G8B8";
   float  ClearDepth=1.000000;
   int    ClearColor=-14671744;
>;
texture big_Tex : RenderColorTarget < float2 RenderTargetDimensions = {256,256}; string Format = "D3DFMT_A16B16G16R16F"; float ClearDepth = 1.0; int ClearColor = 0xff202080; >;
sampler Scene = sampler_state { Texture = (renderTexture_Tex); ADDRESSU = CLAMP; ADDRESSV = CLAMP; MAGFILTER = LINEAR; MINFILTER = LINEAR; MIPFILTER = NONE; };
sampler Big = sampler_state { Texture = (big_Tex); ADDRESSU = WRAP; ADDRESSV = WRAP; MAGFILTER = POINT; MINFILTER = POINT; };
struct S_OUT { float4 Pos : POSITION; float3 N : TEXCOORD0; };
S_OUT Scene_VS( float4 Pos : POSITION, float3 N : NORMAL ) { S_OUT o; o.Pos = mul( Pos, matViewProjection ); o.N = N; return o; }
float4 Scene_PS( float3 N : TEXCOORD0 ) : COLOR0 { return float4( normalize( N ) * 0.5 + 0.5, 1 ); }
struct Q_OUT { float4 Pos : POSITION; float2 uv : TEXCOORD0; };
Q_OUT Quad_VS( float4 Pos : POSITION ) { Q_OUT o; Pos.xy = sign( Pos.xy ); o.Pos = float4( Pos.xy, 0, 1 ); o.uv = (float2( Pos.x, -Pos.y ) + 1.0) / 2; return o; }
float4 Blur_PS( float2 uv : TEXCOORD0 ) : COLOR0
{
   const float2 samples[] = { -0.326, -0.405, -0.840, -0.073, -0.695, 0.457, -0.203, 0.620, 0.962, -0.194, 0.473, -0.480 };
   float4 sum = tex2D( Scene, uv );
   for (int i = 0; i < 6; i++) sum += tex2D( Scene, uv + samples[i] * 12 * float2( fInverseViewportWidth, fInverseViewportHeight ) );
   return sum / 7;
}
float4 Edge_PS( float2 uv : TEXCOORD0 ) : COLOR0 { return abs( tex2D( Scene, uv ) - tex2D( Big, uv ) ) * 4 + tex2D( Scene, uv ) * 0.4; }
technique Post
{
   pass Scene
   <
      string Script = "RenderColorTarget0 = renderTexture_Tex;"
                      "ClearColor = (32, 32, 128, 255);"
                      "ClearDepth = 1.000000;";
   >
   {
      VertexShader = compile vs_2_0 Scene_VS();
      PixelShader = compile ps_2_0 Scene_PS();
   }
   pass Blur < string Script = "RenderColorTarget0 = big_Tex;" "ClearColor = (0, 0, 0, 0);" "Draw = Buffer;"; >
   {
      ZENABLE = FALSE; CULLMODE = NONE;
      VertexShader = compile vs_2_0 Quad_VS();
      PixelShader = compile ps_2_0 Blur_PS();
   }
   pass Show < string Script = "RenderColorTarget0 = ;" "Draw = Buffer;"; >
   {
      ZENABLE = FALSE; CULLMODE = NONE;
      VertexShader = compile vs_2_0 Quad_VS();
      PixelShader = compile ps_2_0 Edge_PS();
   }
}
