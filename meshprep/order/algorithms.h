#pragma once
// The orders, each for one piece. All return the piece's faces as a list of corners: every face once, with its winding.

#include "meshprep/order/piece.h"

#include <limits>

namespace tegument::order {

using Corners = std::vector<std::uint32_t>;

/// For a FIFO cache of `entries` vertices. `first`: the vertex to begin with.
[[nodiscard]] Corners linYu(const Piece& piece, unsigned entries, std::uint32_t first = 0);

/// For a FIFO cache of `entries` vertices; a strip is broken off when more than `limit` vertices would have come since the start of the
/// next. `links`: of `linkFaces`. Nothing comes back when it takes more than `most` misses.
[[nodiscard]] Corners hoppe(const Piece& piece, std::span<const std::uint32_t> links, unsigned entries, unsigned limit,
                            std::size_t most = std::numeric_limits<std::size_t>::max());

inline constexpr std::size_t kBatchVariations = 6;
/// For batches of at most so many vertices and triangles that share nothing. `variation`: which of the rules; the first is the best of
/// most.
[[nodiscard]] Corners batches(const Piece& piece, std::span<const std::uint32_t> links, unsigned vertices, unsigned triangles,
                              std::size_t variation = 0);

/// For a FIFO cache of `entries` vertices.
[[nodiscard]] Corners tipsify(const Piece& piece, unsigned entries);

/// meshoptimizer's; `entries` matter only where a vertex has so many faces that its general order would take quadratic time.
[[nodiscard]] Corners meshopt(const Piece& piece, unsigned entries);

/// meshoptimizer's for a FIFO cache.
[[nodiscard]] Corners meshoptFifo(const Piece& piece, unsigned entries);

/// The triangles along a curve through space; meshoptimizer's. `places`: three coordinates of each vertex.
[[nodiscard]] Corners sortedByPlace(std::span<const std::uint32_t> corners, std::span<const float> places);

/// meshoptimizer's for long strips, which batches like on some meshes.
[[nodiscard]] Corners meshoptStrip(const Piece& piece);

} // namespace tegument::order
