#include "host/run/frame.h"

#include "host/run/describe.h"
#include "host/run/groups.h"
#include "host/run/parts.h"
#include "host/run/pass_request.h"
#include "host/run/pieces.h"
#include "host/run/values.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>

namespace tegument::run {

namespace {

/// At work on one object of the frame.
struct Builder {
    const RunInput& input;
    const Prepared& prepared;
    int object;
    Resources& resources;
    Frame& frame;
};

/// A shader that does not write a bound target leaves it as it is in Direct3D; in Vulkan it would write undefined values. `mirrored`: front
/// faces are the other way round.
PipelineState maskUnwritten(const Pass& pass, const PassProgram& program, bool mirrored) {
    PipelineState state = pass.state;
    if (mirrored) state.frontCounterClockwise = !state.frontCounterClockwise;
    for (std::size_t slot = 0; slot < state.targets.size(); ++slot)
        if ((program.use.writtenColors >> slot & 1U) == 0) state.targets[slot].writeMask = 0;
    return state;
}

/// In a mirrored world the mesh's front faces are clockwise; buffers know no world.
bool drawsMirrored(const Builder& builder, const DrawStep& step) {
    return step.kind != DrawKind::Buffer && isMirrored(builder.prepared.scene);
}

bool isStrip(const Pass& pass) {
    return pass.annotations.string("Topology") == "trianglestrip";
}

gpu::ShaderCode codeOf(const Shader& shader) {
    return {.spirv = shader.spirv, .entry = shader.entry};
}

/// All have one size and one number of samples: completePlan() has seen to it.
const gpu::Texture& anyOf(const gpu::Targets& targets) {
    const gpu::Texture* any = targets.colors.empty() ? targets.depth : targets.colors.front();
    assert(any);
    return *any;
}

Result<const gpu::Pipeline*> pipelineFor(Builder& builder, const DrawStep& step, const gpu::Targets& targets) {
    std::vector<gpu::Format> formats;
    for (const gpu::Texture* color : targets.colors)
        formats.push_back(color->desc().format);
    const std::optional<gpu::Format> depth = targets.depth ? std::optional(targets.depth->desc().format) : std::nullopt;
    const std::uint32_t samples = anyOf(targets).desc().samples;
    const bool mirrored = drawsMirrored(builder, step);
    const PipelineKey key{step.pass, formats, depth, samples, mirrored};
    if (const auto found = builder.resources.kit.pipelines.find(key); found != builder.resources.kit.pipelines.end())
        return static_cast<const gpu::Pipeline*>(found->second.get());
    const PassProgram& program = *builder.prepared.programs.at(step.pass);
    const PipelineSource source{builder.prepared.programs.at(step.pass), maskUnwritten(*step.pass, program, mirrored), formats, depth,
                                samples};
    const auto keep = [&](const std::shared_ptr<const gpu::Pipeline>& pipeline) {
        return static_cast<const gpu::Pipeline*>(builder.resources.kit.pipelines.emplace(key, pipeline).first->second.get());
    };
    if (const auto shared = builder.resources.store.shared.find(source)) return keep(shared);
    auto pipeline = builder.resources.device.createPipeline(
        {.name = step.pass->name,
         .vertex = codeOf(program.vertex),
         .pixel = program.pixel ? codeOf(*program.pixel) : gpu::ShaderCode{},
         .bindings = program.bindings,
         .attributes = program.attributes,
         .vertexStride = program.attributes.empty() ? 0 : kVertexStride,
         .topology = isStrip(*step.pass) ? gpu::Topology::TriangleStrip : gpu::Topology::TriangleList,
         .colorFormats = std::move(formats),
         .depthFormat = depth,
         .samples = samples,
         .state = source.state});
    if (!pipeline) return pipeline.error();
    const auto made = std::make_shared<const gpu::Pipeline>(std::move(*pipeline));
    builder.resources.store.shared.add(source, made);
    const gpu::Pipeline* kept = keep(made);
    if (const auto pause = pauseAfter(builder.input.options); !pause) return pause.error();
    return kept;
}

gpu::Targets targetsOf(Builder& builder, const DrawStep& step) {
    gpu::Targets targets;
    for (const auto& color : step.colors)
        targets.colors.push_back(&builder.resources.targets.at(*color));
    if (step.depth) targets.depth = &builder.resources.targets.at(*step.depth);
    return targets;
}

/// VIEWPORTPIXELSIZE is the size of what is drawn into, loop indices are those of this execution.
Result<Numbers> valueAt(const Builder& builder, const DrawStep& step, const Parameter& parameter, const Extent& viewport) {
    if (const auto written = step.written.find(parameter.name); written != step.written.end()) return Numbers{written->second};
    if (isViewportSize(parameter) && !builder.prepared.values.fixedByUser(parameter.name)) {
        Numbers size{static_cast<double>(viewport.width), static_cast<double>(viewport.height), 0, 0};
        size.resize(static_cast<std::size_t>(parameter.type.scalarCount()));
        return size;
    }
    return builder.prepared.values.require(parameter);
}

Result<std::vector<std::byte>> layOut(const Builder& builder, const DrawStep& step, const UniformBlock& block, const Extent& viewport) {
    std::vector<std::byte> bytes(block.size);
    for (const BlockMember& member : block.members) {
        if (!member.used) continue;
        const Parameter* parameter = builder.input.effect.findParameter(member.name);
        assert(parameter); // prepare() has seen to it
        const auto value = valueAt(builder, step, *parameter, viewport);
        if (!value) return value.error();
        if (const auto packed = pack(member, *parameter, *value, bytes); !packed) return packed.error();
    }
    return bytes;
}

/// What of the targets a shader writes by this name: gatherStored() has found it.
gpu::StoredTexture storedBy(Builder& builder, const std::string& name) {
    const std::string& target = *builder.input.effect.findStorage(name)->target;
    return {&builder.resources.targets.at(target.empty() ? kPicture : target)};
}

Result<void> bindStage(Builder& builder, const DrawStep& step, const Shader& shader, const Extent& viewport, FrameDraw& item) {
    const Reflection& reflection = shader.reflection;
    for (const UniformBlock* block : blocksOf(reflection)) {
        auto bytes = layOut(builder, step, *block, viewport);
        if (!bytes) return bytes.error();
        item.blocks.push_back(std::move(*bytes));
        item.draw.resources.push_back({block->set, block->binding, std::span<const std::byte>(item.blocks.back())});
    }
    for (const Resource& resource : reflection.resources) {
        if (!resource.used) continue;
        gpu::BoundResource bound{.set = resource.set, .binding = resource.binding};
        if (resource.kind == ResourceKind::Sampler || resource.kind == ResourceKind::CompareSampler)
            bound.resource = builder.resources.kit.samplers.at(resource.name).get();
        else if (resource.kind == ResourceKind::StorageImage)
            bound.resource = storedBy(builder, resource.name);
        else if (const auto copy = step.copies.find(resource.name); copy != step.copies.end())
            bound.resource = &builder.resources.targets.at(copy->second);
        else
            bound.resource = builder.resources.texture(builder.prepared, resource.name);
        item.draw.resources.push_back(bound);
    }
    return {};
}

Result<std::uint32_t> instancesOf(const Builder& builder, const DrawStep& step) {
    const Annotation* annotation = step.pass->annotations.find("Instances");
    if (!annotation) return 1U;
    const std::string name = step.pass->annotations.string("Instances").value_or("");
    const Parameter* parameter = builder.input.effect.findParameter(name);
    assert(parameter); // host/effect has checked the annotation
    const auto value = builder.prepared.values.require(*parameter);
    if (!value) return value.error();
    constexpr double kMost = 65536;
    if (value->front() < 0 || value->front() > kMost)
        return inputError(4006, parameter->at, fmt::format("pass {} would draw {} instances", step.pass->name, value->front()),
                          "0 to 65536");
    return static_cast<std::uint32_t>(value->front());
}

Extent extentOf(const gpu::Targets& targets) {
    const gpu::TextureDesc& desc = anyOf(targets).desc();
    return {desc.width, desc.height};
}

PassRequest requestFor(const Builder& builder, const Pass& pass, const Extent& viewport, std::uint32_t instances) {
    const Prepared& prepared = builder.prepared;
    return {.effect = builder.input.effect,
            .pass = pass,
            .mesh = *builder.input.mesh,
            .world = prepared.scene.world,
            .viewProjection = glm::dmat4(prepared.scene.camera.viewProjection),
            .eye = eyeOf(prepared.scene),
            .horizontalFov = static_cast<double>(prepared.scene.camera.horizontalFov),
            .viewportWidth = viewport.width,
            .instances = instances,
            .value = [&prepared](const Parameter& parameter) { return prepared.values.require(parameter); },
            .rows = [&prepared](const std::string& target) -> std::optional<std::uint32_t> {
                const auto found = prepared.targets.find(target);
                if (found == prepared.targets.end()) return std::nullopt;
                return found->second.extent.height;
            }};
}

void setRanges(std::span<const ListedRange> ranges, gpu::Draw& draw) {
    draw.first = draw.count = 0;
    if (ranges.empty()) return;
    draw.first = ranges.front().first;
    draw.count = ranges.front().count;
    if (ranges.front().instances > 0) draw.instances = ranges.front().instances;
    for (const ListedRange& range : ranges.subspan(1))
        draw.more.push_back({range.first, range.count, range.firstInstance, range.instances});
}

/// Indices of a list are uploaded once a frame.
Result<const gpu::Buffer*> indicesOf(const std::shared_ptr<const DrawList>& list, Builder& builder) {
    auto& lists = builder.frame.lists;
    const auto found = std::ranges::find(lists, list, &FrameList::list);
    if (found != lists.end()) return static_cast<const gpu::Buffer*>(found->indices.get());
    auto buffer = builder.resources.device.createBuffer(gpu::BufferUsage::Index, std::as_bytes(std::span(list->indices)));
    if (!buffer) return buffer.error();
    lists.push_back({.list = list, .indices = std::make_unique<gpu::Buffer>(std::move(*buffer))});
    return static_cast<const gpu::Buffer*>(lists.back().indices.get());
}

/// The draw has indices, ranges and instances of the whole mesh; it gets those of the pass.
Result<void> chooseTriangles(Builder& builder, const DrawStep& step, const Extent& viewport, gpu::Draw& draw) {
    if (const auto& ask = builder.input.options.assets.list) {
        const auto list = ask(requestFor(builder, *step.pass, viewport, draw.instances));
        if (!list) return list.error();
        if (*list) {
            setRanges((*list)->ranges, draw);
            if ((*list)->indices.empty() || (*list)->ranges.empty()) return {};
            const auto indices = indicesOf(*list, builder);
            if (!indices) return indices.error();
            draw.indices = *indices;
            return {};
        }
    }
    const auto ranges = partOf(builder.input.effect, *step.pass, *builder.input.mesh);
    if (!ranges) return ranges.error();
    setRanges(*ranges, draw);
    return {};
}

/// Where the draw is of all of a mesh.
void useCoarser(const Builder& builder, const Extent& viewport, gpu::Draw& draw) {
    const RunOptions& options = builder.input.options;
    const Extent picture{static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height)};
    if (!options.coarser.triangles || !(options.coarser.everywhere || viewport == picture)) return;
    const Store& store = builder.resources.store;
    const Geometry& geometry = *store.meshes.at(builder.input.mesh);
    const auto coarse = store.coarse.find(builder.input.mesh);
    const bool whole = draw.indices == &geometry.indices && draw.first == 0 && draw.count == geometry.indexCount && draw.more.empty();
    if (coarse == store.coarse.end() || !whole) return;
    draw.indices = &coarse->second->indices;
    draw.count = coarse->second->indexCount;
}

Result<void> addDraw(Builder& builder, const DrawStep& step) {
    const auto instances = instancesOf(builder, step);
    if (!instances) return instances.error();
    FrameDraw item{.described = describe(step, builder.prepared, builder.object), .targets = targetsOf(builder, step)};
    const auto pipeline = pipelineFor(builder, step, item.targets);
    if (!pipeline) return pipeline.error();
    const Geometry& geometry =
        step.kind == DrawKind::Buffer ? *builder.resources.store.quad : *builder.resources.store.meshes.at(builder.input.mesh);
    item.draw.pipeline = *pipeline;
    item.draw.vertices = &geometry.vertices;
    item.draw.indices = &geometry.indices;
    item.draw.count = geometry.indexCount;
    item.draw.instances = *instances;
    const Extent viewport = extentOf(item.targets);
    if (const auto vertices = step.pass->annotations.numbers("VertexCount"); vertices && step.kind == DrawKind::Buffer) {
        item.draw.indices = nullptr; // the shader places them by SV_VertexID
        item.draw.count = static_cast<std::uint32_t>(std::clamp(vertices->front(), 0.0, 1e6));
    }
    if (step.kind != DrawKind::Buffer) {
        if (const auto chosen = chooseTriangles(builder, step, viewport, item.draw); !chosen) return chosen;
        useCoarser(builder, viewport, item.draw);
    }
    const PassProgram& program = *builder.prepared.programs.at(step.pass);
    if (const auto bound = bindStage(builder, step, program.vertex, viewport, item); !bound) return bound;
    if (program.pixel)
        if (const auto bound = bindStage(builder, step, *program.pixel, viewport, item); !bound) return bound;
    if (*instances > 0) builder.frame.items.emplace_back(std::move(item));
    return {};
}

Result<const gpu::Pipeline*> computePipelineFor(Builder& builder, const Pass& pass, const PassProgram& program) {
    auto& known = builder.resources.kit.computes;
    if (const auto found = known.find(&pass); found != known.end()) return static_cast<const gpu::Pipeline*>(found->second.get());
    const PipelineSource source{.program = builder.prepared.programs.at(&pass)};
    if (auto shared = builder.resources.store.shared.find(source))
        return static_cast<const gpu::Pipeline*>(known.emplace(&pass, std::move(shared)).first->second.get());
    auto pipeline = builder.resources.device.createPipeline(
        gpu::ComputePipelineDesc{.name = pass.name, .shader = codeOf(*program.compute), .bindings = program.bindings});
    if (!pipeline) return pipeline.error();
    auto made = std::make_shared<const gpu::Pipeline>(std::move(*pipeline));
    builder.resources.store.shared.add(source, made);
    const auto* kept = static_cast<const gpu::Pipeline*>(known.emplace(&pass, std::move(made)).first->second.get());
    if (const auto pause = pauseAfter(builder.input.options); !pause) return pause.error();
    return kept;
}

/// VIEWPORTPIXELSIZE is the size of the target that Viewport names (nothing: the picture), else Threads, else of what is written.
Extent extentOf(const Builder& builder, const DrawStep& step, const PassProgram& program) {
    const auto viewport = step.pass->annotations.string("Viewport");
    const auto named = viewport ? viewport : step.pass->annotations.string("Threads");
    if (!named && program.use.stored.empty()) return {};
    const std::string name = named ? *named : *program.use.stored.begin();
    const auto found = builder.prepared.targets.find(name.empty() ? kPicture : name);
    return found == builder.prepared.targets.end() ? Extent{} : found->second.extent;
}

Result<void> addDispatch(Builder& builder, const DrawStep& step) {
    const PassProgram& program = *builder.prepared.programs.at(step.pass);
    if (const auto& fits = builder.input.options.assets.fits; fits && builder.input.mesh)
        if (const auto fit = fits(requestFor(builder, *step.pass, {}, 1)); !fit) return fit;
    const auto groups = groupsOf(builder.input.effect, builder.prepared, *step.pass);
    if (!groups) return groups.error();
    const auto pipeline = computePipelineFor(builder, *step.pass, program);
    if (!pipeline) return pipeline.error();
    FrameDraw item{.described = describe(step, builder.prepared, builder.object)};
    item.groups = *groups;
    item.draw.pipeline = *pipeline;
    for (const std::string& name : program.use.stored)
        item.stored.push_back(&builder.resources.targets.at(name));
    if (const auto bound = bindStage(builder, step, *program.compute, extentOf(builder, step, program), item); !bound) return bound;
    if (item.computes()) builder.frame.items.emplace_back(std::move(item));
    return {};
}

Result<void> addStep(Builder& builder, const Step& step) {
    if (const auto* draw = std::get_if<DrawStep>(&step))
        return draw->kind == DrawKind::Compute ? addDispatch(builder, *draw) : addDraw(builder, *draw);
    const auto* clear = std::get_if<ClearStep>(&step);
    if (clear && (builder.object == 0 || !isCallers(clear->target)))
        builder.frame.items.emplace_back(FrameClear{&builder.resources.targets.at(clear->target), *clear});
    if (const auto* mips = std::get_if<MipStep>(&step))
        builder.frame.items.emplace_back(FrameMips{&builder.resources.targets.at(mips->target)});
    if (const auto* copy = std::get_if<CopyStep>(&step))
        builder.frame.items.emplace_back(FrameCopy{&builder.resources.targets.at(copy->from), &builder.resources.targets.at(copy->to)});
    return {};
}

bool drawsMesh(const Step& step) {
    const auto* draw = std::get_if<DrawStep>(&step);
    return draw && draw->kind != DrawKind::Buffer && draw->kind != DrawKind::Compute;
}

Result<void> recordClear(const FrameClear& item, gpu::Recorder& recorder) {
    gpu::Texture& target = *item.target;
    if (item.step.what == ClearKind::Color) return recorder.clearColor(target, item.step.color);
    if (item.step.what == ClearKind::Depth) return recorder.clearDepthStencil(target, item.step.depth, std::nullopt);
    if (!gpu::hasStencil(target.desc().format)) return {};
    return recorder.clearDepthStencil(target, std::nullopt, item.step.stencil);
}

void recordClears(gpu::Recorder& recorder) {
    recorder.beginTimer(kClears);
    recorder.clearNow();
    recorder.endTimer();
}

/// `cleared`: clears have been asked for since the last draw and are to be timed by themselves.
Result<void> recordTimed(const FrameItem& item, gpu::Recorder& recorder, bool cleared) {
    const auto* draw = std::get_if<FrameDraw>(&item);
    if (!draw) return recordItem(item, recorder);
    if (cleared) recordClears(recorder);
    recorder.beginTimer(draw->described.name);
    auto drawn = recordItem(item, recorder);
    recorder.endTimer();
    return drawn;
}

} // namespace

Result<Frame> buildFrame(std::span<const ObjectRun> objects, Resources& resources) {
    Frame frame;
    const auto add = [&](std::size_t index, const Step& step) {
        Builder builder{.input = objects[index].input,
                        .prepared = objects[index].prepared,
                        .object = static_cast<int>(index),
                        .resources = resources,
                        .frame = frame};
        return addStep(builder, step);
    };
    const auto& global = objects.front().input.effect.standardsGlobal;
    const bool together = global && equalsIgnoreCase(global->scriptClass, "scene");
    for (std::size_t script = 0; script < (together ? 1 : objects.size()); ++script)
        for (const Step& step : objects[script].prepared.plan.steps) {
            const bool everyMesh = together && drawsMesh(step);
            for (std::size_t mesh = everyMesh ? 0 : script; mesh < (everyMesh ? objects.size() : script + 1); ++mesh)
                if (const auto added = add(mesh, step); !added) return added.error();
        }
    if (const auto resolved = resources.targets.find(kPictureResolved); resolved != resources.targets.end())
        frame.resolve = FrameResolve{&resources.targets.at(kPicture), &resolved->second};
    return frame;
}

Result<void> recordDrawIn(const FrameDraw& draw, const std::optional<gpu::RowRange>& rows, gpu::Recorder& recorder) {
    if (draw.computes()) return recorder.dispatch(*draw.draw.pipeline, draw.draw.resources, draw.groups);
    if (!rows) return recorder.draw(draw.targets, draw.draw);
    gpu::Draw part = draw.draw;
    part.rows = rows;
    return recorder.draw(draw.targets, part);
}

Result<void> recordItem(const FrameItem& item, gpu::Recorder& recorder) {
    if (const auto* draw = std::get_if<FrameDraw>(&item)) return recordDrawIn(*draw, std::nullopt, recorder);
    if (const auto* clear = std::get_if<FrameClear>(&item)) return recordClear(*clear, recorder);
    if (const auto* copy = std::get_if<FrameCopy>(&item)) return recorder.copy(*copy->from, *copy->to);
    return recorder.generateMips(*std::get<FrameMips>(item).target);
}

Result<void> recordNode(const FrameNode& node, gpu::Recorder& recorder) {
    for (const FrameItem& item : node.items)
        if (auto done = recordItem(item, recorder); !done) return done;
    return {};
}

Result<void> recordResolve(const FrameResolve& item, gpu::Recorder& recorder) {
    recorder.beginTimer(kResolve);
    auto resolved = recorder.resolve(*item.from, *item.to);
    recorder.endTimer();
    return resolved;
}

Result<void> record(const Frame& frame, gpu::Recorder& recorder, std::size_t items) {
    for (const FrameNode& node : frame.before)
        if (auto done = recordNode(node, recorder); !done) return done;
    bool cleared = false;
    for (std::size_t i = 0; i < std::min(items, frame.items.size()); ++i) {
        if (!frame.kept.empty() && frame.kept[i]) continue;
        const FrameItem& item = frame.items[i];
        if (auto done = recordTimed(item, recorder, cleared && frame.clearsApart); !done) return done;
        cleared = std::holds_alternative<FrameClear>(item) || (cleared && !std::holds_alternative<FrameDraw>(item));
    }
    return frame.resolve && !frame.resolveKept ? recordResolve(*frame.resolve, recorder) : Result<void>();
}

} // namespace tegument::run
