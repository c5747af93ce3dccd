// Point sprites in the manner of the first shader books
float4x4 gWVP; float3 gEyePosL; texture gTex; float gTime; float3 gAccel = { 0.0f, -9.8f, 0.0f }; int gViewportHeight;
sampler TexS = sampler_state
{
	Texture = <gTex>;
	MinFilter = LINEAR;
	MagFilter = LINEAR;
	MipFilter = POINT;
	AddressU  = CLAMP;
    AddressV  = CLAMP;
};
struct OutputVS
{
    float4 posH  : POSITION0;
    float4 color : COLOR0;
    float2 tex0  : TEXCOORD0; // D3D fills in for point sprites.
    float  size  : PSIZE; // In pixels.
};
OutputVS FireRingVS(float3 posL    : POSITION0,
                    float3 vel     : TEXCOORD0,
                    float  size    : TEXCOORD1,
                    float  time    : TEXCOORD2,
                    float lifeTime : TEXCOORD3,
                    float mass     : TEXCOORD4,
                    float4 color   : COLOR0)
{
	// Zero out our output.
	OutputVS outVS = (OutputVS)0;
	// Get age of particle from creation time.
	float t = gTime - time;
	posL = posL + 0.05*vel*t + 0.005f * gAccel * t * t;
	float sin, cos;
	sincos(0.5f*mass*t, sin, cos);
	float3x3 rot = float3x3(cos, sin, 0.0f, -sin, cos, 0.0f, 0.0f, 0.0f, 1.0f);
	posL = mul(posL, rot);
	outVS.posH = mul(float4(posL, 1.0f), gWVP);
	outVS.color = float4(color.rgb * (1.0f - (t / max(lifeTime, 4))), 1);
	size += 8.0f*t*t;
	float d = distance(posL, gEyePosL);
	outVS.size = gViewportHeight*size/(1.0f + 8.0f*d);
	outVS.tex0 = posL.xy * 0.5 + 0.5;
    return outVS;
}
float4 FireRingPS(float4 color : COLOR0, float2 tex0 : TEXCOORD0) : COLOR
{
	return color*tex2D(TexS, tex0);
}
technique FireRingTech
{
    pass P0
    {
        vertexShader = compile vs_2_0 FireRingVS();
        pixelShader  = compile ps_2_0 FireRingPS();

		PointSpriteEnable = true;
		PointScaleEnable = false;
		PointSize = 4.0;
		PointSize_Min = 1.0f;
		AlphaBlendEnable = true;
	    SrcBlend     = One;
	    DestBlend    = One;

	    // Don't write to depth buffer; leave default depth test.
	    ZWriteEnable = false;
    }
}
