#pragma once
// What does not belong in a mesh, taken out with a count.

#include "meshprep/prepare/surface.h"

namespace tegument::prep {

/// Of a mesh that moves: a triangle whose corners lie at one place at rest and move apart, such as one between closed lips, gets places of
/// its own there, so that it is not collapsed.
void partOpening(Surface& surface);

/// Triangles with two corners at one place have no area.
std::size_t dropCollapsed(Surface& surface);

/// Triangles that an earlier one repeats: the same places and texture coordinates, seen from the same side.
std::size_t dropDuplicates(Surface& surface);

std::size_t dropUnreferenced(Surface& surface);

/// For each triangle one that has the same three places and is seen from the other side, or itself.
[[nodiscard]] std::vector<std::uint32_t> backToBack(const Surface& surface);

} // namespace tegument::prep
