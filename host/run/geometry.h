#pragma once
// The vertex stream (docs/conventions.md): POSITION float3, NORMAL float3, TANGENT float4, TEXCOORD0 float2, interleaved. The full-screen
// quad has the same stream, so a pipeline serves both kinds of drawing. Needs no GPU.

#include "host/effect/model.h"
#include "host/mesh/mesh.h"
#include "host/spirv/compile.h"
#include "host/support/layout.h"

#include <cstdint>
#include <vector>

namespace tegument::run {

inline constexpr std::uint32_t kVertexStride = 12 * sizeof(float);

/// Interleaved floats, 12 a vertex, skin as a pose has it; missing normals, tangents and UVs are zeros (no shader that reads them gets this
/// far).
[[nodiscard]] std::vector<float> interleave(const Mesh& mesh);
/// Clip space, texel row 0 (v = 0) at the top, front faces counter-clockwise.
[[nodiscard]] Mesh fullScreenQuad();

/// TG4042: the vertex shader reads something that the stream does not have.
[[nodiscard]] Result<std::vector<VertexAttribute>> bindStream(const Pass& pass, const Reflection& vertex);

/// What a technique says of meshes without texture coordinates.
struct WithoutUvs {
    bool drawn = false;  // it draws them: the stream holds (0, 0), and tangents across the normals
    std::string instead; // what draws them otherwise; may be empty
};
/// TG4040 there is no mesh, TG4041 the mesh has no UVs and the pass reads them (or tangents, which need them).
[[nodiscard]] Result<void> checkMesh(const Pass& pass, const Reflection& vertex, const Mesh* mesh, const WithoutUvs& without);

} // namespace tegument::run
