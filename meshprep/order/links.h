#pragma once
// Which face lies across each side of a face, for meshes of any kind.

#include "meshprep/order/piece.h"

#include <limits>

namespace tegument::order {

inline constexpr std::uint32_t kNoLink = std::numeric_limits<std::uint32_t>::max();

/// For the side from corner i to the next corner of its face: the corner where the same side of another face, run through the other way,
/// starts. Links are mutual. Sides of degenerate faces have none; where many faces meet at a side they are linked in pairs; two faces are
/// linked along one side at most.
[[nodiscard]] std::vector<std::uint32_t> linkFaces(const Piece& piece);

[[nodiscard]] inline std::uint32_t cornerAfter(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

[[nodiscard]] inline std::uint32_t cornerBefore(std::uint32_t corner) {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

} // namespace tegument::order
