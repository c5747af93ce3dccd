// What more passes through bent skin than the diffusion profile says, which is a half-space's (hlsl/scatter/flesh.fxh).
#ifndef TEGUMENT_PASSES_FLESH_FXH
#define TEGUMENT_PASSES_FLESH_FXH

float4 gFlesh < string UIName = "Light through flesh (RGB)";
    string UIHelp = "c of 1 + c h, per mm: about 1.1 times the tissue's effective attenuation"; > = { 0.0, 0.0, 0.0, 0.0 };

#endif
// SPDX-License-Identifier: MIT
