#include "tools/view/unfold.h"

#include "host/run/pixels.h"

#include <algorithm>
#include <array>
#include <span>

namespace tegument::view {

namespace {

constexpr std::uint32_t kMostTexels = 512; // of a face; a large cube would take more memory unfolded than it has itself
constexpr int kAcross = 4;
constexpr int kDown = 3;

struct Cell {
    int x = 0;
    int y = 0;
};
/// In the order of the faces: +X -X +Y -Y +Z -Z.
constexpr std::array<Cell, 6> kCells = {Cell{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};

void put(const Image& face, int side, const Cell& cell, std::vector<float>& texels) {
    const int step = std::max(1, face.width / side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int c = 0; c < 4; ++c) {
                const float alpha = c == 3 ? 1.0F : 0.0F;
                const std::size_t row = static_cast<std::size_t>(cell.y * side + y) * static_cast<std::size_t>(kAcross * side);
                const std::size_t at = 4 * (row + static_cast<std::size_t>(cell.x * side + x)) + static_cast<std::size_t>(c);
                texels[at] = c < face.channels ? face.at(x * step, y * step, c) : alpha;
            }
}

Result<void> unfoldLevel(gpu::Device& device, gpu::Texture& cube, std::uint32_t level, int side, gpu::Texture& flat,
                         std::uint32_t flatLevel) {
    std::vector<float> texels(static_cast<std::size_t>(4 * kAcross * kDown * side * side));
    for (std::uint32_t face = 0; face < kCells.size(); ++face) {
        const auto image = run::readBack(device, cube, level, face);
        if (!image) return image.error();
        put(*image, side, kCells.at(face), texels);
    }
    return device.upload(flat, std::as_bytes(std::span(texels)), flatLevel);
}

} // namespace

Result<gpu::Texture> unfolded(gpu::Device& device, gpu::Texture& cube) {
    const std::uint32_t levels = cube.desc().mips;
    std::uint32_t first = 0;
    while (first + 1 < levels && (cube.desc().width >> first) > kMostTexels)
        ++first;
    std::uint32_t side = std::max(1U, cube.desc().width >> first);
    while (side > kMostTexels)
        side /= 2;
    std::uint32_t count = 1; // of sides that are no power of two the first ones alone: the others would not meet
    while (first + count < levels && (side >> count) << count == side)
        ++count;
    auto flat = device.createTexture({.name = cube.desc().name + ", unfolded",
                                      .format = gpu::Format::RGBA32F,
                                      .width = kAcross * side,
                                      .height = kDown * side,
                                      .mips = count});
    if (!flat) return flat;
    for (std::uint32_t level = first; level < first + count; ++level) {
        const std::uint32_t now = side >> (level - first);
        if (const auto done = unfoldLevel(device, cube, level, static_cast<int>(now), *flat, level - first); !done) return done.error();
    }
    return flat;
}

} // namespace tegument::view
