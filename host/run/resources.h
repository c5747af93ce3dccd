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

struct Resources {
    std::map<std::string, gpu::Texture> targets;
    std::map<std::string, gpu::Texture> textures;
    std::map<std::string, gpu::Sampler> samplers;
    std::optional<Geometry> mesh;
    std::optional<Geometry> quad;

    [[nodiscard]] gpu::Texture* texture(const std::string& name);
};

/// Everything in `prepared.targets`, `prepared.textures` and what the passes sample with; the mesh only if a pass draws it.
[[nodiscard]] Result<Resources> allocate(const RunInput& input, const Prepared& prepared);

} // namespace tegument::run
