#pragma once
// Triangles in the order in which those that hide others tend to come first.

#include "host/mesh/mesh.h"

namespace tegument::prep {

/// Fragments shaded per pixel covered, mean over views along the axes: 1 at best.
struct Overdraw {
    double before = 0;
    double after = 0;
};

/// Clusters of triangles are sorted (P. Sander, D. Nehab, J. Barczak, 2007); vertex reuse may get this much worse.
inline constexpr float kOverdrawThreshold = 1.05f;
Overdraw orderForOverdraw(Mesh& mesh);

} // namespace tegument::prep
