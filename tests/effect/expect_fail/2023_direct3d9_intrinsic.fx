// expect: 2023_direct3d9_intrinsic.fx(3,1): warning TG2023: not checked: Direct3D 9 intrinsic 'sampler2D'; SPIR-V targets need the spelling of Direct3D 10 or hlsl/platform.fxh
Texture2D gSkinMap;
sampler2D gSkin { Texture = <gSkinMap>; };
float4 SkinPS(float2 uv : TEXCOORD0) : SV_Target0 { return tex2D(gSkin, uv); }
