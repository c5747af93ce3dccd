#pragma once
// The scene and one technique as plain files for the Direct3D clients (tests/d3d/client/job.h): the same inputs that the Vulkan host uses.

#include "host/run/stage.h"
#include "tests/d3d/cases.h"

namespace tegument::test {

/// Vertices and indices, as the Vulkan host uploads them.
[[nodiscard]] Result<void> writeMeshFile(const std::filesystem::path& path, const Mesh& mesh);

/// The textures that a technique samples, as its frame was drawn on Vulkan: written as files, named by lines of the job.
[[nodiscard]] Result<std::string> writeTextures(gpu::Device& device, run::Stage& stage, const run::Prepared& prepared,
                                                const std::filesystem::path& folder = drawings());

/// Writes `<case>.<engine>.job`; returns its file name. `textures`: what writeTextures returned.
[[nodiscard]] Result<std::string> writeJob(const Case& drawn, Engine engine, const run::ObjectRun& run, const std::string& textures);

/// Names of files that writeJob refers to and the compiler makes.
[[nodiscard]] std::string effectFile(const Case& drawn, Engine engine);
[[nodiscard]] std::string entryFile(const Case& drawn, const ShaderReference& shader);

inline constexpr const char* kMeshFile = "mesh.bin";

} // namespace tegument::test
