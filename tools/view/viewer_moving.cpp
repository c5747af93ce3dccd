// While something moves, a picture that takes too long is drawn small and of fewer triangles, and sharpened once it rests.

#include "tools/view/viewer.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kStill(150); // nothing has moved for so long
constexpr double kMapsToDraft = 100;             // milliseconds of maps that a smaller picture does not mend

} // namespace

Result<void> Viewer::draw() {
    return drawAs({});
}

Result<void> Viewer::drawMoving(Moving what, bool learns) {
    takeFewer();
    const double maps = what == Moving::Camera ? costs_.camera : costs_.anything;
    Sharpness how = sharpness_;
    how.drafting = how.drafting || (maps > kMapsToDraft && haveDraft(false));
    MovingCosts& costs = how.drafting ? draftCosts_ : costs_;
    how.share = costs.share(what);
    how.single = how.single || how.drafting || costs.slow(what);
    how.coarse = fewer_ && how.single;
    const auto begin = std::chrono::steady_clock::now();
    const auto drawn = drawAs(how);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (learns) costs.note(passCosts(), took.count(), sharpness_.share, what, isDraft());
    return drawn;
}

void Viewer::noteCosts() {
    if (isDraft()) return;
    const bool all = std::ranges::none_of(frame_.passes, &SessionPass::kept);
    costs_.note(passCosts(), 0, 1, all ? std::optional(Moving::Rest) : std::nullopt, false);
    for (const SessionPass& pass : frame_.passes)
        if (!pass.kept && pass.milliseconds > 0) pieces_.note(pass.name, pass.milliseconds); // those behind the shown one were not drawn
}

PassCosts Viewer::costsOf(const SessionFrame& frame, EffectSession& of) const {
    PassCosts costs{.pixels = frame.resolveMilliseconds.value_or(0), .others = 0};
    for (const SessionPass& pass : frame.passes) {
        const gpu::Texture* target = pass.targets.empty() ? nullptr : of.target(pass.targets.front());
        const bool picture = target && PixelSize{target->desc().width, target->desc().height} == drawnPixels();
        (picture ? costs.pixels : costs.others) += pass.milliseconds;
    }
    return costs;
}

PassCosts Viewer::passCosts() {
    PassCosts costs = costsOf(frame_, session());
    if (beside_ && beside_->drawn && beside_->loaded) {
        costs.pixels += beside_->costs.pixels;
        costs.others += beside_->costs.others;
    }
    return costs;
}

Result<void> Viewer::drawAs(const Sharpness& how) {
    sharpness_ = how;
    torn_ = stale_ = false; // an error is shown instead
    auto frame = drawWith(how.drafting ? *draft_ : *loaded_);
    if (!frame) return report(&loaded_->effect, frame.error());
    const auto developed = develop(std::move(*frame));
    moved_ = std::chrono::steady_clock::now(); // the other side and the window's picture take a while, too
    return developed;
}

Result<void> Viewer::drawSoon() {
    if (isDraft()) return drawAs(sharpness_);
    stale_ = true;
    return {};
}

Result<void> Viewer::sharpen() {
    const bool rests = std::chrono::steady_clock::now() - moved_ >= kStill;
    if (!stale_ && (!isDraft() || !rests)) return {};
    const Sharpness shown = std::exchange(sharpness_, {});
    inPieces_ = true;
    auto frame = drawWith(*loaded_);
    const bool both = frame && !frame->givenUp && beside_ && beside_->loaded && state_.show != Show::Pass;
    const auto side = both ? drawSide() : Result<SessionFrame>(SessionFrame{}); // which develop() then finds drawn
    inPieces_ = false;
    if (!frame) {
        stale_ = false;
        return report(&loaded_->effect, frame.error());
    }
    if (!frame->givenUp && !(side && side->givenUp)) return develop(std::move(*frame));
    sharpness_ = shown;
    torn_ = !stale_ && !shown.drafting;
    return {};
}

void Viewer::notePiece() {
    const auto now = std::chrono::steady_clock::now();
    longestPiece_ = std::max(longestPiece_, std::chrono::duration<double, std::milli>(now - std::exchange(pieceBegan_, now)).count());
}

bool Viewer::mayGoOn() {
    notePiece();
    return !interrupted_ && !(window_ && window_->hears());
}

PixelSize Viewer::drawnPixels() const {
    const auto side = [&](std::uint32_t pixels) {
        return std::max(1U, static_cast<std::uint32_t>(std::lround(sharpness_.share * static_cast<double>(pixels))));
    };
    return {side(size_.width), side(size_.height)};
}

/// What is enlarged, or stands beside a saved picture, needs the window's.
PixelSize Viewer::paintedPixels() const {
    const bool alone = !beside_ || (beside_->loaded && !state_.errors);
    const bool plain = state_.zoom == 1 && state_.show == Show::Picture && state_.mesh == MeshShow::None;
    return alone && plain ? drawnPixels() : size_;
}

Canvas::Fit Viewer::fitOf(const gpu::Texture& texture) const {
    const PixelSize pixels{texture.desc().width, texture.desc().height};
    return {.area = kAllOfIt, .fill = sharpness_.share < 1 && pixels == drawnPixels(), .closer = closer()};
}

Closer Viewer::closer() const {
    return {.zoom = state_.zoom, .at = {static_cast<float>(state_.zoomAt.x), static_cast<float>(state_.zoomAt.y)}};
}

} // namespace tegument::view
