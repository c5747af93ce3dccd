#pragma once
// Texels that receive light by links and are too wide for the narrower Gaussian of these: each has lists for its four quarters.

#include "meshprep/skin/link_cells.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tegument {

/// Sides of a texel of kDestinationLevel, mm, as the root of its area. From the first on, or where its longer axis is sqrt(2) of that, the
/// fifth Gaussian, 1.41 mm wide, is not to be had from its spline where skin is thin. From 6.8 on levels bring all of that Gaussian
/// (kWideTexel of effects/passes/pyramid.fxh), so beyond the second, which leaves room for how the effect measures sides, nothing is
/// gained.
inline constexpr float kWideFrom = 2.4F;
inline constexpr float kWideTo = 8;
/// A map most of whose texels lie at borders of charts has quarters for at most so many texels: four lists for each would take five times
/// as long as a map of one chart. Its narrowest wide texels then go without.
inline constexpr std::size_t kMostScatteredBlocks = 12'288;

class WideTexels {
public:
    WideTexels(const Mesh& mesh, const LinkCells& cells);

    /// Side from which texels count as wide, mm: kWideFrom, or more where a map of scattered charts has too many of them.
    [[nodiscard]] float from() const { return from_; }

    [[nodiscard]] bool isWide(const glm::ivec2& texel) const;
    /// Texels whose quarters have lists: the wide ones, and those around them, whose spline would read the wide ones.
    [[nodiscard]] const std::vector<glm::ivec2>& blocks() const { return blocks_; }
    /// What of the light at a quarter, counted in quarters, the spline through texels that are not wide leaves to its own list.
    [[nodiscard]] double share(const glm::ivec2& quarter) const;

    /// Where the quarters of a block are kept, 2 x 2: counted in blocks, `kAlong` beside each other.
    static constexpr int kAlong = 128;
    [[nodiscard]] static glm::ivec2 placeOf(std::size_t block) { return {block % kAlong, block / kAlong}; }
    /// Rows that they take.
    [[nodiscard]] int rows() const { return 2 * static_cast<int>((blocks_.size() + kAlong - 1) / kAlong); }

private:
    void find(const std::vector<float>& sides);

    float from_ = kWideFrom;
    std::vector<std::uint8_t> wide_;
    std::vector<glm::ivec2> blocks_;
};

} // namespace tegument
