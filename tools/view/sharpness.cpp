#include "tools/view/sharpness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::view {

namespace {

constexpr double kQuick = 70;      // milliseconds: with what a window adds, below the 100 that feel like at once
constexpr double kLongPiece = 60;  // milliseconds
constexpr double kShortPiece = 20; // so that twice as long is still no long one
constexpr std::uint32_t kMostBands = 16;
constexpr double kWorth = 4;                                         // pixels that take a quarter of the rest are not worth being fewer
constexpr std::array kShares = {1.0, 0.75, 0.5, 0.375, 0.25, 0.125}; // few: each other size allocates targets anew

/// Which pixels, as a share of all, fit: those cost `whole` less `rest`.
double pixelsThatFit(double whole, double rest) {
    const double pixels = whole - rest;
    if (pixels <= 0) return 1;
    return rest < kQuick ? std::max((kQuick - rest) / pixels, rest / kWorth / pixels) : rest / kWorth / pixels;
}

double fitting(double share) {
    const auto fits = std::ranges::find_if(kShares, [&](double candidate) { return candidate <= share; });
    return fits == kShares.end() ? kShares.back() : *fits;
}

} // namespace

std::string draftText(const Sharpness& how, std::uint32_t width, std::uint32_t height) {
    return fmt::format("while it moves: {} x {}{}", width, height, how.drafting ? ", small maps" : "");
}

double quickShare(double whole, const QuickPicture& last) {
    if (whole <= kQuick) return 1;
    double rest = 0; // what a picture without pixels takes
    if (last.milliseconds <= 0) return fitting(std::sqrt(pixelsThatFit(whole, 0)));
    if (last.share < 1) rest = whole - (whole - last.milliseconds) / (1 - last.share * last.share);
    double share = std::sqrt(pixelsThatFit(whole, std::clamp(rest, 0.0, whole)));
    // The whole picture took longer for what it compiled, or for its samples and triangles: the quick ones tell how large they may be.
    if (rest < -kQuick / 2 || last.share == 1)
        share = std::max(share, std::min(1.0, last.share * std::min(2.0, std::sqrt(kQuick / last.milliseconds))));
    return fitting(share);
}

void MovingCosts::note(const PassCosts& passes, double took, double share, std::optional<Moving> moving, bool draft) {
    if (passes.pixels > 0 && !draft) pixels = passes.pixels;
    if (passes.pixels > 0 && draft) quick = {.share = share, .milliseconds = passes.pixels};
    const double rest = std::max(passes.others, took - passes.pixels);
    if (moving == Moving::Camera) camera = rest;
    if (moving == Moving::Rest) anything = rest;
}

bool MovingCosts::slow(Moving moving) const {
    return pixels + restOf(moving) > kQuick;
}

double MovingCosts::share(Moving moving) const {
    const double rest = restOf(moving);
    QuickPicture last = quick;
    if (last.milliseconds > 0) last.milliseconds += rest;
    return quickShare(pixels + rest, last);
}

void PieceTimes::note(const std::string& pass, double milliseconds) {
    const auto found = bands_.try_emplace(pass, 1).first;
    std::uint32_t& bands = found->second;
    const double each = milliseconds / bands;
    // Each band takes all triangles again: twice as many bands are not half as long each. So they are not found by a division.
    if (each > kLongPiece) bands = std::min(kMostBands, (each > 4 * kLongPiece ? 4 : 2) * bands);
    if (each < kShortPiece && bands > 1) bands /= 2;
}

} // namespace tegument::view
