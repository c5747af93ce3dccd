#pragma once
// What an order of triangles costs: vertex shader runs under models of the hardware, and bytes.

#include "meshprep/prepare/surface.h"

#include <array>
#include <span>
#include <string_view>

namespace tegument::prep {

/// A model of how transformed vertices are reused. `cache` 0: within a batch only.
struct CacheModel {
    std::string_view name;
    unsigned cache = 0;          // entries, first in first out
    unsigned batchVertices = 0;  // a batch ends with this many vertices...
    unsigned batchTriangles = 0; // ...or this many triangles; 0: there are no batches
};

/// FIFO caches as in the literature, and batches after B. Kerbl et al., Revisiting the vertex cache (HPG 2018): warp (32 vertices or 32
/// triangles, NVIDIA-like), wave (64 vertices or 128 triangles with a cache of 14, AMD-like), fifo128 (Intel-like). The last three are the
/// settings that meshoptimizer's author fitted to those GPUs.
inline constexpr std::array<CacheModel, 7> kCacheModels = {{{"fifo12", 12, 0, 0},
                                                            {"fifo16", 16, 0, 0},
                                                            {"fifo24", 24, 0, 0},
                                                            {"fifo32", 32, 0, 0},
                                                            {"warp", 32, 32, 32},
                                                            {"wave", 14, 64, 128},
                                                            {"fifo128", 128, 0, 0}}};

struct CacheFigures {
    double acmr = 0; // vertices transformed per triangle
    double atvr = 0; // vertices transformed per vertex: 1 at best
};

[[nodiscard]] CacheFigures measure(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertices);

/// Bytes against a list of triangles that share nothing.
struct SizeFigures {
    std::size_t vertexBytes = 0; // of one vertex
    std::size_t indexBytes = 0;  // of one index
    std::size_t before = 0;      // triangles * 3 * vertexBytes
    std::size_t after = 0;       // vertices * vertexBytes + triangles * 3 * indexBytes
    [[nodiscard]] double reduction() const { return 1 - static_cast<double>(after) / static_cast<double>(before); }
};

/// The largest number of vertices that 16-bit indices address: 0xFFFF is left out, it cuts triangle strips.
inline constexpr std::size_t kMost16BitVertices = 65535;

[[nodiscard]] SizeFigures sizes(std::size_t vertices, std::size_t triangles, std::size_t vertexBytes, bool small);

} // namespace tegument::prep
