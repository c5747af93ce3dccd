// The mesh in false colours: made when it is first shown, gone when it is not.

#include "tools/view/viewer.h"

#include "host/run/pixels.h"
#include "host/run/semantics.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kFiguresMoment(20);
constexpr std::uint32_t kUsualSide = 1024; // of maps, where the technique has none

} // namespace

std::uint32_t Viewer::mapSide() {
    std::uint32_t largest = 0;
    for (const std::string& name : frame_.targets)
        if (const gpu::Texture* target = session().target(name))
            if (const PixelSize size{target->desc().width, target->desc().height}; size != drawnPixels())
                largest = std::max({largest, size.width, size.height});
    return largest;
}

std::string Viewer::rootsTexture() const {
    if (!request_.rootsOn) return {};
    for (const SessionTexture& texture : frame_.textures) {
        const Parameter* parameter = loaded_->effect.findParameter(texture.name);
        const std::string generator = parameter ? parameter->annotations.string("Generator").value_or("") : std::string();
        if (generator.ends_with(" roots")) return texture.name;
    }
    return {};
}

/// Of several objects the first's, as the texture is.
Result<void> Viewer::countFur() {
    gpu::Texture* texture = session().target(rootsTexture());
    if (!texture || meshes_.empty() || meshes_.front().figures.roots > 0) return {};
    const auto image = run::readBack(device_, *texture);
    if (!image) return image.error();
    countRoots(meshes_.front().figures, *meshes_.front().mesh, request_.rootsOn(*meshes_.front().mesh, *image));
    return {};
}

Result<void> Viewer::bakeAgain(const std::string& name) {
    notice("baking " + name);
    loaded_->session.bakeAgain(name);
    dropDraft();
    dropMeshes(); // roots of fur are counted anew
    targets_.forgetAll();
    const auto drawn = draw();
    if (!problem_.empty() && !session().target(shownTarget(state_, frame_))) state_.show = Show::Picture;
    return drawn;
}

void Viewer::dropMeshes() {
    if (meshesMaking_.valid()) meshesAbandoned_.push_back(std::move(meshesMaking_));
    std::erase_if(meshesAbandoned_,
                  [](const auto& making) { return making.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    meshes_.clear();
    meshCanvas_.reset();
}

/// Large meshes are looked at by another thread; small ones are there at once.
bool Viewer::haveMeshes() {
    if (!meshes_.empty()) return true;
    if (!meshesMaking_.valid())
        meshesMaking_ = std::async(std::launch::async, [scene = request_.scene, keeps = request_.keeps] { return coloredMeshes(scene); });
    if (meshesMaking_.wait_for(kFiguresMoment) != std::future_status::ready) return false;
    meshes_ = meshesMaking_.get();
    return !meshes_.empty();
}

Result<void> Viewer::paintMesh() {
    if (state_.mesh == MeshShow::Fur)
        if (const auto counted = countFur(); !counted) return counted;
    if (meshCanvas_ && meshShown_ != state_.mesh)
        if (const auto colored = meshCanvas_->color(meshes_, state_.mesh); !colored) return colored;
    meshShown_ = state_.mesh;
    if (!meshCanvas_) {
        auto made = MeshCanvas::create(device_, request_.run.compiler, meshes_, state_.mesh);
        if (!made) return made.error();
        meshCanvas_ = std::move(*made);
    }
    const PlacedScene placed = placeScene(area_.seen(state_.workspace, size_), run::boundsOf(request_.scene));
    return meshCanvas_->draw(picture_, cameraMatrices(placed.camera, static_cast<double>(size_.width) / size_.height));
}

void Viewer::describeMesh(PanelPictures& pictures) {
    if (meshes_.empty()) return;
    const std::uint32_t side = mapSide() > 0 ? mapSide() : kUsualSide;
    pictures.legend = legendOf(state_.mesh, meshes_.front().figures, side);
    pictures.figures = linesOf(state_.mesh, meshes_.front().figures, side);
    if (meshes_.size() > 1) pictures.figures.push_back("figures of the first of several meshes");
}

} // namespace tegument::view
