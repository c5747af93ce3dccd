// Every constant that differs between the three settings, and the sizes and formats of maps. docs/settings.md lists each with its source.
//   TEGUMENT_SETTING   0, 1, 2 (default), by name in FX_SETTINGS
//   TEGUMENT_MAP_SIZE  texels along each side of the maps (default 1024)
//   TEGUMENT_MAP_BITS  bits per channel of the irradiance maps: 16 (default) or 32
//   TEGUMENT_PEERS_AS_PRINTED  1: kernels of effects/peers as their authors print them; 0: corrected; default 0 in setting corrected, else 1
//   TEGUMENT_SEAM_REPAIR  1 (default); 0 lets the gaps between the charts bleed into them, to measure what the repair is worth
//   TEGUMENT_CULL_FRUSTUM, TEGUMENT_CULL_BACK_FACES, TEGUMENT_CULL_BLACK  1 (default); 0 takes one cause out of the prepasses, to measure what it is worth
//   TEGUMENT_SHADOW_FROM_TSM  1 (default): the translucent shadow map serves as the shadow map; 0: a shadow map of its own, to measure what that saves
//   TEGUMENT_NORMAL_XY  0 (default); 1: the normal map has two channels (BC5, RG8), and z follows from them
//   TEGUMENT_FUR_COLOR_MAP  0 (default); 1 multiplies the colour of fur by gFurColorMap, for meshes with texture coordinates
// SKIN_... and FUR_... are default values of parameters (literals, so that hosts can read them); k... are constants, folded by the compiler.
#ifndef TEGUMENT_SETTINGS_FXH
#define TEGUMENT_SETTINGS_FXH

// What tools call the values of the first switch, and what a picture's metadata say of the others (docs/effect-files.md).
#define FX_SETTINGS TEGUMENT_SETTING seed deon2007 corrected
#define FX_METADATA map_size TEGUMENT_MAP_SIZE

#ifndef TEGUMENT_SETTING
#define TEGUMENT_SETTING 2
#endif
#ifndef TEGUMENT_MAP_SIZE
#define TEGUMENT_MAP_SIZE 1024
#endif
#ifndef TEGUMENT_MAP_BITS
#define TEGUMENT_MAP_BITS 16
#endif
#ifndef TEGUMENT_SEAM_REPAIR
#define TEGUMENT_SEAM_REPAIR 1
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
#ifndef TEGUMENT_FUR_COLOR_MAP
#define TEGUMENT_FUR_COLOR_MAP 0
#endif
#ifndef TEGUMENT_PEERS_AS_PRINTED
#define TEGUMENT_PEERS_AS_PRINTED (TEGUMENT_SETTING != 2)
#endif
#if TEGUMENT_PEERS_AS_PRINTED
#define PEER_SEPARABLE_UNIT 2.8
#else
#define PEER_SEPARABLE_UNIT 1.0
#endif
#ifndef TEGUMENT_NORMAL_XY
#define TEGUMENT_NORMAL_XY 0
#endif
#if TEGUMENT_MAP_BITS == 32
#define SKIN_MAP_FORMAT "A32B32G32R32F"
#else
#define SKIN_MAP_FORMAT "A16B16G16R16F"
#endif

#if TEGUMENT_SETTING == 0
#define SKIN_MIX 0.4
#define FUR_KAJIYA_KAY 0.0
#define FUR_TAPER 0.0
#define FUR_FRINGES 0.0
#define SKIN_SHADOW_TOLERANCE 0.005
#define SKIN_BLUR_SIZE 1.5
#define SKIN_BLUR_TURN 0.0
#elif TEGUMENT_SETTING == 1
#define SKIN_MIX 0.5
#define FUR_KAJIYA_KAY 1.0
#define FUR_TAPER 0.0
#define FUR_FRINGES 0.0
#define SKIN_SHADOW_TOLERANCE 2.0
#define SKIN_BLUR_SIZE 1.5
#define SKIN_BLUR_TURN 0.0
#else
#define SKIN_MIX 0.5
#define FUR_KAJIYA_KAY 1.0
#define FUR_TAPER 0.0
#define FUR_FRINGES 1.0
#define SKIN_SHADOW_TOLERANCE 0.3
#define SKIN_BLUR_SIZE 1.2
#define SKIN_BLUR_TURN 2.39996
#endif

static const float kPi = 3.14159265;
static const float kMapSize = TEGUMENT_MAP_SIZE;
static const bool kSeed = TEGUMENT_SETTING == 0;
static const bool kCorrected = TEGUMENT_SETTING == 2;
// The largest half is 65504; ten passes of the printed kernel, whose weights sum to 1.001, must not reach it. A float's, 3.4e38, is far beyond any light.
static const float kLargestHalf = 64512.0;
static const float kLargestLight = TEGUMENT_MAP_BITS == 32 ? 1e30 : kLargestHalf;
static const bool kNormalXY = TEGUMENT_NORMAL_XY == 1;

// Specular. Reflectance at normal incidence of an interface with index 1.4, ((1.4 - 1) / (1.4 + 1))^2, as the paper rounds it.
static const float kFresnel0 = 0.028;
// The printed lobe integrates to pi, not 1 (docs/conventions.md): as an albedo it must be divided by pi, which the printed listings omit.
static const float kAlbedoScale = kCorrected ? 1.0 / kPi : 1.0;
// Seed equations 38 and 39 print 1 - atten, without rho_s.
static const bool kAttenuateByIntensity = !kSeed;

// Shadow. Depth in the translucent shadow map: z/w, or the distance to the light in mm.
static const bool kDepthInMillimetres = !kSeed;
static const bool kFilterShadow = kCorrected;

// Transmission: distance at which nothing passes, mm; decay of the stored exp(-k t), per mm (the paper's exp(-20 t) with 100 mm to the unit);
// largest alpha, because 1 marks texels outside the charts; first Gaussian that transmits; exponent -t^2 * k / v.
static const float kOpaqueDistance = 5000.0;
static const float kThicknessDecay = 0.2;
static const float kLargestAlpha = 0.99;
static const bool kThicknessAsDepth = kSeed;
static const int kFirstTransmitted = kSeed ? 2 : 4;
static const float kTransmissionExponent = kSeed ? 1.0 : 0.5;
static const bool kFadeNearLitSide = !kSeed;

// Convolution. Sum and variance of the printed kernel {.006 .061 .242 .383 .242 .061 .006} in units of its spacing.
static const float kKernelSum = 1.001;
static const float kKernelVariance = 1.0789;
static const bool kConvolveIncrement = !kSeed;
static const bool kConvolveExactly = kCorrected;

// Poisson blurs: the disc's own mean subtracted; radii in mm of the surface instead of texels; specular reflection shadowed, for which Final reads
// the shadow map (the seed's Table 5 gives it none).
static const bool kPoissonCentred = kCorrected;
static const bool kPoissonStretched = kCorrected;
static const bool kShadowSpecular = kCorrected;

// Seams: whether texels outside the charts are told from those inside.
static const bool kRepairSeams = TEGUMENT_SEAM_REPAIR == 1;

// Fur: whether its colour comes from a map, too.
static const bool kFurColorMap = TEGUMENT_FUR_COLOR_MAP == 1;

// Stretch maps hold kStretchScale * (texels of a 1024 map per mm): c = 0.1 of the seed's equation 27 brings heads into 0..1.
static const float kStretchScale = 0.1 * 1024.0;

// Culling. Largest channel of a colour that counts as black, linear: exactly black, or up to 2/255 in sRGB.
static const float kBlack = kCorrected ? 2.0 / 255.0 / 12.92 : 0.0;
static const bool kCullPerPixel = kCorrected;
// Equations 41 and 42 as printed: only the right and the upper side of the view.
static const bool kCullAsPrinted = !kCorrected;
// The causes, one by one.
static const bool kCullFrustum = TEGUMENT_CULL_FRUSTUM == 1;
static const bool kCullBackFaces = TEGUMENT_CULL_BACK_FACES == 1;
static const bool kCullBlack = TEGUMENT_CULL_BLACK == 1;

// Peers (docs/peers.md).
static const bool kPeersAsPrinted = TEGUMENT_PEERS_AS_PRINTED == 1;

#endif
