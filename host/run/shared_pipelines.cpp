#include "host/run/shared_pipelines.h"

#include <algorithm>

namespace tegument::run {

namespace {

bool equalCode(const Shader& a, const Shader& b) {
    return a.entry == b.entry && a.spirv == b.spirv;
}

bool equalCode(const std::optional<Shader>& a, const std::optional<Shader>& b) {
    return a.has_value() == b.has_value() && (!a || equalCode(*a, *b));
}

/// Attributes and bindings follow from the code, but for bindings that a measurement adds.
bool equalPrograms(const PassProgram& a, const PassProgram& b) {
    return equalCode(a.vertex, b.vertex) && equalCode(a.pixel, b.pixel) && equalCode(a.compute, b.compute) &&
           a.bindings.size() == b.bindings.size() && a.attributes.size() == b.attributes.size();
}

bool equalSources(const PipelineSource& a, const PipelineSource& b) {
    return a.samples == b.samples && a.depth == b.depth && a.formats == b.formats && a.state == b.state &&
           equalPrograms(*a.program, *b.program);
}

} // namespace

std::shared_ptr<const gpu::Pipeline> SharedPipelines::find(const PipelineSource& source) const {
    for (const auto& entry : pipelines_)
        if (auto pipeline = entry.thing.lock(); pipeline && equalSources(entry.source, source)) return pipeline;
    return nullptr;
}

void SharedPipelines::add(PipelineSource source, const std::shared_ptr<const gpu::Pipeline>& pipeline) {
    std::erase_if(pipelines_, [](const auto& entry) { return entry.thing.expired(); });
    pipelines_.push_back({std::move(source), pipeline});
}

std::shared_ptr<const gpu::Sampler> SharedPipelines::find(const SamplerState& state) const {
    for (const auto& entry : samplers_)
        if (auto sampler = entry.thing.lock(); sampler && entry.source == state) return sampler;
    return nullptr;
}

void SharedPipelines::add(const SamplerState& state, const std::shared_ptr<const gpu::Sampler>& sampler) {
    std::erase_if(samplers_, [](const auto& entry) { return entry.thing.expired(); });
    samplers_.push_back({state, sampler});
}

} // namespace tegument::run
