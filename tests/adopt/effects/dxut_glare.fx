// In the manner of a sample of tone mapping: kernels in arrays that the program sets, luminance, two names for one sampler
static const int    MAX_SAMPLES            = 16;
static const float3 LUMINANCE_VECTOR  = float3(0.2125f, 0.7154f, 0.0721f);
static const float  BRIGHT_PASS_THRESHOLD  = 0.2f;
static const float  BRIGHT_PASS_OFFSET     = 10.0f;
static const float  BLUE_SHIFT_MATRIX_DUMMY = exp2( -2.0f );
float2 g_avSampleOffsets[MAX_SAMPLES];
float4 g_avSampleWeights[MAX_SAMPLES];
float  g_fMiddleGray = 0.36f;
float  g_fWhiteCutoff = sqrt( 0.64f );
float  g_fElapsedTime;
bool   g_bEnableBlueShift = true;
texture g_tScene < string ResourceName = "scene.dds"; >;
sampler s0 = sampler_state { Texture = (g_tScene); AddressU = Clamp; AddressV = Clamp; MinFilter = LINEAR; MagFilter = LINEAR; };
sampler s1 = sampler_state { Texture = (g_tScene); AddressU = MIRROR; AddressV = BORDER; BorderColor = 0xff4080c0; MinFilter = LINEAR; MagFilter = LINEAR; };
float4 Glare( in float2 uv : TEXCOORD0, uniform int nSamples ) : COLOR
{
    float4 vSample = 0.0f;
    float fTotal = 0;
    [unroll] for( int i=0; i < nSamples; i++ )
    {
        vSample += tex2D( s1, uv + g_avSampleOffsets[i] + (i - nSamples / 2) * 0.01 ) * (g_avSampleWeights[i] + 1.0 / nSamples);
        fTotal += 1;
    }
    float3 vColor = vSample.rgb;
    float fLuminance = dot( vColor, LUMINANCE_VECTOR );
    if( g_bEnableBlueShift )
        vColor = lerp( vColor, fLuminance.xxx * float3( 1.05f, 0.97f, 1.27f ), saturate( 1.0f - (fLuminance + 1.5) / 4.1 ) );
    vColor *= g_fMiddleGray / ( 0.001f + 0.3f );
    vColor *= ( 1.0f + ( vColor / ( g_fWhiteCutoff * g_fWhiteCutoff ) ) );
    vColor /= ( 1.0f + vColor );
    vColor -= BRIGHT_PASS_THRESHOLD * BLUE_SHIFT_MATRIX_DUMMY;
    return float4( max( vColor, 0 ) + tex2D( s0, uv ).rgb * 0.2, 1.0f );
}
technique BrightPass { pass P0 { ZEnable = FALSE; PixelShader  = compile ps_2_0 Glare( 4 ); } }
technique Star       { pass P0 { ZEnable = FALSE; PixelShader  = compile ps_2_0 Glare( 8 ); AlphaBlendEnable = (0.5 > 0.99); } }
