// Mesh -> PLY, binary little-endian: positions, normals and texture coordinates as floats, triangles with 32-bit corners.

#include "host/mesh/mesh.h"
#include "host/support/file.h"

#include <fmt/format.h>

#include <bit>

namespace tegument {

namespace {

static_assert(std::endian::native == std::endian::little, "writePly copies numbers as they are in memory");

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string plyHeader(const Mesh& mesh) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment Tegument\n";
    if (!mesh.attribution.empty() && mesh.attribution.find('\n') == std::string::npos) text += "comment " + mesh.attribution + "\n";
    text += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", mesh.positions.size());
    if (!mesh.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.uvs.empty()) text += "property float s\nproperty float t\n";
    text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.indices.size() / 3);
    return text;
}

} // namespace

Result<void> writePly(const std::filesystem::path& path, const Mesh& mesh) {
    std::string bytes = plyHeader(mesh);
    bytes.reserve(bytes.size() + mesh.positions.size() * 32 + mesh.indices.size() / 3 * 13);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        append(bytes, mesh.positions[i]);
        if (!mesh.normals.empty()) append(bytes, mesh.normals[i]);
        if (!mesh.uvs.empty()) append(bytes, glm::vec2(mesh.uvs[i].x, 1 - mesh.uvs[i].y)); // v points up in PLY
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        bytes.push_back(3);
        bytes.append(reinterpret_cast<const char*>(&mesh.indices[i]), 3 * sizeof(std::uint32_t));
    }
    return writeFile(path, bytes);
}

} // namespace tegument
