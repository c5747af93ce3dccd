#pragma once
// Which order suits which cache.

#include "meshprep/order/algorithms.h"
#include "meshprep/order/order.h"

namespace tegument::order {

/// The faces of a piece in the order of one method; for `Method::Best` that of the candidates with the fewest misses in `cache`.
[[nodiscard]] Corners orderPiece(const Piece& piece, Method method, const CacheModel& cache);

} // namespace tegument::order
