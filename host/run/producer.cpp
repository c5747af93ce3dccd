#include "host/run/producer.h"

#include "host/run/execute.h"
#include "host/run/pixels.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>

namespace tegument::run {

namespace fs = std::filesystem;

namespace {

// Targets without a size of their own follow the picture; a producing effect draws this one and throws it away.
constexpr int kProducerPicture = 64;

template <class T>
std::string hashOf(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return contentHash({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string meshKey(const Mesh& mesh) {
    return fmt::format("{} {} {} {} {}", hashOf(mesh.positions), hashOf(mesh.normals), hashOf(mesh.tangents), hashOf(mesh.uvs),
                       hashOf(mesh.indices));
}

std::string textureKey(const TextureData& texture) {
    std::string key = fmt::format("{} {}x{}", hashOf(texture.image.pixels), texture.image.width, texture.image.height);
    for (const Image& image : texture.file.images)
        key += " " + hashOf(image.pixels);
    return key;
}

Result<std::string> sourceKey(const Effect& effect) {
    std::string key;
    std::vector<fs::path> files = effect.includes;
    files.insert(files.begin(), effect.file);
    for (const fs::path& file : files) {
        const auto text = readFile(file);
        if (!text) return text.error();
        key += fmt::format("{} {}\n", file.filename().string(), contentHash(*text));
    }
    for (const auto& [name, value] : effect.defines)
        key += fmt::format("{}={}\n", name, value);
    return key;
}

std::string valueKey(const Prepared& prepared) {
    std::set<std::string> names; // sorted: passes are in the order of their addresses
    for (const auto& program : prepared.programs)
        names.insert(program.second.numbers.begin(), program.second.numbers.end());
    std::string key;
    for (const std::string& name : names)
        if (const Numbers* value = prepared.values.find(name)) key += fmt::format("{} {}\n", name, hashOf(*value));
    return key;
}

RunOptions producerOptions(const RunOptions& options, const Effect& effect, const std::string& target) {
    RunOptions own{.technique = {}, .width = kProducerPicture, .height = kProducerPicture, .compiler = options.compiler, .dump = {target}};
    for (const auto& [name, value] : options.parameters)
        if (effect.findParameter(name)) own.parameters.emplace(name, value);
    for (const auto& [name, file] : options.textures)
        if (const Parameter* parameter = effect.findParameter(name); parameter && parameter->type.isTexture())
            own.textures.emplace(name, file);
    return own;
}

/// Producer errors point into the other effect; this says how one got there.
Error through(Error error, const Parameter& parameter, const ProducerSource& source) {
    error.diagnostics.push_back({.severity = Severity::Note,
                                 .code = 4037,
                                 .at = parameter.at,
                                 .text = fmt::format("{} is drawn by {}", parameter.name, source.effect.string()),
                                 .hint = fmt::format("or give a file: --set {}=FILE", parameter.name),
                                 .sourceLine = {}});
    return error;
}

/// The formats of cached products: floats keep what a float target holds, and no less than an 8-bit one does.
gpu::Format productFormat(gpu::Format target) {
    if (gpu::isDepth(target)) return gpu::Format::R32F;
    switch (target) {
    case gpu::Format::R16F:
    case gpu::Format::RG16F:
    case gpu::Format::RGBA16F:
    case gpu::Format::R32F:
    case gpu::Format::RG32F: return target;
    default: return gpu::Format::RGBA32F;
    }
}

std::optional<Image> cached(const fs::path& path, const TargetDesc& target) {
    std::error_code code;
    if (!fs::exists(path, code)) return std::nullopt;
    auto image = loadImage(path);
    if (!image) return std::nullopt;
    const bool fits = image->width == static_cast<int>(target.extent.width) && image->height == static_cast<int>(target.extent.height) &&
                      image->channels == channelCount(target.format);
    return fits ? std::optional(std::move(*image)) : std::nullopt;
}

Result<TextureData> draw(const RunInput& own, Prepared& prepared, const std::string& target, const std::set<std::string>* uploaded,
                         std::vector<Diagnostic>& warnings) {
    const TargetDesc& desc = prepared.targets.at(target);
    const auto key = productKey(own, prepared, target);
    if (!key) return key.error();
    TextureData texture{.image = {}, .format = productFormat(desc.format), .key = "product " + *key, .file = {}};
    if (uploaded && uploaded->contains(texture.key)) return texture;
    if (auto image = cached(productPath(*key), desc)) {
        texture.image = std::move(*image);
        return texture;
    }
    auto result = execute(own, prepared);
    if (!result) return result.error();
    texture.image = std::move(result->dumped.at(target));
    warnings.insert(warnings.end(), result->warnings.begin(), result->warnings.end());
    if (const auto written = writeExr(productPath(*key), texture.image); !written) {
        Diagnostic warning = written.error().diagnostics.front(); // the picture is right without the cache
        warning.severity = Severity::Warning;
        warnings.push_back(std::move(warning));
    }
    return texture;
}

Result<void> checkProduct(const Effect& effect, const Prepared& prepared, const ProducerSource& source) {
    std::vector<std::string> drawn;
    for (const std::string& name : prepared.plan.targets())
        if (effect.findParameter(name)) drawn.push_back(name);
    if (std::ranges::find(drawn, source.target) != drawn.end()) return {};
    return inputError(4036, {.file = effect.file.string(), .byte = {}},
                      fmt::format("technique {} draws no target '{}'", prepared.plan.technique->name, source.target),
                      didYouMean(source.target, drawn));
}

/// A texture that is drawn once belongs to the mesh wherever it stands: it is drawn as if the mesh stood in its own space, camera and light
/// moved along. So several heads of one mesh share it.
std::optional<PlacedObject> inOwnSpace(const RunInput& input) {
    if (!input.placed) return std::nullopt;
    PlacedObject local{
        .placement = {}, .scene = seenFrom(input.placed->scene, input.placed->placement), .worldUnitMm = input.placed->worldUnitMm};
    local.placement.scale = input.placed->placement.scale;
    return local;
}

Result<TextureData> produce(const RunInput& input, const ProducerSource& source, std::vector<Diagnostic>& warnings) {
    const std::string self = fs::weakly_canonical(source.effect).string();
    std::vector<std::string> chain = input.producers;
    if (chain.empty()) chain.push_back(fs::weakly_canonical(input.effect.file).string());
    if (std::ranges::find(chain, self) != chain.end())
        return inputError(4035, {.file = self, .byte = {}}, "this effect would have to draw a texture that it needs itself",
                          "producers must not form a circle");
    chain.push_back(self);
    const auto effect = loadEffect(source.effect, {.defines = input.effect.defines, .includeFolders = input.effect.includeFolders});
    if (!effect) return effect.error();
    const RunOptions options = producerOptions(input.options, *effect, source.target);
    RunInput own{.device = input.device,
                 .effect = *effect,
                 .mesh = input.mesh,
                 .workspace = input.workspace,
                 .options = options,
                 .producers = std::move(chain)};
    const std::optional<PlacedObject> local = inOwnSpace(input);
    own.placed = local ? &*local : nullptr;
    auto prepared = prepare(own);
    if (!prepared) return prepared.error();
    if (const auto checked = checkProduct(*effect, *prepared, source); !checked) return checked.error();
    if (const auto textures = prepareTextures(own, *prepared); !textures) return textures.error();
    return draw(own, *prepared, source.target, input.uploaded, warnings);
}

} // namespace

Result<TextureData> produceTexture(const RunInput& input, const Parameter& parameter, const ProducerSource& source,
                                   std::vector<Diagnostic>& warnings) {
    auto texture = produce(input, source, warnings);
    if (!texture) return through(texture.error(), parameter, source);
    return texture;
}

Result<std::string> productKey(const RunInput& input, const Prepared& prepared, const std::string& target) {
    auto key = sourceKey(input.effect);
    if (!key) return key;
    *key += fmt::format("target {}\ncompiler {}\ndevice {} {}\n", target, compilerName(input.options.compiler), input.device.info().name,
                        input.device.info().driver);
    *key += valueKey(prepared);
    for (const auto& [name, texture] : prepared.textures)
        *key += fmt::format("{} {}\n", name, textureKey(texture));
    if (prepared.drawsMesh && input.mesh) *key += meshKey(*input.mesh);
    return contentHash(*key);
}

fs::path productPath(const std::string& key) {
    return cacheFolder() / "produced" / (key + ".exr");
}

} // namespace tegument::run
