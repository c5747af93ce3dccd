#pragma once
// Camera and light that all scenes of fur have.

#include "tests/hlsl/pass_case.h"

namespace tegument::test {

inline const dvec3 kFurLamp = {20, -30, 300}; // the light of the workspace
inline const dvec3 kFurColour = {0.9, 0.8, 0.7};
inline const double kFurPixel = 2 * tan(0.3) / 640; // at distance 1

inline const Globals kFurView = {{"gViewProjection", {1, 0.2, 0, 0, 0.1, 1.5, 0, 0.3, 0, 0, -1.1, -1, 5, 7, 300, 400}},
                                 {"gLightViewProjection", {2.5, 0, 0, 0, 0, 2.5, 0, 0, 0, 0, -1.2, -1, -50, 75, 350, 300}},
                                 {"gViewportSize", {640, 480}},
                                 {"gCameraFov", {0.6}},
                                 {"gLightPosition", numbersOf(kFurLamp)},
                                 {"gLightColor", numbersOf(kFurColour)},
                                 {"gLightNear", {100}},
                                 {"gLightFar", {500}}};

/// Where a place of the world is seen.
inline dvec4 furClip(const dvec3& p) {
    return {p.x + 0.1 * p.y + 5, 0.2 * p.x + 1.5 * p.y + 7, -1.1 * p.z + 300, 0.3 * p.y - p.z + 400};
}

/// Likewise from the light.
inline dvec4 furLightClip(const dvec3& p) {
    return {2.5 * (p.x - kFurLamp.x), 2.5 * (p.y - kFurLamp.y), 350 - 1.2 * p.z, kFurLamp.z - p.z};
}

} // namespace tegument::test
