#include "host/run/run.h"

#include "host/run/execute.h"

#include <cassert>
#include <deque>

namespace tegument {

Result<RunResult> runEffect(gpu::Device& device, const Effect& effect, const Mesh* mesh, const Workspace& workspace,
                            const RunOptions& options) {
    const run::RunInput input{
        .device = device, .effect = effect, .mesh = mesh, .workspace = workspace, .options = options, .producers = {}};
    auto prepared = run::prepare(input);
    if (!prepared) return prepared.error();
    if (const auto textures = run::prepareTextures(input, *prepared); !textures) return textures.error();
    return run::execute(input, *prepared);
}

Result<RunResult> runScene(gpu::Device& device, const Effect& effect, std::span<const RunObject> objects, const Workspace& workspace,
                           const RunOptions& options) {
    assert(!objects.empty());
    const PlacedScene scene = run::placeObjects(workspace, objects);
    std::vector<run::PlacedObject> placed;
    for (const RunObject& object : objects)
        placed.push_back({.placement = object.placement, .scene = scene, .worldUnitMm = workspace.worldUnitMm});
    run::Resources resources;
    std::set<std::string> uploaded;
    std::deque<run::RunInput> inputs; // objects point at these two
    std::deque<run::Prepared> prepared;
    std::vector<run::ObjectRun> runs;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        inputs.push_back({.device = device,
                          .effect = effect,
                          .mesh = objects[i].mesh,
                          .workspace = objects[i].workspace,
                          .options = options,
                          .producers = {},
                          .placed = &placed[i],
                          .before = prepared.empty() ? nullptr : &prepared.front(),
                          .uploaded = &uploaded});
        auto ready = run::prepare(inputs.back());
        if (!ready) return ready.error();
        if (const auto textures = run::prepareTextures(inputs.back(), *ready); !textures) return textures.error();
        if (const auto allocated = run::allocate(inputs.back(), *ready, resources); !allocated) return allocated.error();
        run::forgetTexels(*ready, uploaded);
        prepared.push_back(std::move(*ready));
        runs.push_back({inputs.back(), prepared.back()});
    }
    return run::execute(runs, resources);
}

} // namespace tegument
