#pragma once
// Figures that tell good fur from bad without a person's eye: are all strands there, how evenly do they stand, how much do they cover.

#include "host/image/image.h"
#include "meshprep/fur/strands.h"

namespace tegument {

struct StrandStatistics {
    std::size_t count = 0;
    std::size_t wanted = 0;
    double nearestLeast = 0; // distance to the nearest neighbour, in texels
    double nearestMean = 0;
    double nearestCv = 0; // standard deviation over mean; 0.52 for independent points (2D Poisson process: sqrt(4/pi - 1))
    double patchCv = 0;   // of the count of strands in patches of equal area
    double poissonCv = 0; // what independent points would give: sqrt(patches / count)
};

[[nodiscard]] StrandStatistics statisticsOnTexture(const StrandSet& set, int width, int height);
[[nodiscard]] StrandStatistics statisticsOnSphere(const StrandSet& set, std::size_t texels);

/// The index of the evenest set among those with the most strands: the least patchCv.
[[nodiscard]] std::size_t evenest(const std::vector<StrandStatistics>& candidates);

/// How the heights (alpha) of a map differ: what a shader needs where its texels are finer than pixels (docs/design/fur.md, "Seen from
/// afar").
struct HeightStatistics {
    double mean = 0;
    double deviation = 0;
    double grain = 0; // texels: footprints that wide hold half of the variance; 0 where nothing differs
};
[[nodiscard]] HeightStatistics statisticsOfHeights(const Image& map);

} // namespace tegument
