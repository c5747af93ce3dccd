#pragma once
// Figures of a mesh: what its order is measured by, and its bytes.
// Triangles in the order in which those that hide others tend to come first.

#include "host/mesh/mesh.h"
#include "meshprep/order/cache.h"

#include <array>
#include <cstddef>

namespace tegument::prep {

struct NamedModel {
    std::string_view name;
    order::CacheModel model;
};

/// What every report measures: caches as in the literature, and batches of three makers' GPUs: warp (NVIDIA-like), wave (64 vertices or 128
/// triangles with a cache of 14, AMD-like), fifo128 (Intel-like), with the settings that meshoptimizer's author fitted to them.
inline constexpr std::array<NamedModel, 7> kReportedModels = {
    {{"fifo12", order::fifo(12)},
     {"fifo16", order::fifo(16)},
     {"fifo24", order::fifo(24)},
     {"fifo32", order::fifo(32)},
     {"warp", order::kWarp},
     {"wave", {.replacement = order::Replacement::Fifo, .entries = 14, .batchVertices = 64, .batchTriangles = 128}},
     {"fifo128", order::fifo(128)}}};

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

/// Fragments shaded per pixel covered, mean over views along the axes: 1 at best.
struct Overdraw {
    double before = 0;
    double after = 0;
};

/// Clusters of triangles are sorted (P. Sander, D. Nehab, J. Barczak, 2007); vertex reuse may get this much worse.
inline constexpr float kOverdrawThreshold = 1.05f;
Overdraw orderForOverdraw(Mesh& mesh);

} // namespace tegument::prep
