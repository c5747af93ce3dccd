#pragma once
// A validated device for each test, and short ways to say what every test needs. Each test ends by asserting that the validation layers,
// synchronization validation included, said nothing.

#include "host/gpu/gpu.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace tegument::gpu {

using Pixel = std::array<float, 4>;

inline constexpr Pixel kRed = {1, 0, 0, 1};
inline constexpr Pixel kGreen = {0, 1, 0, 1};

/// The value, or the end of the test with the error's text.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(format(result.error()));
    return *std::move(result);
}
inline void must(const Result<void>& result) {
    if (!result) throw std::runtime_error(format(result.error()));
}

/// The code of the first diagnostic; 0 when there was no error.
template <class T>
int codeOf(const Result<T>& result) {
    return result ? 0 : result.error().diagnostics.front().code;
}

template <class T>
std::vector<T> fromBytes(std::span<const std::byte> bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

template <class T>
std::span<const std::byte> bytesOf(const T& values) {
    return std::as_bytes(std::span(values));
}

template <class T>
std::span<const std::byte> objectBytes(const T& object) {
    return std::as_bytes(std::span(&object, 1));
}

class Gpu : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    Device& device() { return *device_; }

    Texture target(Format format, std::uint32_t width, std::uint32_t height);
    Texture texture(std::uint32_t width, std::uint32_t height, const std::vector<Pixel>& pixels); // RGBA32F
    std::vector<Pixel> pixels(Texture& texture, std::uint32_t mip = 0);                           // of RGBA32F
    std::vector<float> floats(Texture& texture) { return fromBytes<float>(must(device().readback(texture))); }
    Sampler sampler(Filter filter, Address address);

    /// A full-screen draw: no vertex stream, no culling, no depth test.
    static PipelineDesc screen(std::span<const std::uint32_t> pixelShader, std::vector<Binding> bindings, std::vector<Format> colors);
    static Draw screenDraw(const Pipeline& pipeline, std::vector<BoundResource> resources = {});
    /// Set 0 has a texture at binding 1 and its sampler at 2, and one colour of RGBA32F is drawn into.
    Pipeline reading(std::span<const std::uint32_t> pixelShader);
    /// One frame with one draw.
    Result<std::vector<TimedSection>> drawOnce(const Targets& targets, const Draw& draw);

    bool messagesExpected = false;

private:
    std::optional<Device> device_;
};

/// With targets of 4 x 4 texels, a pipeline that draws in a colour, and one that copies a texture.
class Drawing : public Gpu {
protected:
    void SetUp() override;
    Draw copyDraw(Texture& source) { return screenDraw(copy_, {{0, 1, &source}, {0, 2, &point_}}); }

    Texture image_, other_, depth_;
    Sampler point_;
    Pipeline color_, copy_;
    Pixel white_ = {1, 1, 1, 1};
};

} // namespace tegument::gpu
