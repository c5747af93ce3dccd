#include "meshprep/human/quad_mesh.h"

#include "host/mesh/obj_file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tegument {

namespace {

/// Nothing for a face that is no quad, or lacks texture coordinates.
std::optional<Quad> quadOf(std::span<const ObjCorner> corners) {
    if (corners.size() != 4) return std::nullopt;
    Quad quad;
    for (std::size_t c = 0; c < 4; ++c) {
        if (corners[c].uv == ObjCorner::kNone) return std::nullopt;
        quad.position[c] = corners[c].position;
        quad.uv[c] = corners[c].uv;
    }
    return quad;
}

} // namespace

Result<QuadMesh> readQuadObj(std::string_view text, const std::string& file, float unitMm) {
    const Result<ObjFile> obj = parseObj(text, file);
    if (!obj) return obj.error();
    QuadMesh mesh;
    for (const glm::vec3& p : obj->positions)
        mesh.positions.push_back(p * unitMm);
    mesh.uvs.assign(obj->uvs.begin(), obj->uvs.end());
    if (!std::ranges::all_of(mesh.uvs, [](const glm::vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }))
        return inputError(7001, {.file = file}, "a texture coordinate is not finite", "the file is damaged; fetch it again");
    for (std::size_t i = 0; i < obj->sections.size(); ++i)
        mesh.groups.push_back({obj->sections[i].group, obj->sections[i].firstFace, obj->endOf(i) - obj->sections[i].firstFace});
    for (std::size_t face = 0; face < obj->faces.size(); ++face) {
        const std::optional<Quad> quad = quadOf(obj->cornersOf(face));
        if (!quad)
            return inputError(7002, {.file = file, .line = obj->faces[face].line}, "a face must have four corners, each position/texture",
                              "subdivision and charts need a mesh of quads with texture coordinates");
        mesh.quads.push_back(*quad);
    }
    return mesh;
}

Result<std::vector<Quad>> quadsOfGroup(const QuadMesh& mesh, std::string_view name, const std::string& file) {
    std::vector<Quad> result;
    std::vector<std::string> names;
    for (const QuadGroup& group : mesh.groups) {
        names.push_back(group.name);
        if (group.name != name) continue;
        const auto first = mesh.quads.begin() + static_cast<std::ptrdiff_t>(group.first);
        result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(group.count));
    }
    if (!result.empty()) return result;
    return inputError(7004, {.file = file}, fmt::format("there is no face in a group '{}'", name), didYouMean(name, names));
}

} // namespace tegument
