// Skin with this library: an effect, a mesh, a camera, a light, a picture.
//   vulkan_sample EFFECT.fx MESH PICTURE.png [STREAM.bin]     with STREAM: the mesh as the Direct3D sample reads it
#include "host/run/geometry.h"
#include "host/run/run.h"
#include "host/support/file.h"

#include <cstdio>

namespace {

using namespace tegument;

int fail(const Error& error) {
    std::fprintf(stderr, "%s\n", format(error).c_str());
    return static_cast<int>(error.blame);
}

/// In units of the mesh's bounding sphere, from its centre: docs/workspace.md.
Workspace portrait() {
    Workspace workspace;
    workspace.camera.position = {1.75F, 0.35F, 3.7F};
    workspace.camera.target = {0, 0.17F, 0.1F};
    workspace.light.position = {-3.2F, 3.6F, 6};
    workspace.light.color = {1.7F, 1.7F, 1.7F}; // irradiance / pi
    workspace.background = {0.008F, 0.008F, 0.012F};
    return workspace;
}

/// Counts, bounding sphere, the vertex stream of docs/conventions.md, indices.
Result<void> writeStream(const char* file, const Mesh& mesh) {
    const std::vector<float> vertices = run::interleave(mesh);
    const std::uint32_t counts[] = {static_cast<std::uint32_t>(mesh.positions.size()), static_cast<std::uint32_t>(mesh.indices.size())};
    const float sphere[] = {mesh.bounds.centre.x, mesh.bounds.centre.y, mesh.bounds.centre.z, mesh.bounds.radius};
    std::string bytes;
    const auto append = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
    append(counts, sizeof counts);
    append(sphere, sizeof sphere);
    append(vertices.data(), vertices.size() * sizeof(float));
    append(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
    return writeFile(file, bytes);
}

int draw(const char* effectFile, const char* meshFile, const char* pictureFile, const char* streamFile) {
    const auto effect = loadEffect(effectFile, {.defines = {{"TEGUMENT_MAP_SIZE", "512"}}, .includeFolders = {}});
    if (!effect) return fail(effect.error());
    const auto mesh = loadMesh(meshFile, {.expectHead = true});
    if (!mesh) return fail(mesh.error());
    auto device = gpu::Device::create();
    if (!device) return fail(device.error());
    RunOptions options;
    options.width = options.height = 512;
    const auto result = runEffect(*device, *effect, &*mesh, portrait(), options);
    if (!result) return fail(result.error());
    if (const auto written = writePng(pictureFile, result->image, PngEncoding::Display); !written) return fail(written.error());
    if (streamFile)
        if (const auto written = writeStream(streamFile, *mesh); !written) return fail(written.error());
    return 0;
}

} // namespace

int main(int count, char** arguments) {
    if (count == 4 || count == 5) return draw(arguments[1], arguments[2], arguments[3], count == 5 ? arguments[4] : nullptr);
    std::fprintf(stderr, "vulkan_sample EFFECT.fx MESH PICTURE.png [STREAM.bin]\n");
    return static_cast<int>(Blame::Usage);
}
