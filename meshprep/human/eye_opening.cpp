#include "meshprep/human/eye_opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace tegument {

namespace {

constexpr int kDirections = 96;
constexpr float kReach = 14; // mm in the chart: what meets the eyeball farther out lies behind the lids

// What of the light is left: right under a lid, and how far its shadow reaches, mm. By eye; the upper lid's lashes hang before it.
constexpr float kUnderUpper = 0.25f;
constexpr float kUpperReach = 2.6f;
constexpr float kUnderLower = 0.55f;
constexpr float kLowerReach = 0.9f;
constexpr float kTearHeight = 0.16f; // mm; the meniscus of tears is 0.2 to 0.5 mm high
constexpr float kTearWidth = 0.3f;   // mm

using Segment = std::array<glm::vec2, 2>;

float crossed(const glm::vec2& a, const glm::vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Segments along which the skin's triangles pass through the eyeball's surface, before its middle.
std::vector<Segment> contacts(const HeadSurface& head, const Eyeball& eye) {
    std::vector<Segment> result;
    for (std::size_t t = 0; t < head.parts.size(); ++t) {
        if (head.parts[t] != BustPart::Skin) continue;
        std::vector<glm::vec2> ends;
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec3 a = head.mesh.positions[head.mesh.indices[3 * t + c]] - eye.centre;
            const glm::vec3 b = head.mesh.positions[head.mesh.indices[3 * t + (c + 1) % 3]] - eye.centre;
            if (a.z <= 0 || b.z <= 0) continue;
            const float offA = glm::length(a) - eyeSurface(eye, glm::normalize(a));
            const float offB = glm::length(b) - eyeSurface(eye, glm::normalize(b));
            if ((offA > 0) == (offB > 0)) continue;
            ends.push_back(eyeChart(eye, eye.centre + glm::mix(a, b, offA / (offA - offB))));
        }
        if (ends.size() == 2 && glm::length(ends[0]) < kReach) result.push_back({ends[0], ends[1]});
    }
    return result;
}

/// The nearest of the segments that a ray meets.
std::optional<glm::vec2> firstMet(const std::vector<Segment>& segments, const glm::vec2& from, const glm::vec2& way) {
    float nearest = std::numeric_limits<float>::max();
    for (const Segment& segment : segments) {
        const glm::vec2 along = segment[1] - segment[0];
        const float turn = crossed(way, along);
        if (turn == 0) continue;
        const float t = crossed(segment[0] - from, along) / turn;
        const float s = crossed(segment[0] - from, way) / turn;
        if (t > 0 && s >= 0 && s <= 1) nearest = std::min(nearest, t);
    }
    if (nearest == std::numeric_limits<float>::max()) return std::nullopt;
    return from + way * nearest;
}

float distanceToLine(const std::vector<glm::vec2>& line, const glm::vec2& p) {
    float nearest = 1e6f;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::vec2 along = line[i + 1] - line[i];
        const float t = std::clamp(glm::dot(p - line[i], along) / std::max(glm::dot(along, along), 1e-12f), 0.0f, 1.0f);
        nearest = std::min(nearest, glm::distance(p, line[i] + along * t));
    }
    return nearest;
}

/// 1 far from a lid, `least` at it.
float besideLid(float distance, float least, float reach) {
    return 1 - (1 - least) * std::exp(-distance / reach);
}

} // namespace

EyeOpening::EyeOpening(const HeadSurface& head, const Eyeball& eye) : eye_(eye) {
    const std::vector<Segment> segments = contacts(head, eye);
    std::vector<glm::vec2> rim;
    for (int i = 0; i < kDirections; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * (static_cast<float>(i) + 0.5f) / kDirections;
        if (const auto point = firstMet(segments, glm::vec2(0), glm::vec2(std::cos(angle), std::sin(angle)))) rim.push_back(*point);
    }
    if (rim.size() < 3) return;
    const auto [right, left] = std::ranges::minmax_element(rim, {}, &glm::vec2::x);
    const glm::vec2 corners[2] = {*right, *left};
    for (const glm::vec2& p : rim) {
        const float along = (p.x - corners[0].x) / (corners[1].x - corners[0].x);
        const float middle = glm::mix(corners[0].y, corners[1].y, along);
        if (p.y >= middle) upper_.push_back(p);
        if (p.y <= middle) lower_.push_back(p);
    }
    std::ranges::sort(upper_, {}, &glm::vec2::x);
    std::ranges::sort(lower_, {}, &glm::vec2::x);
}

LidDistances EyeOpening::distances(const glm::vec3& position) const {
    if (empty()) return {};
    const glm::vec2 p = eyeChart(eye_, position);
    return {.upper = distanceToLine(upper_, p), .lower = distanceToLine(lower_, p)};
}

float EyeOpening::light(const glm::vec3& position) const {
    const LidDistances lids = distances(position);
    return besideLid(lids.upper, kUnderUpper, kUpperReach) * besideLid(lids.lower, kUnderLower, kLowerReach);
}

float EyeOpening::tears(const glm::vec3& position) const {
    const float off = distances(position).lower / kTearWidth;
    const float aside = std::abs(eyeChart(eye_, position).x);
    return kTearHeight * std::exp(-off * off) * (1 - glm::smoothstep(7.5f, 10.5f, aside)); // the corners have other forms
}

} // namespace tegument
