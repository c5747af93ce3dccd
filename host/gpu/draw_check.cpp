#include "host/gpu/draw_check.h"

#include "host/gpu/error.h"
#include "host/gpu/pipeline_layout.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::gpu::detail {

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

/// All colour targets of one size; the depth target may be larger, as in Direct3D 9.
Result<void> checkSizes(const PipelineHandle& pipeline, const Scope& scope) {
    if (scope.colors.empty()) return {};
    const TextureDesc& first = scope.colors.front()->desc;
    const auto differs = [&](const TextureState* color) { return color->desc.width != first.width || color->desc.height != first.height; };
    const auto odd = std::ranges::find_if(scope.colors, differs);
    const TextureState* wrong = odd != scope.colors.end() ? *odd : nullptr;
    if (scope.depth && (scope.depth->desc.width < first.width || scope.depth->desc.height < first.height)) wrong = scope.depth;
    if (!wrong) return {};
    return requestError(6036, fmt::format("pipeline '{}': targets '{}' ({}x{}) and '{}' ({}x{}) do not fit together", pipeline.name,
                                          first.name, first.width, first.height, wrong->desc.name, wrong->desc.width, wrong->desc.height));
}

Result<void> checkDistinct(const PipelineHandle& pipeline, const Scope& scope) {
    for (auto color = scope.colors.begin(); color != scope.colors.end(); ++color)
        if (std::find(color + 1, scope.colors.end(), *color) != scope.colors.end())
            return requestError(6034, fmt::format("pipeline '{}': '{}' is set as two colour targets", pipeline.name, (*color)->desc.name));
    return {};
}

Result<void> checkNotSampled(const PipelineHandle& pipeline, const Scope& scope, const std::vector<BoundResource>& resources) {
    for (const BoundResource& resource : resources) {
        const auto* bound = std::get_if<Texture*>(&resource.resource);
        const TextureState* texture = bound ? state(*bound) : nullptr;
        if (!texture || (texture != scope.depth && std::ranges::find(scope.colors, texture) == scope.colors.end())) continue;
        return requestError(6034,
                            fmt::format("pipeline '{}': '{}' is a {} target of the draw that reads it at set {} binding {}", pipeline.name,
                                        texture->desc.name, texture == scope.depth ? "depth" : "colour", resource.set, resource.binding),
                            "draw to another texture and read that one in the next pass");
    }
    return {};
}

} // namespace

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

Result<Scope> checkTargets(const PipelineHandle& pipeline, const Targets& targets, const std::vector<BoundResource>& resources) {
    Scope scope{.depth = state(targets.depth)};
    for (const Texture* color : targets.colors)
        scope.colors.push_back(state(color));
    if (const auto distinct = checkDistinct(pipeline, scope); !distinct) return distinct.error();
    if (const auto apart = checkNotSampled(pipeline, scope, resources); !apart) return apart.error();
    if (const auto formats = checkFormats(pipeline, scope); !formats) return formats.error();
    if (const auto sizes = checkSizes(pipeline, scope); !sizes) return sizes.error();
    return scope;
}

Result<void> checkStored(const PipelineHandle& pipeline, const std::vector<BoundResource>& resources) {
    const auto textureOf = [](const BoundResource& resource) -> const TextureState* {
        if (const auto* stored = std::get_if<StoredTexture>(&resource.resource)) return state(stored->texture);
        const auto* sampled = std::get_if<Texture*>(&resource.resource);
        return sampled ? state(*sampled) : nullptr;
    };
    for (const BoundResource& stored : resources) {
        if (!std::holds_alternative<StoredTexture>(stored.resource)) continue;
        for (const BoundResource& other : resources)
            if (&other != &stored && textureOf(other) == textureOf(stored))
                return requestError(
                    6034,
                    fmt::format("pipeline '{}': '{}' is bound at set {} binding {}, and the dispatch writes it at binding {}",
                                pipeline.name, textureOf(stored)->desc.name, other.set, other.binding, stored.binding),
                    "write another texture and read that one in the next pass");
    }
    return {};
}

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

} // namespace tegument::gpu::detail
