// While something moves, a picture that takes too long is drawn small, and sharpened once it rests.

#include "host/view/viewer.h"

#include <algorithm>
#include <cmath>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kStill(150); // nothing has moved for so long

} // namespace

Result<void> Viewer::draw() {
    return drawAt(1);
}

Result<void> Viewer::drawMoving() {
    return drawAt(quickShare(wholeMilliseconds_, quick_));
}

Result<void> Viewer::drawAt(double share) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    sharpness_ = share;
    auto frame = drawWith(*loaded_);
    if (!frame) return report(&loaded_->effect, frame.error());
    if (const auto developed = develop(std::move(*frame)); !developed) return developed;
    moved_ = Clock::now();
    const double took = std::chrono::duration<double, std::milli>(moved_ - begin).count();
    if (share < 1)
        quick_ = {.share = share, .milliseconds = took};
    else
        wholeMilliseconds_ = took;
    return {};
}

Result<void> Viewer::sharpen() {
    if (sharpness_ >= 1 || std::chrono::steady_clock::now() - moved_ < kStill) return {};
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
