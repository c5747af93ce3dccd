// Constants of setting corrected that a printed setting changes. Black: up to 2/255 in sRGB, for photographed maps hold no exact black.
// TG_SKIN_... and TG_FUR_... are default values of parameters (literals, so that hosts can read them); k... are constants, folded by the
// compiler.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../hlsl/settings.fxh"
#endif
#ifndef TEGUMENT_CONSTANTS_FXH
#define TEGUMENT_CONSTANTS_FXH

#define TG_SKIN_MIX 0.5
#define TG_SKIN_SPECULAR_INTENSITY 1.0
#define TG_SKIN_SHADOW_TOLERANCE 0.3
#define TG_SKIN_BLUR_SIZE 1.2
#define TG_SKIN_BLUR_TURN 2.39996
#define TG_FUR_KAJIYA_KAY 1.0
#define TG_FUR_TAPER 0.0
#define TG_FUR_FRINGES 1.0

#ifndef TEGUMENT_LIBRARY
static const bool kTgCorrected = true;
// Depth in shadow maps: the distance to the light in mm, or z/w. Whether the test is filtered.
static const bool kTgDepthInMillimetres = true;
static const bool kTgFilterShadow = true;
// First Gaussian that light through thin parts is taken from.
static const int kTgFirstTransmitted = 4;
// Whether the cascade counts what has blurred its first map.
static const bool kTgConvolveExactly = true;
// Whether the first Gaussian, narrower than a texel, is taken at the pixel instead of from the first map.
static const bool kTgFirstAtPixel = true;
// Poisson blurs: radii in mm of the surface, or texels. Whether specular reflection is shadowed, for which Final reads the shadow map.
static const bool kTgPoissonStretched = true;
static const bool kTgShadowSpecular = true;
// Culling: whether fragments are culled, or whole vertices.
static const bool kTgCullPerPixel = true;
#endif

// Specular: reflectance at normal incidence of an interface with index 1.5, ((1.5 - 1) / (1.5 + 1))^2. Cheeks have 1.51 to 1.53 (Yoshida et
// al. 2013); 1.4 is the mean of the tissue below.
static const float kTgFresnel0 = 0.04;
// Culling: largest channel of a colour that counts as black, linear.
static const float kTgBlack = 2.0 / 255.0 / 12.92;

#endif
// SPDX-License-Identifier: MIT
