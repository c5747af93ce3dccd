#include "host/run/resources.h"

#include "host/run/pixels.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument::run {

namespace {

Result<void> allocateTargets(const RunInput& input, const Prepared& prepared, Resources& resources) {
    for (const auto& [name, target] : prepared.targets) {
        auto texture = input.device.createTexture({.name = name,
                                                   .format = target.format,
                                                   .width = target.extent.width,
                                                   .height = target.extent.height,
                                                   .mips = target.mips,
                                                   .cube = false,
                                                   .renderTarget = true});
        if (!texture) return texture.error();
        resources.targets.emplace(name, std::move(*texture));
    }
    return {};
}

Result<void> uploadTextures(const RunInput& input, const Prepared& prepared, Resources& resources) {
    std::vector<gpu::Texture*> chains;
    for (const auto& [name, data] : prepared.textures) {
        auto texture = input.device.createTexture({.name = name,
                                                   .format = data.format,
                                                   .width = static_cast<std::uint32_t>(data.image.width),
                                                   .height = static_cast<std::uint32_t>(data.image.height),
                                                   .mips = data.mips ? 0U : 1U});
        if (!texture) return texture.error();
        const auto uploaded = input.device.upload(*texture, texels(data.image, data.format, data.decode));
        if (!uploaded) return uploaded;
        const auto placed = resources.textures.emplace(name, std::move(*texture));
        if (data.mips) chains.push_back(&placed.first->second);
    }
    if (chains.empty()) return {};
    const auto run = input.device.run([&](gpu::Recorder& recorder) -> Result<void> {
        for (gpu::Texture* texture : chains)
            if (const auto made = recorder.generateMips(*texture); !made) return made;
        return {};
    });
    return run ? Result<void>() : Result<void>(run.error());
}

Result<void> createSamplers(const RunInput& input, const Prepared& prepared, Resources& resources) {
    std::set<std::string> names;
    for (const auto& program : prepared.programs)
        names.insert(program.second.samplers.begin(), program.second.samplers.end());
    std::vector<std::string> declared;
    for (const Sampler& sampler : input.effect.samplers)
        declared.push_back(sampler.name);
    for (const std::string& name : names) {
        const Sampler* sampler = input.effect.findSampler(name);
        if (!sampler)
            return inputError(4005, {.file = input.effect.file.string(), .byte = {}},
                              fmt::format("a shader samples with {}, which the effect does not declare outside FX_ENTRY", name),
                              didYouMean(name, declared));
        auto made = input.device.createSampler(sampler->state);
        if (!made) return made.error();
        resources.samplers.emplace(name, std::move(*made));
    }
    return {};
}

Result<void> uploadMeshes(const RunInput& input, const Prepared& prepared, Resources& resources) {
    auto quad = uploadGeometry(input.device, fullScreenQuad());
    if (!quad) return quad.error();
    resources.quad = std::move(*quad);
    if (!prepared.drawsMesh) return {};
    auto mesh = uploadGeometry(input.device, *input.mesh);
    if (!mesh) return mesh.error();
    resources.mesh = std::move(*mesh);
    return {};
}

} // namespace

gpu::Texture* Resources::texture(const std::string& name) {
    if (const auto target = targets.find(name); target != targets.end()) return &target->second;
    const auto found = textures.find(name);
    return found == textures.end() ? nullptr : &found->second;
}

Result<Resources> allocate(const RunInput& input, const Prepared& prepared) {
    Resources resources;
    for (const auto step : {allocateTargets, uploadTextures, createSamplers, uploadMeshes})
        if (const auto done = step(input, prepared, resources); !done) return done.error();
    return resources;
}

} // namespace tegument::run
