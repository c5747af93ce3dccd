// The switches, and the constants that no setting changes: those that differ stand in constants.fxh (corrected) and in printed/.
//   TEGUMENT_MAP_SIZE  texels along each side of the maps in texture space (default 1024)
//   TEGUMENT_SHADOW_SIZE  texels along each side of the maps that are seen from the light (default: as many)
//   TEGUMENT_MAP_BITS  bits per channel of the irradiance maps: 16 (default) or 32
//   TEGUMENT_SEAM_REPAIR  1 (default); 0 lets the gaps between the charts bleed into them, to measure what the repair is worth
//   TEGUMENT_NORMAL_XY  0 (default); 1: the normal map has two channels (BC5, RG8), and z follows from them
#ifndef TEGUMENT_SETTINGS_FXH
#define TEGUMENT_SETTINGS_FXH

#ifndef TEGUMENT_MAP_SIZE
#define TEGUMENT_MAP_SIZE 1024
#endif
#ifndef TEGUMENT_SHADOW_SIZE
#define TEGUMENT_SHADOW_SIZE TEGUMENT_MAP_SIZE
#endif
#ifndef TEGUMENT_MAP_BITS
#define TEGUMENT_MAP_BITS 16
#endif
#ifndef TEGUMENT_SEAM_REPAIR
#define TEGUMENT_SEAM_REPAIR 1
#endif
#ifndef TEGUMENT_NORMAL_XY
#define TEGUMENT_NORMAL_XY 0
#endif

#ifdef TEGUMENT_LIBRARY
#define TEGUMENT_PRINTED_BURLEY_FXH
#define TEGUMENT_PRINTED_DEON2007_FXH
#define TEGUMENT_PRINTED_ENERGY_FXH
#define TEGUMENT_PRINTED_FILTER_FXH
#define TEGUMENT_PRINTED_GAUSSIAN_FXH
#define TEGUMENT_PRINTED_OUTSIDE_FXH
#define TEGUMENT_PRINTED_POISSON_FXH
#define TEGUMENT_PRINTED_PREINTEGRATED_FXH
#define TEGUMENT_PRINTED_SEED_FXH
#define TEGUMENT_PRINTED_SEPARABLE_FXH
#define TEGUMENT_PRINTED_TRANSMISSION_FXH
#else
// docs/settings.md lists every constant with its source.
//   TEGUMENT_SETTING   0, 1, 2 (default), by name in FX_SETTINGS
//   TEGUMENT_PEERS_AS_PRINTED  1: kernels of effects/peers as their authors print them; 0: corrected; default 0 in setting
//                      corrected, else 1
//   TEGUMENT_CULL_FRUSTUM, TEGUMENT_CULL_BACK_FACES, TEGUMENT_CULL_BLACK  1 (default); 0 takes one cause out of the prepasses, to
//                      measure what it is worth
//   TEGUMENT_SHADOW_FROM_TSM  1 (default): the translucent shadow map serves as the shadow map; 0: a shadow map of its own, to measure
//                      what that saves
//   TEGUMENT_SURROUNDINGS  0 (default); 1 lights skin by surroundings too: gEnvironmentMap, gOcclusionMap
//   TEGUMENT_LAMPS  0 (default) to 7: so many lamps light skin beside the light of the workspace: gLampPlace and the others
//   TEGUMENT_LAMP_SHADOWS  how many of them throw shadows, from the first on, 0 to 3 (default: as many as may)
//   TEGUMENT_SOFT_SHADOWS  0 (default); 1: shadows of lamps have penumbras, by the lamps' radius
//   TEGUMENT_LOBES  0 (default); 1: skin mirrors by two lobes, as wide as the relief that its normal map loses with distance
//   TEGUMENT_SLAB  0 (default); 1: d'Eon and Luebke's technique lets as much light through thin parts as simulated skin does
//   TEGUMENT_RIBBON_ROWS    height of the maps in which fur by compute shaders is noted: 1,366 rows of strands each (2048, default)
//   TEGUMENT_FUR_COLOR_MAP  0 (default); 1 multiplies the colour of fur by gFurColorMap, for meshes with texture coordinates
//   TEGUMENT_FUR_VERTEX_LIGHT  0 (default); 1 finds the light of Fur's layers at vertices, for meshes whose triangles are small

// What tools call the values of the first switch, and what a picture's metadata say of the others (docs/effect-files.md).
#define FX_SETTINGS TEGUMENT_SETTING seed deon2007 corrected
#define FX_METADATA map_size TEGUMENT_MAP_SIZE

#ifndef TEGUMENT_SETTING
#define TEGUMENT_SETTING 2
#endif
#ifndef TEGUMENT_CULL_FRUSTUM
#define TEGUMENT_CULL_FRUSTUM 1
#endif
#ifndef TEGUMENT_CULL_BACK_FACES
#define TEGUMENT_CULL_BACK_FACES 1
#endif
#ifndef TEGUMENT_CULL_BLACK
#define TEGUMENT_CULL_BLACK 1
#endif
#ifndef TEGUMENT_SHADOW_FROM_TSM
#define TEGUMENT_SHADOW_FROM_TSM 1
#endif
#ifndef TEGUMENT_SURROUNDINGS
#define TEGUMENT_SURROUNDINGS 0
#endif
#ifndef TEGUMENT_LAMPS
#define TEGUMENT_LAMPS 0
#endif
#ifndef TEGUMENT_LAMP_SHADOWS
#if TEGUMENT_LAMPS > 3
#define TEGUMENT_LAMP_SHADOWS 3
#else
#define TEGUMENT_LAMP_SHADOWS TEGUMENT_LAMPS
#endif
#endif
#ifndef TEGUMENT_SOFT_SHADOWS
#define TEGUMENT_SOFT_SHADOWS 0
#endif
#if TEGUMENT_SURROUNDINGS || TEGUMENT_LAMPS
#define TEGUMENT_MORE_LIGHT 1
#else
#define TEGUMENT_MORE_LIGHT 0
#endif
#ifndef TEGUMENT_POST_HALF
#define TEGUMENT_POST_HALF 0
#endif
#ifndef TEGUMENT_SLAB
#define TEGUMENT_SLAB 0
#endif
#ifndef TEGUMENT_LOBES
#define TEGUMENT_LOBES 0
#endif
// An effect says TEGUMENT_LIGHTS_IN_ONE_PASS, before its includes, where shader model 3 has slots for so many of them only.
#if defined(TEGUMENT_HLSL_3) && defined(TEGUMENT_LIGHTS_IN_ONE_PASS)
#if TEGUMENT_LAMPS + TEGUMENT_SURROUNDINGS > TEGUMENT_LIGHTS_IN_ONE_PASS
#define TEGUMENT_LIGHT_BY_LIGHT 1
#endif
#endif
#ifndef TEGUMENT_LIGHT_BY_LIGHT
#define TEGUMENT_LIGHT_BY_LIGHT 0
#endif
#ifndef TEGUMENT_RIBBON_ROWS
#define TEGUMENT_RIBBON_ROWS 2048
#endif
#ifndef TEGUMENT_FUR_COLOR_MAP
#define TEGUMENT_FUR_COLOR_MAP 0
#endif
#ifndef TEGUMENT_FUR_POSE
#define TEGUMENT_FUR_POSE 0
#endif
#ifndef TEGUMENT_FUR_CURVES
#define TEGUMENT_FUR_CURVES 0
#endif
#ifndef TEGUMENT_MOTION
#define TEGUMENT_MOTION 0
#endif
#ifndef TEGUMENT_FUR_VERTEX_LIGHT
#define TEGUMENT_FUR_VERTEX_LIGHT 0
#endif
#ifndef TEGUMENT_PEERS_AS_PRINTED
#define TEGUMENT_PEERS_AS_PRINTED (TEGUMENT_SETTING != 2)
#endif
#if TEGUMENT_PEERS_AS_PRINTED
#define TG_PEER_SEPARABLE_UNIT 2.8
#else
#define TG_PEER_SEPARABLE_UNIT 1.0
#endif
#if TEGUMENT_MAP_BITS == 32
#define TG_SKIN_MAP_FORMAT "A32B32G32R32F"
#else
#define TG_SKIN_MAP_FORMAT "A16B16G16R16F"
#endif

// Fur: whether its colour comes from a map, too.
static const bool kTgFurColorMap = TEGUMENT_FUR_COLOR_MAP == 1;

// Culling: the causes, one by one.
static const bool kTgCullFrustum = TEGUMENT_CULL_FRUSTUM == 1;
static const bool kTgCullBackFaces = TEGUMENT_CULL_BACK_FACES == 1;
static const bool kTgCullBlack = TEGUMENT_CULL_BLACK == 1;

// Peers (docs/design/peers.md).
static const bool kTgPeersAsPrinted = TEGUMENT_PEERS_AS_PRINTED == 1;

// What is printed takes the place of what is right file by file, under the same names: the guard of every file that is not to be read is
// set here, and nothing else chooses. Groups include both.
#if TEGUMENT_PEERS_AS_PRINTED
#define TEGUMENT_PEERS_BURLEY_WEIGHT_FXH
#define TEGUMENT_PEERS_RING_LIGHT_FXH
#define TEGUMENT_PEERS_SEPARABLE_KERNEL_FXH
#else
#define TEGUMENT_PRINTED_BURLEY_FXH
#define TEGUMENT_PRINTED_PREINTEGRATED_FXH
#define TEGUMENT_PRINTED_SEPARABLE_FXH
#endif
#if TEGUMENT_SETTING == 2
#define TEGUMENT_PRINTED_ENERGY_FXH
#define TEGUMENT_PRINTED_FILTER_FXH
#define TEGUMENT_PRINTED_GAUSSIAN_FXH
#define TEGUMENT_PRINTED_POISSON_FXH
#define TEGUMENT_PRINTED_OUTSIDE_FXH
#else
#define TEGUMENT_CONSTANTS_FXH
#define TEGUMENT_SPECULAR_ENERGY_FXH
#define TEGUMENT_SHADOW_FILTER_FXH
#define TEGUMENT_SCATTER_GAUSSIAN_FXH
#define TEGUMENT_SCATTER_POISSON_FXH
#define TEGUMENT_CULL_OUTSIDE_FXH
#endif
#if TEGUMENT_SETTING == 0
#define TEGUMENT_SCATTER_TRANSMISSION_FXH
#else
#define TEGUMENT_PRINTED_SEED_FXH
#define TEGUMENT_PRINTED_TRANSMISSION_FXH
#endif
#if TEGUMENT_SETTING != 1
#define TEGUMENT_PRINTED_DEON2007_FXH
#endif
#endif

static const float kTgPi = 3.14159265;
static const float kTgMapSize = TEGUMENT_MAP_SIZE;
static const float kTgShadowSize = TEGUMENT_SHADOW_SIZE;
// The largest half is 65504; ten passes of the printed kernel, whose weights sum to 1.001, must not reach it. A float's, 3.4e38, is far
// beyond any light.
static const float kTgLargestHalf = 64512.0;
static const float kTgLargestLight = TEGUMENT_MAP_BITS == 32 ? 1e30 : kTgLargestHalf;
static const bool kTgNormalXY = TEGUMENT_NORMAL_XY == 1;

// Transmission: distance at which nothing passes, mm; decay of the stored exp(-k t), per mm (the paper's exp(-20 t) with 100 mm to the
// unit); largest alpha, because 1 marks texels outside the charts.
static const float kTgOpaqueDistance = 5000.0;
static const float kTgThicknessDecay = 0.2;
static const float kTgLargestAlpha = 0.99;

// Convolution. Sum and variance of the printed kernel {.006 .061 .242 .383 .242 .061 .006} in units of its spacing.
static const float kTgKernelSum = 1.001;
static const float kTgKernelVariance = 1.0789;

// Seams: whether texels outside the charts are told from those inside.
static const bool kTgRepairSeams = TEGUMENT_SEAM_REPAIR == 1;

// Stretch maps hold kTgStretchScale * (texels of a 1024 map per mm): c = 0.1 of the seed's equation 27 brings heads into 0..1.
static const float kTgStretchScale = 0.1 * 1024.0;

#endif
// SPDX-License-Identifier: MIT
