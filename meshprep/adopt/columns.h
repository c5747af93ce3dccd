#pragma once
// Which way round the author's host hands over matrices: for rows, as Direct3D 9's own effect runtime has it, or for columns.

#include "meshprep/adopt/code.h"

#include <set>
#include <string>

namespace tegument::adopt {

/// Whether projections stand before what they project (`mul(worldViewProj, position)`) and nowhere behind it, as in effects of hosts that
/// count in columns. `projections`: parameters that the host fills with one.
[[nodiscard]] bool multipliesColumns(const Code& code, const std::set<std::string>& projections);

/// The same matrix for the other side of a product: "VIEW" and "VIEWTRANSPOSE".
[[nodiscard]] std::string transposedSemantic(const std::string& semantic);

} // namespace tegument::adopt
