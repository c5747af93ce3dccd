#include "meshprep/skin/wide_texels.h"

#include "meshprep/skin/link_receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

/// Along a texel's longer axis, mm: the largest stretch from the map to the surface.
float longest(const LinkCells::Middle& middle) {
    const float uu = glm::dot(middle.alongU, middle.alongU);
    const float vv = glm::dot(middle.alongV, middle.alongV);
    const float uv = glm::dot(middle.alongU, middle.alongV);
    const float mean = (uu + vv) / 2;
    const float stretch = std::sqrt(mean + std::sqrt(std::max(mean * mean - (uu * vv - uv * uv), 0.0F)));
    return stretch * (kSamplesAlongCell << kDestinationLevel);
}

/// What is held against the limits, mm: the side, or that of a square whose diagonal is the longer axis. 0 beyond kWideTo.
float sideOf(const LinkCells::Middle& middle) {
    return middle.side < kWideTo ? std::max(middle.side, longest(middle) / std::numbers::sqrt2_v<float>) : 0;
}

/// Lists, those beside charts among them, for each texel of charts: 1.05 to 1.16 in atlases of heads and bodies,
/// 1.3 of 64 charts, 1.6 of 256, 2 to 3 of a chart for each triangle.
constexpr double kScattered = 1.25;
constexpr float kWider = 1.1F;
constexpr float kNoTexel = -1;

} // namespace

static_assert(WideTexels::kAlong * 2 == kLinkSide);

WideTexels::WideTexels(const Mesh& mesh, const LinkCells& cells) {
    std::vector<float> sides(static_cast<std::size_t>(kLinkSide) * kLinkSide, kNoTexel);
    double charts = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const glm::ivec2 texel(i % kLinkSide, i / kLinkSide);
        if (const auto middle = cells.middle(mesh, kDestinationLevel, texel.x, texel.y, kLinksBeside)) sides[i] = sideOf(*middle);
        charts += static_cast<double>(cells.at(kDestinationLevel, texel.x, texel.y).covered);
    }
    find(sides);
    const auto lists = static_cast<double>(std::ranges::count_if(sides, [](float side) { return side != kNoTexel; }));
    const bool scattered = lists > kScattered * charts;
    for (; scattered && blocks_.size() > kMostScatteredBlocks; find(sides))
        from_ *= kWider;
}

void WideTexels::find(const std::vector<float>& sides) {
    wide_.assign(sides.size(), 0);
    std::ranges::transform(sides, wide_.begin(), [&](float side) { return side > from_ ? 1 : 0; });
    blocks_.clear();
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const glm::ivec2 texel(i % kLinkSide, i / kLinkSide);
        bool near = false;
        for (int k = 0; k < 9; ++k)
            near = near || isWide(texel + glm::ivec2(k % 3 - 1, k / 3 - 1));
        if (near && sides[i] != kNoTexel) blocks_.push_back(texel);
    }
}

bool WideTexels::isWide(const glm::ivec2& texel) const {
    if (texel.x < 0 || texel.y < 0 || texel.x >= kLinkSide || texel.y >= kLinkSide) return false;
    return wide_[static_cast<std::size_t>(texel.y) * kLinkSide + static_cast<std::size_t>(texel.x)] != 0;
}

// A bilinear look-up at the quarter's middle, as the level of the quarters reads that of the texels.
double WideTexels::share(const glm::ivec2& quarter) const {
    const glm::ivec2 own = quarter / 2;
    const glm::ivec2 next = own + 2 * (quarter % 2) - 1;
    const auto wide = [&](int x, int y) { return isWide({x, y}) ? 1.0 : 0.0; };
    return (9 * wide(own.x, own.y) + 3 * wide(next.x, own.y) + 3 * wide(own.x, next.y) + wide(next.x, next.y)) / 16;
}

} // namespace tegument
