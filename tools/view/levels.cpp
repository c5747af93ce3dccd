#include "tools/view/levels.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tegument::view {

namespace {

constexpr double kShare = 0.01;     // of the texels at each end may clip
constexpr double kLight = 2;        // light above this is spread
constexpr double kUnlike = 16;      // channels are of different kinds
constexpr float kSmallest = 1e-30F; // a narrower range is one value

struct Range {
    float low = 0;
    float high = 0;
    [[nodiscard]] float width() const { return high - low; }
};

/// Texels that something was drawn into, with finite values.
std::vector<std::size_t> writtenTexels(const Image& image, int colors) {
    std::vector<std::size_t> texels;
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t first = 0; first < image.pixels.size(); first += channels) {
        const auto begin = image.pixels.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + colors;
        if (std::all_of(begin, end, [](float v) { return std::isfinite(v); }) && std::any_of(begin, end, [](float v) { return v != 0; }))
            texels.push_back(first);
    }
    return texels;
}

Range rangeOf(const Image& image, const std::vector<std::size_t>& texels, int channel) {
    std::vector<float> values;
    values.reserve(texels.size());
    for (const std::size_t first : texels)
        values.push_back(image.pixels[first + static_cast<std::size_t>(channel)]);
    const auto at = [&values](double share) {
        const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::ranges::nth_element(values, nth);
        return *nth;
    };
    return {.low = at(kShare), .high = at(1 - kShare)};
}

bool isLight(const std::vector<Range>& ranges) {
    return std::ranges::all_of(ranges, [](const Range& range) { return range.low >= 0 && range.high <= kLight; });
}

bool areUnlike(const std::vector<Range>& ranges) {
    float least = INFINITY;
    float most = 0;
    for (const Range& range : ranges) {
        least = std::min(least, range.width());
        most = std::max(most, range.width());
    }
    return most > kUnlike * std::max(least, kSmallest);
}

void spread(std::vector<Range>& ranges) {
    if (areUnlike(ranges)) return;
    Range all = ranges.front();
    for (const Range& range : ranges)
        all = {.low = std::min(all.low, range.low), .high = std::max(all.high, range.high)};
    std::ranges::fill(ranges, all);
}

void spreadChannel(Levels& levels, std::size_t channel, const Range& range) {
    const float width = std::max(range.width(), kSmallest);
    levels.scale[channel] = 1 / width;
    levels.offset[channel] = -range.low / width;
}

} // namespace

Levels levelsOf(const Image& image) {
    const int colors = std::min(image.channels, 3);
    Levels levels{.channel = image.channels == 1 ? 1 : 0, .toneMap = true, .encode = true};
    const std::vector<std::size_t> texels = writtenTexels(image, colors);
    if (texels.empty()) return levels;
    std::vector<Range> ranges;
    for (int channel = 0; channel < colors; ++channel)
        ranges.push_back(rangeOf(image, texels, channel));
    if (image.channels == 4)
        if (const Range alpha = rangeOf(image, texels, 3); alpha.low < 0 || alpha.high > 1) spreadChannel(levels, 3, alpha);
    if (colors > 1 && isLight(ranges)) return levels;
    spread(ranges);
    levels.toneMap = false;
    levels.encode = false;
    for (std::size_t channel = 0; channel < ranges.size(); ++channel)
        spreadChannel(levels, channel, ranges[channel]);
    return levels;
}

Levels brightened(const Levels& levels, double stops) {
    Levels result = levels;
    const auto factor = static_cast<float>(std::exp2(stops));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result.scale[channel] *= factor;
        result.offset[channel] *= factor;
    }
    return result;
}

} // namespace tegument::view
