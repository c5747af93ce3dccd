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

bool tooWide(const LinkCells::Middle& middle) {
    return middle.side < kWideTo && (middle.side > kWideFrom || longest(middle) > std::numbers::sqrt2_v<float> * kWideFrom);
}

} // namespace

static_assert(WideTexels::kAlong * 2 == kLinkSide);

WideTexels::WideTexels(const Mesh& mesh, const LinkCells& cells) : wide_(static_cast<std::size_t>(kLinkSide) * kLinkSide, 0) {
    std::vector<std::uint8_t> has(wide_.size(), 0);
    for (std::size_t i = 0; i < wide_.size(); ++i) {
        const auto middle =
            cells.middle(mesh, kDestinationLevel, static_cast<int>(i % kLinkSide), static_cast<int>(i / kLinkSide), kLinksBeside);
        has[i] = middle ? 1 : 0;
        wide_[i] = middle && tooWide(*middle) ? 1 : 0;
    }
    for (std::size_t i = 0; i < wide_.size(); ++i) {
        const glm::ivec2 texel(i % kLinkSide, i / kLinkSide);
        bool near = false;
        for (int k = 0; k < 9; ++k)
            near = near || isWide(texel + glm::ivec2(k % 3 - 1, k / 3 - 1));
        if (near && has[i] != 0) blocks_.push_back(texel);
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
