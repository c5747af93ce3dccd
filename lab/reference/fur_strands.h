#pragma once
// The strands of effects/FurRoots.fx near a place, as docs/design/modules/FurRoots.md defines them. Places and lengths in spacings, from
// the centre of the mesh's ball.

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

#include <functional>
#include <vector>

namespace tegument::reference {

/// What of a strand the sweep of a ray needs to know.
struct FurStand {
    glm::dvec3 root{0};
    double length = 1; // share of the coat
    double radius = 0; // at the root
    double stray = 1;  // share of what strands bend
    glm::dvec3 random{0.5};
};

/// Where strands are looked for: around the piece of a ray whose place over the skin begins at `begin`; roots along the skin no further
/// than `reach` from `middle`.
struct FurPlace {
    glm::dvec3 begin{0};
    glm::dvec3 middle{0};
    glm::dvec3 normal{0}; // of the skin, unit
    double reach = 0;
};

/// Replaces the list by all strands that may be near, in the order in which they are met.
using FurStrandsAt = std::function<void(const FurPlace& place, std::vector<FurStand>& strands)>;

/// What technique Cellular has in a cube of side 1 of its lattice: a point, and random numbers in (0, 1) of its strand.
struct LatticePoint {
    glm::dvec3 place{0};
    glm::dvec3 random{0.5};
};
/// `cube`: its lowest corner.
[[nodiscard]] LatticePoint latticePoint(const glm::i64vec3& cube);

/// Technique Cellular: one point to each cube of side 1, at a place that a random number of the cube gives; the skin grows its strand where
/// it passes nearer than half a side.
[[nodiscard]] FurStrandsAt latticeStrands(double radius, double shortest);

/// A root of technique Roots.
struct FurRoot {
    FurStand strand;        // its length: share of the coat where the skin faces as the root does, before the limit
    glm::dvec3 normal{0};   // unit
    glm::dvec3 straying{0}; // lean and curl: what of it lies along the skin's normal at a place is the share of what strands bend there
    double limit = 1;       // longest, share of the coat
};

/// Technique Roots, `roots` in the order of the file. On skin that looks another way a strand is as much shorter as the cosine.
[[nodiscard]] FurStrandsAt rootedStrands(std::vector<FurRoot> roots);

} // namespace tegument::reference
