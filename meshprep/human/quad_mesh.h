#pragma once
// Meshes of quads with face-varying texture coordinates, as modellers keep them: positions and coordinates have indices of their own.

#include "host/support/result.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

struct Quad {
    std::array<std::uint32_t, 4> position{};
    std::array<std::uint32_t, 4> uv{};
};

/// `quads[first]` to `quads[first + count - 1]`.
struct QuadGroup {
    std::string name;
    std::size_t first = 0;
    std::size_t count = 0;
};

struct QuadMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<Quad> quads;
    std::vector<QuadGroup> groups;
};

/// An OBJ text in which every face has four corners with texture coordinates. Positions are multiplied by `unitMm`; v stays as it is in
/// the file, pointing up. `file` is for messages: those of `parseObj`, TG7001, TG7002.
[[nodiscard]] Result<QuadMesh> readQuadObj(std::string_view text, const std::string& file, float unitMm);

/// The quads of every group of that name. TG7004, with the nearest name, when there is none.
[[nodiscard]] Result<std::vector<Quad>> quadsOfGroup(const QuadMesh& mesh, std::string_view name, const std::string& file);

} // namespace tegument
