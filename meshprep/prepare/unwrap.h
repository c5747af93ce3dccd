#pragma once
// Texture coordinates for meshes that have none: charts, laid out without overlap, by xatlas.

#include "host/support/result.h"
#include "meshprep/prepare/surface.h"

namespace tegument::prep {

struct Unwrapping {
    std::size_t charts = 0;
    std::size_t split = 0; // vertices more, along the borders of charts
    double covered = 0;    // share of the unit square
};

/// Gives every vertex a place in the unit square; vertices split where charts end. Texture coordinates that there were, and the textures
/// that lay by them, are gone (carryTextures() draws them anew). TG7027 this build has no xatlas; TG7028 no charts could be made.
[[nodiscard]] Result<Unwrapping> unwrap(Surface& surface);

} // namespace tegument::prep
