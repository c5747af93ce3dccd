#include "prelude"
cbuffer Frame : register(b0) { float4 gTint = float4(1, 2.0 / 3, -3, 4); int gTaps[4] = { 1, 2, { 3 }, 4 }; };
Texture2D<float4> gSkinMap;
SamplerState gSkin { Filter = MIN_MAG_MIP_LINEAR; AddressU = CLAMP; };
DepthStencilState gDepth { DepthEnable = TRUE; DepthWriteMask = ZERO; DepthFunc = EQUAL; };
BlendState gBlend { BlendEnable[0] = TRUE; SrcBlend = SRC_ALPHA; RenderTargetWriteMask[0] = 7; };
VertexShader gShader = CompileShader(vs_5_0, F());
fxgroup Group
{
    technique11 Main
    {
        pass Only
        {
            SetVertexShader(gShader); SetPixelShader(NULL);
            SetDepthStencilState(gDepth, 1); SetBlendState(gBlend, float4(0, 0, 0, 0), 0xffffffff); SetRasterizerState(NULL);
        }
    }
}
//---
#define JOIN(a, b) a##b
#define TEXT(a) #a
#if defined(FX_D3D11) && !(1 > 2) || 0x10 == 16
float4 F(float JOIN(u, v) : TEXCOORD0) : SV_Position { return uv; }
#else
#error not this one
#endif
