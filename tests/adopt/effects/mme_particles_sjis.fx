////////////////////////////////////////////////////////////////////////////////////////////////
//  パーティクル 表  粒子の表現  (Shift-JIS, CRLF)
////////////////////////////////////////////////////////////////////////////////////////////////
// ユーザーパラメータ
#define TEX_PARTICLE_NUM  4     // ソ 粒子テクスチャの数
#define UNIT_COUNT 2            // 能 表 十 です
#define ADD_FLG     1
int RepertCount = UNIT_COUNT;
int RepertIndex;
float4x4 ViewProjMatrix : VIEWPROJECTION;
float4x4 ViewMatrixInverse : VIEWINVERSE;
float AcsTr : CONTROLOBJECT < string name = "(self)"; string item = "Tr"; >;
float AcsSi : CONTROLOBJECT < string name = "(self)"; string item = "Si"; >;
float4 MaterialDiffuse : DIFFUSE < string Object = "Geometry"; >;
static float3x3 BillboardMatrix = { normalize(ViewMatrixInverse[0].xyz), normalize(ViewMatrixInverse[1].xyz), normalize(ViewMatrixInverse[2].xyz) };
texture2D ParticleTex < string ResourceName = "粒子.png"; int MipLevels = 0; >;
sampler ParticleSamp = sampler_state { texture = <ParticleTex>; MinFilter = LINEAR; MagFilter = LINEAR; MipFilter = LINEAR; AddressU = CLAMP; AddressV = CLAMP; };
struct VS_OUTPUT { float4 Pos : POSITION; float2 Tex : TEXCOORD0; float4 Color : COLOR0; };
VS_OUTPUT Particle_VS(float4 Pos : POSITION, float2 Tex : TEXCOORD0, float index : TEXCOORD1)
{
   VS_OUTPUT Out = (VS_OUTPUT)0;   // 構造体
   int i = RepertIndex * 4 + fmod(index, 4);
   Pos.xyz = mul(Pos.xyz, BillboardMatrix) * (0.4 + 0.3 * i);
   Pos.w = 1;
   Out.Pos = mul(Pos, ViewProjMatrix);
   Out.Tex = Tex;
   Out.Color = MaterialDiffuse;
   Out.Color.a *= 0.5;
   return Out;
}
float4 Particle_PS(VS_OUTPUT IN) : COLOR0
{
   float4 Color = tex2D(ParticleSamp, IN.Tex) * IN.Color;
   #if ADD_FLG == 1
   Color.rgb *= Color.a;
   #endif
   return Color;
}
technique MainTec1 < string MMDPass = "object";
   string Script = "LoopByCount=RepertCount;"
                   "LoopGetIndex=RepertIndex;"
                      "Pass=DrawObject;"
                   "LoopEnd=;";
> {
   pass DrawObject {
      ZENABLE = TRUE; ZWRITEENABLE = FALSE;
      ALPHABLENDENABLE = TRUE;
      #if ADD_FLG == 1
      DestBlend = ONE; SrcBlend = ONE;
      #else
      DestBlend = INVSRCALPHA; SrcBlend = SRCALPHA;
      #endif
      CullMode = NONE;
      VertexShader = compile vs_3_0 Particle_VS();
      PixelShader  = compile ps_3_0 Particle_PS();
   }
}
technique EdgeTec < string MMDPass = "edge"; > { }
technique ZplotTec < string MMDPass = "zplot"; > { }
