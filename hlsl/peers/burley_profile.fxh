// Burley's normalised diffusion gathered over a disc of the picture (Golubev, Efficient screen-space subsurface scattering using Burley's
// normalized diffusion in real-time, 2018; Christensen and Burley, Approximate reflectance profiles for efficient subsurface scattering,
// 2015).
//   R(r) = (exp(-r / d) + exp(-r / 3d)) / (8 pi d r),   share of light within r: 1 - exp(-r / d) / 4 - 3 exp(-r / 3d) / 4
// d, r in mm; one d for each colour.
#ifndef TEGUMENT_PEERS_BURLEY_PROFILE_FXH
#define TEGUMENT_PEERS_BURLEY_PROFILE_FXH

// Radius over d within which the share u of the light is: with s = exp(-r / 3d), s^3 + 3 s = 4 (1 - u), a cubic with one real root
// (Cardano). Written so that nothing cancels: s = 4 (1 - u) / c.
float tgBurleyRadius(float u)
{
    float rest = 1.0 - u;
    float g = 1.0 + 4.0 * rest * (2.0 * rest + sqrt(1.0 + 4.0 * rest * rest));
    float root = pow(g, 1.0 / 3.0);
    float c = 1.0 + root + 1.0 / root;
    return 3.0 * log(c / (4.0 * rest));
}

// 8 pi r R(r), per mm.
float3 tgBurleyPolar(float r, float3 d)
{
    float3 third = exp(-r / (3.0 * d));
    return (third * third * third + third) / d;
}

#endif
// SPDX-License-Identifier: MIT
