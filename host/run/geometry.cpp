#include "host/run/geometry.h"

#include "host/mesh/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace tegument::run {

namespace {

struct StreamElement {
    std::string_view semantic;
    std::uint32_t components;
    std::uint32_t offset;
};

constexpr std::array kStream = {StreamElement{"POSITION0", 3, 0}, StreamElement{"NORMAL0", 3, 12}, StreamElement{"TANGENT0", 4, 24},
                                StreamElement{"TEXCOORD0", 2, 40}};

bool reads(const Reflection& vertex, std::string_view semantic) {
    return std::ranges::any_of(vertex.inputs, [&](const StageVariable& input) { return input.semantic == semantic; });
}

/// Any unit vector across the normal: without texture coordinates all are alike.
glm::vec4 tangentAcross(const glm::vec3& normal) {
    const glm::vec3 aside = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 across = glm::cross(aside, normal);
    const float length = glm::length(across);
    return {length > 0 ? across / length : glm::vec3(1, 0, 0), 1};
}

} // namespace

std::vector<float> interleave(const Mesh& mesh) {
    std::vector<float> stream;
    stream.reserve(mesh.positions.size() * 12);
    const auto pose = poseOf(mesh);
    const std::vector<bool> expanded = pose ? expandedVertices(mesh) : std::vector<bool>();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool posed = pose && (expanded.empty() || !expanded[i]);
        const glm::vec3 position = posed ? glm::vec3(pose->position(i)) : mesh.positions[i];
        const glm::vec3 normal = posed ? glm::vec3(pose->normal(i)) : mesh.normals.empty() ? glm::vec3(0) : mesh.normals[i];
        const glm::vec4 tangent = mesh.tangents.empty() ? tangentAcross(normal) : mesh.tangents[i];
        const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[i];
        stream.insert(stream.end(), {position.x, position.y, position.z, normal.x, normal.y, normal.z});
        stream.insert(stream.end(), {tangent.x, tangent.y, tangent.z, tangent.w, uv.x, uv.y});
    }
    return stream;
}

Mesh fullScreenQuad() {
    Mesh quad;
    quad.positions = {{-1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {1, -1, 0}};
    quad.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    quad.normals.assign(4, {0, 0, 1});
    quad.tangents.assign(4, {1, 0, 0, 1});
    quad.indices = {0, 1, 2, 2, 1, 3};
    return quad;
}

Result<std::vector<VertexAttribute>> bindStream(const Pass& pass, const Reflection& vertex) {
    std::vector<VertexAttribute> attributes;
    for (const StageVariable& input : vertex.inputs) {
        const auto* found = std::ranges::find(kStream, input.semantic, &StreamElement::semantic);
        if (found == kStream.end())
            return inputError(4042, pass.vertexShader->at,
                              fmt::format("{} of pass {} reads {}", pass.vertexShader->entry, pass.name, input.semantic),
                              "the vertex stream has POSITION, NORMAL, TANGENT and TEXCOORD0");
        if (input.base != MemberBase::Float)
            return inputError(4042, pass.vertexShader->at,
                              fmt::format("{} of pass {} reads {} as integers", pass.vertexShader->entry, pass.name, input.semantic),
                              "the vertex stream holds floats");
        attributes.push_back({.location = input.location, .components = found->components, .offset = found->offset});
    }
    return attributes;
}

Result<void> checkMesh(const Pass& pass, const Reflection& vertex, const Mesh* mesh, const WithoutUvs& without) {
    if (!mesh || mesh->indices.empty())
        return inputError(4040, pass.at, fmt::format("pass {} draws a mesh, and there is none", pass.name),
                          "name one with --mesh or in the workspace");
    if (mesh->uvs.empty() && !without.drawn && (reads(vertex, "TEXCOORD0") || reads(vertex, "TANGENT0")))
        return inputError(4041, {.file = mesh->name},
                          fmt::format("the mesh has no texture coordinates (UVs), and pass {} needs them", pass.name),
                          "tegument prep MESH --unwrap -o NEW.glb makes some" +
                              (without.instead.empty() ? "" : fmt::format("; without them draw: {}", without.instead)));
    return {};
}

} // namespace tegument::run
