#include "host/run/ahead.h"

#include "host/run/resources.h"

#include <algorithm>

namespace tegument::run {

namespace {

void takeFrom(Prepared& prepared, Ahead& ahead) {
    for (auto& [name, texture] : prepared.textures)
        if (!texture.image.pixels.empty() || !texture.file.images.empty()) ahead.textures.emplace(texture.key, std::move(texture));
    for (const auto& [name, bake] : prepared.bakes)
        if (!bake.fromCache) ahead.bakes.emplace(name, bake);
    ahead.warnings.insert(ahead.warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
}

Result<void> readProducers(const ProductRequest& consumer, Prepared& prepared, Ahead& ahead) {
    for (const auto& [name, source] : prepared.products) {
        const auto use = [&](const ProductRequest& request, Producer&, Prepared& product) -> Result<void> {
            if (auto nested = readProducers(request, product, ahead); !nested) return nested;
            takeFrom(product, ahead);
            return {};
        };
        if (const auto read = withProducer(consumer, source, ahead.producers, use); !read)
            return through(read.error(), *consumer.input.effect.findParameter(name), source);
    }
    return {};
}

Result<void> readObject(const RunInput& input, Ahead& ahead) {
    auto prepared = prepare(input);
    if (!prepared) return prepared.error();
    ahead.programs.insert(prepared->programs.begin(), prepared->programs.end());
    if (auto textures = prepareTextures(input, *prepared); !textures) return textures;
    if (auto read = readProducers(requestOf(input), *prepared, ahead); !read) return read;
    takeFrom(*prepared, ahead);
    return {};
}

} // namespace

Result<Ahead> prepareAhead(const Effect& effect, const SessionScene& scene, const Workspace& workspace, const RunOptions& options,
                           const Known& known) {
    Ahead ahead;
    ahead.programs = known.programs;
    const auto read = [&](const Mesh* mesh, const Workspace& own, const PlacedObject* placed) {
        return readObject({.effect = effect,
                           .mesh = mesh,
                           .workspace = own,
                           .options = options,
                           .placed = placed,
                           .compiled = &ahead.programs,
                           .uploaded = &known.uploaded,
                           .loaded = &ahead.textures},
                          ahead);
    };
    if (scene.objects.empty()) {
        if (const auto done = read(scene.mesh, workspace, nullptr); !done) return done.error();
        return ahead;
    }
    const PlacedScene whole = placeObjects(workspace, scene.objects);
    for (const RunObject& object : scene.objects) {
        const PlacedObject placed{.placement = object.placement, .scene = whole, .worldUnitMm = workspace.worldUnitMm};
        if (const auto done = read(object.mesh, object.workspace, &placed); !done) return done.error();
    }
    return ahead;
}

} // namespace tegument::run
