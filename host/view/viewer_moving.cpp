// While something moves, a picture that takes too long is drawn small, and sharpened once it rests.

#include "host/view/viewer.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kStill(150); // nothing has moved for so long
constexpr double kSlowMaps = 100;                // milliseconds: what a smaller picture does not mend
constexpr std::uint32_t kFewer = 4;              // texels along each side, in a draft
constexpr std::uint32_t kLeastSide = 256;        // of a map that has fewer in a draft

/// TEGUMENT_SHADOW_SIZE follows it where nothing is said.
void divideSizes(std::vector<std::pair<std::string, std::string>>& defines, std::uint32_t side) {
    std::erase_if(defines, [](const auto& define) { return define.first == "TEGUMENT_MAP_SIZE"; });
    defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(side / kFewer));
    for (auto& [name, value] : defines)
        if (name == "TEGUMENT_SHADOW_SIZE") value = std::to_string(side / kFewer);
}

} // namespace

Result<void> Viewer::draw() {
    drafting_ = false;
    return drawAt(1);
}

Result<void> Viewer::drawMoving(Moving what) {
    drafting_ = drafting_ || (what == Moving::Rest && costs_.anything > kSlowMaps && haveDraft());
    const auto begin = std::chrono::steady_clock::now();
    MovingCosts& costs = drafting_ ? draftCosts_ : costs_;
    const auto drawn = drawAt(costs.share(what));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    costs.note(passCosts(), took.count(), sharpness_, what);
    return drawn;
}

bool Viewer::haveDraft() {
    if (draftTried_) return draft_ != nullptr;
    draftTried_ = true;
    const std::uint32_t side = mapSide();
    if (side < kLeastSide) return false;
    LoadOptions load = request_.load;
    divideSizes(load.defines, side);
    auto effect = readEffect(std::move(load));
    if (!effect) return false; // the whole picture has said why, or will
    auto draft = std::make_unique<Loaded>(device_, std::move(*effect), request_.keeps, request_.scene, loaded_.get());
    const auto frame = drawWith(*draft);
    const bool fewer = frame && std::ranges::any_of(frame->targets, [&](const std::string& name) {
                           return draft->session.target(name)->desc().width == side / kFewer;
                       });
    if (!fewer) return false;
    draft_ = std::move(draft);
    draftCosts_ = costs_;
    draftCosts_.anything /= kFewer * kFewer;
    draftCosts_.camera = draftCosts_.anything;
    return true;
}

void Viewer::dropDraft() {
    draft_.reset();
    draftTried_ = drafting_ = false;
}

void Viewer::noteCosts() {
    if (isDraft()) return;
    const bool all = std::ranges::none_of(frame_.passes, &SessionPass::kept);
    costs_.note(passCosts(), 0, 1, all ? std::optional(Moving::Rest) : std::nullopt);
}

PassCosts Viewer::passCosts() {
    PassCosts costs{.pixels = frame_.resolveMilliseconds.value_or(0), .others = 0};
    for (const SessionPass& pass : frame_.passes) {
        const gpu::Texture* target = pass.targets.empty() ? nullptr : session().target(pass.targets.front());
        const bool picture = target && PixelSize{target->desc().width, target->desc().height} == drawnPixels();
        (picture ? costs.pixels : costs.others) += pass.milliseconds;
    }
    return costs;
}

Result<void> Viewer::drawAt(double share) {
    sharpness_ = share;
    auto frame = drawWith(drafting_ ? *draft_ : *loaded_);
    if (!frame) return report(&loaded_->effect, frame.error());
    if (const auto developed = develop(std::move(*frame)); !developed) return developed;
    return {};
}

Result<void> Viewer::sharpen() {
    if (!isDraft() || std::chrono::steady_clock::now() - moved_ < kStill) return {};
    return draw();
}

PixelSize Viewer::drawnPixels() const {
    const auto side = [&](std::uint32_t pixels) {
        return std::max(1U, static_cast<std::uint32_t>(std::lround(sharpness_ * static_cast<double>(pixels))));
    };
    return {side(size_.width), side(size_.height)};
}

Canvas::Fit Viewer::fitOf(const gpu::Texture& texture) const {
    const PixelSize pixels{texture.desc().width, texture.desc().height};
    return {.share = 1, .fill = sharpness_ < 1 && pixels == drawnPixels(), .closer = closer()};
}

Closer Viewer::closer() const {
    return {.zoom = state_.zoom, .at = {static_cast<float>(state_.zoomAt.x), static_cast<float>(state_.zoomAt.y)}};
}

} // namespace tegument::view
