#pragma once
// What the mesh fuzzers share: the bytes go through a file, because loadMesh reads files, and the result must keep loadMesh's promises.

#include "host/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <unistd.h>

namespace tegument::fuzz {

inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
}

inline bool unit(const glm::vec3& v) {
    return std::abs(glm::length(v) - 1) < 1e-3f;
}

inline void checkMesh(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    require(count > 0 && mesh.indices.size() % 3 == 0 && !mesh.indices.empty(), "triangles");
    require(mesh.normals.size() == count, "a normal per vertex");
    require(mesh.uvs.empty() || mesh.uvs.size() == count, "a UV per vertex or none");
    require(mesh.tangents.empty() ? mesh.uvs.empty() : mesh.tangents.size() == count, "tangents where there are UVs");
    for (const std::uint32_t index : mesh.indices)
        require(index < count, "indices in range");
    for (const glm::vec3& normal : mesh.normals)
        require(unit(normal), "unit normals");
    for (const glm::vec4& tangent : mesh.tangents)
        require(unit(glm::vec3(tangent)) && std::abs(tangent.w) == 1, "unit tangents");
    std::size_t covered = 0;
    for (const MeshPart& part : mesh.parts) {
        require(part.firstIndex == covered, "parts without gaps");
        covered += part.indexCount;
    }
    require(covered == mesh.indices.size(), "parts that cover the mesh");
}

/// A new file each time: one that is cut short and written again is put on disk at once by some file systems, which takes most of the time.
inline void writeAnew(const std::string& path, const std::uint8_t* data, std::size_t size) {
    std::remove(path.c_str());
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

inline void check(const std::string& path) {
    const Result<Mesh> mesh = loadMesh(path, {.unitMm = 1});
    if (mesh)
        checkMesh(*mesh);
    else
        require(mesh.error().diagnostics.size() == 1 && !format(mesh.error()).empty(), "one error");
}

inline void loadBytes(const std::uint8_t* data, std::size_t size, const char* extension) {
    static const std::string path = "/tmp/tegument-fuzz-" + std::to_string(::getpid()) + "." + extension;
    writeAnew(path, data, size);
    check(path);
}

} // namespace tegument::fuzz
