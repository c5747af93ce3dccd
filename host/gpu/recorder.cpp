// The recorder's commands, and the frame that they belong to.

#include "host/gpu/draw_check.h"
#include "host/gpu/error.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::gpu {

namespace detail {

namespace {

PendingClear& pendingClear(RecorderState& recorder, TextureState& texture) {
    const bool attached = recorder.scope && (recorder.scope->depth == &texture ||
                                             std::ranges::find(recorder.scope->colors, &texture) != recorder.scope->colors.end());
    if (attached) endScope(recorder);
    const auto found = std::ranges::find(recorder.clears, &texture, &PendingClear::texture);
    if (found != recorder.clears.end()) return *found;
    return recorder.clears.emplace_back(PendingClear{.texture = &texture});
}

Result<void> checkDepthClear(const TextureState& texture, std::optional<float> depth, std::optional<std::uint32_t> stencil) {
    const auto wrong = [&](std::string_view what) { return requestError(6042, fmt::format("texture '{}' {}", texture.desc.name, what)); };
    if (!isDepth(texture.desc.format)) return wrong("has no depth to clear");
    if (stencil && !hasStencil(texture.desc.format)) return wrong("has no stencil to clear");
    if (depth && !(*depth >= 0 && *depth <= 1)) return wrong(fmt::format("cannot be cleared to depth {}: depths are 0 to 1", *depth));
    return {};
}

/// Clears first: they end the open scope, and the textures are then read.
void useResources(RecorderState& recorder, std::span<const BoundResource* const> resources, const Use& sampled, const Use& storage) {
    for (const BoundResource* resource : resources) {
        if (const auto* texture = std::get_if<Texture*>(&resource->resource)) flushClear(recorder, *(*texture)->state);
        if (const auto* stored = std::get_if<StoredTexture>(&resource->resource)) flushClear(recorder, *stored->texture->state);
    }
    for (const BoundResource* resource : resources) {
        if (const auto* texture = std::get_if<Texture*>(&resource->resource)) use(recorder, *(*texture)->state, sampled);
        if (const auto* buffer = std::get_if<Buffer*>(&resource->resource)) use(recorder, *(*buffer)->state, storage);
        if (const auto* stored = std::get_if<StoredTexture>(&resource->resource)) use(recorder, *stored->texture->state, kStoredByDispatch);
    }
}

void setRows(RecorderState& recorder, const Scope& scope, const std::optional<RowRange>& rows) {
    const TextureDesc& target = (scope.colors.empty() ? scope.depth : scope.colors.front())->desc;
    const RowRange all{.first = 0, .count = target.height};
    const RowRange drawn = rows.value_or(all);
    recorder.commands.setScissor(0,
                                 vk::Rect2D{.offset = {0, static_cast<std::int32_t>(drawn.first)}, .extent = {target.width, drawn.count}});
}

BytesArena::Slice sliceOf(RecorderState& recorder, const Buffer* buffer, std::span<const std::byte> bytes) {
    if (buffer) return {.buffer = *buffer->state->buffer};
    return bytes.empty() ? BytesArena::Slice{} : recorder.device.bytes.push(recorder.device, bytes);
}

void recordDraw(RecorderState& recorder, const PipelineHandle& pipeline, const Draw& draw) {
    const vk::raii::CommandBuffer& commands = recorder.commands;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline.pipeline);
    const BytesArena::Slice vertices = sliceOf(recorder, draw.vertices, draw.vertexBytes);
    const BytesArena::Slice indices = sliceOf(recorder, draw.indices, draw.indexBytes);
    if (vertices.buffer) commands.bindVertexBuffers(0, vertices.buffer, vertices.offset);
    if (indices.buffer) commands.bindIndexBuffer(indices.buffer, indices.offset, vk::IndexType::eUint32);
    const auto record = [&](const DrawRange& range) {
        const std::uint32_t instances = range.instances > 0 ? range.instances : draw.instances;
        if (indices.buffer)
            commands.drawIndexed(range.count, instances, range.first, 0, range.firstInstance);
        else
            commands.draw(range.count, instances, range.first, range.firstInstance);
    };
    record({.first = draw.first, .count = draw.count});
    for (const DrawRange& range : draw.more)
        record(range);
}

Result<void> drawChecked(RecorderState& recorder, const Targets& targets, const Draw& draw) {
    const PipelineHandle& pipeline = *draw.pipeline->state;
    const auto scope = checkTargets(pipeline, targets, draw.resources);
    if (!scope) return scope.error();
    const auto resources = matchResources(pipeline, draw.resources);
    if (!resources) return resources.error();
    if (auto geometry = checkGeometry(pipeline, draw); !geometry) return geometry;

    bindResources(recorder, pipeline, *resources);
    useResources(recorder, *resources, kSampledByDraw, kStorageInDraw);
    if (draw.vertices) use(recorder, *draw.vertices->state, kVertexInput);
    if (draw.indices) use(recorder, *draw.indices->state, kIndexInput);
    openScope(recorder, *scope);
    if (draw.rows) setRows(recorder, *scope, draw.rows);
    recordDraw(recorder, pipeline, draw);
    if (draw.rows) setRows(recorder, *scope, std::nullopt);
    return {};
}

Result<void> checkGroups(const DeviceState& device, const PipelineHandle& pipeline, const std::array<std::uint32_t, 3>& groups) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (groups[axis] > device.limits.maxComputeWorkGroupCount[axis])
            return requestError(6041, fmt::format("pipeline '{}': {} work groups along axis {}, and {} allows {}", pipeline.name,
                                                  groups[axis], axis, device.info.name, device.limits.maxComputeWorkGroupCount[axis]));
    return {};
}

std::vector<TimedSection> timedSections(const RecorderState& recorder) {
    const DeviceState& device = recorder.device;
    const std::vector<std::uint64_t> ticks = device.timestamps.read();
    const std::uint64_t mask = device.timestampBits >= 64 ? ~0ull : (1ull << device.timestampBits) - 1;
    std::vector<TimedSection> sections;
    for (std::size_t i = 0; i < recorder.timers.size(); ++i) {
        const std::uint64_t elapsed = ticks.empty() ? 0 : (ticks[2 * i + 1] - ticks[2 * i]) & mask;
        sections.push_back({recorder.timers[i], static_cast<double>(elapsed) * static_cast<double>(device.limits.timestampPeriod) * 1e-6});
    }
    return sections;
}

/// Timestamps stand outside of rendering scopes, so that a section holds its own loads, stores and clears.
void writeTimestamp(RecorderState& recorder) {
    endScope(recorder);
    if (!recorder.device.info.timestamps) return;
    const auto written = guarded("timing a section", [&]() -> Result<void> {
        recorder.device.timestamps.write(recorder.device, recorder.commands);
        return {};
    });
    if (!written && !recorder.failure) recorder.failure = written.error();
}

Result<std::vector<TimedSection>> finishFrame(RecorderState& recorder) {
    assert(!recorder.timing && "every timer is ended");
    if (recorder.failure) return *recorder.failure;
    endScope(recorder);
    flushAllClears(recorder);
    submitAndWait(recorder.device, recorder.commands);
    recorder.submitted = true;
    return timedSections(recorder);
}

} // namespace
} // namespace detail

Result<void> Recorder::clearColor(Texture& target, const std::array<float, 4>& rgba) {
    assert(target.state);
    if (isDepth(target.state->desc.format))
        return detail::requestError(6042, fmt::format("texture '{}' has no colour to clear", target.state->desc.name));
    detail::pendingClear(state_, *target.state).color = rgba;
    return {};
}

Result<void> Recorder::clearDepthStencil(Texture& target, std::optional<float> depth, std::optional<std::uint32_t> stencil) {
    assert(target.state);
    if (auto possible = detail::checkDepthClear(*target.state, depth, stencil); !possible) return possible;
    if (!depth && !stencil) return {};
    detail::PendingClear& clear = detail::pendingClear(state_, *target.state);
    if (depth) clear.depth = depth;
    if (stencil) clear.stencil = stencil;
    return {};
}

void Recorder::clearNow() {
    detail::endScope(state_);
    detail::flushAllClears(state_);
}

Result<void> Recorder::draw(const Targets& targets, const Draw& draw) {
    assert(draw.pipeline && draw.pipeline->state && !draw.pipeline->state->compute);
    return detail::guarded("recording a draw", [&] { return detail::drawChecked(state_, targets, draw); });
}

Result<void> Recorder::dispatch(const Pipeline& pipeline, const std::vector<BoundResource>& resources,
                                std::array<std::uint32_t, 3> groups) {
    assert(pipeline.state && pipeline.state->compute);
    return detail::guarded("recording a dispatch", [&]() -> Result<void> {
        if (auto possible = detail::checkGroups(state_.device, *pipeline.state, groups); !possible) return possible;
        const auto matched = detail::matchResources(*pipeline.state, resources);
        if (!matched) return matched.error();
        if (auto apart = detail::checkStored(*pipeline.state, resources); !apart) return apart;
        detail::endScope(state_);
        detail::bindResources(state_, *pipeline.state, *matched);
        detail::useResources(state_, *matched, detail::kSampledByDispatch, detail::kStorageInDispatch);
        detail::flushBarriers(state_);
        state_.commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline.state->pipeline);
        state_.commands.dispatch(groups[0], groups[1], groups[2]);
        return {};
    });
}

void Recorder::beginTimer(std::string name) {
    assert(!state_.timing && "sections do not nest");
    state_.timing = true;
    state_.timers.push_back(std::move(name));
    detail::writeTimestamp(state_);
}

void Recorder::endTimer() {
    assert(state_.timing);
    state_.timing = false;
    detail::endScope(state_);
    detail::flushAllClears(state_);
    detail::writeTimestamp(state_);
}

Result<std::vector<TimedSection>> Device::run(const std::function<Result<void>(Recorder&)>& record) {
    assert(!state_->recording && "frames do not nest");
    return detail::guarded("running a frame", [&]() -> Result<std::vector<TimedSection>> {
        detail::RecorderState frame(*state_);
        Recorder recorder(frame);
        if (const auto recorded = record(recorder); !recorded) return recorded.error();
        return detail::finishFrame(frame);
    });
}

} // namespace tegument::gpu
