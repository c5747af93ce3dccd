#include "meshprep/fur/roots/head_hair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace tegument {

namespace {

constexpr double kEyes = 64; // mm between the middles of the eyes: lengths below are of such a head
constexpr double kAxis = 68; // the middle of the head behind the eyes
constexpr double kSoft = 4;  // across which hair begins
constexpr double kBrowLength = 0.3;
constexpr double kBeardLength = 0.2;
constexpr double kSideLength = 0.4;
const glm::dvec3 kWhorl(9, 108, -120); // of the scalp

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A line through points (x, y), x rising.
double alongLine(std::span<const glm::dvec2> line, double x) {
    for (std::size_t i = 1; i < line.size(); ++i)
        if (x < line[i].x) {
            const double t = std::max(x - line[i - 1].x, 0.0) / (line[i].x - line[i - 1].x);
            return glm::mix(line[i - 1].y, line[i].y, t);
        }
    return line.back().y;
}

/// How high hair begins: degrees around the head from the front, mm above the eyes. High temples, sideburns, free ears, the nape.
constexpr std::array kHairline = {glm::dvec2(0, 66),   glm::dvec2(25, 69),   glm::dvec2(45, 58),   glm::dvec2(62, 32),
                                  glm::dvec2(71, 6),   glm::dvec2(78, -24),  glm::dvec2(88, -24),  glm::dvec2(93, 16),
                                  glm::dvec2(112, 10), glm::dvec2(120, -38), glm::dvec2(150, -72), glm::dvec2(180, -78)};
/// How high a beard reaches: mm from the middle, mm above the eyes. From the nose to the corner of the mouth, up to the sideburns.
constexpr std::array kCheek = {glm::dvec2(0, -54),  glm::dvec2(22, -57), glm::dvec2(32, -66),
                               glm::dvec2(46, -62), glm::dvec2(60, -44), glm::dvec2(70, -22)};
constexpr double kNeck = -106;        // where it ends
constexpr double kMouth = -69;        // the middle of the lips, mm above the eyes
constexpr glm::dvec2 kLips(27, 10.5); // half their extent

/// A place of the head, mm from the middle between its eyes.
struct Place {
    glm::dvec3 at{0};
    double around = 0; // degrees from the front
    double side = 1;   // of x
};

double scalp(const Place& p) {
    const bool ear = std::abs(p.at.x) > 75 && p.at.y < 12 && p.at.y > -45;
    const double wave = 1.5 * std::sin(0.37 * p.at.x) + 1.2 * std::sin(0.71 * p.at.x + 0.4 * p.at.z);
    return ear ? 0 : smooth(-kSoft, kSoft, p.at.y - alongLine(kHairline, p.around) + wave);
}

double beard(const Place& p) {
    if (p.around > 86 || p.at.z < -62) return 0;
    const double x = std::abs(p.at.x);
    const double lips = glm::length(glm::dvec2(x, p.at.y - kMouth) / kLips);
    const double upper = smooth(-kSoft, kSoft, alongLine(kCheek, x) - p.at.y);
    return upper * smooth(-8, 4, p.at.y - kNeck) * smooth(0.92, 1.12, lips);
}

/// The brow's middle line and half of its height, as painted (meshprep/human/brows.cpp). t: 0 at the nose, 1 at the temple.
double browT(const Place& p) {
    return (std::abs(p.at.x) - kEyes / 2 + 16) / 45;
}

double brow(const Place& p) {
    const double t = browT(p);
    if (p.at.z < -30 || t < -0.1 || t > 1.05) return 0;
    const double rise = 17 + 5 * smooth(-0.2, 0.66, t) - 5.5 * smooth(0.55, 1.15, t);
    const double half = 5.0 * smooth(-0.12, 0.15, t) * (1 - 0.7 * std::clamp(t, 0.0, 1.0));
    return 1 - smooth(0.5, 1.1, std::abs(p.at.y - rise) / std::max(half, 0.3));
}

glm::dvec3 browFlow(const Place& p) {
    const double t = std::clamp(browT(p), 0.0, 1.0);
    const double lean = glm::mix(1.2, -0.2, smooth(0.0, 0.45, t));
    return {p.side * std::cos(lean), std::sin(lean), 0};
}

glm::dvec3 beardFlow(const Place& p) {
    const bool moustache = p.at.y > kMouth && std::abs(p.at.x) < kLips.x + 6;
    return moustache ? glm::dvec3(0.8 * p.side * smooth(0, 8, std::abs(p.at.x)), -0.6, 0) : 0.6 * glm::dvec3(0.15 * p.side, -1, 0.1);
}

/// From the whorl, down at the sides.
glm::dvec3 scalpFlow(const Place& p) {
    const glm::dvec3 away = p.at - kWhorl;
    return glm::normalize(away + glm::dvec3(0, -40, 0) * smooth(40, 75, std::abs(p.at.x)));
}

glm::dvec3 alongSkin(const glm::dvec3& v, const glm::dvec3& normal) {
    const glm::dvec3 along = v - normal * glm::dot(v, normal);
    return along / std::max(glm::length(along), 1.0);
}

/// The middles of the eyeballs; nothing without them.
std::optional<std::array<glm::dvec3, 2>> eyesOf(const Mesh& mesh) {
    const auto part = std::ranges::find(mesh.parts, "eyes", &MeshPart::name);
    if (part == mesh.parts.end()) return std::nullopt;
    std::array<glm::dvec3, 2> low, high;
    low.fill(glm::dvec3(1e30));
    high.fill(glm::dvec3(-1e30));
    for (std::uint32_t i = 0; i < part->indexCount; ++i) {
        const glm::dvec3 p(mesh.positions[mesh.indices[part->firstIndex + i]]);
        const std::size_t side = p.x < static_cast<double>(mesh.bounds.centre.x) ? 1 : 0;
        low[side] = glm::min(low[side], p);
        high[side] = glm::max(high[side], p);
    }
    if (low[0].x > high[0].x || low[1].x > high[1].x) return std::nullopt;
    return std::array{0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
}

} // namespace

std::optional<HeadHair> hairOfHead(const Mesh& mesh) {
    const auto eyes = eyesOf(mesh);
    if (!eyes) return std::nullopt;
    const glm::dvec3 middle = 0.5 * ((*eyes)[0] + (*eyes)[1]);
    const double scale = kEyes / std::max(glm::distance((*eyes)[0], (*eyes)[1]), 1e-9);
    const auto eyesPart = std::ranges::find(mesh.parts, "eyes", &MeshPart::name);
    HeadHair hair;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        Place p{.at = scale * (glm::dvec3(mesh.positions[i]) - middle)};
        p.around = std::atan2(std::abs(p.at.x), p.at.z + kAxis) * 180 / std::numbers::pi;
        p.side = p.at.x < 0 ? -1 : 1;
        const double onScalp = scalp(p), onBrow = brow(p), onChin = beard(p);
        const double density = std::max({onScalp, onBrow, 0.55 * onChin});
        const double length = onScalp >= std::max(onBrow, onChin) ? glm::mix(kSideLength, 1.0, smooth(10, 75, p.at.y))
                                                                  : (onBrow > onChin ? kBrowLength : kBeardLength);
        const glm::dvec3 flow = onScalp >= std::max(onBrow, onChin) ? scalpFlow(p) : (onBrow > onChin ? browFlow(p) : beardFlow(p));
        hair.density.emplace_back(density, density, density);
        hair.length.emplace_back(length, length, length);
        hair.direction.push_back(0.5 + 0.5 * alongSkin(flow, glm::dvec3(mesh.normals[i])));
    }
    for (std::uint32_t i = 0; i < eyesPart->indexCount; ++i)
        hair.density[mesh.indices[eyesPart->firstIndex + i]] = glm::dvec3(0);
    return hair;
}

} // namespace tegument
