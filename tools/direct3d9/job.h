#pragma once
// Files for the Direct3D clients (tests/d3d/client/job.h): meshes, textures, pictures, and the frame of an effect of another host.

#include "host/image/image.h"
#include "host/run/stage.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tegument {

/// Vertices and indices, as the Vulkan host uploads them.
[[nodiscard]] Result<void> writeMeshFile(const std::filesystem::path& path, const Mesh& mesh);

/// The textures that a technique samples, as its frame was drawn on Vulkan: written as files, named by lines of the job.
[[nodiscard]] Result<std::string> writeTextures(gpu::Device& device, run::Stage& stage, const run::Prepared& prepared,
                                                const std::filesystem::path& folder);

/// Raw floats: width, height, channels, values.
[[nodiscard]] Result<Image> readFloats(const std::filesystem::path& path);
[[nodiscard]] Result<void> writeFloats(const std::filesystem::path& path, const Image& image);

/// Numbers that the author gave; members of structures among them.
using AuthorsNumbers = std::map<std::string, std::vector<double>>;

/// Values, targets and steps. Error: something in the frame exists on this host alone.
[[nodiscard]] Result<std::string> frameLines(const Effect& effect, const run::Prepared& prepared, const AuthorsNumbers& theirs, int width,
                                             int height);

} // namespace tegument
