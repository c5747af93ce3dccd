// constants.fxh as d'Eon and Luebke (2007) print them; what the paper does not have is the seed's.
// SKIN_... and FUR_... are default values of parameters (literals, so that hosts can read them); k... are constants, folded by the compiler.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_DEON2007_FXH
#define TEGUMENT_PRINTED_DEON2007_FXH

#define SKIN_MIX 0.5
#define SKIN_SHADOW_TOLERANCE 2.0
#define SKIN_BLUR_SIZE 1.5
#define SKIN_BLUR_TURN 0.0
#define FUR_KAJIYA_KAY 1.0
#define FUR_TAPER 0.0
#define FUR_FRINGES 0.0

static const bool kCorrected = false;
// Depth in shadow maps: the distance to the light in mm, or z/w. Whether the test is filtered.
static const bool kDepthInMillimetres = true;
static const bool kFilterShadow = false;
// First Gaussian that light through thin parts is taken from.
static const int kFirstTransmitted = 4;
// Whether the cascade counts what has blurred its first map.
static const bool kConvolveExactly = false;
// Poisson blurs: radii in mm of the surface, or texels. Whether specular reflection is shadowed, for which Final reads the shadow map.
static const bool kPoissonStretched = false;
static const bool kShadowSpecular = false;
// Culling: whether fragments are culled, or whole vertices. Largest channel of a colour that counts as black, linear.
static const bool kCullPerPixel = false;
static const float kBlack = 0.0;

// Read by printed/ alone: 1 - rho_s rho_dt; a cascade of increments; outside the charts the mean stretch.
static const bool kAttenuateByIntensity = true;
static const bool kConvolveIncrement = true;
static const bool kIgnoreStretchOutside = false;

#endif
