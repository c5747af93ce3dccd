// Where targets differ; no other file does.
#ifndef TEGUMENT_PLATFORM_FXH
#define TEGUMENT_PLATFORM_FXH

#ifndef TEGUMENT_LIBRARY
// Effects are written once: Direct3D 9 call spelling, Direct3D 10 type names and system values.
//   (nothing defined)   Direct3D 9 effect, fx_2_0, shader model 3
//   FX_D3D10, FX_D3D11  Direct3D 10 effect (fx_4_0), Direct3D 11 effect (fx_5_0)
//   FX_ENTRY            entry points only: DXC, glslang, fxc /T ps_5_0
//   TEGUMENT_LIBRARY    functions only, for shaders of any kind (tegument.fxh): no keyword is redefined. Shader model 3 by TEGUMENT_HLSL_3.
// Convention: sampler gX reads texture gXMap; a second sampler of that texture is declared with SAMPLER2D_OF and passed with SAMPLER2D_ARG_OF. Techniques
// stand inside #ifdef FX_TECHNIQUES. No variadic macro, no empty argument: glslang and fxc lack them.
#if defined(__hlsl_dx_compiler) && !defined(FX_ENTRY)
#define FX_ENTRY 1
#endif
#if !defined(FX_D3D10) && !defined(FX_D3D11) && !defined(FX_ENTRY)
#define TEGUMENT_HLSL_3 1
#endif
#ifndef FX_ENTRY
#define FX_TECHNIQUES 1
#endif
#endif

// Textures with their samplers as arguments of functions, and look-ups. A texture and a sampler of their own names are passed with SAMPLER2D_ARG_OF.
#ifdef TEGUMENT_HLSL_3
#define SAMPLER2D_PARAM(s) sampler2D s
#define SAMPLER2D_ARG(s) s
#define SAMPLER2D_ARG_OF(s, map) s
#define TG_TEX2D(s, uv) tex2D(s, uv)
#define TG_TEX2DLOD(s, uvzl) tex2Dlod(s, uvzl)
#else
#define SAMPLER2D_PARAM(s) Texture2D s##Map, SamplerState s
#define SAMPLER2D_ARG(s) s##Map, s
#define SAMPLER2D_ARG_OF(s, map) map, s
#define TG_TEX2D(s, uv) s##Map.Sample(s, uv)
#define TG_TEX2DLOD(s, uvzl) s##Map.SampleLevel(s, (uvzl).xy, (uvzl).w)
#endif

#ifndef TEGUMENT_LIBRARY
// Samplers, look-ups in Direct3D 9's spelling, and the half pixel by which it misses texel centres: viewport = size of the current target.
#ifndef TEGUMENT_HLSL_3
#ifdef FX_ENTRY
#define SAMPLER2D(s, filter, address) SamplerState s
#else
#define SAMPLER2D(s, filter, address) SamplerState s { Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; }
#endif
#define SAMPLER2D_SRGB(s, filter, address) SAMPLER2D(s, filter, address)
#define SAMPLERCUBE(s, filter) SAMPLER2D(s, filter, CLAMP)
#define SAMPLER2D_OF(s, map, filter, address) SAMPLER2D(s, filter, address)
#define tex2D(s, uv) TG_TEX2D(s, uv)
#define tex2Dlod(s, uvzl) TG_TEX2DLOD(s, uvzl)
#define texCUBE(s, direction) s##Map.Sample(s, direction)
#define tex2Dbias(s, uvzb) s##Map.SampleBias(s, (uvzb).xy, (uvzb).w)
#define texCUBEbias(s, directionb) s##Map.SampleBias(s, (directionb).xyz, (directionb).w)
#define tex2Dgrad(s, uv, across, down) s##Map.SampleGrad(s, uv, across, down)
#define texCUBEgrad(s, direction, across, down) s##Map.SampleGrad(s, direction, across, down)
#define HALF_PIXEL(position, viewport) (position)
#else
#define SAMPLER2D(s, filter, address) sampler2D s { Texture = <s##Map>; Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; }
#define SAMPLER2D_SRGB(s, filter, address) sampler2D s { Texture = <s##Map>; Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; SRGBTexture = TRUE; }
#define SAMPLER2D_OF(s, map, filter, address) sampler2D s { Texture = <map>; Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; }
#define SAMPLERCUBE(s, filter) samplerCUBE s { Texture = <s##Map>; Filter = MIN_MAG_MIP_##filter; AddressU = CLAMP; AddressV = CLAMP; AddressW = CLAMP; }
#define HALF_PIXEL(position, viewport) ((position) + float4(float2(-1, 1) / (viewport) * (position).w, 0, 0))
#endif

// Layers drawn over one another: SM4 draws them as instances of one draw (pass annotation Instances), Direct3D 9 in a loop of the script whose index
// it writes into a parameter. LAYER_INPUT declares a vertex shader's input, LAYER_INDEX(looped) is the layer, counted from 0.
// PIXEL_INPUT declares the input of a pixel shader that asks where on the target its pixel is, PIXEL_CENTRE(name) is its centre, in pixels: Direct3D 9 has
// that in a register of its own.
#ifndef TEGUMENT_HLSL_3
#define LAYER_INPUT(type, name) type name, uint fxInstance : SV_InstanceID
#define LAYER_INDEX(looped) ((float)fxInstance)
#define LAYER_SCRIPT(count, index, passName) "Pass=" passName ";"
#define PIXEL_INPUT(type, name) type name
#define PIXEL_CENTRE(name) ((name).position.xy)
#else
#define LAYER_INPUT(type, name) type name
#define LAYER_INDEX(looped) (looped)
#define LAYER_SCRIPT(count, index, passName) "LoopByCount=" count "; LoopGetIndex=" index "; Pass=" passName "; LoopEnd;"
#define PIXEL_INPUT(type, name) type name, float2 fxPixel : VPOS
#define PIXEL_CENTRE(name) (fxPixel + 0.5)
#endif

// Full state sets, one per pass: Direct3D 9 keeps what the pass before has set. Front faces are counter-clockwise (docs/conventions.md).
//   STATE_BUFFER    no depth test, both faces: full-screen quads, unwrapped meshes
//   STATE_SOLID     depth test and write, back faces culled
//   STATE_INSIDE    depth test and write, front faces culled
//   STATE_TWOSIDED  depth test and write, both faces: maps seen from the light
//   STATE_EQUAL     drawn where the depth target holds the depth of the fragment, both faces
//   STATE_LAYER     depth test and write, back faces culled, blended over what is there by alpha
//   STATE_PREPASS   writes depth where it is greater, no colour, both faces
#ifdef FX_TECHNIQUES
#ifndef TEGUMENT_HLSL_3
#ifdef FX_D3D11
#define technique technique11
#define VS_MODEL vs_5_0
#define PS_MODEL ps_5_0
#else
#define technique technique10
#define VS_MODEL vs_4_0
#define PS_MODEL ps_4_0
#endif
DepthStencilState fxDepthOff { DepthEnable = FALSE; DepthWriteMask = ZERO; };
DepthStencilState fxDepthLess { DepthEnable = TRUE; DepthWriteMask = ALL; DepthFunc = LESS_EQUAL; };
DepthStencilState fxDepthEqual { DepthEnable = TRUE; DepthWriteMask = ZERO; DepthFunc = EQUAL; };
DepthStencilState fxDepthGreater { DepthEnable = TRUE; DepthWriteMask = ALL; DepthFunc = GREATER; };
BlendState fxOpaque { BlendEnable[0] = FALSE; RenderTargetWriteMask[0] = 15; };
BlendState fxNoColour { BlendEnable[0] = FALSE; RenderTargetWriteMask[0] = 0; };
BlendState fxOver { BlendEnable[0] = TRUE; SrcBlend = SRC_ALPHA; DestBlend = INV_SRC_ALPHA; BlendOp = ADD; SrcBlendAlpha = ONE; DestBlendAlpha = INV_SRC_ALPHA; BlendOpAlpha = ADD; RenderTargetWriteMask[0] = 15; };
RasterizerState fxBothFaces { CullMode = NONE; FrontCounterClockwise = TRUE; };
RasterizerState fxFrontFaces { CullMode = BACK; FrontCounterClockwise = TRUE; };
RasterizerState fxBackFaces { CullMode = FRONT; FrontCounterClockwise = TRUE; };
#define FX_STATE(depth, blend, faces) SetDepthStencilState(depth, 0); SetBlendState(blend, float4(0, 0, 0, 0), 0xffffffff); SetRasterizerState(faces)
#define STATE_BUFFER FX_STATE(fxDepthOff, fxOpaque, fxBothFaces)
#define STATE_SOLID FX_STATE(fxDepthLess, fxOpaque, fxFrontFaces)
#define STATE_INSIDE FX_STATE(fxDepthLess, fxOpaque, fxBackFaces)
#define STATE_TWOSIDED FX_STATE(fxDepthLess, fxOpaque, fxBothFaces)
#define STATE_LAYER FX_STATE(fxDepthLess, fxOver, fxFrontFaces)
#define STATE_EQUAL FX_STATE(fxDepthEqual, fxOpaque, fxBothFaces)
#define STATE_PREPASS FX_STATE(fxDepthGreater, fxNoColour, fxBothFaces)
#else
#define VS_MODEL vs_3_0
#define PS_MODEL ps_3_0
#define FX_STATE(test, write, compare, colour, cull, blend) ZEnable = test; ZWriteEnable = write; ZFunc = compare; ColorWriteEnable = colour; CullMode = cull; AlphaBlendEnable = blend; AlphaTestEnable = FALSE; StencilEnable = FALSE; SRGBWriteEnable = FALSE
#define STATE_BUFFER FX_STATE(FALSE, FALSE, ALWAYS, 15, NONE, FALSE)
#define STATE_SOLID FX_STATE(TRUE, TRUE, LESSEQUAL, 15, CW, FALSE)
#define STATE_INSIDE FX_STATE(TRUE, TRUE, LESSEQUAL, 15, CCW, FALSE)
#define STATE_TWOSIDED FX_STATE(TRUE, TRUE, LESSEQUAL, 15, NONE, FALSE)
#define STATE_LAYER FX_STATE(TRUE, TRUE, LESSEQUAL, 15, CW, TRUE); SrcBlend = SRCALPHA; DestBlend = INVSRCALPHA; BlendOp = ADD; SeparateAlphaBlendEnable = TRUE; SrcBlendAlpha = ONE; DestBlendAlpha = INVSRCALPHA; BlendOpAlpha = ADD
#define STATE_EQUAL FX_STATE(TRUE, FALSE, EQUAL, 15, NONE, FALSE)
#define STATE_PREPASS FX_STATE(TRUE, TRUE, GREATER, 0, NONE, FALSE)
#endif

// One line per pass: its name, entry points, states.
#define MESH_PASS(name, vs, ps, states) pass name < string Script = "Draw=Geometry;"; > { VertexShader = compile VS_MODEL vs(); PixelShader = compile PS_MODEL ps(); states; }
#ifndef TEGUMENT_HLSL_3
#define LAYER_PASS(name, count, vs, ps, states) pass name < string Script = "Draw=Geometry;"; string Instances = count; > { VertexShader = compile VS_MODEL vs(); PixelShader = compile PS_MODEL ps(); states; }
#else
#define LAYER_PASS(name, count, vs, ps, states) MESH_PASS(name, vs, ps, states)
#endif
#define QUAD_PASS(name, vs, ps, states) pass name < string Script = "Draw=Buffer;"; > { VertexShader = compile VS_MODEL vs(); PixelShader = compile PS_MODEL ps(); states; }
#endif

#endif

#endif
