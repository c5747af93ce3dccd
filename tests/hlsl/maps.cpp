#include "tests/hlsl/maps.h"

#include <cmath>
#include <cstdint>

namespace tegument::test {

namespace {

/// Scattered bits of a texel's place, so that the exceptions are not in a pattern.
std::uint32_t scattered(int x, int y) {
    auto h = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ static_cast<std::uint32_t>(y) * 0x85ebca77U;
    h ^= h >> 15U;
    h *= 0x2c1b3c6dU;
    return h ^ (h >> 12U);
}

template <class Texel>
TestMap fill(Texel texel) {
    return mapOf(kTestMapSize, kTestMapSize, texel);
}

float wave(int x, int y, double period, double phase) {
    return static_cast<float>(0.5 + 0.5 * std::sin((x + 0.7 * y) / period + phase));
}

} // namespace

std::array<float, 4> texelOf(double x, double y, double z, double w) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

std::array<float, 4> texelOf(const glm::dvec4& v) {
    return texelOf(v.x, v.y, v.z, v.w);
}

TestMap oneTexel(double x, double y, double z, double w) {
    return {.size = 1, .texels = {texelOf(x, y, z, w)}};
}

const TestMap& shadowMap() {
    static const TestMap kMap = fill([](int x, int y) -> std::array<float, 4> {
        if (scattered(x, y) % 29 == 0) return {0, 0, 0, 0};
        const float step = x > 100 && x < 140 ? -6.0F : 0.0F;
        const float seam = y > 128 ? 0.4F : 0.0F;
        return {600 + 3 * wave(x, y, 9, 0) + step, 0.002F * static_cast<float>(x) + seam, 0.002F * static_cast<float>(y), 1};
    });
    return kMap;
}

const TestMap& halvesMap() {
    static const TestMap kMap = fill([](int x, int y) -> std::array<float, 4> {
        const glm::dvec4 texel = shadowMap().texel(x, y);
        const auto depth = static_cast<float>(texel.x);
        return {depth, std::round(depth), depth - std::round(depth), static_cast<float>(texel.w)};
    });
    return kMap;
}

const TestMap& irradianceMap() {
    static const TestMap kMap = fill([](int x, int y) -> std::array<float, 4> {
        const bool block = x > 60 && x < 90 && y > 60 && y < 90;
        if (block || y % 37 == 0 || scattered(x, y) % 11 == 0) return {0, 0, 0, 1};
        return {2 * wave(x, y, 5, 0), wave(x, y, 3, 1), 0.1F * wave(x, y, 2, 2), 0.99F * wave(x, y, 7, 3)};
    });
    return kMap;
}

const TestMap& addressMap() {
    static const TestMap kMap = fill([](int x, int y) -> std::array<float, 4> {
        std::array<float, 4> texel{};
        for (int i = 0; i < 4; ++i) {
            const std::uint32_t bits = scattered(4 * x + i, y);
            texel[static_cast<std::size_t>(i)] = bits % 7 == 0 ? 0.0F : static_cast<float>(bits % 8001);
        }
        return texel;
    });
    return kMap;
}

} // namespace tegument::test
