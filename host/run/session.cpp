#include "host/run/session.h"

#include "host/run/execute.h"

#include <deque>
#include <set>

namespace tegument {

namespace {

/// Everything on which textures may depend, besides camera and light.
struct TextureRequest {
    std::string technique;
    Compiler compiler = Compiler::Dxc;
    std::map<std::string, std::vector<double>> parameters;
    std::map<std::string, std::string> textures;
    std::map<std::string, std::vector<double>> workspaceParameters;
    std::map<std::string, std::string> workspaceTextures;
    bool operator==(const TextureRequest&) const = default;
};

TextureRequest textureRequest(const Workspace& workspace, const RunOptions& options) {
    return {.technique = options.technique,
            .compiler = options.compiler,
            .parameters = options.parameters,
            .textures = options.textures,
            .workspaceParameters = workspace.parameters,
            .workspaceTextures = workspace.textures};
}

std::string callersName(const std::string& target) {
    return run::isCallers(target) ? std::string() : target;
}

SessionPass describe(const run::FrameDraw& draw) {
    SessionPass pass{.name = draw.name, .object = draw.object, .targets = {}};
    for (const gpu::Texture* color : draw.targets.colors)
        pass.targets.push_back(callersName(color->desc().name));
    if (draw.targets.depth) pass.targets.push_back(callersName(draw.targets.depth->desc().name));
    return pass;
}

/// Items in front of the draw behind the first `draws` of them.
std::size_t itemsUpTo(const run::Frame& frame, std::size_t draws) {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < frame.items.size(); ++i) {
        if (!std::holds_alternative<run::FrameDraw>(frame.items[i])) continue;
        if (seen == draws) return i;
        ++seen;
    }
    return frame.items.size();
}

} // namespace

struct EffectSession::State {
    gpu::Device& device;
    const Effect& effect;
    SessionScene scene;
    run::Resources resources;
    std::map<std::string, run::TargetDesc> allocated;
    run::Prepared known; // only its compiled passes, of all techniques drawn so far
    std::set<std::string> uploaded;
    TextureRequest asked;
    std::vector<std::map<std::string, run::TextureData>> answered; // to `asked`, for each object; without texels
};

namespace {

using State = EffectSession::State;

/// One run for each object; they point at each other.
struct Scene {
    std::deque<run::PlacedObject> placed;
    std::deque<run::RunInput> inputs;
    std::deque<run::Prepared> prepared;
    std::vector<run::ObjectRun> runs;
};

void addInput(Scene& scene, const State& state, const Mesh* mesh, const Workspace& workspace, const RunOptions& options) {
    scene.inputs.push_back({.device = state.device,
                            .effect = state.effect,
                            .mesh = mesh,
                            .workspace = workspace,
                            .options = options,
                            .producers = {},
                            .placed = scene.placed.empty() ? nullptr : &scene.placed.back(),
                            .before = &state.known,
                            .uploaded = &state.uploaded});
}

Scene inputsOf(const State& state, const Workspace& workspace, const RunOptions& options) {
    Scene scene;
    if (state.scene.objects.empty()) {
        addInput(scene, state, state.scene.mesh, workspace, options);
        return scene;
    }
    const PlacedScene placed = run::placeObjects(workspace, state.scene.objects);
    for (const RunObject& object : state.scene.objects) {
        scene.placed.push_back({.placement = object.placement, .scene = placed, .worldUnitMm = workspace.worldUnitMm});
        addInput(scene, state, object.mesh, object.workspace, options);
    }
    return scene;
}

bool same(const run::TargetDesc& a, const run::TargetDesc& b) {
    return a.extent == b.extent && a.format == b.format && a.mips == b.mips && a.samples == b.samples;
}

/// Targets of the last frame that this one does not have, or has in another size, make room.
void dropTargets(State& state, const run::Prepared& prepared) {
    std::erase_if(state.allocated, [&](const auto& entry) {
        const auto wanted = prepared.targets.find(entry.first);
        if (wanted != prepared.targets.end() && same(wanted->second, entry.second)) return false;
        state.resources.targets.erase(entry.first);
        return true;
    });
}

Result<void> prepareObject(State& state, const run::RunInput& input, run::Prepared& prepared, std::size_t object) {
    state.known.programs.insert(prepared.programs.begin(), prepared.programs.end());
    if (object < state.answered.size()) {
        prepared.textures = state.answered[object];
    } else if (const auto textures = run::prepareTextures(input, prepared); !textures) {
        return textures;
    }
    if (object == 0) dropTargets(state, prepared);
    if (const auto allocated = run::allocate(input, prepared, state.resources); !allocated) return allocated;
    state.allocated.insert(prepared.targets.begin(), prepared.targets.end());
    run::forgetTexels(prepared, state.uploaded);
    if (object == state.answered.size()) state.answered.push_back(prepared.textures);
    return {};
}

Result<void> prepareScene(State& state, Scene& scene, TextureRequest request) {
    if (state.asked != request) state.answered.clear();
    state.asked = std::move(request);
    for (std::size_t i = 0; i < scene.inputs.size(); ++i) {
        auto prepared = run::prepare(scene.inputs[i]);
        if (!prepared) return prepared.error();
        scene.prepared.push_back(std::move(*prepared));
        if (const auto ready = prepareObject(state, scene.inputs[i], scene.prepared.back(), i); !ready) return ready;
        scene.runs.push_back({scene.inputs[i], scene.prepared.back()});
    }
    return {};
}

void readTimes(const std::vector<gpu::TimedSection>& sections, SessionFrame& frame) {
    for (std::size_t i = 0; i < sections.size() && i < frame.passes.size(); ++i) // a resolve is no pass
        frame.passes[i].milliseconds = sections[i].milliseconds;
}

SessionFrame describe(const Scene& scene, const run::Frame& items) {
    SessionFrame frame{.technique = scene.prepared.front().plan.technique->name,
                       .passes = {},
                       .targets = {},
                       .metadata = run::metadata(scene.runs),
                       .warnings = run::warningsOf(scene.runs)};
    for (const auto& item : items.items)
        if (const auto* draw = std::get_if<run::FrameDraw>(&item)) frame.passes.push_back(describe(*draw));
    for (const auto& target : scene.prepared.front().targets)
        if (!callersName(target.first).empty()) frame.targets.push_back(target.first);
    return frame;
}

} // namespace

EffectSession::EffectSession(gpu::Device& device, const Effect& effect, SessionScene scene)
    : state_(new State{.device = device,
                       .effect = effect,
                       .scene = scene,
                       .resources = {},
                       .allocated = {},
                       .known = {},
                       .uploaded = {},
                       .asked = {},
                       .answered = {}}) {}
EffectSession::EffectSession(EffectSession&&) noexcept = default;
EffectSession& EffectSession::operator=(EffectSession&&) noexcept = default;
EffectSession::~EffectSession() = default;

Result<SessionFrame> EffectSession::draw(const Workspace& workspace, const RunOptions& options, std::size_t passes) {
    Scene scene = inputsOf(*state_, workspace, options);
    if (const auto prepared = prepareScene(*state_, scene, textureRequest(workspace, options)); !prepared) return prepared.error();
    const auto items = run::buildFrame(scene.runs, state_->resources);
    if (!items) return items.error();
    const std::size_t count = itemsUpTo(*items, passes);
    const auto sections = state_->device.run([&](gpu::Recorder& recorder) { return run::record(*items, recorder, count); });
    if (!sections) return sections.error();
    SessionFrame frame = describe(scene, *items);
    readTimes(*sections, frame);
    return frame;
}

gpu::Texture* EffectSession::target(const std::string& name) {
    if (name.empty()) return state_->resources.picture();
    const auto found = state_->resources.targets.find(name);
    return found == state_->resources.targets.end() ? nullptr : &found->second;
}

} // namespace tegument
