#include "host/run/resources.h"

#include "host/image/mips.h"
#include "host/run/pieces.h"
#include "host/run/pixels.h"
#include "host/spirv/reflect.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::run {

namespace {

Result<void> allocateTargets(const RunInput& input, const Prepared& prepared, Resources& resources) {
    for (const auto& [name, target] : prepared.targets) {
        if (resources.targets.contains(name)) continue;
        auto texture = resources.device.createTexture({.name = name,
                                                       .format = target.format,
                                                       .width = target.extent.width,
                                                       .height = target.extent.height,
                                                       .mips = target.mips,
                                                       .cube = false,
                                                       .renderTarget = true,
                                                       .samples = target.samples,
                                                       .storage = target.stored});
        if (!texture) return texture.error();
        resources.targets.emplace(name, std::move(*texture));
        if (const auto pause = pauseAfter(input.options); !pause) return pause;
    }
    return {};
}

/// A picture, or a cube's face, and the levels made of it. Of wider sRGB values the light is in the texture: of that the means are taken,
/// too.
Result<void> uploadChain(gpu::Device& device, const TextureData& data, const Image& image, gpu::Texture& texture, std::uint32_t face) {
    const Image light = data.decode ? decoded(image) : Image();
    const Image& top = data.decode ? light : image;
    auto uploaded = device.upload(texture, texels(top, data.format, false), 0, face);
    std::uint32_t mip = 0;
    for (const Image& level : mipLevels(top, data.format == PixelFormat::RGBA8Srgb ? MeanOf::Light : MeanOf::Values))
        if (uploaded) uploaded = device.upload(texture, texels(level, data.format, false), ++mip, face);
    return uploaded;
}

Result<void> uploadLevels(gpu::Device& device, const TextureData& data, gpu::Texture& texture) {
    if (data.file.images.empty() && data.mips) return uploadChain(device, data, data.image, texture, 0);
    if (data.file.images.empty()) return device.upload(texture, texels(data.image, data.format, data.decode));
    for (int face = 0; face < data.file.faces; ++face)
        for (int mip = 0; mip < data.file.mips; ++mip) {
            const Image& image = data.file.at(face, mip);
            const auto to = static_cast<std::uint32_t>(face);
            const auto uploaded =
                data.mips ? uploadChain(device, data, image, texture, to)
                          : device.upload(texture, texels(image, data.format, data.decode), static_cast<std::uint32_t>(mip), to);
            if (!uploaded) return uploaded;
        }
    return {};
}

Result<gpu::Texture> uploadTexture(gpu::Device& device, const std::string& name, const TextureData& data) {
    auto texture = device.createTexture({.name = name,
                                         .format = data.format,
                                         .width = static_cast<std::uint32_t>(data.image.width),
                                         .height = static_cast<std::uint32_t>(data.image.height),
                                         .mips = data.mips ? 0U : static_cast<std::uint32_t>(data.file.mips),
                                         .cube = data.file.isCube()});
    if (!texture) return texture;
    if (const auto uploaded = uploadLevels(device, data, *texture); !uploaded) return uploaded.error();
    return texture;
}

Result<void> uploadTextures(const RunInput& input, const Prepared& prepared, Resources& resources) {
    Store& store = resources.store;
    for (const auto& [name, data] : prepared.textures) {
        if (store.textures.contains(data.key) || store.products.contains(data.key)) continue;
        const auto loaded = store.loaded.find(data.key);
        const TextureData& texels = loaded == store.loaded.end() ? data : loaded->second;
        auto texture = uploadTexture(resources.device, name, texels);
        if (!texture) return texture.error();
        store.textures.emplace(data.key, std::make_shared<gpu::Texture>(std::move(*texture)));
        store.uploaded.insert(data.key);
        if (loaded != store.loaded.end()) store.loaded.erase(loaded);
        if (const auto pause = pauseAfter(input.options); !pause) return pause;
    }
    return {};
}

/// Mesa's software device (22.3 with LLVM 15) dies of an anisotropic look-up that brings gradients of its own. Where pixels have several
/// samples it takes ten seconds and more for one picture, whatever its size: gradients beyond an outline are any number there. And it dies
/// of a look-up with a level or a bias of its own where only one of the filters is POINT.
bool suffersFromAnisotropy(const RunInput& input, const gpu::Device& device, const Prepared& prepared, const SamplerState& state) {
    if (!device.info().driver.starts_with("llvmpipe")) return false;
    const bool onePoint = (state.minFilter == Filter::Point) != (state.magFilter == Filter::Point);
    return onePoint || input.options.samples > 1 || std::ranges::any_of(prepared.programs, [](const auto& program) {
               return program.second->pixel && spirv::readsByGradient(program.second->pixel->spirv);
           });
}

Result<void> createSamplers(const RunInput& input, const Prepared& prepared, Resources& resources) {
    std::set<std::string> names;
    for (const auto& program : prepared.programs)
        names.insert(program.second->samplers.begin(), program.second->samplers.end());
    std::vector<std::string> declared;
    for (const Sampler& sampler : input.effect.samplers)
        declared.push_back(sampler.name);
    for (const std::string& name : names) {
        if (resources.kit.samplers.contains(name)) continue;
        const Sampler* sampler = input.effect.findSampler(name);
        if (!sampler)
            return inputError(4005, {.file = input.effect.file.string()},
                              fmt::format("a shader samples with {}, which the effect does not declare outside FX_ENTRY", name),
                              didYouMean(name, declared));
        SamplerState state = sampler->state;
        if (suffersFromAnisotropy(input, resources.device, prepared, state)) state.maxAnisotropy = 1;
        auto shared = resources.store.shared.find(state);
        if (!shared) {
            auto made = resources.device.createSampler(state);
            if (!made) return made.error();
            shared = std::make_shared<const gpu::Sampler>(std::move(*made));
            resources.store.shared.add(state, shared);
        }
        resources.kit.samplers.emplace(name, std::move(shared));
    }
    return {};
}

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

Result<Geometry> uploadGeometry(gpu::Device& device, const Mesh& mesh) {
    auto vertices = device.createBuffer(gpu::BufferUsage::Vertex, bytesOf(interleave(mesh)));
    if (!vertices) return vertices.error();
    auto indices = device.createBuffer(gpu::BufferUsage::Index, bytesOf(mesh.indices));
    if (!indices) return indices.error();
    return Geometry{std::move(*vertices), std::move(*indices), static_cast<std::uint32_t>(mesh.indices.size())};
}

Result<void> uploadCoarser(const RunInput& input, Resources& resources) {
    const std::shared_ptr<const FewerTriangles>& asked = input.options.coarser.triangles;
    if (!asked) return {};
    Store& store = resources.store;
    if (store.coarser != asked) store.coarse.clear();
    store.coarser = asked;
    const auto triangles = asked->find(input.mesh);
    if (triangles == asked->end() || store.coarse.contains(input.mesh)) return {};
    auto indices = resources.device.createBuffer(gpu::BufferUsage::Index, bytesOf(triangles->second));
    if (!indices) return indices.error();
    store.coarse.emplace(input.mesh, std::make_shared<FewerIndices>(
                                         FewerIndices{std::move(*indices), static_cast<std::uint32_t>(triangles->second.size())}));
    return {};
}

Result<void> uploadMeshes(const RunInput& input, const Prepared& prepared, Resources& resources) {
    if (!resources.store.quad) {
        auto quad = uploadGeometry(resources.device, fullScreenQuad());
        if (!quad) return quad.error();
        resources.store.quad = std::make_shared<const Geometry>(std::move(*quad));
    }
    if (!prepared.drawsMesh) return {};
    if (const auto coarse = uploadCoarser(input, resources); !coarse) return coarse;
    if (resources.store.meshes.contains(input.mesh)) return {};
    auto mesh = uploadGeometry(resources.device, *input.mesh);
    if (!mesh) return mesh.error();
    resources.store.meshes.emplace(input.mesh, std::make_shared<Geometry>(std::move(*mesh)));
    return pauseAfter(input.options);
}

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

gpu::Texture* Resources::texture(const Prepared& prepared, const std::string& name) {
    if (const auto target = targets.find(name); target != targets.end()) return &target->second;
    const auto data = prepared.textures.find(name);
    if (data == prepared.textures.end()) return nullptr;
    if (const auto product = store.products.find(data->second.key); product != store.products.end()) return product->second;
    const auto found = store.textures.find(data->second.key);
    return found == store.textures.end() ? nullptr : found->second.get();
}

gpu::Texture* Resources::picture() {
    for (const char* name : {kPictureResolved, kPicture})
        if (const auto found = targets.find(name); found != targets.end()) return &found->second;
    return nullptr;
}

Result<void> allocate(const RunInput& input, const Prepared& prepared, Resources& resources) {
    for (const auto step : {allocateTargets, uploadTextures, createSamplers, uploadMeshes})
        if (const auto done = step(input, prepared, resources); !done) return done;
    return {};
}

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
