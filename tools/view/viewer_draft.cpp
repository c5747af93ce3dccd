// What a move needs, made while nothing moves: meshes of fewer triangles, and a session with fewer texels in its maps.

#include "tools/view/viewer.h"

#include "tools/view/orbit.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kRested(400);
constexpr double kSlowPicture = 70;            // milliseconds: whoever is quicker needs nothing
constexpr double kSlowMaps = 100;              // likewise: what a smaller picture does not mend
constexpr double kLittle = 0.02;               // radians
constexpr double kLeastShare = 0.125;          // of each side of a picture
constexpr std::uint32_t kFewerTexels = 4;      // along each side
constexpr std::uint32_t kLeastSide = 256;      // of a map that has fewer in a draft
constexpr std::size_t kDraftTriangles = 12000; // of a mesh while it moves: five milliseconds of a processor for each pass
constexpr std::size_t kManyTriangles = 3 * kDraftTriangles;

/// TEGUMENT_SHADOW_SIZE follows it where nothing is said.
void divideSizes(std::vector<std::pair<std::string, std::string>>& defines, std::uint32_t side) {
    std::erase_if(defines, [](const auto& define) { return define.first == "TEGUMENT_MAP_SIZE"; });
    defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(side / kFewerTexels));
    for (auto& [name, value] : defines)
        if (name == "TEGUMENT_SHADOW_SIZE") value = std::to_string(side / kFewerTexels);
}

/// Those with many triangles. Ribbons of fur are drawn by passes that choose among them themselves.
std::set<const Mesh*> largeMeshes(const SessionScene& scene) {
    std::set<const Mesh*> meshes;
    if (scene.mesh) meshes.insert(scene.mesh);
    for (const RunObject& object : scene.objects)
        meshes.insert(object.mesh);
    std::erase_if(meshes, [](const Mesh* mesh) {
        return mesh->indices.size() / 3 < kManyTriangles || std::ranges::any_of(mesh->parts, &MeshPart::expanded);
    });
    return meshes;
}

} // namespace

Result<void> Viewer::prepareToMove() {
    if (costs_.pixels + costs_.anything <= kSlowPicture) return {};
    takeFewer();
    if (std::chrono::steady_clock::now() - moved_ < kRested) return {}; // the next edit may come at once, and wants the processor
    if (!fewerMaking_.valid() && rehearse() && wantsDraft() && haveDraft(true)) rehearseDraftBeside();
    return {};
}

bool Viewer::rehearse() {
    const bool other = beside_ && beside_->loaded;
    if (!rehearsed_) {
        const auto costs = rehearse(*loaded_, state_.technique, state_.parameters);
        if (!costs) return false;
        rehearsed_ = true;
        const RehearsalCosts beside = other ? beside_->moves : RehearsalCosts{};
        costs_.camera = costs->camera + beside.camera;
        costs_.anything = costs->anything + beside.anything;
        return !other;
    }
    if (!other || beside_->rehearsed) return true;
    const auto costs = rehearse(*beside_->loaded, beside_->technique, beside_->parameters);
    if (!costs) return false;
    beside_->rehearsed = true;
    beside_->moves = *costs;
    costs_.camera += costs->camera;
    costs_.anything += costs->anything;
    return true;
}

/// Given up, it begins anew: what passes take is to be seen of all of them.
std::optional<RehearsalCosts> Viewer::rehearse(Loaded& side, const std::string& technique,
                                               const std::map<std::string, std::vector<double>>& parameters) {
    Loaded rehearsal(device_, side.source, request_.keeps, request_.scene, &side);
    const Sharpness shown =
        std::exchange(sharpness_, {.share = kLeastShare, .drafting = false, .coarse = fewer_ != nullptr, .single = true});
    inPieces_ = true;
    RunOptions options = runOptions();
    options.technique = technique;
    options.parameters = parameters;
    Workspace workspace = area_.seen(state_.workspace, size_);
    const auto take = [&]() -> std::optional<double> {
        const auto frame = rehearsal.session.draw(workspace, options);
        if (!frame) return 0; // the whole picture has said why, or will
        return frame->givenUp ? std::nullopt : std::optional(costsOf(*frame, rehearsal.session).others);
    };
    orbit(workspace.camera, kLittle, 0);
    const auto camera = take();
    orbitLight(workspace.light, workspace.camera, kLittle, 0);
    const auto anything = camera ? take() : std::nullopt;
    inPieces_ = false;
    sharpness_ = shown;
    side.session.learn(rehearsal.session);
    return anything ? std::optional(RehearsalCosts{*camera, *anything}) : std::nullopt;
}

/// The kept side's session with fewer texels has drawn nothing yet.
void Viewer::rehearseDraftBeside() {
    if (!beside_ || !beside_->draft || beside_->draftDrawn) return;
    const Sharpness shown =
        std::exchange(sharpness_, {.share = costs_.share(Moving::Camera), .drafting = true, .coarse = fewer_ != nullptr, .single = true});
    inPieces_ = true;
    const auto frame = drawSide();
    inPieces_ = false;
    sharpness_ = shown;
    beside_->drafting = false; // nobody has seen it
    beside_->draftDrawn = !(frame && frame->givenUp);
}

bool Viewer::wantsDraft() const {
    return costs_.pixels + costs_.anything > kSlowPicture && std::max(costs_.camera, costs_.anything) > kSlowMaps;
}

/// As prepareToMove() goes on.
bool Viewer::preparing() const {
    if (costs_.pixels + costs_.anything <= kSlowPicture) return false;
    if (fewerMaking_.valid() || !rehearsed_ || (beside_ && beside_->loaded && !beside_->rehearsed)) return true;
    if (!wantsDraft()) return false;
    return !draftTried_ || draftReading_ || (draft_ && !draftDrawn_) || (draftDrawn_ && beside_ && beside_->draft && !beside_->draftDrawn);
}

void Viewer::takeFewer() {
    if (!fewerAsked_ && request_.fewer) {
        fewerAsked_ = true;
        fewerMaking_ =
            std::async(std::launch::async, [meshes = largeMeshes(request_.scene), make = request_.fewer, keeps = request_.keeps] {
                FewerTriangles fewer;
                for (const Mesh* mesh : meshes)
                    fewer.emplace(mesh, make(*mesh, kDraftTriangles));
                return fewer;
            });
    }
    if (fewerMaking_.valid() && fewerMaking_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        fewer_ = std::make_shared<const FewerTriangles>(fewerMaking_.get());
}

void Viewer::readDraft() {
    draftTried_ = true;
    const std::uint32_t side = mapSide();
    if (side < kLeastSide) return;
    ToRead asked = toRead(request_, {.technique = state_.technique, .setting = state_.setting, .binds = state_.binds});
    divideSizes(asked.load.defines, side);
    asked.known.uploaded = loaded_->session.known().uploaded;
    draftReading_ = std::make_unique<Reading>(std::move(asked));
}

Result<SessionFrame> Viewer::drawDraft(bool inPieces) {
    draftCosts_ = costs_;
    draftCosts_.anything /= kFewerTexels * kFewerTexels;
    draftCosts_.camera = draftCosts_.anything;
    const Sharpness shown =
        std::exchange(sharpness_, {.share = costs_.share(Moving::Camera), .drafting = true, .coarse = fewer_ != nullptr});
    const double milliseconds = milliseconds_;
    inPieces_ = inPieces;
    auto frame = drawWith(*draft_);
    inPieces_ = false;
    sharpness_ = shown;
    milliseconds_ = milliseconds;
    return frame;
}

bool Viewer::haveDraft(bool inPieces) {
    if (draftDrawn_) return true;
    if (!draftTried_) readDraft();
    if (draftReading_) {
        if (!draftReading_->done()) return false;
        ReadAhead read = draftReading_->take();
        draftReading_.reset();
        if (!read.ahead) return false; // the whole picture has said why, or will
        draft_ = std::make_unique<Loaded>(device_, std::move(read.source), request_.keeps, request_.scene, loaded_.get());
        draft_->session.take(std::move(*read.ahead));
    }
    if (!draft_) return false;
    const auto frame = drawDraft(inPieces);
    if (frame && frame->givenUp) return false;
    draftDrawn_ = frame && std::ranges::any_of(frame->targets, [&](const std::string& name) {
                      return draft_->session.target(name)->desc().width == mapSide() / kFewerTexels;
                  });
    if (!draftDrawn_) draft_.reset();
    shareDraft();
    return draftDrawn_;
}

void Viewer::shareDraft() {
    if (!draftDrawn_ || !beside_ || !beside_->loaded || beside_->draft || beside_->loaded->source != loaded_->source) return;
    beside_->draft = std::make_unique<Loaded>(device_, draft_->source, request_.keeps, request_.scene, draft_.get());
}

/// Another scene.
void Viewer::dropFewer() {
    if (fewerMaking_.valid()) fewerAbandoned_.push_back(std::move(fewerMaking_));
    std::erase_if(fewerAbandoned_,
                  [](const auto& making) { return making.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    fewer_ = nullptr;
    fewerAsked_ = false;
}

void Viewer::dropDraft() {
    draft_.reset();
    rehearsed_ = false;
    if (draftReading_) {
        draftReading_->giveUp();
        abandoned_.push_back(std::move(draftReading_));
    }
    draftTried_ = draftDrawn_ = false;
    sharpness_.drafting = false;
}

} // namespace tegument::view
