#pragma once
// The scene and one technique as plain files for the Direct3D clients (tests/d3d/client/job.h): the same inputs that the Vulkan host uses.

#include "host/run/stage.h"
#include "tests/d3d/cases.h"
#include "tools/direct3d9/job.h"

namespace tegument::test {

/// Writes `<case>.<engine>.job`; returns its file name. `textures`: what writeTextures returned.
[[nodiscard]] Result<std::string> writeJob(const Case& drawn, Engine engine, const run::ObjectRun& run, const std::string& textures);

/// Names of files that writeJob refers to and the compiler makes.
[[nodiscard]] std::string effectFile(const Case& drawn, Engine engine);
[[nodiscard]] std::string entryFile(const Case& drawn, const ShaderReference& shader);

inline constexpr const char* kMeshFile = "mesh.bin";

} // namespace tegument::test
