#pragma once
// One frame ready to be recorded any number of times: pipelines made, uniform blocks laid out, resources bound.

#include "host/run/resources.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace tegument::run {

struct FrameDraw {
    std::string name;
    gpu::Targets targets;
    gpu::Draw draw; // its spans point into `blocks`
    std::vector<std::vector<std::byte>> blocks;
};

struct FrameClear {
    gpu::Texture* target = nullptr;
    ClearStep step;
};

struct FrameMips {
    gpu::Texture* target = nullptr;
};

/// Pipelines depend on the pass and on the formats that it draws into.
using PipelineKey = std::tuple<const Pass*, std::vector<gpu::Format>, std::optional<gpu::Format>>;

struct Frame {
    std::map<PipelineKey, gpu::Pipeline> pipelines; // nodes stay where they are: draws point at them
    std::vector<std::variant<FrameDraw, FrameClear, FrameMips>> items;
};

/// TG4006 the annotation Instances asks for an impossible number.
[[nodiscard]] Result<Frame> buildFrame(const RunInput& input, const Prepared& prepared, Resources& resources);

/// Records the frame; each draw is a timed section with its pass's name.
[[nodiscard]] Result<void> record(const Frame& frame, gpu::Recorder& recorder);

} // namespace tegument::run
