// Group specular: Fresnel, Beckmann, Kelemen and Szirmay-Kalos, energy taken from the diffuse light. About the paths see surface.fxh.
#include "../hlsl/surface.fxh"
#include "../hlsl/specular/fresnel.fxh"
#include "../hlsl/specular/beckmann.fxh"
#include "../hlsl/specular/kelemen.fxh"
#include "../hlsl/specular/lobes.fxh"
#include "../hlsl/specular/energy.fxh"
#include "../hlsl/printed/energy.fxh"
// SPDX-License-Identifier: MIT
