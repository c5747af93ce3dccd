#include "meshprep/skin/link_receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

/// Variance along each axis in squares of a texel's side: a texel's light is interpolated between texels by a quadratic B-spline.
constexpr double kReceived = 0.25;
/// What the above leaves of a Gaussian: at least this share.
constexpr double kLeast = 0.35;
/// Share that is taken back of each texel beside: the coefficients of a quadratic are its values less an eighth of their second difference.
constexpr float kTakenBack = 0.125F;
/// A texel beside lies at most so many sides off the plane of the texel, or it is of another part of the surface.
constexpr float kFold = 1;
/// Widths of the widest Gaussian within which sources count: 3.5 leave out 0.2 %.
constexpr double kReach = 3.5;
/// No Gaussian is narrower, in squares of a finest cell's side: what it gives to the cells of a grid is then within 1.1 % of 1 wherever it
/// stands (Poisson's sum: 4 exp(-2 pi^2 kFelt)). Below that it would fall between their middles, and large bodies would lose light.
constexpr double kFelt = 0.3;
/// A texel counts as at most so many usual ones along a side; for kFelt, which loses light where it is less, twice as many.
constexpr double kMostSide = 1.5;
constexpr double kMostFelt = 3;

/// Of a squared distance, 1/mm^2.
float bell(float squared, float variance) {
    return std::exp(-0.5F * squared / variance) / (2 * std::numbers::pi_v<float> * variance);
}

float squared(const glm::vec3& way) {
    return glm::dot(way, way);
}

/// Variance that cells can feel, mm^2.
double felt(const LinkCells& cells, int level, const LinkCells::Middle& middle) {
    const double finest =
        std::min(static_cast<double>(middle.side), kMostFelt * static_cast<double>(cells.usualSide(level))) / (1 << level);
    return kFelt * finest * finest;
}

LinkReceiver receiverOf(const LinkCells& cells, int level, const LinkCells::Middle& middle, const LinkOptions& options) {
    const double side = std::min(static_cast<double>(middle.side), kMostSide * static_cast<double>(cells.usualSide(level)));
    const auto left = [&](double variance) {
        const double along = std::max({variance - kReceived * side * side, kLeast * variance, felt(cells, level, middle)});
        return LinkSpread{.along = static_cast<float>(along), .through = static_cast<float>(std::max(along, variance))};
    };
    const glm::vec3 across = glm::cross(middle.alongU, middle.alongV);
    const float length = glm::length(across);
    LinkReceiver receiver{.middle = middle,
                          .normal = length > 0 ? across / length : glm::vec3(0),
                          .spreads = {},
                          .fourth = left(options.fourth),
                          .whole = {}};
    receiver.fourthReach = static_cast<float>(kReach) * std::sqrt(receiver.fourth.through);
    float widest = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        receiver.spreads[i] = left(options.variances[i]);
        widest = std::max(widest, receiver.spreads[i].through);
    }
    receiver.reach = static_cast<float>(kReach) * std::sqrt(widest);
    return receiver;
}

/// The middle of the texel beside, or where it would be if the skin went on as it does in the texel: beyond a border, or over to another
/// part.
glm::vec3 placeBeside(const Mesh& mesh, const LinkCells& cells, int level, const LinkCells::Middle& middle, const glm::ivec2& texel,
                      const glm::ivec2& by) {
    const auto samples = static_cast<float>(kSamplesAlongCell << level);
    const glm::vec3 step = samples * (static_cast<float>(by.x) * middle.alongU + static_cast<float>(by.y) * middle.alongV);
    const glm::vec3 onPlane = middle.place + step;
    const auto there = cells.middle(mesh, level, texel.x + by.x, texel.y + by.y, kLinksBeside);
    return there && glm::length(there->place - onPlane) < kFold * glm::length(step) ? there->place : onPlane;
}

} // namespace

float LinkReceiver::sent(const glm::vec3& way, const LinkSpread& spread) const {
    const float height = glm::dot(way, normal);
    const float flat = squared(way) - height * height;
    return std::exp(-0.5F * (flat / spread.along + height * height / spread.through)) / (2 * std::numbers::pi_v<float> * spread.along);
}

float LinkReceiver::sentBy(const glm::vec3& from, std::size_t gaussian) const {
    if (!whole) return sent(from - middle.place, spreads[gaussian]);
    const float variance = (*whole)[gaussian];
    float sum = (1 + 4 * kTakenBack) * bell(squared(from - middle.place), variance);
    for (const glm::vec3& place : beside)
        sum -= kTakenBack * bell(squared(from - place), variance);
    return sum;
}

float LinkReceiver::sentAlong(const LinkCell& cell, const LinkSpread& spread) const {
    const float distance = flat(cell);
    return bell(distance * distance, spread.along);
}

float LinkReceiver::flat(const LinkCell& cell) const {
    const glm::vec2 way = cell.uv - middle.uv;
    return glm::length(way.x * middle.alongU + way.y * middle.alongV);
}

LinkReceiver linkReceiver(const LinkCells& cells, const LinkCells::Middle& middle, const LinkOptions& options) {
    return receiverOf(cells, kDestinationLevel, middle, options);
}

std::optional<LinkReceiver> linkReceiverAmong(const Mesh& mesh, const LinkCells& cells, int level, const glm::ivec2& texel,
                                              const LinkOptions& options) {
    const auto middle = cells.middle(mesh, level, texel.x, texel.y, kLinksBeside);
    if (!middle) return std::nullopt;
    LinkReceiver receiver = receiverOf(cells, level, *middle, options);
    const std::array<glm::ivec2, 4> ways = {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}};
    float farthest = 0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        receiver.beside[k] = placeBeside(mesh, cells, level, *middle, texel, ways[k]);
        farthest = std::max(farthest, glm::length(receiver.beside[k] - middle->place));
    }
    std::array<float, 2> whole{};
    for (std::size_t i = 0; i < 2; ++i)
        whole[i] = static_cast<float>(std::max(options.variances[i], felt(cells, level, *middle)));
    receiver.whole = whole;
    receiver.reach += std::min(farthest, receiver.reach);
    return receiver;
}

} // namespace tegument
