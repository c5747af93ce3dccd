#pragma once
// Links in space: for each texel of a map, the texels that send light to it by the widest Gaussians of the diffusion profile, found by
// their distance in millimetres, so across seams, folds and between bodies. Near sources are small, far ones large. What the next narrower
// Gaussian sends from chart to chart comes along with them (docs/design/modules/Pyramid.md).

#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/support/result.h"

#include <array>
#include <cstddef>
#include <vector>

namespace tegument {

struct LinkOptions {
    std::array<double, 2> variances{1.99, 7.41}; // mm^2: the fifth and sixth Gaussian (effects/passes/profile.fxh)
    std::array<double, 2> weights{0.358, 0.078}; // what they weigh in red, by which links are judged
    double fourth = 0.567;                       // mm^2: the Gaussian that pyramids keep, but for what comes from chart to chart
    double fourthShare = 0.113 / 0.358;          // of it, in red, in that of the first of the two above
    double lost = 0.0005;                        // share of a texel's light whose links may be left out; the others make up for it
    double nearest = 1.3;                        // largest source where it is received, mm
    double growth = 1.0;                         // and how it grows with the distance, mm per mm
    unsigned threads = 0;                        // 0: one a processor
};

/// A list of links for each texel of a map of kLinkSide texels along each side.
inline constexpr int kLinkSide = 256;
inline constexpr int kMostLinks = 64; // of a list: what effects/passes/pyramid_links.fxh reads
inline constexpr int kLinkVersion = 8;

struct SkinLinks {
    Image sheet;           // RGBA: tiles x tiles maps of kLinkSide, below each the quarters, as the effect reads it; for half floats
    int tiles = 0;         // along each side
    std::size_t lists = 0; // texels that have any
    std::size_t links = 0;
    std::size_t longest = 0;
    std::size_t quarters = 0; // lists of quarters of texels that are too wide for the fifth Gaussian, within `lists`
    bool fourth = false;      // the fourth Gaussian comes along: texels that receive are no larger than it is wide
    double sideMm = 0;        // of a usual texel that receives light
    std::vector<Diagnostic> warnings;
    struct Seconds {
        double cells = 0;
        double links = 0;
        double sheet = 0;
    } seconds;
};

/// The mesh needs texture coordinates: TG7044 where it has none, or none in the unit square. Warns (TG7045) where charts are so many and so
/// scattered that texels too wide for thin skin have one list each.
[[nodiscard]] Result<SkinLinks> makeSkinLinks(const Mesh& mesh, const LinkOptions& options = {});

} // namespace tegument
