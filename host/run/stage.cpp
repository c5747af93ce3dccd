#include "host/run/stage.h"

#include "host/run/pieces.h"

#include <chrono>
#include <filesystem>

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
    store_.known = before->store_.known;
    for (const auto& [name, bake] : before->bakes_)
        if (!bake.file.empty()) bakes_.emplace(name, bake);
    for (const auto& [name, texture] : before->resources_.targets)
        if (const auto desc = before->allocated_.find(name); desc != before->allocated_.end())
            offered_.emplace(name, Offered{texture.shared(), desc->second});
    held_ = before->held_;
    if (&effect != &before->effect_) return;
    compiler_ = before->compiler_;
    kit_ = before->kit_;
    products_.share(before->products_);
}

void Stage::take(Ahead ahead) {
    kit_.programs.insert(ahead.programs.begin(), ahead.programs.end());
    for (auto& [key, texture] : ahead.textures)
        if (!store_.uploaded.contains(key)) store_.loaded.emplace(key, std::move(texture));
    for (const auto& [name, bake] : ahead.bakes)
        if (!bake.fromCache) bakes_[name] = bake;
    products_.take(ahead.producers);
}

Known Stage::known() const {
    return {.programs = kit_.programs, .uploaded = store_.uploaded};
}

void Stage::learn(const Stage& other) {
    if (&effect_ != &other.effect_ || compiler_ != other.compiler_) return;
    kit_.samplers.insert(other.kit_.samplers.begin(), other.kit_.samplers.end());
    kit_.computes.insert(other.kit_.computes.begin(), other.kit_.computes.end());
    kit_.pipelines.insert(other.kit_.pipelines.begin(), other.kit_.pipelines.end());
}

/// Of several objects the first's.
void Stage::noteSampled(const std::deque<Prepared>& prepared) {
    sampled_.clear();
    for (const Prepared& object : prepared)
        for (const auto& [name, origin] : object.origins)
            if (gpu::Texture* texture = resources_.texture(object, name))
                sampled_.emplace(name, Sampled{texture, origin, object.textures.at(name).key});
}

/// Frames after the first find what that made.
void Stage::noteBakes(const std::deque<Prepared>& prepared) {
    for (const Prepared& object : prepared)
        for (const auto& [name, bake] : object.bakes)
            if (!bake.fromCache || !bakes_.contains(name)) bakes_[name] = bake;
}

Result<void> Stage::drawNodes(StagedFrame& staged) {
    std::map<std::filesystem::path, double> took;
    for (const FrameNode& node : staged.frame.before) {
        const auto begin = std::chrono::steady_clock::now();
        const auto drawn = device_.run([&](gpu::Recorder& recorder) { return recordNode(node, recorder); });
        if (!drawn) return drawn.error();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
        took[std::filesystem::weakly_canonical(node.effect)] += time.count();
        if (node.drawn) *node.drawn = true;
        if (const auto pause = pauseAfter(staged.inputs.front().options); !pause) return pause;
    }
    for (const Prepared& object : staged.prepared)
        for (const auto& [name, source] : object.products)
            if (const auto found = took.find(std::filesystem::weakly_canonical(source.effect)); found != took.end())
                bakes_[name] = {.milliseconds = found->second};
    staged.frame.before.clear();
    return {};
}

std::optional<Bake> Stage::bakeOf(const std::string& name) const {
    const auto found = bakes_.find(name);
    return found == bakes_.end() ? std::nullopt : std::optional(found->second);
}

void Stage::bakeAgain(const std::string& name) {
    const auto sampled = sampled_.find(name);
    const auto bake = bakes_.find(name);
    if (sampled == sampled_.end() || bake == bakes_.end()) return;
    std::error_code gone;
    if (!bake->second.file.empty()) std::filesystem::remove(bake->second.file, gone); // a file of the cache: whoever misses it makes it
    std::erase_if(store_.known.made, [&](const auto& made) { return made.second == bake->second.file; });
    products_.dropDrawn(sampled->second.texture);
    store_.textures.erase(sampled->second.key);
    store_.uploaded.erase(sampled->second.key);
    bakes_.erase(bake);
    sampled_.erase(sampled);
}

void Stage::takeTargets() {
    for (auto& [name, wanted] : allocated_) {
        const auto there = offered_.find(name);
        if (there == offered_.end() || !serves(there->second.desc, wanted) || resources_.targets.contains(name)) continue;
        wanted.stored = there->second.desc.stored;
        resources_.targets.emplace(name, std::move(there->second.texture));
        offered_.erase(there);
    }
}

Result<bool> Stage::separate(const std::set<std::uint64_t>* due) {
    bool any = false;
    for (auto& [name, target] : resources_.targets) {
        if (!target.isShared() || (due && !due->contains(gpu::identityOf(target)))) continue;
        auto own = device_.createTexture(target.desc());
        if (!own) return own.error();
        target = std::move(*own); // whoever points at the handle draws into this one
        any = true;
    }
    return any;
}

Result<void> Stage::choose(StagedFrame& staged, std::size_t items) {
    Result<void> done;
    held_.choose(staged.frame, items, [&](const std::set<std::uint64_t>& due) {
        const auto separated = separate(&due);
        if (!separated) done = separated.error();
        return separated && *separated;
    });
    return done;
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
                             .uploaded = &store_.uploaded,
                             .loaded = &store_.loaded,
                             .known = &store_.known});
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
    noteBakes(staged.prepared);
    auto frame = buildFrame(staged.runs, resources_);
    if (!frame) return frame.error();
    staged.frame = std::move(*frame);
    staged.frame.before = std::move(before);
    staged.frame.clearsApart = options.clearsApart;
    return staged;
}

Result<std::vector<gpu::TimedSection>> Stage::drawPieces(StagedFrame& staged, std::size_t items) {
    auto drawn = drawInPieces(device_, staged.frame, items, staged.inputs.front().options.pieces);
    if (!drawn) return drawn.error();
    staged.givenUp = drawn->givenUp;
    if (drawn->givenUp) held_.giveUp(staged.frame, drawn->begun, drawn->done);
    return std::move(drawn->sections);
}

Result<std::vector<gpu::TimedSection>> Stage::drawKeeping(StagedFrame& staged, std::size_t items) {
    if (const auto chosen = choose(staged, items); !chosen) return chosen.error();
    if (const auto nodes = drawNodes(staged); !nodes) {
        if (!isGivenUp(nodes.error())) return nodes.error();
        staged.givenUp = true;
        held_.giveUp(staged.frame, 0, 0);
        return std::vector<gpu::TimedSection>();
    }
    if (staged.inputs.front().options.pieces.goOn) return drawPieces(staged, items);
    return device_.run([&](gpu::Recorder& recorder) { return record(staged.frame, recorder, items); });
}

Result<std::vector<gpu::TimedSection>> Stage::draw(StagedFrame& staged, std::size_t items) {
    const bool keeps = staged.inputs.front().options.keepUnchanged;
    if (!keeps) {
        held_.forget();
        if (const auto separated = separate(nullptr); !separated) return separated.error();
    }
    auto sections =
        keeps ? drawKeeping(staged, items) : device_.run([&](gpu::Recorder& recorder) { return record(staged.frame, recorder, items); });
    if (!sections) {
        held_.forget();
        return sections;
    }
    if (staged.givenUp) return sections;
    offered_.clear();
    staged.frame.before.clear();
    products_.finish();
    return sections;
}

} // namespace tegument::run
