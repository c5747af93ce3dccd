// The recorder's commands, and the frame that they belong to.

#include "host/gpu/error.h"
#include "host/gpu/pipeline_layout.h"
#include "host/gpu/recorder_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::gpu {

namespace detail {

namespace {

bool isNull(const BoundResource& resource) {
    struct Visitor {
        bool operator()(std::span<const std::byte> bytes) const { return bytes.empty(); }
        bool operator()(const Texture* texture) const { return !texture || !texture->state; }
        bool operator()(const Sampler* sampler) const { return !sampler || !sampler->state; }
        bool operator()(const Buffer* buffer) const { return !buffer || !buffer->state; }
        bool operator()(const StoredTexture& stored) const { return !stored.texture || !stored.texture->state; }
    };
    return std::visit(Visitor{}, resource.resource);
}

/// BindingKind and BoundResource's alternatives have the same order.
BindingKind kindOf(const BoundResource& resource) {
    return static_cast<BindingKind>(resource.resource.index());
}

Result<void> checkValue(const PipelineHandle& pipeline, const Binding& binding, const BoundResource& resource) {
    const auto wrong = [&](int code, std::string_view what) {
        return requestError(code, fmt::format("pipeline '{}': {} {}", pipeline.name, describe(binding), what));
    };
    if (kindOf(resource) != binding.kind) return wrong(6033, fmt::format("was given a {}", kindName(kindOf(resource))));
    if (isNull(resource)) return wrong(6030, "was given nothing");
    if (binding.kind == BindingKind::StorageBuffer && std::get<Buffer*>(resource.resource)->state->usage != BufferUsage::Storage)
        return wrong(6033, "was given a vertex or index buffer");
    if (binding.kind == BindingKind::Texture && std::get<Texture*>(resource.resource)->desc().samples != 1)
        return wrong(6017, "was given a multisampled texture, which must be resolved first");
    if (binding.kind == BindingKind::StorageTexture && !std::get<StoredTexture>(resource.resource).texture->desc().storage)
        return wrong(6033, "was given a texture that was not made to be written by dispatches");
    if (binding.kind != BindingKind::UniformBuffer) return {};
    const std::size_t size = std::get<std::span<const std::byte>>(resource.resource).size();
    const std::uint32_t limit = pipeline.device->limits.maxUniformBufferRange;
    if (size > limit) return wrong(6038, fmt::format("was given {} bytes, and {} allows {}", size, pipeline.device->info.name, limit));
    return {};
}

TextureState* state(const Texture* texture) {
    return texture ? texture->state.get() : nullptr;
}

Result<void> checkTarget(const PipelineHandle& pipeline, const TextureState* target, Format format, std::string_view what) {
    if (!target) return requestError(6035, fmt::format("pipeline '{}': {} is missing", pipeline.name, what));
    if (!target->desc.renderTarget)
        return requestError(6037, fmt::format("pipeline '{}': {}, '{}', is not a render target", pipeline.name, what, target->desc.name));
    if (target->desc.format != format)
        return requestError(6035, fmt::format("pipeline '{}': {}, '{}', is {}, and the pipeline writes {}", pipeline.name, what,
                                              target->desc.name, name(target->desc.format), name(format)));
    if (target->desc.samples != pipeline.samples)
        return requestError(6035, fmt::format("pipeline '{}': {}, '{}', has {} samples a pixel, and the pipeline draws {}", pipeline.name,
                                              what, target->desc.name, target->desc.samples, pipeline.samples));
    return {};
}

Result<void> checkFormats(const PipelineHandle& pipeline, const Scope& scope) {
    if (scope.colors.size() != pipeline.colorFormats.size())
        return requestError(6035, fmt::format("pipeline '{}' writes {} colour targets, and {} are set", pipeline.name,
                                              pipeline.colorFormats.size(), scope.colors.size()));
    for (std::size_t i = 0; i < scope.colors.size(); ++i)
        if (auto fits = checkTarget(pipeline, scope.colors[i], pipeline.colorFormats[i], fmt::format("colour target {}", i)); !fits)
            return fits;
    if (pipeline.depthFormat) return checkTarget(pipeline, scope.depth, *pipeline.depthFormat, "the depth target");
    if (scope.depth)
        return requestError(6035,
                            fmt::format("pipeline '{}' uses no depth target, and '{}' is set", pipeline.name, scope.depth->desc.name));
    return {};
}

/// The resources in the order of the pipeline's bindings, each exactly once and of the right kind: TG6030 to TG6033, TG6038.
Result<std::vector<const BoundResource*>> matchResources(const PipelineHandle& pipeline, const std::vector<BoundResource>& resources) {
    std::vector<const BoundResource*> matched(pipeline.bindings.size(), nullptr);
    for (const BoundResource& resource : resources) {
        const auto found = std::ranges::find_if(
            pipeline.bindings, [&](const Binding& binding) { return binding.set == resource.set && binding.binding == resource.binding; });
        if (found == pipeline.bindings.end())
            return requestError(6032, fmt::format("pipeline '{}' has no set {} binding {}, and a {} was given for it", pipeline.name,
                                                  resource.set, resource.binding, kindName(kindOf(resource))));
        const BoundResource*& slot = matched[static_cast<std::size_t>(found - pipeline.bindings.begin())];
        if (slot) return requestError(6031, fmt::format("pipeline '{}': {} was given twice", pipeline.name, describe(*found)));
        if (const auto fits = checkValue(pipeline, *found, resource); !fits) return fits.error();
        slot = &resource;
    }
    const auto missing = std::ranges::find(matched, nullptr);
    if (missing == matched.end()) return matched;
    const Binding& binding = pipeline.bindings[static_cast<std::size_t>(missing - matched.begin())];
    return requestError(6030, fmt::format("pipeline '{}': {} was not given", pipeline.name, describe(binding)));
}

/// Targets against the pipeline: TG6035, TG6037. That they fit each other, and are bound once, is the caller's to see (host/run/plan.h).
Result<Scope> checkTargets(const PipelineHandle& pipeline, const Targets& targets) {
    Scope scope{.depth = state(targets.depth)};
    for (const Texture* color : targets.colors)
        scope.colors.push_back(state(color));
    if (const auto formats = checkFormats(pipeline, scope); !formats) return formats.error();
    return scope;
}

/// Vertices and indices: TG6039.
Result<void> checkGeometry(const PipelineHandle& pipeline, const Draw& draw) {
    const auto wrong = [&](const std::string& what) { return requestError(6039, fmt::format("pipeline '{}': {}", pipeline.name, what)); };
    const auto twice = [](const Buffer* buffer, std::span<const std::byte> bytes) { return buffer && !bytes.empty(); };
    if (twice(draw.vertices, draw.vertexBytes)) return wrong("the draw has a vertex buffer, and bytes of vertices");
    if (twice(draw.indices, draw.indexBytes)) return wrong("the draw has an index buffer, and bytes of indices");
    const std::uint64_t vertexBytes = draw.vertices ? draw.vertices->bytes() : draw.vertexBytes.size();
    const std::uint64_t indexBytes = draw.indices ? draw.indices->bytes() : draw.indexBytes.size();
    if (pipeline.vertexStride > 0 && vertexBytes == 0) return wrong("the draw has no vertex buffer");
    if (draw.vertices && draw.vertices->state->usage != BufferUsage::Vertex) return wrong("the vertex buffer was made for another use");
    if (draw.indices && draw.indices->state->usage != BufferUsage::Index) return wrong("the index buffer was made for another use");
    std::uint64_t end = std::uint64_t{draw.first} + draw.count;
    for (const DrawRange& range : draw.more)
        end = std::max(end, std::uint64_t{range.first} + range.count);
    if (indexBytes > 0 && end * sizeof(std::uint32_t) > indexBytes)
        return wrong(fmt::format("the draw needs {} indices, and the buffer has {}", end, indexBytes / sizeof(std::uint32_t)));
    if (indexBytes == 0 && vertexBytes > 0 && end * pipeline.vertexStride > vertexBytes)
        return wrong(fmt::format("the draw needs {} vertices, and the buffer has {}", end, vertexBytes / pipeline.vertexStride));
    return {};
}

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
    const auto scope = checkTargets(pipeline, targets);
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
