#include "lab/invariance/painter.h"

#include "host/run/pixels.h"

namespace tegument::invariance {

namespace {

/// Each draw of the mesh as two, of the first and of the last of its triangles, as an engine has it that cuts a mesh by materials. (Two
/// objects of a workspace would not do: each has a light of its own, docs/workspace.md.)
void splitMeshDraws(run::Frame& frame, const gpu::Buffer* mesh) {
    auto items = std::exchange(frame.items, {});
    for (auto& item : items) {
        const auto* whole = std::get_if<run::FrameDraw>(&item);
        if (!whole || whole->draw.vertices != mesh) {
            frame.items.push_back(std::move(item));
            continue;
        }
        run::FrameDraw rest{.described = whole->described, .targets = whole->targets, .draw = whole->draw};
        const std::uint32_t triangles = whole->draw.count / 3;
        const std::uint32_t kept = 3 * (triangles / 3); // not in the middle: a mirror's plane may lie there
        rest.draw.first += kept;
        rest.draw.count -= kept;
        frame.items.push_back(std::move(item)); // its blocks stay where they are: `rest` reads them too
        auto& begun = std::get<run::FrameDraw>(frame.items.back()).draw;
        begun.count = kept;
        begun.more.clear();
        frame.items.emplace_back(std::move(rest));
    }
}

void exchangeLeftAndRight(Image& image) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width / 2; ++x)
            for (int c = 0; c < image.channels; ++c)
                std::swap(image.at(x, y, c), image.at(image.width - 1 - x, y, c));
}

} // namespace

Result<Image> Painter::draw(const EngineScene& scene) {
    RunOptions options = options_;
    options.parameters = scene.set;
    const RunObject object{.mesh = &scene.mesh, .workspace = scene.workspace, .placement = scene.placement};
    stage_.setScene({.mesh = nullptr, .objects = std::span(&object, 1)});
    auto staged = stage_.prepare(scene.workspace, options);
    if (!staged) return staged.error();
    remember(staged->prepared.front());
    const auto& meshes = stage_.resources().store.meshes;
    if (const auto mesh = meshes.find(&scene.mesh); scene.split && mesh != meshes.end())
        splitMeshDraws(staged->frame, &mesh->second->vertices);
    if (const auto drawn = stage_.draw(*staged, staged->frame.items.size()); !drawn) return drawn.error();
    auto image = run::readBack(device_, *stage_.resources().picture());
    if (image && scene.mirrored) exchangeLeftAndRight(*image);
    return image;
}

void Painter::remember(const run::Prepared& prepared) {
    for (const auto& program : prepared.programs)
        reads_.insert(program.second->numbers.begin(), program.second->numbers.end());
    for (const auto& texture : prepared.textures)
        reads_.insert(texture.first);
}

} // namespace tegument::invariance
