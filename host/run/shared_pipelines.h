#pragma once
// Pipelines and samplers that sessions of one store have in common: an edit changes the passes that it touches, and all others are equal.

#include "host/gpu/gpu.h"
#include "host/run/program.h"

#include <memory>
#include <optional>
#include <vector>

namespace tegument::run {

/// All that a pipeline is made from; of compute passes the program alone.
struct PipelineSource {
    std::shared_ptr<const PassProgram> program;
    PipelineState state{};
    std::vector<gpu::Format> formats{};
    std::optional<gpu::Format> depth{};
    std::uint32_t samples = 1;
};

class SharedPipelines {
public:
    /// Null: nobody has such a one any more.
    [[nodiscard]] std::shared_ptr<const gpu::Pipeline> find(const PipelineSource& source) const;
    void add(PipelineSource source, const std::shared_ptr<const gpu::Pipeline>& pipeline);
    [[nodiscard]] std::shared_ptr<const gpu::Sampler> find(const SamplerState& state) const;
    void add(const SamplerState& state, const std::shared_ptr<const gpu::Sampler>& sampler);

private:
    template <class Source, class Thing>
    struct Entry {
        Source source;
        std::weak_ptr<const Thing> thing;
    };
    std::vector<Entry<PipelineSource, gpu::Pipeline>> pipelines_;
    std::vector<Entry<SamplerState, gpu::Sampler>> samplers_;
};

} // namespace tegument::run
