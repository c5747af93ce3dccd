#include "meshprep/human/lips.h"

#include "meshprep/human/atlas.h"
#include "meshprep/human/cut.h"
#include "meshprep/human/subdivide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace tegument {

namespace {

constexpr float kLipReach = 12;  // mm along the skin: from the rim to where the lips' skin passes into the face's
constexpr float kOverlap = 0.3f; // mm: lips press on each other
constexpr int kBins = 48;        // from one corner of the mouth to the other

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

/// For each vertex within kLipReach of the rim: the way to it, and on which lip it is.
struct LipSides {
    std::vector<float> distance; // mm along edges; kLipReach where farther
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

/// The rim's lips are told apart by the line between its corners.
LipSides findSides(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads, const std::vector<std::uint8_t>& kinds) {
    const std::set<std::uint32_t> rim = rimOf(quads, kinds);
    const auto [right, left] = std::ranges::minmax(rim, {}, [&](std::uint32_t v) { return positions[v].x; });
    std::vector<int> rimSide(positions.size(), 0);
    std::vector<std::uint32_t> sources; // all but the corners themselves
    for (const std::uint32_t v : rim) {
        const float along = (positions[v].x - positions[right].x) / (positions[left].x - positions[right].x);
        const float height = positions[v].y - glm::mix(positions[right].y, positions[left].y, along);
        rimSide[v] = height > 0 ? 1 : height < 0 ? -1 : 0;
        if (height != 0) sources.push_back(v);
    }
    std::vector<Quad> around;
    for (std::size_t q = 0; q < quads.size(); ++q)
        if (kinds[q] != 0) around.push_back(quads[q]);
    EdgeWays ways = waysAlongEdges(positions, around, sources, kLipReach);
    LipSides sides{.distance = std::move(ways.length)};
    for (std::size_t v = 0; v < positions.size(); ++v)
        sides.side.push_back(sides.distance[v] < kLipReach ? rimSide[ways.source[v]] : 0);
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
        width_ = (last - first_) / kBins;
        std::vector<float> upper(kBins, std::numeric_limits<float>::max());
        std::vector<float> lower(upper.size(), std::numeric_limits<float>::lowest());
        for (std::size_t v = 0; v < positions.size(); ++v) {
            if (sides.distance[v] > kRim || positions[v].x < first_ || positions[v].x > last) continue;
            const auto bin = std::min(upper.size() - 1, static_cast<std::size_t>((positions[v].x - first_) / width_));
            if (sides.side[v] > 0) upper[bin] = std::min(upper[bin], positions[v].y);
            if (sides.side[v] < 0) lower[bin] = std::max(lower[bin], positions[v].y);
        }
        for (std::size_t bin = 0; bin < upper.size(); ++bin)
            gaps_.push_back(std::abs(upper[bin] - lower[bin]) < kLipReach ? upper[bin] - lower[bin] : -kOverlap);
    }

    /// What is to be closed at x, so that the lips overlap by kOverlap; fades to 0 at the corners, where they pass into each other.
    [[nodiscard]] float at(float x) const {
        constexpr float kCorner = 3; // mm
        const float place = (x - first_) / width_ - 0.5f;
        const float below = std::floor(place);
        const float toCorner = std::min(x - first_, first_ + width_ * kBins - x);
        const float open = glm::mix(bin(static_cast<long>(below)), bin(static_cast<long>(below) + 1), place - below);
        return glm::smoothstep(0.0f, kCorner, toCorner) * (open + kOverlap);
    }
    [[nodiscard]] float widest() const {
        float result = -kLipReach;
        for (std::size_t i = 0; i < gaps_.size(); ++i)
            result = std::max(result, at(first_ + width_ * (static_cast<float>(i) + 0.5f)) - kOverlap);
        return result;
    }

private:
    [[nodiscard]] float bin(long index) const {
        return index < 0 || index >= static_cast<long>(gaps_.size()) ? -kOverlap : gaps_[static_cast<std::size_t>(index)];
    }

    float first_ = 0; // x of the right corner
    float width_ = 0; // of a bin, mm
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
        const float weight = 1 - glm::smoothstep(kLipReach / 4, kLipReach, sides.distance[v]);
        bust.positions[v].y -= static_cast<float>(sides.side[v]) * weight * gap.at(bust.positions[v].x) / 2;
    }
}

} // namespace

Result<LipGap> closeLips(Bust& bust, int subdivisionLevels) {
    constexpr int kPasses = 4; // the limit surface follows its control points only in part
    const std::optional<Mouth> mouth = findMouth(bust);
    if (!mouth) return LipGap{};
    Result<GapCurve> gap = measureGap(bust, *mouth, subdivisionLevels);
    if (!gap) return gap.error();
    LipGap result{.before = gap->widest(), .after = gap->widest()};
    const LipSides sides = findSides(bust.positions, bust.quads, mouth->quads);
    for (int pass = 0; pass < kPasses && result.after > -kOverlap / 2; ++pass) {
        pull(bust, sides, *gap);
        gap = measureGap(bust, *mouth, subdivisionLevels);
        if (!gap) return gap.error();
        result.after = gap->widest();
    }
    return result;
}

} // namespace tegument
