#pragma once
// Closed shells of a surface, and which of them are inside out.

#include "meshprep/prepare/surface.h"

namespace tegument::prep {

/// Triangles joined across edges, all of whose edges have two triangles.
struct Shell {
    std::vector<std::uint32_t> triangles;
    double volume = 0;     // mm^3; below 0 where it faces inwards
    std::size_t depth = 0; // how many other shells it lies in

    /// A shell in a shell is the wall of a hollow, and faces the hollow; one in that is a body again.
    [[nodiscard]] bool insideOut() const { return depth % 2 == 0 ? volume < 0 : volume > 0; }
};

/// The closed ones of these components that hold a volume, each of triangles that face the same way. Of more than 20,000, none counts as
/// lying in another.
[[nodiscard]] std::vector<Shell> shellsOf(const Surface& surface, std::vector<std::vector<std::uint32_t>> closed);

} // namespace tegument::prep
