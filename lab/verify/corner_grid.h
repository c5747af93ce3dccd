#pragma once
// Inside lab/verify: where a device has the corners of the triangles that it draws.

#include "lab/verify/work.h"

namespace tegument::verify {

/// Rasterisers decide on a grid finer than pixels which of them a triangle covers. Some (graphics chips) also interpolate between the
/// corners on that grid, others (llvmpipe) between the corners as they are: pictures then differ by what a value changes over the
/// difference. One small draw tells.
struct CornerGrid {
    double step = 0;      // pixels, to the nearest multiple of which corners are moved before values are interpolated; 0: they are not
    double exact = 0;     // RMS distance of drawn places from those between the corners as they are, pixels
    double remaining = 0; // the same from those between corners moved by `step`
};
[[nodiscard]] Result<CornerGrid> measureCornerGrid(const Context& context);

} // namespace tegument::verify
