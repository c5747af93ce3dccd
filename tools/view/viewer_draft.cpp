// What a move needs, made while nothing moves: meshes of fewer triangles, and a first small picture.

#include "tools/view/viewer.h"

#include "tools/view/orbit.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kRested(400);
constexpr double kSlowPicture = 70;            // milliseconds: whoever is quicker needs nothing
constexpr double kLittle = 0.02;               // radians
constexpr double kLeastShare = 0.125;          // of each side of a picture
constexpr std::size_t kDraftTriangles = 12000; // of a mesh while it moves: five milliseconds of a processor for each pass
constexpr std::size_t kManyTriangles = 3 * kDraftTriangles;

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
    if (!fewerMaking_.valid()) rehearse();
    return {};
}

void Viewer::rehearse() {
    const bool other = beside_ && beside_->loaded;
    if (!rehearsed_) {
        const auto costs = rehearse(*loaded_, state_.technique, state_.parameters);
        if (!costs) return;
        rehearsed_ = true;
        const RehearsalCosts beside = other ? beside_->moves : RehearsalCosts{};
        costs_.camera = costs->camera + beside.camera;
        costs_.anything = costs->anything + beside.anything;
    } else if (other && !beside_->rehearsed) {
        const auto costs = rehearse(*beside_->loaded, beside_->technique, beside_->parameters);
        if (!costs) return;
        beside_->rehearsed = true;
        beside_->moves = *costs;
        costs_.camera += costs->camera;
        costs_.anything += costs->anything;
    }
}

/// Given up, it begins anew: what passes take is to be seen of all of them.
std::optional<RehearsalCosts> Viewer::rehearse(Loaded& side, const std::string& technique,
                                               const std::map<std::string, std::vector<double>>& parameters) {
    Loaded rehearsal(device_, side.source, request_.keeps, request_.scene, &side);
    const Sharpness shown = std::exchange(sharpness_, {.share = kLeastShare, .coarse = fewer_ != nullptr, .single = true});
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

/// As prepareToMove() goes on.
bool Viewer::preparing() const {
    if (costs_.pixels + costs_.anything <= kSlowPicture) return false;
    return fewerMaking_.valid() || !rehearsed_ || (beside_ && beside_->loaded && !beside_->rehearsed);
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

/// Another scene.
void Viewer::dropFewer() {
    if (fewerMaking_.valid()) fewerAbandoned_.push_back(std::move(fewerMaking_));
    std::erase_if(fewerAbandoned_,
                  [](const auto& making) { return making.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    fewer_ = nullptr;
    fewerAsked_ = false;
}

} // namespace tegument::view
