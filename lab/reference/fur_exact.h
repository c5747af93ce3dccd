#pragma once
// Strands as docs/design/fur-layers.md ("What a strand is") defines them in space, and rays against them: what effects/FurRoots.fx should
// show. Nothing here knows layers, sweeps, or coverage to expect. Lengths in mm.

#include "lab/reference/fur_strands.h"
#include "lab/reference/surface.h"

#include <memory>
#include <span>

namespace tegument::reference {

/// What strands of a coat have in common.
struct FurStrandShape {
    double spacing = 1;   // mean distance of two strands: the unit of the five lengths below
    double thickness = 1; // of the coat
    double scatter = 0;   // how far tips stray, each to its own side
    double curls = 0;     // radius of the turns at the tip
    double turns = 0;     // from root to tip of the longest strand
    double tufts = 0;     // how far tips stray together
    double tuftSize = 1;  // of the waves by which they do
    glm::dvec3 origin{0}; // of those waves
    glm::dvec3 lean{0};   // of all tips, share of the coat
    bool round = false;   // sections across the axis are circles, as of strands that are ribbons; else those parallel to the skin
};

/// A strand as it is given.
struct FurGrown {
    glm::dvec3 root{0}; // on the skin
    glm::dvec3 lean{0}; // of its tip besides the shape's, share of the coat
    double length = 1;  // share of the coat
    double radius = 0;  // at the root
    double stray = 1;   // share of the shape's scatter and curls
    glm::dvec3 side{0}; // towards which it strays: what of this lies along the skin
    double tint = 1;    // its colour is multiplied by that
};

/// The nearest point of a mesh, with its interpolated normal, unit.
struct OnSkin {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};
    double distance = 0;
};
/// None within `radius`. `facing`: only of triangles that look that way (not 0), for sheets lie back to back.
[[nodiscard]] std::optional<OnSkin> nearestSkin(const RayScene& skin, const glm::dvec3& point, double radius,
                                                const glm::dvec3& facing = glm::dvec3(0));

/// A place of a strand's axis. The strand there is a disc around it, parallel to the skin or across the axis.
struct FurJoint {
    glm::dvec3 position{0};
    glm::dvec3 normal{0}; // of the skin below
    double height = 0;    // in the coat, 0 to 1
    double radius = 0;    // of the disc
};
/// From root to tip, `pieces` + 1 of them. Empty where the root is not on the skin.
[[nodiscard]] std::vector<FurJoint> axisOf(const RayScene& skin, const FurStrandShape& shape, const FurGrown& strand, int pieces);

class FurExact {
public:
    /// Between neighbouring joints strands are straight: pieces of cones. `skin` must outlive this.
    FurExact(const RayScene& skin, const FurStrandShape& shape, std::vector<FurGrown> strands, int pieces = 12);
    ~FurExact();
    FurExact(const FurExact&) = delete;
    FurExact& operator=(const FurExact&) = delete;

    struct Hit {
        double distance = 0;
        glm::dvec3 normal{0};             // of the skin below, unit
        double height = 0;                // in the coat
        double along = 0;                 // the strand, 0 root, 1 tip
        const FurGrown* strand = nullptr; // null: the skin
    };
    /// What a ray meets first. `direction`: unit.
    [[nodiscard]] std::optional<Hit> meet(const glm::dvec3& origin, const glm::dvec3& direction) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The strands of technique Cellular near points of the skin that `wanted` approves of: one to each point of the lattice that is nearer to
/// the skin than half a spacing, rooted where the skin is nearest to it. `radius`: at the root, and `shortest`: the least length, share of
/// the longest; `variation`: of tints.
struct FurLattice {
    glm::dvec3 centre{0};
    double spacing = 1;
    double radius = 0.3; // spacings
    double shortest = 1;
    double variation = 0;
};
[[nodiscard]] std::vector<FurGrown> latticeOn(const RayScene& skin, const FurLattice& lattice,
                                              const std::function<bool(const glm::dvec3&)>& wanted);

} // namespace tegument::reference
