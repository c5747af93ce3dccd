#pragma once
// The scene and one technique as plain files for the Direct3D clients (tests/d3d/client/job.h): the same inputs that the Vulkan host uses.

#include "host/run/prepare.h"
#include "tests/d3d/cases.h"

namespace tegument::test {

/// Vertices and indices, as the Vulkan host uploads them.
[[nodiscard]] Result<void> writeMeshFile(const std::filesystem::path& path, const Mesh& mesh);

/// Writes `<case>.<engine>.job` and the textures that it names; returns its file name.
[[nodiscard]] Result<std::string> writeJob(const Case& drawn, Engine engine, const run::RunInput& input, const run::Prepared& prepared);

/// Names of files that writeJob refers to and the compiler makes.
[[nodiscard]] std::string effectFile(const Case& drawn, Engine engine);
[[nodiscard]] std::string entryFile(const Case& drawn, const ShaderReference& shader);

inline constexpr const char* kMeshFile = "mesh.bin";

} // namespace tegument::test
