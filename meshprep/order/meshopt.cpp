#include "meshprep/order/algorithms.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace tegument::order {

namespace {

/// meshopt_optimizeVertexCache looks at all faces of each vertex that it draws, which takes quadratic time round one of very many
/// (180 ms for 20,000, 4.3 s for 100,000); its variant for a FIFO cache does not.
constexpr std::uint32_t kMostFacesOfAVertex = 1000;

constexpr unsigned kStripEntries = 16; // where it cannot be had

bool crowded(const Piece& piece) {
    for (std::uint32_t v = 0; v < piece.vertexCount; ++v)
        if (piece.around.count(v) > kMostFacesOfAVertex) return true;
    return false;
}

} // namespace

Corners meshoptFifo(const Piece& piece, unsigned entries) {
    Corners out(piece.corners.size());
    meshopt_optimizeVertexCacheFifo(out.data(), piece.corners.data(), out.size(), piece.vertexCount, std::max(entries, 4u));
    return out;
}

Corners sortedByPlace(std::span<const std::uint32_t> corners, std::span<const float> places) {
    Corners out(corners.size());
    meshopt_spatialSortTriangles(out.data(), corners.data(), corners.size(), places.data(), places.size() / 3, 3 * sizeof(float));
    return out;
}

Corners meshoptStrip(const Piece& piece) {
    Corners out(piece.corners.size());
    if (crowded(piece)) return meshoptFifo(piece, kStripEntries);
    meshopt_optimizeVertexCacheStrip(out.data(), piece.corners.data(), out.size(), piece.vertexCount);
    return out;
}

Corners meshopt(const Piece& piece, unsigned entries) {
    Corners out(piece.corners.size());
    if (crowded(piece))
        out = meshoptFifo(piece, entries);
    else
        meshopt_optimizeVertexCache(out.data(), piece.corners.data(), out.size(), piece.vertexCount);
    return out;
}

} // namespace tegument::order
