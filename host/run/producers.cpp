#include "host/run/producers.h"

#include "host/run/resources.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace tegument::run {

namespace fs = std::filesystem;

namespace {

// Targets without a size of their own follow the picture; a producing effect draws this one and throws it away.
constexpr int kProducerPicture = 64;

RunOptions producerOptions(const RunOptions& options, const Effect& effect) {
    RunOptions own{.width = kProducerPicture, .height = kProducerPicture, .compiler = options.compiler};
    own.assets = options.assets;
    own.plainSkin = options.plainSkin;
    own.compiling = options.compiling;
    for (const auto& [name, value] : options.parameters)
        if (effect.findParameter(name)) own.parameters.emplace(name, value);
    for (const auto& [name, file] : options.textures)
        if (const Parameter* parameter = effect.findParameter(name); parameter && parameter->type.isTexture())
            own.textures.emplace(name, file);
    return own;
}

Result<void> checkProduct(const Effect& effect, const Prepared& prepared, const ProducerSource& source) {
    std::vector<std::string> drawn;
    for (const std::string& name : prepared.plan.targets())
        if (effect.findParameter(name)) drawn.push_back(name);
    if (std::ranges::find(drawn, source.target) != drawn.end()) return {};
    return inputError(4036, {.file = effect.file.string()},
                      fmt::format("technique {} draws no target '{}'", prepared.plan.technique->name, source.target),
                      didYouMean(source.target, drawn));
}

/// A texture that is drawn once belongs to the mesh wherever it stands: it is drawn as if the mesh stood in its own space, camera and light
/// moved along. So several heads of one mesh share it.
std::optional<PlacedObject> inOwnSpace(const RunInput& input) {
    if (!input.placed) return std::nullopt;
    PlacedObject local{.scene = seenFrom(input.placed->scene, input.placed->placement), .worldUnitMm = input.placed->worldUnitMm};
    local.placement.scale = input.placed->placement.scale;
    return local;
}

Result<Producer*> producerOf(Producers& producers, const fs::path& file, const std::string& canonical, const Effect& consumer) {
    std::shared_ptr<Producer>& producer = producers[canonical];
    if (producer) return producer.get();
    LoadOptions load{.defines = consumer.defines, .includeFolders = consumer.includeFolders};
    load.roots = consumer.roots;
    auto effect = loadEffect(file, load);
    if (!effect) return effect.error();
    producer = std::make_shared<Producer>(Producer{.effect = std::move(*effect)});
    return producer.get();
}

} // namespace

ProductRequest requestOf(const RunInput& input) {
    return {.input = input, .chain = {fs::weakly_canonical(input.effect.file).string()}};
}

/// Producer errors point into the other effect; this says how one got there.
Error through(Error error, const Parameter& parameter, const ProducerSource& source) {
    error.diagnostics.push_back({.severity = Severity::Note,
                                 .code = 4037,
                                 .at = parameter.at,
                                 .text = fmt::format("{} is drawn by {}", parameter.name, source.effect.string()),
                                 .hint = fmt::format("or give a file: --set {}=FILE", parameter.name)});
    return error;
}

Result<void> withProducer(const ProductRequest& consumer, const ProducerSource& source, Producers& producers,
                          const std::function<Result<void>(const ProductRequest&, Producer&, Prepared&)>& use) {
    const std::string self = fs::weakly_canonical(source.effect).string();
    if (std::ranges::find(consumer.chain, self) != consumer.chain.end())
        return inputError(4035, {.file = self}, "this effect would have to draw a texture that it needs itself",
                          "producers must not form a circle");
    const auto producer = producerOf(producers, source.effect, self, consumer.input.effect);
    if (!producer) return producer.error();
    const RunOptions options = producerOptions(consumer.input.options, (*producer)->effect);
    const std::optional<PlacedObject> local = inOwnSpace(consumer.input);
    const RunInput own{.effect = (*producer)->effect,
                       .mesh = consumer.input.mesh,
                       .workspace = consumer.input.workspace,
                       .options = options,
                       .placed = local ? &*local : nullptr,
                       .compiled = &(*producer)->kit.programs,
                       .uploaded = consumer.input.uploaded,
                       .loaded = consumer.input.loaded};
    ProductRequest request{.input = own, .chain = consumer.chain};
    request.chain.push_back(self);
    auto prepared = prepare(own);
    if (!prepared) return prepared.error();
    (*producer)->kit.programs.insert(prepared->programs.begin(), prepared->programs.end());
    if (auto checked = checkProduct((*producer)->effect, *prepared, source); !checked) return checked;
    if (auto textures = prepareTextures(own, *prepared); !textures) return textures;
    return use(request, **producer, *prepared);
}

} // namespace tegument::run
