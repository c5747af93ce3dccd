#pragma once
// Inside host/invariance: one technique, drawn for many scenes; what it compiled for one serves the next.

#include "host/invariance/engine_scene.h"
#include "host/run/resources.h"

#include <set>
#include <string>

namespace tegument::invariance {

class Painter {
public:
    /// Device, effect and the options, whose technique is drawn, must outlive it. Their parameters are left aside: a scene brings its own.
    Painter(gpu::Device& device, const Effect& effect, const RunOptions& options) : device_(device), effect_(effect), options_(options) {}

    [[nodiscard]] Result<Image> draw(const EngineScene& scene);

    /// Parameters that the technique's shaders read, known once a scene has been drawn.
    [[nodiscard]] std::set<std::string> numbers() const;

private:
    gpu::Device& device_;
    const Effect& effect_;
    const RunOptions& options_;
    run::Prepared known_; // only its compiled passes
    std::map<run::PipelineKey, gpu::Pipeline> pipelines_;
};

} // namespace tegument::invariance
