#pragma once
// Which way the triangles of a mesh face. Fur grows towards their front, and light falls on it: a mesh that was exported inside out is bald
// and dark, and looks like a fault of the effect.

#include "host/mesh/mesh.h"

#include <optional>
#include <span>
#include <string>

namespace tegument {

struct Facing {
    double outward = 0; // 1: a ball seen from outside, -1: from inside, 0: as much one as the other, or open
    double opposed = 0; // share of the edges of two triangles that are seen from opposite sides
    double doubled = 0; // share of the triangles that another one repeats, seen from the other side
};

/// The mean over the area of the cosine between a triangle's normal and the way to it from the mesh's middle, weighted by that way.
/// 0 for what is open: whether a hollow is meant to be seen from above nobody knows.
[[nodiscard]] double outwardFacing(const Mesh& mesh);

/// `places`: of each vertex; vertices of one place have the same number. Of large meshes a sample of edges and triangles is looked at.
[[nodiscard]] Facing examineFacing(const Mesh& mesh, std::span<const std::uint32_t> places);

/// What is wrong with it, as a warning: TG5332 most face inwards, TG5333 neighbours face opposite ways, TG5334 each is there twice.
[[nodiscard]] std::optional<Diagnostic> facingFault(const Facing& facing, const std::string& file);

} // namespace tegument
