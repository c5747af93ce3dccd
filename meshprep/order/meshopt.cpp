#include "meshprep/order/algorithms.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace tegument::order {

namespace {

/// meshopt_optimizeVertexCache looks at all faces of each vertex that it draws, which takes quadratic time round one of very many
/// (180 ms for 20,000, 4.3 s for 100,000); its variant for a FIFO cache does not.
constexpr std::uint32_t kMostFacesOfAVertex = 1000;

bool crowded(const Piece& piece) {
    for (std::uint32_t v = 0; v < piece.vertexCount; ++v)
        if (piece.around.count(v) > kMostFacesOfAVertex) return true;
    return false;
}

} // namespace

Corners meshopt(const Piece& piece, unsigned entries) {
    Corners out(piece.corners.size());
    if (crowded(piece))
        meshopt_optimizeVertexCacheFifo(out.data(), piece.corners.data(), out.size(), piece.vertexCount, std::max(entries, 4u));
    else
        meshopt_optimizeVertexCache(out.data(), piece.corners.data(), out.size(), piece.vertexCount);
    return out;
}

} // namespace tegument::order
