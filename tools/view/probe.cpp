#include "tools/view/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace tegument::view {

namespace {

std::string nameOf(const ProbedTexel& target) {
    const std::string name = target.name.empty() ? "picture" : target.name;
    return target.level > 0 ? fmt::format("{}, level {}", name, target.level) : name;
}

std::string lineOf(const ProbedTexel& target, std::size_t width) {
    std::string text = fmt::format("{:<{}} {:>4},{:>4}", nameOf(target), width, target.at.x, target.at.y);
    for (const float value : target.values)
        text += fmt::format(" {:>8.4g}", value);
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

glm::ivec2 texelAt(glm::dvec2 place, glm::ivec2 size) {
    const auto along = [](double share, int count) { return std::clamp(static_cast<int>(share * count), 0, std::max(count - 1, 0)); };
    return {along(place.x, size.x), along(place.y, size.y)};
}

ProbedTexel probedTexel(std::string name, const Image& image, glm::dvec2 place) {
    ProbedTexel texel{.name = std::move(name), .level = 0, .at = texelAt(place, {image.width, image.height})};
    if (image.width > 0 && image.height > 0)
        for (int c = 0; c < image.channels; ++c)
            texel.values.push_back(image.at(texel.at.x, texel.at.y, c));
    return texel;
}

std::vector<std::string> probeLines(const std::vector<ProbedTexel>& targets, const std::string& shown, glm::dvec2 place) {
    std::vector<std::string> lines = {fmt::format("at {:.4f}, {:.4f}", place.x, place.y)};
    std::size_t width = 0;
    for (const ProbedTexel& target : targets)
        width = std::max(width, nameOf(target).size());
    for (const bool first : {true, false})
        for (const ProbedTexel& target : targets)
            if ((target.name == shown) == first) lines.push_back(lineOf(target, width));
    return lines;
}

std::vector<std::string> besideLines(const ProbedTexel& picture, const ProbedTexel& beside) {
    if (picture.values.empty() || beside.values.empty()) return {};
    std::string values = fmt::format("beside     {:>4},{:>4}", beside.at.x, beside.at.y);
    std::string less = "difference          ";
    std::string share = "relative            ";
    for (std::size_t c = 0; c < std::min({picture.values.size(), beside.values.size(), std::size_t{3}}); ++c) {
        const auto value = static_cast<double>(beside.values[c]);
        const double apart = static_cast<double>(picture.values[c]) - value;
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
