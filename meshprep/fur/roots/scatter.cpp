#include "meshprep/fur/roots/scatter.h"

#include "meshprep/fur/roots/parallel.h"
#include "meshprep/fur/roots/point_grid.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

// Sparser than a sixteenth, discs do not grow any more (the number of roots still falls): the search for neighbours stays short.
constexpr double kLeastDensity = 1.0 / 16;
constexpr float kShrinking = 0.95F;               // of the distance from one round to the next
constexpr std::uint32_t kOfDensity = 0x5bd1e995U; // streams of the noise of their own
constexpr std::uint32_t kOfTurns = 0x6c8e9cf5U;

struct Candidate {
    SurfacePoint point;
    float distance = 0;
    double turn = 0; // when it is its turn
};

/// Darts numbered from `first`, one into each of `count` parts of equal area: in the order of the triangles, so that what is read for one
/// is still at hand for the next.
struct Round {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

class Darts {
public:
    Darts(const FurSurface& surface, const ScatterOptions& options)
        : surface_(surface), options_(options), distance_(options.distance), taken_(std::max(2 * options.distance, 1e-6F), options.wanted) {
        points_.reserve(options.wanted);
    }

    void play(const Round& round) {
        std::vector<std::vector<Candidate>> left(threadCount(options_.threads));
        inChunks(round.count, options_.threads, [&](std::size_t from, std::size_t to, std::size_t chunk) {
            for (std::size_t i = from; i < to; ++i)
                if (auto candidate = at(round, i); candidate && isFree(*candidate)) {
                    candidate->turn = rootNoise(round.first + i, options_.seed ^ kOfTurns).x;
                    left[chunk].push_back(*candidate);
                }
        });
        // What is left has room among the roots of earlier rounds; among each other they are taken in a random order.
        std::vector<Candidate> candidates;
        for (const auto& chunk : left)
            candidates.insert(candidates.end(), chunk.begin(), chunk.end());
        std::ranges::stable_sort(candidates, {}, &Candidate::turn);
        for (const Candidate& candidate : candidates)
            if (points_.size() < options_.wanted && isFree(candidate)) take(candidate);
    }

    /// Roots to come may stand this much closer.
    void shrink(float share) { distance_ *= share; }

    [[nodiscard]] bool done() const { return points_.size() >= options_.wanted; }
    ScatteredRoots roots() && { return {.points = std::move(points_), .distance = distance_}; }

private:
    [[nodiscard]] std::optional<Candidate> at(const Round& round, std::uint64_t number) const {
        glm::dvec3 place = rootNoise(round.first + number, options_.seed);
        place.x = (static_cast<double>(number) + place.x) / static_cast<double>(round.count);
        Candidate candidate{.point = surface_.point(place), .distance = distance_};
        if (!options_.density) return candidate;
        const double density = options_.density(candidate.point);
        if (!(rootNoise(round.first + number, options_.seed ^ kOfDensity).x < density)) return std::nullopt;
        candidate.distance = static_cast<float>(distance_ / std::sqrt(std::clamp(density, kLeastDensity, 1.0)));
        return candidate;
    }

    [[nodiscard]] bool isFree(const Candidate& candidate) const {
        return taken_.visit(candidate.point.position, candidate.distance, [&](std::uint32_t i, float squared) {
            const PointGrid::Entry& other = taken_.entries()[i];
            const float distance = std::min(candidate.distance, other.reach);
            return squared >= distance * distance || glm::dot(candidate.point.normal, other.normal) <= 0;
        });
    }

    void take(const Candidate& candidate) {
        taken_.add(candidate.point.position, candidate.point.normal, candidate.distance);
        points_.push_back(candidate.point);
    }

    const FurSurface& surface_;
    const ScatterOptions& options_;
    float distance_;
    PointGrid taken_;
    std::vector<SurfacePoint> points_;
};

} // namespace

ScatteredRoots scatterRoots(const FurSurface& surface, const ScatterOptions& options) {
    if (options.wanted == 0 || !(surface.area() > 0)) return {};
    Darts darts(surface, options);
    const std::uint64_t wanted = options.wanted;
    // Darts of one round are compared with those of earlier rounds by all processors, with each other by one: rounds start small.
    std::uint64_t size = std::max<std::uint64_t>(wanted / 4, 1024);
    for (std::uint64_t first = 0; first < wanted * kTriesPerRoot && !darts.done();
         first += size, size = std::clamp<std::uint64_t>(2 * size, 1024, 2 * wanted + 1024)) {
        if (first > wanted * kTriesAtFullDistance) darts.shrink(kShrinking);
        darts.play({.first = first, .count = size});
    }
    ScatteredRoots roots = std::move(darts).roots();
    std::ranges::stable_sort(roots.points, {}, &SurfacePoint::triangle);
    return roots;
}

} // namespace tegument
