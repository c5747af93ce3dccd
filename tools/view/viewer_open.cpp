// Files that were dropped on the window or chosen: each is read by another thread, and its picture is made while the old one is shown and
// moved.

#include "tools/view/viewer.h"

#include "host/run/semantics.h"

#include <algorithm>

namespace tegument::view {

void Viewer::openDropped() {
    if (dropped_.empty() || making_) return;
    const Opening opening = dropped_.front();
    dropped_.pop_front();
    if (!request_.open) return;
    notice_.clear();
    const std::string what = opening.sets.empty() ? opening.file.string() : opening.sets.back();
    making_ = std::make_unique<Making>(
        Making{.what = opening.sets.empty() ? opening.file.filename().string() : what, .wanted = wanted_, .file = what});
    making_->opening =
        std::async(std::launch::async, [open = request_.open, opening, shown = loaded_->source] { return open(opening, shown->effect); });
    settling_ = kSettlingFrames;
}

/// What was asked for meanwhile is not lost where the file is of no use.
Result<void> Viewer::takeOpened() {
    Making& making = *making_;
    Result<ViewRequest> opened = making.opening.get();
    if (!opened) {
        const std::unique_ptr<Making> refused = std::move(making_);
        const Wanted shown{.technique = state_.technique, .setting = state_.setting, .binds = state_.binds};
        if (refused->reads || refused->wanted != shown)
            make({.what = "what was asked for", .wanted = refused->wanted, .reads = refused->reads, .anew = refused->anew});
        ++made_;
        return report(nullptr, opened.error());
    }
    opened->pictures = request_.pictures;
    if (!opened->keepView) making.wanted = {.technique = opened->run.technique, .setting = opened->load.setting, .binds = opened->binds};
    wanted_ = making.wanted;
    making.picture = true;
    making.reads = true;
    making.request = std::move(*opened);
    making.reading = std::make_unique<Reading>(toRead(*making.request, making.wanted));
    return {};
}

void Viewer::lookAt(Making& making) const {
    const bool anew = making.request && !making.request->keepView;
    making.workspace = anew ? run::inWorld(making.request->workspace, making.request->scene) : state_.workspace;
    making.workspace = area_.seen(std::move(making.workspace), size_);
    making.parameters = anew ? making.request->run.parameters : state_.parameters;
    std::erase_if(making.parameters, [&](const auto& value) { return !making.loaded->effect.findParameter(value.first); });
}

void Viewer::showOpened(ViewRequest request) {
    request_ = std::move(request);
    if (!request_.keepView) begin();
    state_.workspace.parameters = request_.workspace.parameters; // with its switches
    state_.workspace.textures = request_.workspace.textures;
    area_.shape = static_cast<double>(request_.run.width) / std::max(1, request_.run.height);
    dropFewer();
    dropMeshes();
    costs_ = draftCosts_ = {};
}

} // namespace tegument::view
