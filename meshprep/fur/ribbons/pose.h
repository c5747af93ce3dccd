#pragma once
// Roots on a body that bends: each follows the triangle that it grows on. docs/design/fur.md, "Bodies that bend".

#include "host/image/image.h"
#include "host/mesh/mesh.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <vector>

namespace tegument {

/// Where a root grows: what stays while the body bends.
struct RootSeat {
    float address = 0;          // of its texels in the texture of roots
    std::uint32_t triangle = 0; // of the mesh
    glm::vec2 weights{0};       // of the second and the third corner
};

struct RootSeats {
    std::vector<RootSeat> seats;
    std::size_t lost = 0; // roots below which the mesh has no triangle: they stay where they are
};

/// What a pose does with a root.
struct RootPose {
    glm::dvec3 moved{0};
    glm::dquat turn{1, 0, 0, 0}; // of its triangle and of the normal there; unit
};

/// Seats of the roots of a texture, along its order. `skin`: the mesh at rest that they were made for, without ribbons. TG7109.
[[nodiscard]] Result<RootSeats> seatsOfRoots(const Mesh& skin, const Image& roots, unsigned threads = 0);

/// `posed` has the triangles of `rest`. Where nothing moves this is exactly no motion.
[[nodiscard]] RootPose poseOfRoot(const RootSeat& seat, const Mesh& rest, const Mesh& posed);

/// As large as the texture of roots. Texels of a root: 0 how far it has moved, in the mesh's lengths; 1 its turn, as x y z w.
[[nodiscard]] Image poseTexture(const RootSeats& seats, const Mesh& rest, const Mesh& posed, const Image& roots, unsigned threads = 0);

/// Likewise, what a pose is found from: 0 the vertices of the triangle's corners, and its number; 1 their weights.
[[nodiscard]] Image seatTexture(const RootSeats& seats, const Mesh& skin, const Image& roots);

/// Gives the mesh its pose (host/mesh/pose.h). `posed`: the skin's vertices and triangles, which come first in `mesh`; `pose`: poseTexture.
void applyPose(Mesh& mesh, const Mesh& posed, const Image& pose);

/// Whether one can be bent into the other: the same triangles of the same vertices, but for ribbons behind them.
[[nodiscard]] bool sameTriangles(const Mesh& rest, const Mesh& posed);

/// The mesh without ribbons, with the numbers of its vertices: as many as `posed` has.
[[nodiscard]] Mesh skinOf(const Mesh& rest, const Mesh& posed);

} // namespace tegument
