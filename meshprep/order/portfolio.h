#pragma once
// Which order suits which cache.

#include "meshprep/order/algorithms.h"
#include "meshprep/order/order.h"

namespace tegument::order {

/// The faces of a piece in the order of one method, which is not `Method::Best`.
[[nodiscard]] Corners orderPiece(const Piece& piece, Method method, const CacheModel& cache);

struct BestOrder {
    Corners corners;
    bool sortedToo = false; // `betterSorted` may find a better one
};

/// All triangles in the order with the fewest misses in `cache` of those that suit it, judged on the whole: what came in is one of them.
/// `triangles`: of the mesh that they are a part of, if so.
[[nodiscard]] BestOrder bestOrder(std::span<const std::uint32_t> indices, std::size_t vertexCount, const CacheModel& cache,
                                  std::size_t triangles = 0);

/// Of an order and meshoptimizer's of what is sorted by place the one with fewer misses.
[[nodiscard]] Corners betterSorted(Corners best, std::span<const std::uint32_t> indices, std::size_t vertexCount, const CacheModel& cache,
                                   std::span<const float> places);

} // namespace tegument::order
