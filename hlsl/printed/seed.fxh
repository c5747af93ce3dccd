// constants.fxh as the seed prints them: chapter 5 of the dissertation. Its Table 5 gives Gosselin's Final no shadow map.
// SKIN_... and FUR_... are default values of parameters (literals, so that hosts can read them); k... are constants, folded by the compiler.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_PRINTED_SEED_FXH
#define TEGUMENT_PRINTED_SEED_FXH

#define SKIN_MIX 0.4
#define SKIN_SHADOW_TOLERANCE 0.005
#define SKIN_BLUR_SIZE 1.5
#define SKIN_BLUR_TURN 0.0
#define FUR_KAJIYA_KAY 0.0
#define FUR_TAPER 0.0
#define FUR_FRINGES 0.0

static const bool kCorrected = false;
// Depth in shadow maps: the distance to the light in mm, or z/w. Whether the test is filtered.
static const bool kDepthInMillimetres = false;
static const bool kFilterShadow = false;
// First Gaussian that light through thin parts is taken from.
static const int kFirstTransmitted = 2;
// Whether the cascade counts what has blurred its first map.
static const bool kConvolveExactly = false;
// Poisson blurs: radii in mm of the surface, or texels. Whether specular reflection is shadowed, for which Final reads the shadow map.
static const bool kPoissonStretched = false;
static const bool kShadowSpecular = false;
// Culling: whether fragments are culled, or whole vertices. Largest channel of a colour that counts as black, linear.
static const bool kCullPerPixel = false;
static const float kBlack = 0.0;

// Read by printed/ alone. Equations 38 and 39 print 1 - atten, without rho_s; each pass takes its own sigma; outside the charts the stretch is ignored.
static const bool kAttenuateByIntensity = false;
static const bool kConvolveIncrement = false;
static const bool kIgnoreStretchOutside = true;

#endif
