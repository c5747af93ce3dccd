// Mesh -> PLY, binary little-endian: positions, normals and texture coordinates as floats, colours and attributes as they came, triangles
// with 32-bit corners.

#include "host/image/image.h"
#include "host/support/file.h"
#include "meshprep/write/write_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace tegument {

namespace {

static_assert(std::endian::native == std::endian::little, "writePly copies numbers as they are in memory");

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

constexpr std::array<std::string_view, 8> kTypeNames = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};

/// A type that PLY readers know, for each number of an attribute: "quality", or "TEXCOORD_1_0" and "TEXCOORD_1_1".
std::string propertiesOf(const MeshAttribute& attribute) {
    std::string text;
    for (std::size_t c = 0; c < attribute.components; ++c)
        text += fmt::format("property {} {}{}\n", kTypeNames[static_cast<std::size_t>(attribute.type)], attribute.name,
                            attribute.components == 1 ? "" : fmt::format("_{}", c));
    return text;
}

void appendNumber(std::string& bytes, NumberType type, double value) {
    switch (type) {
    case NumberType::Int8: return append(bytes, static_cast<std::int8_t>(value));
    case NumberType::Uint8: return append(bytes, static_cast<std::uint8_t>(value));
    case NumberType::Int16: return append(bytes, static_cast<std::int16_t>(value));
    case NumberType::Uint16: return append(bytes, static_cast<std::uint16_t>(value));
    case NumberType::Int32: return append(bytes, static_cast<std::int32_t>(value));
    case NumberType::Uint32: return append(bytes, static_cast<std::uint32_t>(value));
    case NumberType::Float32: return append(bytes, static_cast<float>(value));
    case NumberType::Float64: return append(bytes, value);
    }
}

/// As scans have them: encoded, 0 to 255 where nothing is lost by it.
struct Colors {
    std::vector<glm::vec4> encoded;
    bool bytes = true;
    bool alpha = false;

    explicit Colors(const Mesh& mesh) {
        for (const glm::vec4& c : mesh.colors) {
            encoded.emplace_back(linearToSrgb(c.r), linearToSrgb(c.g), linearToSrgb(c.b), c.a);
            const glm::vec4 scaled = encoded.back() * 255.0f;
            const glm::vec4 off = glm::abs(scaled - glm::round(scaled));
            bytes &= std::max({off.r, off.g, off.b, off.a}) < 0.02f;
            alpha |= c.a != 1;
        }
    }

    void write(std::string& file, std::size_t vertex) const {
        for (glm::length_t i = 0; i < (alpha ? 4 : 3); ++i)
            if (bytes)
                append(file, static_cast<std::uint8_t>(std::lround(std::clamp(encoded[vertex][i], 0.0f, 1.0f) * 255)));
            else
                append(file, float{encoded[vertex][i]});
    }
};

std::string plyHeader(const Mesh& mesh, const Colors& colors, const glm::dvec3& moved) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment Tegument\n";
    if (!mesh.attribution.empty() && mesh.attribution.find('\n') == std::string::npos) text += "comment " + mesh.attribution + "\n";
    if (moved != glm::dvec3(0)) text += fmt::format("comment moved by {} {} {} mm\n", moved.x, moved.y, moved.z);
    const std::string_view number = mesh.origin == glm::dvec3(0) ? "float" : "double";
    text += fmt::format("element vertex {}\n", mesh.positions.size());
    for (const char axis : {'x', 'y', 'z'})
        text += fmt::format("property {} {}\n", number, axis);
    if (!mesh.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.uvs.empty()) text += "property float s\nproperty float t\n";
    for (const char* channel : {"red", "green", "blue", "alpha"})
        if (!mesh.colors.empty() && (*channel != 'a' || colors.alpha))
            text += fmt::format("property {} {}\n", colors.bytes ? "uchar" : "float", channel);
    for (const MeshAttribute& attribute : mesh.attributes)
        text += propertiesOf(attribute);
    text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.indices.size() / 3);
    return text;
}

} // namespace

Result<void> writePly(const std::filesystem::path& path, const Mesh& mesh, const glm::dvec3& moved) {
    const Colors colors(mesh);
    std::string bytes = plyHeader(mesh, colors, moved);
    bytes.reserve(bytes.size() + mesh.positions.size() * 32 + mesh.indices.size() / 3 * 13);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.origin == glm::dvec3(0))
            append(bytes, mesh.positions[i]);
        else
            append(bytes, mesh.origin + glm::dvec3(mesh.positions[i]));
        if (!mesh.normals.empty()) append(bytes, mesh.normals[i]);
        if (!mesh.uvs.empty()) append(bytes, glm::vec2(mesh.uvs[i].x, 1 - mesh.uvs[i].y)); // v points up in PLY
        if (!mesh.colors.empty()) colors.write(bytes, i);
        for (const MeshAttribute& attribute : mesh.attributes)
            for (std::size_t c = 0; c < attribute.components; ++c)
                appendNumber(bytes, attribute.type, attribute.values[i * attribute.components + c]);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        bytes.push_back(3);
        bytes.append(reinterpret_cast<const char*>(&mesh.indices[i]), 3 * sizeof(std::uint32_t));
    }
    return writeFile(path, bytes);
}

} // namespace tegument
