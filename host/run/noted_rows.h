#pragma once
// Whether a target holds what a compute pass notes of a part's strands: rows that do not fit would be lost in silence.

#include "host/run/prepare.h"

#include <cstdint>

namespace tegument::run {

/// Rows of roots that the part takes in the texture of roots, 1,365 roots to a row; 0 where the mesh has no such part or it holds no
/// ribbons.
[[nodiscard]] std::uint32_t rootRowsOf(const Mesh& mesh, const std::string& part);

/// Of a compute pass with the annotation Rows, a target: that it has as many rows as rows of roots (of the part that Part names), times
/// strands of a root (the sum of the parameters RowsStrands and RowsMore; 1), times rows of a strand (RowsEach segments times RowsScale,
/// rounded up, and one), and that the target Threads has as many as there are of roots. TG4064: it has fewer; the hint says how many are
/// wanted, and by which macro (RowsMacro) they are given.
[[nodiscard]] Result<void> checkNotedRows(const RunInput& input, const Prepared& prepared, const Pass& pass);

} // namespace tegument::run
