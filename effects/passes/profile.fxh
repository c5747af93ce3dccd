// The diffusion profile: a sum of six Gaussians (d'Eon and Luebke 2007). Weights of each channel sum to 1; the widths are the square roots
// of the variances, kept apart because the convolutions need nothing else.
#ifndef TEGUMENT_PASSES_PROFILE_FXH
#define TEGUMENT_PASSES_PROFILE_FXH

float4 gGaussianWeight[6] < string UIName = "Weight (RGB) and variance (mm^2)"; > = {
    { 0.233, 0.455, 0.649, 0.0064 },
    { 0.100, 0.336, 0.344, 0.0484 },
    { 0.118, 0.198, 0.000, 0.187 },
    { 0.113, 0.007, 0.007, 0.567 },
    { 0.358, 0.004, 0.000, 1.99 },
    { 0.078, 0.000, 0.000, 7.41 }
};
float4 gGaussianSigma[2] < string UIName = "Widths 1 to 4; 5, 6 (mm)"; > = {
    { 0.080, 0.220, 0.432, 0.753 },
    { 1.411, 2.722, 0.000, 0.000 }
};

#endif
