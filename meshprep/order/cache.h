#pragma once
// What an order of triangles costs: runs of the vertex shader under models of how hardware reuses transformed vertices.

#include "host/support/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tegument::order {

enum class Replacement {
    Fifo, // the vertex that came first leaves first; a hit changes nothing
    Lru   // the vertex that was used least recently leaves first
};

/// A cache of `entries` vertices. With batches it starts empty again after so many transformed vertices or triangles (0: no such limit).
struct CacheModel {
    Replacement replacement = Replacement::Fifo;
    unsigned entries = 16;
    unsigned batchVertices = 0;
    unsigned batchTriangles = 0;

    [[nodiscard]] bool batched() const { return batchVertices != 0 || batchTriangles != 0; }
    bool operator==(const CacheModel&) const = default;
};

inline constexpr unsigned kLeastEntries = 3;   // one triangle
inline constexpr unsigned kMostEntries = 1024; // no hardware has more

[[nodiscard]] constexpr CacheModel fifo(unsigned entries) {
    return {.replacement = Replacement::Fifo, .entries = entries};
}
[[nodiscard]] constexpr CacheModel lru(unsigned entries) {
    return {.replacement = Replacement::Lru, .entries = entries};
}

/// Batches of at most 32 vertices and 32 triangles that share nothing: NVIDIA-like (B. Kerbl et al., Revisiting the vertex cache, HPG 2018;
/// the limits are those that meshoptimizer's author fitted to such GPUs).
inline constexpr CacheModel kWarp{.replacement = Replacement::Fifo, .entries = 32, .batchVertices = 32, .batchTriangles = 32};

/// "fifo:K", "lru:K" or "warp"; TG7040 otherwise.
[[nodiscard]] Result<CacheModel> parseCacheModel(std::string_view text);
/// The text that `parseCacheModel` takes; batches other than the warp's: "fifo:14 batch:64/128".
[[nodiscard]] std::string name(const CacheModel& model);

struct CacheCost {
    std::size_t misses = 0;   // vertices transformed
    std::size_t faces = 0;    // triangles drawn
    std::size_t vertices = 0; // named by at least one triangle

    [[nodiscard]] double acmr() const { return faces == 0 ? 0 : static_cast<double>(misses) / static_cast<double>(faces); }
    [[nodiscard]] double atvr() const { return vertices == 0 ? 0 : static_cast<double>(misses) / static_cast<double>(vertices); }
};

/// Plays the index list through the model. Every index must be below `vertexCount`.
[[nodiscard]] CacheCost measure(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertexCount);
/// Its misses alone.
[[nodiscard]] std::size_t countMisses(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertexCount);

} // namespace tegument::order
