#include "host/view/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace tegument::view {

namespace {

/// The texel that a share of the width lies in.
int texelAt(double share, int size) {
    return std::clamp(static_cast<int>(share * size), 0, std::max(size - 1, 0));
}

std::string nameOf(const ProbedTarget& target) {
    return target.name.empty() ? "picture" : target.name;
}

std::string lineOf(const ProbedTarget& target, std::size_t width, glm::dvec2 place) {
    const Image& image = *target.image;
    if (image.width <= 0 || image.height <= 0) return nameOf(target);
    const int x = texelAt(place.x, image.width);
    const int y = texelAt(place.y, image.height);
    std::string text = fmt::format("{:<{}} {:>4},{:>4}", nameOf(target), width, x, y);
    for (int c = 0; c < image.channels; ++c)
        text += fmt::format(" {:>8.4g}", image.at(x, y, c));
    return text;
}

} // namespace

std::optional<glm::dvec2> placeOnPicture(glm::dvec2 cursor, glm::ivec2 picture, glm::ivec2 window) {
    if (picture.x <= 0 || picture.y <= 0 || window.x <= 0 || window.y <= 0) return std::nullopt;
    const double scale = std::min(static_cast<double>(window.x) / picture.x, static_cast<double>(window.y) / picture.y);
    const glm::dvec2 shares(scale * picture.x / window.x, scale * picture.y / window.y); // of the window that the picture fills
    const glm::dvec2 place = (cursor - 0.5) / shares + 0.5;
    const bool inside = place.x >= 0 && place.x < 1 && place.y >= 0 && place.y < 1;
    return inside ? std::optional(place) : std::nullopt;
}

std::vector<std::string> probeLines(const std::vector<ProbedTarget>& targets, const std::string& shown, glm::dvec2 place) {
    std::vector<std::string> lines = {fmt::format("at {:.4f}, {:.4f}", place.x, place.y)};
    std::size_t width = 0;
    for (const ProbedTarget& target : targets)
        width = std::max(width, nameOf(target).size());
    for (const bool first : {true, false})
        for (const ProbedTarget& target : targets)
            if ((target.name == shown) == first) lines.push_back(lineOf(target, width, place));
    return lines;
}

std::vector<std::string> besideLines(const Image& image, const Image& beside, glm::dvec2 place) {
    if (image.pixels.empty() || beside.pixels.empty()) return {};
    const glm::ivec2 here(texelAt(place.x, image.width), texelAt(place.y, image.height));
    const glm::ivec2 there(texelAt(place.x, beside.width), texelAt(place.y, beside.height));
    std::string values = fmt::format("beside     {:>4},{:>4}", there.x, there.y);
    std::string less = "difference          ";
    std::string share = "relative            ";
    for (int c = 0; c < std::min({image.channels, beside.channels, 3}); ++c) {
        const auto value = static_cast<double>(beside.at(there.x, there.y, c));
        const double apart = static_cast<double>(image.at(here.x, here.y, c)) - value;
        values += fmt::format(" {:>8.4g}", value);
        less += fmt::format(" {:>8.2g}", apart);
        share += value == 0 ? fmt::format(" {:>8}", "-") : fmt::format(" {:>7.2f}%", 100 * apart / value);
    }
    return {values, less, share};
}

Histogram histogramOf(const Image& image) {
    const auto stride = static_cast<std::size_t>(image.channels);
    const std::size_t colors = std::min<std::size_t>(stride, Histogram::kChannels);
    Histogram histogram{.channels = static_cast<int>(colors)};
    std::vector<std::size_t> written; // where a texel begins
    bool any = false;
    for (std::size_t first = 0; first + stride <= image.pixels.size(); first += stride) {
        const std::span<const float> texel = std::span(image.pixels).subspan(first, colors);
        if (std::ranges::all_of(texel, [](float value) { return value == 0; })) continue;
        written.push_back(first);
        for (const float value : texel) {
            histogram.notFinite += std::isfinite(value) ? 0U : 1U;
            if (!std::isfinite(value)) continue;
            histogram.low = any ? std::min(histogram.low, value) : value;
            histogram.high = any ? std::max(histogram.high, value) : value;
            any = true;
        }
    }
    const double width = static_cast<double>(histogram.high) - static_cast<double>(histogram.low);
    for (const std::size_t first : written)
        for (std::size_t c = 0; c < colors; ++c) {
            const float value = image.pixels[first + c];
            if (!std::isfinite(value)) continue;
            const double share = width > 0 ? (static_cast<double>(value) - static_cast<double>(histogram.low)) / width : 0;
            ++histogram.counts[c][std::min(static_cast<std::size_t>(share * Histogram::kBins), Histogram::kBins - 1)];
        }
    return histogram;
}

} // namespace tegument::view
