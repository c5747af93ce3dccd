#pragma once
// Mistakes in a draw or dispatch, found before Vulkan sees them.

#include "host/gpu/recorder_state.h"

namespace tegument::gpu::detail {

/// The resources in the order of the pipeline's bindings, each exactly once and of the right kind: TG6030 to TG6033, TG6038.
[[nodiscard]] Result<std::vector<const BoundResource*>> matchResources(const PipelineHandle& pipeline,
                                                                       const std::vector<BoundResource>& resources);

/// Targets against each other, the pipeline and the resources: TG6034 to TG6037.
[[nodiscard]] Result<Scope> checkTargets(const PipelineHandle& pipeline, const Targets& targets,
                                         const std::vector<BoundResource>& resources);

/// No texture that a dispatch writes is bound a second time: TG6034.
[[nodiscard]] Result<void> checkStored(const PipelineHandle& pipeline, const std::vector<BoundResource>& resources);

/// Vertices and indices: TG6039.
[[nodiscard]] Result<void> checkGeometry(const PipelineHandle& pipeline, const Draw& draw);

} // namespace tegument::gpu::detail
