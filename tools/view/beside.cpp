#include "tools/view/beside.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::view {

namespace {

constexpr int kRgba = 4;
constexpr int kByteBits = 8;
constexpr float kDecades = 3; // from a thousandth of the mean to 1
using Colour = std::array<float, 3>;
constexpr std::array<Colour, 5> kErrorColours = {Colour{0, 0, 0}, Colour{0.1F, 0.2F, 0.9F}, Colour{0.1F, 0.8F, 0.3F}, Colour{1, 0.9F, 0.1F},
                                                 Colour{1, 0.1F, 0.05F}};
constexpr Colour kNotFinite = {1, 0, 1};

Colour errorColour(float error) {
    if (!std::isfinite(error)) return kNotFinite;
    const float share = error <= 0 ? 0 : std::clamp(1 + std::log10(error) / kDecades, 0.0F, 1.0F);
    const float place = share * static_cast<float>(kErrorColours.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), kErrorColours.size() - 2);
    Colour colour{};
    for (std::size_t c = 0; c < colour.size(); ++c)
        colour.at(c) = std::lerp(kErrorColours.at(below).at(c), kErrorColours.at(below + 1).at(c), place - static_cast<float>(below));
    return colour;
}

} // namespace

Image lightOf(const Image& stored) {
    Image light{.width = stored.width, .height = stored.height, .channels = kRgba, .metadata = stored.metadata};
    light.pixels.resize(static_cast<std::size_t>(stored.width) * static_cast<std::size_t>(stored.height) * kRgba, 1);
    const bool bytes = stored.bitsPerChannel == kByteBits;
    for (int y = 0; y < stored.height; ++y)
        for (int x = 0; x < stored.width; ++x)
            for (int c = 0; c < kRgba - 1; ++c) {
                const float value = stored.at(x, y, stored.channels < 3 ? 0 : c); // grey has one channel, perhaps alpha
                light.at(x, y, c) = bytes ? srgbToLinear(value) : value;
            }
    return light;
}

Image displayLight(const Image& radiance) {
    Image shown = displayed(radiance);
    shown.bitsPerChannel = kByteBits;
    return lightOf(shown);
}

std::string errorLine(const Result<Difference>& difference) {
    if (!difference) return difference.error().diagnostics.front().text;
    if (difference->largest == 0 && difference->bias == 0) return "no difference";
    return fmt::format("relative L2 {:.3g}, 99 % within {:.3g}, bias {:+.2g}, largest {:.3g} at ({}, {})", difference->relativeL2,
                       difference->p99, difference->bias, difference->largest, difference->largestX, difference->largestY);
}

Image falseColours(const Image& image, const Image& reference) {
    Image colours = differenceImage(image, reference);
    Image opaque{.width = colours.width, .height = colours.height, .channels = kRgba};
    opaque.pixels.reserve(colours.pixels.size() / 3 * kRgba);
    for (std::size_t first = 0; first + 2 < colours.pixels.size(); first += 3) {
        const float* error = &colours.pixels[first];
        const bool finite = std::isfinite(error[0]) && std::isfinite(error[1]) && std::isfinite(error[2]);
        const Colour colour = finite ? errorColour(std::max({error[0], error[1], error[2]})) : kNotFinite;
        opaque.pixels.insert(opaque.pixels.end(), {colour[0], colour[1], colour[2], 1});
    }
    return opaque;
}

} // namespace tegument::view
