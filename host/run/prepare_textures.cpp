// Textures of a run, loaded into memory: from files, from the mesh, from other effects.

#include "host/run/pixels.h"
#include "host/run/prepare.h"
#include "host/run/producer.h"
#include "host/run/texture_source.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::run {

namespace {

/// Mip chains are made for textures that a sampler of this effect reads with a linear mip filter.
bool wantsMips(const Effect& effect, const std::string& texture) {
    return std::ranges::any_of(effect.samplers, [&](const Sampler& sampler) {
        return sampler.texture == texture && sampler.state.mipmapping && sampler.state.mipFilter == Filter::Linear;
    });
}

TextureData fromImage(const Parameter& parameter, Image image, bool mips) {
    const bool srgb = equalsIgnoreCase(parameter.annotations.string("ColorSpace").value_or("linear"), "sRGB");
    TextureData texture{.image = std::move(image), .format = {}, .decode = false, .mips = mips};
    texture.format = formatFor(texture.image, srgb);
    texture.decode = srgb && texture.image.bitsPerChannel == 16; // float files are linear already, 8 bits are decoded by the sampler
    return texture;
}

TextureData fromConstant(const ConstantSource& constant) {
    Image image{.width = 1, .height = 1, .channels = 4, .pixels = {constant.begin(), constant.end()}};
    return {.image = std::move(image), .format = gpu::Format::RGBA32F};
}

Result<TextureData> load(const RunInput& input, const Parameter& parameter, std::vector<Diagnostic>& warnings) {
    const auto source = findTexture(parameter, input.effect, input.options.textures, input.workspace, input.mesh);
    if (!source) return source.error();
    const bool mips = wantsMips(input.effect, parameter.name);
    if (const auto* file = std::get_if<FileSource>(&*source)) {
        auto image = loadNamed(parameter, *file);
        if (!image) return image.error();
        return fromImage(parameter, std::move(*image), mips);
    }
    if (const auto* embedded = std::get_if<const EmbeddedTexture*>(&*source)) return fromImage(parameter, (*embedded)->image, mips);
    if (const auto* producer = std::get_if<ProducerSource>(&*source)) return produceTexture(input, parameter, *producer, warnings);
    return fromConstant(std::get<ConstantSource>(*source));
}

} // namespace

Result<void> prepareTextures(const RunInput& input, Prepared& prepared) {
    std::set<std::string> names;
    for (const auto& program : prepared.programs)
        names.insert(program.second.use.sampled.begin(), program.second.use.sampled.end());
    for (const std::string& name : names) {
        if (prepared.targets.contains(name)) continue;
        const Parameter* parameter = input.effect.findParameter(name);
        if (!parameter)
            return inputError(4005, {.file = input.effect.file.string(), .byte = {}},
                              fmt::format("a shader samples {}, which the effect does not declare outside FX_ENTRY", name),
                              "declare it outside the #ifdef");
        if (parameter->type.base != BaseType::Texture2D)
            return inputError(4032, parameter->at, fmt::format("{} is a {}: this host loads Texture2D only", name, parameter->type.name));
        auto texture = load(input, *parameter, prepared.warnings);
        if (!texture) return texture.error();
        prepared.textures.emplace(name, std::move(*texture));
    }
    return {};
}

} // namespace tegument::run
