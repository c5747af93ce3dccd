#pragma once
// A regression check, not a reference: effects/FurRoots.fx said again in double precision, its approximations and their constants with it.
// What a layer shows at a point is what its ray meets of the strands between this layer and the next. Places by intersecting rays with
// planes, strands by searching along the ray, sums by quadrature. It tells what the shader's arithmetic and the device lose of that, not
// whether it is right: that is fur_exact's to say.

#include "lab/reference/fur.h"
#include "lab/reference/fur_strands.h"

namespace tegument::reference {

/// The parameters of effects/FurRoots.fx that Fur.fx does not have. Lengths in spacings.
struct FurSwept {
    double spacing = 1;   // mm
    double thickness = 1; // of the coat, mm
    int layers = 32;
    double segment = 3;
    double fewest = 4;
    double scatter = 0.4;
    double curls = 0.15;
    double turns = 1;
    double tufts = 1.5;
    double tuftSize = 4;
    double variation = 0.4;
    double density = 1;     // strands per square spacing, for coverage to expect
    double radius = 0.3;    // of strands at their roots, and
    double shortest = 0.55; // least length, share of the longest: likewise
    glm::dvec3 lean{0};     // of all tips, share of the coat
};

/// Who looks: `pixel` is the width of one at a distance of 1.
struct FurEye {
    glm::dvec3 position{0};
    double pixel = 0;
};

/// What is covered, and where along the strands: means by coverage.
struct FurMet {
    double covered = 0;
    double height = 0; // in the coat
    double along = 0;  // the strand, 0 root, 1 tip
    double tint = 1;
};

/// How often the number of layers may be halved where a ray takes this way over the skin while it crosses an upright coat, spacings:
/// logarithm to the base 2. `far`: 0 strands, 1 only coverage to expect.
[[nodiscard]] double furSpare(const FurSwept& fur, double across, double far);

/// A strand's axis from where it stands, at this height: along the side to which it strays, and across it.
[[nodiscard]] glm::dvec2 furAxis(const FurSwept& fur, double height);

/// How far aside strands are looked up for a place at this height, so that neighbours lean together: along the skin with this normal.
[[nodiscard]] glm::dvec3 furTuft(const FurSwept& fur, const glm::dvec3& place, double height, const glm::dvec3& normal);

/// How a ray goes on from a point of a layer, to the second order: per unit of s, which is as the ray's length, its place moves by `travel`
/// and the normal there turns by `turn`; its height falls by s - bow s^2 / 2.
struct FurPath {
    glm::dvec3 travel{0};
    glm::dvec3 turn{0};
    double bow = 0;
};
/// `ray`: unit. `strand`: how a point of the coat moves while its height rises by 1, of which `upright` is along the normal; spacings.
/// `least`: square of the cosine with the layer at which rays go on for longest.
[[nodiscard]] FurPath furPath(const FurSwept& fur, const FurFacet& facet, const glm::dvec3& ray, const glm::dvec3& strand, double upright,
                              double least);

struct FurPieceMet {
    double covered = 0;
    double entry = 0; // 0 begin, 1 end
};
/// What a cone covers of a piece of a ray beyond what it covers where the piece begins, and where the ray enters it. `begin`, `end`: from
/// the cone's axis; `width`: of a pixel.
[[nodiscard]] FurPieceMet meetCone(const glm::dvec3& begin, const glm::dvec3& end, double radiusAtBegin, double radiusAtEnd, double width);

/// Coverage to expect of this share of the strands between two heights, on a way of so many spacings, and the mean height of what covers.
struct FurExpected {
    double covered = 0;
    double height = 0;
};
[[nodiscard]] FurExpected expectedCover(const FurSwept& fur, double share, double top, double bottom, double way);

/// None of the layer where `met.covered` is 0.
struct FurSeen {
    FurMet met;
    bool drawn = false;
    bool decided = true;
};
[[nodiscard]] FurSeen sweepLayer(const FurSwept& fur, const FurStrandsAt& strands, const FurFragment& fragment, const FurFacet& facet,
                                 const FurEye& eye);

/// Radiance of what the sweep has met.
[[nodiscard]] glm::dvec3 sweptRadiance(const FurCoat& coat, const FurFragment& fragment, const FurMet& met, const FurLight& light,
                                       const glm::dvec3& eye, bool lit);

} // namespace tegument::reference
