/* a byte order mark, CRLF, tabs, everything where nobody expects it */
	#	define	EMPTY
#define JOIN( a , b ) a ## b
#define ARGS(x,	y) \
   (x , \
      y)
#ifdef NOTHING_AT_ALL
 this is not HLSL at all {
#elif defined NOTHING_EITHER || ( 1 > 2 && defined(JOIN) )
 nor is this (
#else
float4x4 JOIN ( world , ViewProj ) : WORLDVIEWPROJECTION < bool unused = true ; > ;
#endif
	float4	colour	=	{	.5f	,	1.	,	0x1	,	1e0f	}	;;
float3 a [ 2 ] = { float2 ARGS(1, 0) .xyx , { 0 , 1 , 0 } } , b = (float3) 0.25 , c EMPTY ;
Texture2D pic ; SamplerState smp { Filter = MIN_MAG_MIP_LINEAR ; } ;
struct { float k ; int l [ 3 ] ; } odd < string UIName = "odd" ; > = { 0.5 , 1 , 2 , 3 } ;
uniform extern const float power = 2 , more = 3 ; extern float less ; static const int2x2 table = { 1 , 2 , 3 , 4 } ;
float f ( float x ) ; float f ( float x ) { return x * odd . k ; } float f ( float2 x ) { return x . x ; }
void V ( float4 p : POSITION0 , float3 n : NORMAL0 , float2 t : TEXCOORD0 , out float4 q : POSITION , out float4 d : COLOR0 , out float2 u : TEXCOORD7 ) { q = mul ( p , worldViewProj ) , d = float4 ( n * .5 + .5 , 1 ) , u = t ; }
float4 P ( float4 d : COLOR0 , float2 u : TEXCOORD7 ) : COLOR0 { float s [ 4 ] = { 1 , 2 , 3 , 4 } ; [ unroll ] for ( int i = 0 ; i < 4 ; ++ i ) d . xyz += s [ i ] * .01 ; if ( u . x > .5 ) { } else d . rgb *= f ( power ) + f ( u ) * .1 ; do { d *= 1 ; } while ( false ) ; { ; ; } switch ( table [ 0 ] [ 0 ] ) { case 1 : d . g += a [ 1 ] . y * .1 ; break ; default : d = 0 ; break ; } return d * ( ( colour . a ) ) ; }
TECHNIQUE t1 < string s = "a" "b" /* two */ "c" ; > { PASS p < > { VERTEXSHADER = compile vs_3_0 V ( ) ; pixelshader = compile ps_3_0 P ( ) ; ZENABLE = true ; zwriteenable = TRUE ; cullmode = ccw ; } }
Technique { Pass { vertexShader = NULL ; } }
