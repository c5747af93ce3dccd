#pragma once
// Vertices of fewer bytes, with what that costs.

#include "host/mesh/mesh.h"

namespace tegument::prep {

enum class VertexPrecision { Float, Half, Unorm16 };

struct VertexError {
    double positionMm = 0;    // greatest
    double normalDegrees = 0; // greatest
    double uv = 0;            // greatest, in units of the texture's side
};

/// Bytes of one vertex with what the mesh has: three numbers of 16 bits take 8 bytes, because elements begin at multiples of 4.
[[nodiscard]] std::size_t vertexBytes(const Mesh& mesh, VertexPrecision precision);

/// Replaces every number by the one that is nearest in that precision. TG7026 when positions exceed what a half float holds.
[[nodiscard]] Result<VertexError> reducePrecision(Mesh& mesh, VertexPrecision precision);

} // namespace tegument::prep
