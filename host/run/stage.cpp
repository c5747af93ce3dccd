#include "host/run/stage.h"

namespace tegument::run {

namespace {

/// What can be stored to need not be: it keeps what it holds for frames that only read it.
bool serves(const TargetDesc& there, const TargetDesc& wanted) {
    return there.extent == wanted.extent && there.format == wanted.format && there.mips == wanted.mips && there.samples == wanted.samples &&
           (there.stored || !wanted.stored);
}

} // namespace

Stage::Stage(gpu::Device& device, const Effect& effect, SessionScene scene, const Stage* before)
    : device_(device), effect_(effect), scene_(scene) {
    if (!before) return;
    store_.textures = before->store_.textures;
    store_.meshes = before->store_.meshes;
    store_.uploaded = before->store_.uploaded;
    store_.quad = before->store_.quad;
    store_.shared = before->store_.shared;
}

Stage::~Stage() {
    giveTargetsBack();
}

void Stage::follow(Stage& before) {
    before_ = &before;
    held_ = before.held_;
}

/// Of several objects the first's.
void Stage::noteSampled(const std::deque<Prepared>& prepared) {
    sampled_.clear();
    for (const Prepared& object : prepared)
        for (const auto& [name, origin] : object.origins)
            if (gpu::Texture* texture = resources_.texture(object, name)) sampled_.emplace(name, Sampled{texture, origin});
}

void Stage::takeTargets() {
    if (!before_) return;
    for (auto& [name, wanted] : allocated_) {
        const auto there = before_->allocated_.find(name);
        if (there == before_->allocated_.end() || !serves(there->second, wanted) || resources_.targets.contains(name)) continue;
        if (auto node = before_->resources_.targets.extract(name)) {
            resources_.targets.insert(std::move(node));
            wanted.stored = there->second.stored;
            taken_.push_back(name);
        }
    }
}

void Stage::giveTargetsBack() {
    if (!before_) return;
    for (const std::string& name : taken_)
        if (auto node = resources_.targets.extract(name)) before_->resources_.targets.insert(std::move(node));
    if (!taken_.empty()) before_->held_.forget();
    before_ = nullptr;
    taken_.clear();
}

void Stage::setScene(SessionScene scene) {
    scene_ = scene;
    products_.dropNodes();
    resources_.targets.clear();
    allocated_.clear();
    store_ = {};
}

void Stage::addInput(StagedFrame& staged, const Mesh* mesh, const Workspace& workspace, const RunOptions& options) {
    staged.inputs.push_back({.effect = effect_,
                             .mesh = mesh,
                             .workspace = workspace,
                             .options = options,
                             .placed = staged.placed.empty() ? nullptr : &staged.placed.back(),
                             .compiled = &kit_.programs,
                             .uploaded = &store_.uploaded});
}

StagedFrame Stage::inputsOf(const Workspace& workspace, const RunOptions& options) {
    StagedFrame staged;
    if (scene_.objects.empty()) {
        addInput(staged, scene_.mesh, workspace, options);
        return staged;
    }
    const PlacedScene placed = placeObjects(workspace, scene_.objects);
    for (const RunObject& object : scene_.objects) {
        staged.placed.push_back({.placement = object.placement, .scene = placed, .worldUnitMm = workspace.worldUnitMm});
        addInput(staged, object.mesh, object.workspace, options);
    }
    return staged;
}

void Stage::dropTargets(const std::deque<Prepared>& prepared) {
    std::map<std::string, TargetDesc> wanted;
    for (const Prepared& object : prepared)
        wanted.insert(object.targets.begin(), object.targets.end());
    std::erase_if(allocated_, [&](const auto& entry) {
        const auto found = wanted.find(entry.first);
        if (found != wanted.end() && serves(entry.second, found->second)) {
            found->second.stored = entry.second.stored;
            return false;
        }
        resources_.targets.erase(entry.first);
        return true;
    });
    allocated_ = std::move(wanted);
}

Result<void> Stage::equip(const RunInput& input, Prepared& prepared, std::vector<FrameNode>& before) {
    if (const auto textures = prepareTextures(input, prepared); !textures) return textures;
    if (const auto nodes = products_.use(input, prepared, before); !nodes) return nodes;
    if (const auto allocated = allocate(input, prepared, resources_); !allocated) return allocated;
    forgetTexels(prepared, store_.uploaded);
    return {};
}

Result<StagedFrame> Stage::prepare(const Workspace& workspace, const RunOptions& options) {
    if (options.compiler != compiler_) {
        products_.forget();
        kit_ = {};
        compiler_ = options.compiler;
    }
    StagedFrame staged = inputsOf(workspace, options);
    for (const RunInput& input : staged.inputs) {
        auto prepared = run::prepare(input);
        if (!prepared) return prepared.error();
        kit_.programs.insert(prepared->programs.begin(), prepared->programs.end());
        staged.prepared.push_back(std::move(*prepared));
        staged.runs.push_back({input, staged.prepared.back()});
    }
    dropTargets(staged.prepared);
    takeTargets();
    products_.begin();
    std::vector<FrameNode> before;
    for (std::size_t i = 0; i < staged.inputs.size(); ++i)
        if (const auto equipped = equip(staged.inputs[i], staged.prepared[i], before); !equipped) return equipped.error();
    noteSampled(staged.prepared);
    auto frame = buildFrame(staged.runs, resources_);
    if (!frame) return frame.error();
    staged.frame = std::move(*frame);
    staged.frame.before = std::move(before);
    staged.frame.clearsApart = options.clearsApart;
    return staged;
}

Result<std::vector<gpu::TimedSection>> Stage::draw(StagedFrame& staged, std::size_t items) {
    if (staged.inputs.front().options.keepUnchanged)
        held_.choose(staged.frame, items);
    else
        held_.forget();
    auto sections = device_.run([&](gpu::Recorder& recorder) { return record(staged.frame, recorder, items); });
    if (!sections) {
        held_.forget();
        return sections;
    }
    before_ = nullptr;
    taken_.clear();
    staged.frame.before.clear();
    products_.finish();
    return sections;
}

} // namespace tegument::run
