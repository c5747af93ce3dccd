#include "meshprep/human/neck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace tegument {

namespace {

constexpr std::size_t kOutlineBins = 72; // of the outline, around the neck
constexpr float kFlare = 0.1f;           // of the outline's radius
constexpr float kFlareOver = 24;         // mm
constexpr float kRounded = 0.12f;        // of the outline's radius: over so much the skin passes into the limit

/// The lowest control point of the middle of the face.
float chinOf(const Bust& bust) {
    constexpr float kMiddle = 5; // mm to either side
    float chin = bust.eyes[0].centre.y;
    for (std::size_t q = 0; q < bust.quads.size(); ++q)
        for (const std::uint32_t v : bust.quads[q].position) {
            const glm::vec3& p = bust.positions[v];
            if (bust.parts[q] == BustPart::Skin && std::abs(p.x) < kMiddle && p.z > bust.eyes[0].centre.z) chin = std::min(chin, p.y);
        }
    return chin;
}

/// Where the skin crosses a height, as its farthest radius in each direction around an axis.
class Outline {
public:
    Outline(const Bust& bust, float height) {
        std::vector<glm::vec2> points;
        for (std::size_t q = 0; q < bust.quads.size(); ++q)
            for (std::size_t c = 0; c < 4 && bust.parts[q] == BustPart::Skin; ++c) {
                const glm::vec3& a = bust.positions[bust.quads[q].position[c]];
                const glm::vec3& b = bust.positions[bust.quads[q].position[(c + 1) % 4]];
                if ((a.y - height) * (b.y - height) >= 0) continue;
                const glm::vec3 crossing = glm::mix(a, b, (height - a.y) / (b.y - a.y));
                points.emplace_back(crossing.x, crossing.z);
            }
        if (points.empty()) return;
        const auto [back, front] = std::ranges::minmax(points, {}, &glm::vec2::y);
        axis_ = glm::vec2(0, (back.y + front.y) / 2);
        for (const glm::vec2& p : points)
            radius_[bin(angle(p))] = std::max(radius_[bin(angle(p))], glm::distance(p, axis_));
        fill();
    }

    [[nodiscard]] bool empty() const { return radius_[0] == 0; }
    [[nodiscard]] const glm::vec2& axis() const { return axis_; }
    [[nodiscard]] float at(const glm::vec2& p) const {
        const float place = angle(p) / (2 * std::numbers::pi_v<float>)*kOutlineBins - 0.5f;
        const float below = std::floor(place);
        const auto index = static_cast<std::size_t>(static_cast<long>(below) + static_cast<long>(kOutlineBins)) % kOutlineBins;
        return glm::mix(radius_[index], radius_[(index + 1) % kOutlineBins], place - below);
    }

private:
    /// 0 to 2 pi.
    [[nodiscard]] float angle(const glm::vec2& p) const {
        const float turn = std::atan2(p.x - axis_.x, p.y - axis_.y);
        return turn < 0 ? turn + 2 * std::numbers::pi_v<float> : turn;
    }
    static std::size_t bin(float angle) {
        return std::min(kOutlineBins - 1, static_cast<std::size_t>(angle / (2 * std::numbers::pi_v<float>)*kOutlineBins));
    }

    /// Directions without a crossing lie between those that have one; two rounds of (1 2 1) / 4 take the corners off.
    void fill() {
        const std::array<float, kOutlineBins> found = radius_;
        for (std::size_t i = 0; i < kOutlineBins; ++i) {
            if (found[i] != 0) continue;
            std::size_t before = 1;
            std::size_t after = 1;
            while (found[(i + kOutlineBins - before) % kOutlineBins] == 0)
                ++before;
            while (found[(i + after) % kOutlineBins] == 0)
                ++after;
            radius_[i] = glm::mix(found[(i + kOutlineBins - before) % kOutlineBins], found[(i + after) % kOutlineBins],
                                  static_cast<float>(before) / static_cast<float>(before + after));
        }
        for (int round = 0; round < 2; ++round) {
            const std::array<float, kOutlineBins> sharp = radius_;
            for (std::size_t i = 0; i < kOutlineBins; ++i)
                radius_[i] = (sharp[(i + kOutlineBins - 1) % kOutlineBins] + 2 * sharp[i] + sharp[(i + 1) % kOutlineBins]) / 4;
        }
    }

    glm::vec2 axis_{0};
    std::array<float, kOutlineBins> radius_{};
};

/// `value` below the limit, rounded into it from `limit - width` on.
float limited(float value, float limit, float width) {
    const float t = (value - limit + width) / width;
    return t <= 0 ? value : limit - width + width * (1 - std::exp(-t));
}

} // namespace

float straightenNeck(Bust& bust, float fromMm) {
    const float height = chinOf(bust) - fromMm;
    const Outline outline(bust, height);
    float farthest = 0;
    if (outline.empty()) return farthest;
    std::vector<std::uint8_t> moved(bust.positions.size(), 0);
    for (std::size_t q = 0; q < bust.quads.size(); ++q)
        for (const std::uint32_t v : bust.quads[q].position) {
            glm::vec3& p = bust.positions[v];
            if (bust.parts[q] != BustPart::Skin || moved[v] != 0 || p.y >= height) continue;
            moved[v] = 1;
            const glm::vec2 from = glm::vec2(p.x, p.z) - outline.axis();
            const float radius = glm::length(from);
            if (radius == 0) continue;
            const float round = outline.at(glm::vec2(p.x, p.z));
            const float deep = (height - p.y) / kFlareOver;
            const float kept = limited(radius, round * (1 + kRounded + kFlare * deep), kRounded * round);
            p.x = outline.axis().x + from.x * kept / radius;
            p.z = outline.axis().y + from.y * kept / radius;
            farthest = std::max(farthest, radius - kept);
        }
    return farthest;
}

} // namespace tegument
