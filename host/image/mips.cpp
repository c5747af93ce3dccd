#include "host/image/mips.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

/// What one texel of a row of `to` covers of a row of `from`: first texel and weights.
struct Cover {
    int first = 0;
    int count = 0; // 1 to 3
    std::array<float, 3> weights{};
};

std::vector<Cover> covers(int from, int to) {
    const double width = static_cast<double>(from) / to; // 1, 2, or between 2 and 3
    std::vector<Cover> all;
    for (int texel = 0; texel < to; ++texel) {
        const double start = texel * width;
        Cover cover{.first = static_cast<int>(start)};
        for (int i = 0; i < 3 && cover.first + i < from; ++i) {
            const double share = std::min(start + width, cover.first + i + 1.0) - std::max(start, cover.first + static_cast<double>(i));
            if (share <= 0) break;
            cover.weights[static_cast<std::size_t>(cover.count++)] = static_cast<float>(share / width);
        }
        all.push_back(cover);
    }
    return all;
}

float mean(const Image& image, const Cover& across, const Cover& down, int channel) {
    float sum = 0;
    for (int j = 0; j < down.count; ++j) {
        float row = 0;
        for (int i = 0; i < across.count; ++i)
            row += across.weights[static_cast<std::size_t>(i)] * image.at(across.first + i, down.first + j, channel);
        sum += down.weights[static_cast<std::size_t>(j)] * row;
    }
    return sum;
}

bool isAlpha(const Image& image, std::size_t value) {
    const auto channels = static_cast<std::size_t>(image.channels);
    return channels % 2 == 0 && value % channels == channels - 1;
}

template <class Curve>
Image mapped(Image image, Curve curve) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (!isAlpha(image, i)) image.pixels[i] = curve(image.pixels[i]);
    return image;
}

} // namespace

Image halved(const Image& image) {
    Image half{.width = std::max(image.width / 2, 1),
               .height = std::max(image.height / 2, 1),
               .channels = image.channels,
               .bitsPerChannel = image.bitsPerChannel};
    half.pixels.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                        static_cast<std::size_t>(half.channels));
    const std::vector<Cover> across = covers(image.width, half.width);
    for (const Cover& down : covers(image.height, half.height))
        for (const Cover& texel : across)
            for (int channel = 0; channel < image.channels; ++channel)
                half.pixels.push_back(mean(image, texel, down, channel));
    return half;
}

Image decoded(Image image) {
    if (image.bitsPerChannel != 8) return mapped(std::move(image), srgbToLinear);
    std::array<float, 256> light{}; // a power for each texel of a large map would take longer than all the rest
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = srgbToLinear(static_cast<float>(i) / 255);
    return mapped(std::move(image), [&](float value) {
        return light[static_cast<std::size_t>(static_cast<double>(std::clamp(value, 0.0F, 1.0F) * 255) + 0.5)];
    });
}

Image encoded(Image image) {
    return mapped(std::move(image), linearToSrgb);
}

std::vector<Image> mipLevels(const Image& image, MeanOf mean) {
    std::vector<Image> levels;
    const bool light = mean == MeanOf::Light;
    Image level = light ? decoded(image) : image;
    while (level.width > 1 || level.height > 1) {
        level = halved(level);
        levels.push_back(light ? encoded(level) : level);
    }
    return levels;
}

} // namespace tegument
