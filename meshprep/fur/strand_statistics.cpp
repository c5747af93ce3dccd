#include "meshprep/fur/strand_statistics.h"

#include "meshprep/fur/root_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tegument {

namespace {

constexpr int kPatchesAcross = 16; // 256 patches: a few dozen strands in each at the sizes in use

struct Moments {
    double mean = 0;
    double cv = 0;
};

template <class Values>
Moments momentsOf(const Values& values) {
    if (values.empty()) return {};
    double sum = 0;
    for (const auto value : values)
        sum += static_cast<double>(value);
    const double mean = sum / static_cast<double>(values.size());
    double squares = 0;
    for (const auto value : values)
        squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
    return {mean, mean > 0 ? std::sqrt(squares / static_cast<double>(values.size())) / mean : 0};
}

/// For each strand the distance to its nearest neighbour; strands alone within reach of three mean gaps count as that reach.
template <class Space>
std::vector<double> nearestDistances(const StrandSet& set, const Space& space) {
    const double reach = 3 * std::sqrt(space.area() / static_cast<double>(std::max<std::size_t>(set.strands.size(), 1)));
    RootGrid<Space> grid(space, reach, set.strands.size());
    for (std::size_t i = 0; i < set.strands.size(); ++i)
        grid.add(set.strands[i].root, static_cast<std::uint32_t>(i));
    std::vector<double> distances(set.strands.size(), reach);
    for (std::size_t i = 0; i < set.strands.size(); ++i)
        grid.visit(set.strands[i].root, [&](std::uint32_t other, double distance) {
            if (other != i) distances[i] = std::min(distances[i], distance);
        });
    return distances;
}

template <class Space, class PatchOf>
StrandStatistics statistics(const StrandSet& set, const Space& space, double texel, PatchOf&& patchOf) {
    StrandStatistics result{.count = set.strands.size(), .wanted = set.wanted};
    if (set.strands.empty()) return result;
    const std::vector<double> nearest = nearestDistances(set, space);
    const Moments gaps = momentsOf(nearest);
    result.nearestLeast = *std::min_element(nearest.begin(), nearest.end()) / texel;
    result.nearestMean = gaps.mean / texel;
    result.nearestCv = gaps.cv;

    constexpr std::size_t kPatches = std::size_t{kPatchesAcross} * kPatchesAcross;
    std::vector<std::size_t> counts(kPatches, 0);
    for (const Strand& strand : set.strands) {
        const glm::dvec2 at = glm::clamp(patchOf(strand.root), glm::dvec2(0), glm::dvec2(1)) * static_cast<double>(kPatchesAcross);
        const auto column = static_cast<std::size_t>(std::min(static_cast<int>(at.x), kPatchesAcross - 1));
        const auto row = static_cast<std::size_t>(std::min(static_cast<int>(at.y), kPatchesAcross - 1));
        ++counts[row * kPatchesAcross + column];
    }
    result.patchCv = momentsOf(counts).cv;
    result.poissonCv = std::sqrt(static_cast<double>(kPatches) / static_cast<double>(set.strands.size()));
    return result;
}

struct Heights {
    double mean = 0;
    double square = 0;
};

Heights heightsIn(const Image& map, int left, int top, int side) {
    Heights heights;
    for (int y = top; y < top + side; ++y)
        for (int x = left; x < left + side; ++x) {
            const auto height = static_cast<double>(map.at(x, y, 3));
            heights.mean += height;
            heights.square += height * height;
        }
    return {heights.mean / (side * side), heights.square / (side * side)};
}

} // namespace

StrandStatistics statisticsOnTexture(const StrandSet& set, int width, int height) {
    return statistics(set, TorusSpace(width, height), 1.0,
                      [&](const glm::dvec3& root) { return glm::dvec2(root) / glm::dvec2(width, height); });
}

StrandStatistics statisticsOnSphere(const StrandSet& set, std::size_t texels) {
    // Equal heights and equal longitudes bound equal areas (Archimedes).
    return statistics(set, SphereSpace{}, texelAngle(texels), [](const glm::dvec3& root) {
        return glm::dvec2(0.5 - 0.5 * root.z, 0.5 + std::atan2(root.y, root.x) / (2 * std::numbers::pi));
    });
}

std::size_t evenest(const std::vector<StrandStatistics>& candidates) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < candidates.size(); ++i) {
        const bool more = candidates[i].count > candidates[best].count;
        const bool asMany = candidates[i].count == candidates[best].count;
        if (more || (asMany && candidates[i].patchCv < candidates[best].patchCv)) best = i;
    }
    return best;
}

HeightStatistics statisticsOfHeights(const Image& map) {
    constexpr int kBox = 4; // texels: near the scale at which strands as usually drawn differ
    double sum = 0;
    double squares = 0;
    double within = 0; // variance in boxes
    const int columns = map.width / kBox;
    const int rows = map.height / kBox;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto [mean, square] = heightsIn(map, column * kBox, row * kBox, kBox);
            sum += mean;
            squares += square;
            within += square - mean * mean;
        }
    const double count = static_cast<double>(rows) * columns;
    if (count < 1) return {};
    HeightStatistics figures{.mean = sum / count};
    const double variance = squares / count - figures.mean * figures.mean;
    const double share = within / count / variance;
    if (variance < 1e-9 || share >= 1) return figures;
    figures.deviation = std::sqrt(variance);
    // Boxes of n texels hold the share (n^2 - 1) / (n^2 - 1 + grain^2): a texel by itself holds none.
    figures.grain = std::sqrt((kBox * kBox - 1) * (1 - share) / share);
    return figures;
}

} // namespace tegument
