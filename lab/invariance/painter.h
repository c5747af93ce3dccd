#pragma once
// Inside lab/invariance: one technique, drawn for many scenes; what it compiled for one serves the next.

#include "host/run/stage.h"
#include "lab/invariance/engine_scene.h"

#include <set>
#include <string>

namespace tegument::invariance {

class Painter {
public:
    /// Device, effect and the options, whose technique is drawn, must outlive it. Their parameters are left aside: a scene brings its own.
    Painter(gpu::Device& device, const Effect& effect, const RunOptions& options)
        : device_(device), stage_(device, effect, {}), options_(options) {}

    [[nodiscard]] Result<Image> draw(const EngineScene& scene);

    /// Parameters and textures that the technique's shaders read, known once a scene has been drawn.
    [[nodiscard]] const std::set<std::string>& reads() const { return reads_; }

private:
    void remember(const run::Prepared& prepared);

    gpu::Device& device_;
    run::Stage stage_;
    const RunOptions& options_;
    std::set<std::string> reads_;
};

} // namespace tegument::invariance
