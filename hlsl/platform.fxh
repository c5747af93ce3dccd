// Where targets differ; no other file does.
#ifndef TEGUMENT_PLATFORM_FXH
#define TEGUMENT_PLATFORM_FXH

// 10000 major + 100 minor + patch.
#define TEGUMENT_VERSION 100

#ifndef TEGUMENT_LIBRARY
// Effects are written once: Direct3D 9 call spelling, Direct3D 10 type names and system values.
//   (nothing defined)   Direct3D 9 effect, fx_2_0, shader model 3
//   FX_D3D10, FX_D3D11  Direct3D 10 effect (fx_4_0), Direct3D 11 effect (fx_5_0)
//   FX_ENTRY            entry points only: DXC, glslang, fxc /T ps_5_0
//   TEGUMENT_LIBRARY    functions only, for shaders of any kind (tegument.fxh): no keyword is redefined. Shader model 3 by TEGUMENT_HLSL_3.
// Convention: sampler gX reads texture gXMap; a second sampler of that texture is declared with TG_SAMPLER2D_OF and passed with
// TG_SAMPLER2D_ARG_OF. Techniques stand inside #ifdef FX_TECHNIQUES. No variadic macro, no empty argument: glslang and fxc lack them.
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

// Textures with their samplers as arguments of functions, and look-ups: of shaders of any kind all but TG_TEX2D, which takes the level from
// the neighbours of a pixel. TG_TEX2DFINEST is for maps of one level: in shader model 3 a plain look-up, in half of the slots. A texture
// and a sampler of their own names are passed with TG_SAMPLER2D_ARG_OF.
#ifdef TEGUMENT_HLSL_3
#define TG_SAMPLER2D_PARAM(s) sampler2D s
#define TG_SAMPLER2D_ARG(s) s
#define TG_SAMPLER2D_ARG_OF(s, map) s
#define TG_TEX2D(s, uv) tex2D(s, uv)
#define TG_TEX2DLOD(s, uvzl) tex2Dlod(s, uvzl)
#define TG_TEX2DFINEST(s, uv) tex2D(s, uv)
#define TG_FEW_SLOTS true
#else
#define TG_SAMPLER2D_PARAM(s) Texture2D s##Map, SamplerState s
#define TG_SAMPLER2D_ARG(s) s##Map, s
#define TG_SAMPLER2D_ARG_OF(s, map) map, s
#define TG_TEX2D(s, uv) s##Map.Sample(s, uv)
#define TG_TEX2DLOD(s, uvzl) s##Map.SampleLevel(s, (uvzl).xy, (uvzl).w)
#define TG_TEX2DFINEST(s, uv) s##Map.SampleLevel(s, uv, 0.0)
#define TG_FEW_SLOTS false
#endif
// A shader has 512 instruction slots: what only saves time, or only smooths borders of shadows in maps, is left out.
static const bool kTgFewSlots = TG_FEW_SLOTS;

#ifndef TEGUMENT_LIBRARY
// Samplers, look-ups in Direct3D 9's spelling, and the half pixel by which it misses texel centres: viewport = size of the current target.
#ifndef TEGUMENT_HLSL_3
#ifdef FX_ENTRY
#define TG_SAMPLER2D(s, filter, address) SamplerState s
#else
#define TG_SAMPLER2D(s, filter, address) SamplerState s { Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; }
#endif
#define TG_SAMPLER2D_SRGB(s, filter, address) TG_SAMPLER2D(s, filter, address)
#define TG_SAMPLERCUBE(s, filter) TG_SAMPLER2D(s, filter, CLAMP)
#define TG_SAMPLER2D_OF(s, map, filter, address) TG_SAMPLER2D(s, filter, address)
#define tex2D(s, uv) TG_TEX2D(s, uv)
#define tex2Dlod(s, uvzl) TG_TEX2DLOD(s, uvzl)
#define texCUBE(s, direction) s##Map.Sample(s, direction)
#define texCUBElod(s, directionl) s##Map.SampleLevel(s, (directionl).xyz, (directionl).w)
#define tex2Dbias(s, uvzb) s##Map.SampleBias(s, (uvzb).xy, (uvzb).w)
#define texCUBEbias(s, directionb) s##Map.SampleBias(s, (directionb).xyz, (directionb).w)
#define tex2Dgrad(s, uv, across, down) s##Map.SampleGrad(s, uv, across, down)
#define texCUBEgrad(s, direction, across, down) s##Map.SampleGrad(s, direction, across, down)
#define TG_HALF_PIXEL(position, viewport) (position)
#else
#define TG_SAMPLER2D(s, filter, address) sampler2D s { \
    Texture = <s##Map>; Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; }
#define TG_SAMPLER2D_SRGB(s, filter, address) sampler2D s { \
    Texture = <s##Map>; Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; SRGBTexture = TRUE; }
#define TG_SAMPLER2D_OF(s, map, filter, address) sampler2D s { \
    Texture = <map>; Filter = MIN_MAG_MIP_##filter; AddressU = address; AddressV = address; }
#define TG_SAMPLERCUBE(s, filter) samplerCUBE s { \
    Texture = <s##Map>; Filter = MIN_MAG_MIP_##filter; AddressU = CLAMP; AddressV = CLAMP; AddressW = CLAMP; }
#define TG_HALF_PIXEL(position, viewport) ((position) + float4(float2(-1, 1) / (viewport) * (position).w, 0, 0))
#endif

// Layers drawn over one another: SM4 draws them as instances of one draw (pass annotation Instances), Direct3D 9 in a loop of the script
// whose index it writes into a parameter. TG_LAYER_INPUT declares a vertex shader's input, TG_LAYER_INDEX(looped) is the layer, counted
// from 0. TG_PIXEL_INPUT declares the input of a pixel shader that asks where on the target its pixel is, TG_PIXEL_CENTRE(name) is its
// centre, in pixels: Direct3D 9 has that in a register of its own. TG_LEAVES_EARLY: whether long pixel shaders ask early whether the pixel
// is theirs; a branch more takes slots that shader model 3 does not have.
#ifndef TEGUMENT_HLSL_3
#define TG_LAYER_INPUT(type, name) type name, uint tgInstance : SV_InstanceID
#define TG_LAYER_INDEX(looped) ((float)tgInstance)
#define TG_LAYER_SCRIPT(count, index, passName) "Pass=" passName ";"
#define TG_PIXEL_INPUT(type, name) type name
#define TG_PIXEL_CENTRE(name) ((name).position.xy)
#define TG_LEAVES_EARLY true
#else
#define TG_LAYER_INPUT(type, name) type name
#define TG_LAYER_INDEX(looped) (looped)
#define TG_LAYER_SCRIPT(count, index, passName) "LoopByCount=" count "; LoopGetIndex=" index "; Pass=" passName "; LoopEnd;"
#define TG_PIXEL_INPUT(type, name) type name, float2 tgPixel : VPOS
#define TG_PIXEL_CENTRE(name) (tgPixel + 0.5)
#define TG_LEAVES_EARLY false
#endif

// Compute shaders, where there are any (TEGUMENT_COMPUTE): Direct3D 11 and SPIR-V. TG_STORE2D(gXStore) is what they write of the target
// gXMap, by texel; TG_STORE_PICTURE(gXStore) of the picture. Techniques that use them stand inside #ifdef TEGUMENT_COMPUTE_TECHNIQUES, and
// there is one that draws the same.
#if defined(FX_D3D11) || defined(FX_ENTRY)
#define TEGUMENT_COMPUTE 1
#define TG_STORE2D(name) RWTexture2D<float4> name;
#define TG_STORE_PICTURE(name) RWTexture2D<float4> name < string Stores = ""; >;
#ifdef FX_TECHNIQUES
#define TEGUMENT_COMPUTE_TECHNIQUES 1
#endif
#else
#define TG_STORE2D(name)
#endif

// Full state sets, one per pass: Direct3D 9 keeps what the pass before has set. Front faces are counter-clockwise (docs/conventions.md).
//   TG_STATE_BUFFER    no depth test, both faces: full-screen quads, unwrapped meshes
//   TG_STATE_SOLID     depth test and write, back faces culled
//   TG_STATE_INSIDE    depth test and write, front faces culled
//   TG_STATE_TWOSIDED  depth test and write, both faces: maps seen from the light
//   TG_STATE_EQUAL     drawn where the depth target holds the depth of the fragment, both faces
//   TG_STATE_LAYER     depth test and write, back faces culled, blended over what is there by alpha
//   TG_STATE_STRAND    depth test and write, both faces, blended over what is there by alpha
//   TG_STATE_FRINGE    depth test, both faces, blended over what is there by alpha
//   TG_STATE_SUM       no depth test, both faces, added to what is there
//   TG_STATE_ADDED     depth test, back faces culled, added to what is there
//   TG_STATE_PREPASS   writes depth where it is greater, no colour, both faces
#ifdef FX_TECHNIQUES
#ifndef TEGUMENT_HLSL_3
#ifdef FX_D3D11
#define technique technique11
#define TG_VS_MODEL vs_5_0
#define TG_PS_MODEL ps_5_0
#else
#define technique technique10
#define TG_VS_MODEL vs_4_0
#define TG_PS_MODEL ps_4_0
#endif
DepthStencilState tgDepthOff { DepthEnable = FALSE; DepthWriteMask = ZERO; };
DepthStencilState tgDepthLess { DepthEnable = TRUE; DepthWriteMask = ALL; DepthFunc = LESS_EQUAL; };
DepthStencilState tgDepthEqual { DepthEnable = TRUE; DepthWriteMask = ZERO; DepthFunc = EQUAL; };
DepthStencilState tgDepthBehind { DepthEnable = TRUE; DepthWriteMask = ZERO; DepthFunc = LESS_EQUAL; };
DepthStencilState tgDepthGreater { DepthEnable = TRUE; DepthWriteMask = ALL; DepthFunc = GREATER; };
BlendState tgOpaque { BlendEnable[0] = FALSE; RenderTargetWriteMask[0] = 15; };
BlendState tgNoColour { BlendEnable[0] = FALSE; RenderTargetWriteMask[0] = 0; };
BlendState tgOver { BlendEnable[0] = TRUE; SrcBlend = SRC_ALPHA; DestBlend = INV_SRC_ALPHA; BlendOp = ADD; SrcBlendAlpha = ONE;
    DestBlendAlpha = INV_SRC_ALPHA; BlendOpAlpha = ADD; RenderTargetWriteMask[0] = 15; };
BlendState tgSum { BlendEnable[0] = TRUE; SrcBlend = ONE; DestBlend = ONE; BlendOp = ADD; SrcBlendAlpha = ONE;
    DestBlendAlpha = ONE; BlendOpAlpha = ADD; RenderTargetWriteMask[0] = 15; };
RasterizerState tgBothFaces { CullMode = NONE; FrontCounterClockwise = TRUE; };
RasterizerState tgFrontFaces { CullMode = BACK; FrontCounterClockwise = TRUE; };
RasterizerState tgBackFaces { CullMode = FRONT; FrontCounterClockwise = TRUE; };
#define TG_SET_STATES(depth, blend, faces) SetDepthStencilState(depth, 0); SetBlendState(blend, float4(0, 0, 0, 0), 0xffffffff); \
    SetRasterizerState(faces)
#define TG_STATE_BUFFER TG_SET_STATES(tgDepthOff, tgOpaque, tgBothFaces)
#define TG_STATE_SOLID TG_SET_STATES(tgDepthLess, tgOpaque, tgFrontFaces)
#define TG_STATE_INSIDE TG_SET_STATES(tgDepthLess, tgOpaque, tgBackFaces)
#define TG_STATE_TWOSIDED TG_SET_STATES(tgDepthLess, tgOpaque, tgBothFaces)
#define TG_STATE_LAYER TG_SET_STATES(tgDepthLess, tgOver, tgFrontFaces)
#define TG_STATE_STRAND TG_SET_STATES(tgDepthLess, tgOver, tgBothFaces)
#define TG_STATE_FRINGE TG_SET_STATES(tgDepthBehind, tgOver, tgBothFaces)
#define TG_STATE_SUM TG_SET_STATES(tgDepthOff, tgSum, tgBothFaces)
#define TG_STATE_ADDED TG_SET_STATES(tgDepthEqual, tgSum, tgFrontFaces)
#define TG_STATE_EQUAL TG_SET_STATES(tgDepthEqual, tgOpaque, tgBothFaces)
#define TG_STATE_PREPASS TG_SET_STATES(tgDepthGreater, tgNoColour, tgBothFaces)
#else
#define TG_VS_MODEL vs_3_0
#define TG_PS_MODEL ps_3_0
#define TG_SET_STATES(test, write, compare, colour, cull, blend) ZEnable = test; ZWriteEnable = write; ZFunc = compare; \
    ColorWriteEnable = colour; CullMode = cull; AlphaBlendEnable = blend; AlphaTestEnable = FALSE; StencilEnable = FALSE; \
    SRGBWriteEnable = FALSE
#define TG_STATE_BUFFER TG_SET_STATES(FALSE, FALSE, ALWAYS, 15, NONE, FALSE)
#define TG_STATE_SOLID TG_SET_STATES(TRUE, TRUE, LESSEQUAL, 15, CW, FALSE)
#define TG_STATE_INSIDE TG_SET_STATES(TRUE, TRUE, LESSEQUAL, 15, CCW, FALSE)
#define TG_STATE_TWOSIDED TG_SET_STATES(TRUE, TRUE, LESSEQUAL, 15, NONE, FALSE)
#define TG_BLEND_OVER SrcBlend = SRCALPHA; DestBlend = INVSRCALPHA; BlendOp = ADD; \
    SeparateAlphaBlendEnable = TRUE; SrcBlendAlpha = ONE; DestBlendAlpha = INVSRCALPHA; BlendOpAlpha = ADD
#define TG_STATE_LAYER TG_SET_STATES(TRUE, TRUE, LESSEQUAL, 15, CW, TRUE); TG_BLEND_OVER
#define TG_STATE_STRAND TG_SET_STATES(TRUE, TRUE, LESSEQUAL, 15, NONE, TRUE); TG_BLEND_OVER
#define TG_STATE_FRINGE TG_SET_STATES(TRUE, FALSE, LESSEQUAL, 15, NONE, TRUE); TG_BLEND_OVER
#define TG_STATE_SUM TG_SET_STATES(FALSE, FALSE, ALWAYS, 15, NONE, TRUE); SrcBlend = ONE; DestBlend = ONE; BlendOp = ADD; \
    SeparateAlphaBlendEnable = FALSE
#define TG_STATE_ADDED TG_SET_STATES(TRUE, FALSE, EQUAL, 15, CW, TRUE); SrcBlend = ONE; DestBlend = ONE; BlendOp = ADD; \
    SeparateAlphaBlendEnable = FALSE
#define TG_STATE_EQUAL TG_SET_STATES(TRUE, FALSE, EQUAL, 15, NONE, FALSE)
#define TG_STATE_PREPASS TG_SET_STATES(TRUE, TRUE, GREATER, 0, NONE, FALSE)
#endif

// One line per pass: its name, entry points, states.
#define TG_MESH_PASS(name, vs, ps, states) pass name < string Script = "Draw=Geometry;"; \
    > { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
// The same of one part of the mesh; a host that does not know parts draws all of it. TG_SEEN_...: of its ribbons only those that show.
// seen: annotations Reach and ReachScale (nothing is drawn further from them than so many times that parameter, in the mesh's radii), Share
// (of the strands that is drawn), ShareRadius and ShareThinnest (of a strand, in the mesh's radii; pixels below which fewer are drawn).
#define TG_SEEN_PASS(name, part, seen, vs, ps, states) pass name < string Script = "Draw=Geometry;"; string Part = part; seen > \
    { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
#define TG_PART_PASS(name, part, vs, ps, states) pass name < string Script = "Draw=Geometry;"; string Part = part; \
    > { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
#ifndef TEGUMENT_HLSL_3
#define TG_SEEN_LAYER_PASS(name, part, seen, count, vs, ps, states) pass name < string Script = "Draw=Geometry;"; string Part = part; \
    seen string Instances = count; > { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
#define TG_LAYER_PASS(name, count, vs, ps, states) pass name < string Script = "Draw=Geometry;"; string Instances = count; \
    > { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
#else
#define TG_LAYER_PASS(name, count, vs, ps, states) TG_MESH_PASS(name, vs, ps, states)
#define TG_SEEN_LAYER_PASS(name, part, seen, count, vs, ps, states) TG_SEEN_PASS(name, part, seen, vs, ps, states)
#endif
#ifdef TEGUMENT_COMPUTE
// A compute pass with a thread for each texel of the target, by its name; it writes them all.
#define TG_COMPUTE_PASS(name, cs, target) pass name < string Script = "Draw=Compute;"; string Threads = target; bool CoversTarget = true; \
    > { ComputeShader = compile cs_5_0 cs(); }
#endif
// A full-screen pass that leaves texels as they are where it discards.
#define TG_OVER_PASS(name, vs, ps, states) pass name < string Script = "Draw=Buffer;"; \
    > { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
#define TG_QUAD_PASS(name, vs, ps, states) pass name < string Script = "Draw=Buffer;"; bool CoversTarget = true; \
    > { VertexShader = compile TG_VS_MODEL vs(); PixelShader = compile TG_PS_MODEL ps(); states; }
#endif

#endif

#endif
// SPDX-License-Identifier: MIT
