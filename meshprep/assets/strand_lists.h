#pragma once
// Ribbons of fur that a pass draws (docs/design/fur.md): those that the eye can see, of thin ones a share, of short
// ones fewer rows.

#include "host/mesh/mesh.h"
#include "host/run/parts.h"

#include <optional>
#include <vector>

namespace tegument::assets {

/// Strand n of a root is drawn while (n + rank of the root) / strands is below a share: the annotation Share of a pass, with
/// ShareRadius, ShareThinnest, ShareFewest and ShareFirst. The effect's shaders leave out the same strands; here a few more may be kept,
/// never fewer.
struct StrandShare {
    double share = 1;        // of all strands, wherever they are
    double width = 0;        // of a strand, mm; 0: distance takes none away
    double thinnest = 0;     // pixels: of narrower ones so many are drawn as if they were that wide
    double fewest = 0;       // share that distance leaves
    double first = 0;        // is added to ranks, less whole ones: passes may begin with different roots
    double pixel = 0;        // across it at distance 1
    std::uint32_t count = 1; // strands of a root: instances of the pass
    double length = 0;       // of a strand, mm
    double segment = 0;      // pixels: of a shorter strand rows are left out, so that its segments are as long; 0: none is
    std::uint32_t fewestSegments = 1;
    double widest = 0; // of a strand, mm, before a share makes it wider
    double least = 0;  // pixels: strands that are drawn narrower from near their roots on are left out; 0: none is
    double taper = 0; // a strand's width at place t, 0 root, 1 tip, is 1 - t^taper of its root's: rows behind `least` are left out; 0: even
    bool operator==(const StrandShare&) const = default;
};

/// Share of the strands of a root at this distance in mm, at least what a shader finds.
[[nodiscard]] double shareAt(const StrandShare& share, double distance);

/// Place along a strand at this distance, 0 root, 1 tip, from which on nothing of it is as wide as the share asks; it may come nearer to
/// the eye by `reach`, mm.
[[nodiscard]] double thinFrom(const StrandShare& share, double distance, double reach);

/// How many segments the ribbon of this root has, 1 to `most`. Roots differ, so that not all change at one distance.
[[nodiscard]] std::uint32_t segmentsAt(const StrandShare& share, double distance, double rank, std::uint32_t most);

/// In [0, 1): tgRibbonRank of hlsl/fur/ribbons.fxh plus `first`, less whole ones, to kRankTolerance, or 0 where that may be 1.
[[nodiscard]] double rankOf(float address, double first = 0);
inline constexpr double kRankTolerance = 1e-3; // a shader multiplies by addresses of 4 digits in single precision: 2.5e-4, twice

/// The ribbons of the part, in its order, the first range from instance 0 on; a ribbon is a run of triangles of one address. `view`: of
/// those only what canBeSeen. Nothing where all of it is to be drawn anyway.
[[nodiscard]] std::optional<DrawList> listStrands(const Mesh& mesh, const MeshPart& part, const run::PartView* view, const glm::dvec3& eye,
                                                  const StrandShare& share);

} // namespace tegument::assets
