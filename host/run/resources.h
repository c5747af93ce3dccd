#pragma once
// The GPU's side of a prepared run: targets, textures, samplers, geometry, pipelines.

#include "host/gpu/gpu.h"
#include "host/run/geometry.h"
#include "host/run/prepare.h"

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace tegument::run {

/// Pipelines depend on the pass, on the formats and samples that it draws into, and on whether what it draws is mirrored.
using PipelineKey = std::tuple<const Pass*, std::vector<gpu::Format>, std::optional<gpu::Format>, std::uint32_t, bool>;

struct Resources {
    std::map<std::string, gpu::Texture> targets;
    std::map<std::string, gpu::Texture> textures; // by TextureData::key
    std::map<std::string, gpu::Sampler> samplers;
    std::map<PipelineKey, gpu::Pipeline> pipelines; // nodes stay where they are: draws point at them; made by buildFrame
    std::map<const Mesh*, Geometry> meshes;
    std::optional<Geometry> quad;

    /// What a parameter's name means to an object.
    [[nodiscard]] gpu::Texture* texture(const Prepared& prepared, const std::string& name);
    /// The caller's colour target as a frame leaves it, of one sample a pixel; null before anything is allocated.
    [[nodiscard]] gpu::Texture* picture();
};

/// Everything in `prepared.targets`, `prepared.textures` and what the passes sample with, as far as it is not there yet; the mesh only if a
/// pass draws it.
[[nodiscard]] Result<void> allocate(const RunInput& input, const Prepared& prepared, Resources& resources);

} // namespace tegument::run
