#pragma once
// Inside lab/verify: what the sources of module Pyramid share.

#include "lab/verify/truth.h"

namespace tegument::verify {

struct PyramidScene {
    const Scene& scene;
    const Truth& truth;
    const Seen& texels; // of the maps
};

/// Levels, links and the picture against the integral over the surface.
[[nodiscard]] Result<void> verifyPyramidLight(ModuleReport& report, const Context& context, const PyramidScene& at);
} // namespace tegument::verify
