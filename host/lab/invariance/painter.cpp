#include "host/lab/invariance/painter.h"

#include "host/run/frame.h"
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
        run::FrameDraw rest{.name = whole->name, .object = whole->object, .targets = whole->targets, .draw = whole->draw, .blocks = {}};
        const std::uint32_t triangles = whole->draw.count / 3;
        rest.draw.first = 3 * (triangles / 3); // not in the middle: a mirror's plane may lie there
        rest.draw.count -= rest.draw.first;
        frame.items.push_back(std::move(item)); // its blocks stay where they are: `rest` reads them too
        std::get<run::FrameDraw>(frame.items.back()).draw.count = rest.draw.first;
        frame.items.emplace_back(std::move(rest));
    }
}

void exchangeLeftAndRight(Image& image) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width / 2; ++x)
            for (int c = 0; c < image.channels; ++c)
                std::swap(image.at(x, y, c), image.at(image.width - 1 - x, y, c));
}

Result<Image> readPicture(gpu::Device& device, gpu::Texture& picture) {
    const auto bytes = device.readback(picture);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = picture.desc();
    return run::imageFrom(*bytes, static_cast<int>(desc.width), static_cast<int>(desc.height), desc.format);
}

} // namespace

Result<Image> Painter::draw(const EngineScene& scene) {
    RunOptions options = options_;
    options.parameters = scene.set;
    const RunObject object{.mesh = &scene.mesh, .workspace = scene.workspace, .placement = scene.placement};
    const run::PlacedObject placed{.placement = scene.placement,
                                   .scene = run::placeObjects(scene.workspace, std::span(&object, 1)),
                                   .worldUnitMm = scene.workspace.worldUnitMm};
    const run::RunInput input{.device = device_,
                              .effect = effect_,
                              .mesh = &scene.mesh,
                              .workspace = scene.workspace,
                              .options = options,
                              .producers = {},
                              .placed = &placed,
                              .before = &known_};
    auto prepared = run::prepare(input);
    if (!prepared) return prepared.error();
    if (const auto textures = run::prepareTextures(input, *prepared); !textures) return textures.error();
    remember(*prepared);
    run::Resources resources;
    resources.pipelines = std::move(pipelines_);
    if (const auto allocated = run::allocate(input, *prepared, resources); !allocated) return allocated.error();
    const run::ObjectRun only{input, *prepared};
    auto frame = run::buildFrame(std::span(&only, 1), resources);
    if (!frame) return frame.error();
    if (const auto mesh = resources.meshes.find(&scene.mesh); scene.split && mesh != resources.meshes.end())
        splitMeshDraws(*frame, &mesh->second.vertices);
    if (const auto drawn = device_.run([&](gpu::Recorder& recorder) { return run::record(*frame, recorder); }); !drawn)
        return drawn.error();
    auto image = readPicture(device_, *resources.picture());
    pipelines_ = std::move(resources.pipelines);
    if (image && scene.mirrored) exchangeLeftAndRight(*image);
    return image;
}

void Painter::remember(const run::Prepared& prepared) {
    known_.programs.insert(prepared.programs.begin(), prepared.programs.end());
    for (const auto& program : prepared.programs)
        reads_.insert(program.second.numbers.begin(), program.second.numbers.end());
    for (const auto& texture : prepared.textures)
        reads_.insert(texture.first);
}

} // namespace tegument::invariance
