// constants.fxh as d'Eon and Luebke (2007) print them; what the paper does not have is the seed's.
// TG_SKIN_... and TG_FUR_... are default values of parameters (literals, so that hosts can read them); k... are constants, folded by the
// compiler.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_DEON2007_FXH
#define TEGUMENT_PRINTED_DEON2007_FXH

#define TG_SKIN_MIX 0.5
#define TG_SKIN_SPECULAR_INTENSITY 0.18
#define TG_SKIN_SHADOW_TOLERANCE 2.0
#define TG_SKIN_BLUR_SIZE 1.5
#define TG_SKIN_BLUR_TURN 0.0
#define TG_FUR_KAJIYA_KAY 1.0
#define TG_FUR_TAPER 0.0
#define TG_FUR_FRINGES 0.0

static const bool kTgCorrected = false;
// Depth in shadow maps: the distance to the light in mm, or z/w. Whether the test is filtered.
static const bool kTgDepthInMillimetres = true;
static const bool kTgFilterShadow = false;
// First Gaussian that light through thin parts is taken from.
static const int kTgFirstTransmitted = 4;
// Whether the cascade counts what has blurred its first map.
static const bool kTgConvolveExactly = false;
// Whether the first Gaussian is taken at the pixel instead of from the first map.
static const bool kTgFirstAtPixel = false;
// Poisson blurs: radii in mm of the surface, or texels. Whether specular reflection is shadowed, for which Final reads the shadow map.
static const bool kTgPoissonStretched = false;
static const bool kTgShadowSpecular = false;
// Culling: whether fragments are culled, or whole vertices. Largest channel of a colour that counts as black, linear.
static const bool kTgCullPerPixel = false;
static const float kTgBlack = 0.0;
// Specular: reflectance at normal incidence of an interface with index 1.4, as the paper rounds 0.02778.
static const float kTgFresnel0 = 0.028;

// Read by printed/ alone: 1 - rho_s rho_dt; a cascade of increments; outside the charts the mean stretch.
static const bool kTgAttenuateByIntensity = true;
static const bool kTgConvolveIncrement = true;
static const bool kTgIgnoreStretchOutside = false;

#endif
// SPDX-License-Identifier: MIT
