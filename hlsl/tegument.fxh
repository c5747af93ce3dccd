// Tegument: real-time human skin and fur. Functions only: no parameter, no texture, no technique.
// `tegument flatten --library` makes one file of this folder, tegument.hlsl.
//
// MIT License
//
// Copyright (c) 2026 Tegument contributors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy
// of this software and associated documentation files (the "Software"), to deal
// in the Software without restriction, including without limitation the rights
// to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
// copies of the Software, and to permit persons to whom the Software is
// furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all
// copies or substantial portions of the Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
// IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
// FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
// AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
// LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
// OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
// SOFTWARE.
//
// HOW TO USE
//   #define TEGUMENT_MAP_SIZE 1024      // what differs from the defaults below
//   #include "tegument.hlsl"            // TEGUMENT_VERSION: 10000 major + 100 minor + patch
//   float4 main(...) : SV_Target { ... tgKelemenSpecular(normal, toLight, toEye, 0.3, 1.0) ... }
//
// WHAT TO DEFINE BEFORE (each has a default)
//   TEGUMENT_HLSL_3      for ps_3_0 and vs_3_0: functions take a sampler2D in place of a texture and its sampler
//   TEGUMENT_MAP_SIZE    texels along each side of the maps in texture space, a number: 1024
//   TEGUMENT_SHADOW_SIZE texels along each side of the maps that are seen from the light: as many
//   TEGUMENT_MAP_BITS    bits per channel of the maps of light: 16, or 32
//   TEGUMENT_NORMAL_XY   1: the normal map has two channels (BC5, RG8), and z follows from them: 0
//   TEGUMENT_SEAM_REPAIR 0: texels outside the charts count as valid, to measure what the repair is worth: 1
//
// WHAT TO GIVE
//   Lengths in mm, unless a comment says that any unit will do. Unit vectors from the surface outwards. Colours linear; the light's
//   colour is its irradiance / pi, so that a white matt surface facing it reflects exactly that. Matrices for row vectors, mul(v, M);
//   clip space of Direct3D.
//   A texture with its sampler: TG_SAMPLER2D_ARG_OF(sampler, texture), or TG_SAMPLER2D_ARG(gX) for texture gXMap with sampler gX. In
//   functions of your own declare such an argument as TG_SAMPLER2D_PARAM(name) and hand it on as TG_SAMPLER2D_ARG(name).
//   Samplers are CLAMP. POINT: shadow maps, depth, the maps of light 1 to 13 below. LINEAR: maps of light in the picture (14), levels
//   of the pyramid, tables (energy, ladder, pre-integrated), what tgSeparableConvolve and tgBurleyGather blur.
//
// SKIN, IN PASSES
//   1 light's view      tgShadowDepth, with uv: a translucent shadow map (depth, u, v, 1), 32 bits, cleared to 0
//   2 once for a mesh   tgStretchEncode(ddx(mm), ddy(mm), size) drawn at tgUnwrapPosition(uv, 0): texels per mm
//     once              tgEnergyTexel(tgEnergyDirectionalAlbedo)
//   3 irradiance        drawn at tgUnwrapPosition(uv, 0), cleared to (0, 0, 0, 1): tgIrradianceEntering; alpha is
//                       tgTransmissionEncode(tgTransmissionThickness)
//   4 to 13 cascade     U and V of five convolutions, widths kTgSkinWidth: tgGaussianIncrement, tgGaussianSpacing, tgGaussianConvolve
//   14 picture          sum of kTgSkinProfile times the six maps, tgTransmissionShare of maps 4 to 6 at tgTsmEntry,
//                       tgIrradianceColour, tgKelemenSpecular
// OVER YOUR BUFFERS     light, depth and colour that your engine has drawn: alpha tgPostMask. Once,
//                       tgPostStored and tgPostTap into two tables; each frame light and depth times tgPostGrazing into two maps with
//                       levels, LINEAR, then tgPostGather of a tgPostDisc; projections of any kind, by one matrix (tgPostView)
// BY A PYRAMID, in the place of 4 to 13: tgPyramidReduce, tgPyramidRound, weighed by tgLadderWeight
// ANY SKIN              tgToneWeight(i, melanin, blood) and kTgToneVariance in the place of kTgSkinProfile; tgToneAlbedo, tgToneFlesh
// WITHOUT TEXTURE SPACE tgPreintegratedLight, tgBurleyGather, tgSeparableConvolve
// SHADOWS               tgShadowTest, tgShadowTapped: percentage-closer filtering (PCF), tolerance is the bias, mm; tgShadowSoft: with a
//                       blocker search (PCSS); tgSurroundingsNormal: with ambient occlusion
// STAGES                vertex, pixel, compute and ray tracing; tgPreintegratedCurvature and tgTransmissionScale in pixel shaders only, for
//                       they take derivatives
// FUR                   tgFurDistance, tgFurCoverage, tgFurDiffuse, tgFurSpecular
#include "../hlsl/platform.fxh"
#include "../hlsl/space.fxh"
#include "../hlsl/surface.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "../hlsl/cull.fxh"
#include "../hlsl/fur.fxh"
#include "../hlsl/peers.fxh"
// SPDX-License-Identifier: MIT
