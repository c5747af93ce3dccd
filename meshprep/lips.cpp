#include "meshprep/lips.h"

#include "meshprep/charts.h"
#include "meshprep/subdivide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <set>

namespace tegument {

namespace {

constexpr float kReach = 12;     // mm along the skin: from the rim to where the lips' skin passes into the face's
constexpr float kOverlap = 0.3f; // mm: lips press on each other
constexpr float kBin = 1;        // mm of x

/// The skin around the mouth: quads of the two charts that meet in the lips' inner rim.
struct Mouth {
    std::vector<std::uint8_t> quads; // of the coarse quads: 1 for the inside, 2 for the head's skin
};

std::optional<Mouth> findMouth(const Bust& bust) {
    const std::vector<std::uint32_t> charts = chartsOf(bust.quads);
    const std::size_t count = std::size_t{1} + std::ranges::max(charts);
    std::vector<glm::vec3> low(count, glm::vec3(std::numeric_limits<float>::max()));
    std::vector<glm::vec3> high(count, glm::vec3(std::numeric_limits<float>::lowest()));
    for (std::size_t q = 0; q < bust.quads.size(); ++q)
        for (const std::uint32_t v : bust.quads[q].position) {
            low[charts[q]] = glm::min(low[charts[q]], bust.positions[v]);
            high[charts[q]] = glm::max(high[charts[q]], bust.positions[v]);
        }
    const std::size_t head = static_cast<std::size_t>(std::ranges::max_element(high, {}, &glm::vec3::y) - high.begin());
    for (std::size_t inner = 0; inner < count; ++inner) {
        if (inner == head || low[inner].y < low[head].y || low[inner].x >= 0 || high[inner].x <= 0) continue;
        Mouth mouth{.quads = std::vector<std::uint8_t>(bust.quads.size(), 0)};
        for (std::size_t q = 0; q < bust.quads.size(); ++q)
            mouth.quads[q] = charts[q] == inner ? 1 : charts[q] == head ? 2 : 0;
        return mouth;
    }
    return std::nullopt;
}

/// For each vertex within kReach of the rim: the way to it, and on which lip it is.
struct LipSides {
    std::vector<float> distance; // mm along edges; kReach where farther
    std::vector<int> side;       // +1 upper, -1 lower, 0 neither
};

/// Vertices that belong to quads of both kinds.
std::set<std::uint32_t> rimOf(const std::vector<Quad>& quads, const std::vector<std::uint8_t>& kinds) {
    std::set<std::uint32_t> inside;
    std::set<std::uint32_t> rim;
    for (std::size_t q = 0; q < quads.size(); ++q)
        if (kinds[q] == 1) inside.insert(quads[q].position.begin(), quads[q].position.end());
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (const std::uint32_t v : quads[q].position)
            if (kinds[q] == 2 && inside.contains(v)) rim.insert(v);
    return rim;
}

/// Shortest ways along edges (Dijkstra 1959) from the rim, whose lips are told apart by the line between its corners.
LipSides findSides(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads, const std::vector<std::uint8_t>& kinds) {
    std::vector<std::vector<std::uint32_t>> neighbours(positions.size());
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (std::size_t c = 0; kinds[q] != 0 && c < 4; ++c) {
            neighbours[quads[q].position[c]].push_back(quads[q].position[(c + 1) % 4]);
            neighbours[quads[q].position[(c + 1) % 4]].push_back(quads[q].position[c]);
        }
    const std::set<std::uint32_t> rim = rimOf(quads, kinds);
    const auto [right, left] = std::ranges::minmax(rim, {}, [&](std::uint32_t v) { return positions[v].x; });
    LipSides sides{.distance = std::vector<float>(positions.size(), kReach), .side = std::vector<int>(positions.size(), 0)};
    using Step = std::pair<float, std::uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    for (const std::uint32_t v : rim) {
        const float along = (positions[v].x - positions[right].x) / (positions[left].x - positions[right].x);
        const float height = positions[v].y - glm::mix(positions[right].y, positions[left].y, along);
        if (height == 0) continue; // the corners themselves
        sides.side[v] = height > 0 ? 1 : -1;
        sides.distance[v] = 0;
        open.emplace(0.0f, v);
    }
    while (!open.empty()) {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > sides.distance[v]) continue;
        for (const std::uint32_t next : neighbours[v]) {
            const float farther = distance + glm::distance(positions[v], positions[next]);
            if (farther >= sides.distance[next]) continue;
            sides.distance[next] = farther;
            sides.side[next] = sides.side[v];
            open.emplace(farther, next);
        }
    }
    return sides;
}

/// The gap between the lips over x, seen from the front.
class GapCurve {
public:
    GapCurve(const std::vector<glm::vec3>& positions, const LipSides& sides) {
        constexpr float kRim = 8; // mm from the rim: where the lips are nearest to each other
        first_ = std::numeric_limits<float>::max();
        float last = std::numeric_limits<float>::lowest();
        for (std::size_t v = 0; v < positions.size(); ++v)
            if (sides.distance[v] == 0) {
                first_ = std::min(first_, positions[v].x);
                last = std::max(last, positions[v].x);
            }
        std::vector<float> upper(static_cast<std::size_t>((last - first_) / kBin) + 1, std::numeric_limits<float>::max());
        std::vector<float> lower(upper.size(), std::numeric_limits<float>::lowest());
        for (std::size_t v = 0; v < positions.size(); ++v) {
            if (sides.distance[v] > kRim || positions[v].x < first_ || positions[v].x > last) continue;
            const auto bin = static_cast<std::size_t>((positions[v].x - first_) / kBin);
            if (sides.side[v] > 0) upper[bin] = std::min(upper[bin], positions[v].y);
            if (sides.side[v] < 0) lower[bin] = std::max(lower[bin], positions[v].y);
        }
        for (std::size_t bin = 0; bin < upper.size(); ++bin)
            gaps_.push_back(upper[bin] >= lower[bin] && upper[bin] - lower[bin] < kReach ? upper[bin] - lower[bin] : 0);
    }

    /// Fades to 0 towards the corners, where the lips pass into each other and there is nothing to close.
    [[nodiscard]] float at(float x) const {
        constexpr float kCorner = 5; // mm
        const float place = (x - first_) / kBin - 0.5f;
        const float below = std::floor(place);
        const float toCorner = std::min(x - first_, first_ + kBin * static_cast<float>(gaps_.size()) - x);
        return glm::smoothstep(0.0f, kCorner, toCorner) *
               glm::mix(bin(static_cast<long>(below)), bin(static_cast<long>(below) + 1), place - below);
    }
    [[nodiscard]] float widest() const {
        float result = 0;
        for (std::size_t i = 0; i < gaps_.size(); ++i)
            result = std::max(result, at(first_ + kBin * (static_cast<float>(i) + 0.5f)));
        return result;
    }

private:
    [[nodiscard]] float bin(long index) const {
        return index < 0 || index >= static_cast<long>(gaps_.size()) ? 0 : gaps_[static_cast<std::size_t>(index)];
    }

    float first_ = 0;
    std::vector<float> gaps_;
};

Result<GapCurve> measureGap(const Bust& bust, const Mouth& mouth, int levels) {
    const Result<Subdivided> fine = subdivide(bust.positions, bust.uvs, bust.quads, levels);
    if (!fine) return fine.error();
    std::vector<std::uint8_t> kinds;
    for (const std::uint32_t parent : fine->parents)
        kinds.push_back(mouth.quads[parent]);
    return GapCurve(fine->positions, findSides(fine->positions, fine->quads, kinds));
}

void pull(Bust& bust, const LipSides& sides, const GapCurve& gap) {
    for (std::size_t v = 0; v < bust.positions.size(); ++v) {
        const float open = gap.at(bust.positions[v].x);
        const float weight = 1 - glm::smoothstep(kReach / 4, kReach, sides.distance[v]);
        const float shift = (open + kOverlap * glm::smoothstep(0.0f, kOverlap, open)) / 2;
        bust.positions[v].y -= static_cast<float>(sides.side[v]) * weight * shift;
    }
}

} // namespace

Result<LipGap> closeLips(Bust& bust, int subdivisionLevels) {
    constexpr int kPasses = 2; // the limit surface follows its control points only in part
    const std::optional<Mouth> mouth = findMouth(bust);
    if (!mouth) return LipGap{};
    Result<GapCurve> gap = measureGap(bust, *mouth, subdivisionLevels);
    if (!gap) return gap.error();
    LipGap result{.before = gap->widest(), .after = gap->widest()};
    const LipSides sides = findSides(bust.positions, bust.quads, mouth->quads);
    for (int pass = 0; pass < kPasses && result.after > 0; ++pass) {
        pull(bust, sides, *gap);
        gap = measureGap(bust, *mouth, subdivisionLevels);
        if (!gap) return gap.error();
        result.after = gap->widest();
    }
    return result;
}

} // namespace tegument
