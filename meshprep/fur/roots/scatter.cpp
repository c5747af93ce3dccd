#include "meshprep/fur/roots/scatter.h"

#include "meshprep/fur/roots/parallel.h"
#include "meshprep/fur/roots/point_grid.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

// Sparser than a sixteenth, discs do not grow any more (the number of roots still falls): the search for neighbours stays short.
constexpr double kLeastDensity = 1.0 / 16;
constexpr std::uint32_t kThinning = 0x5bd1e995U; // another stream of the same noise

struct Candidate {
    SurfacePoint point;
    float distance = 0;
};

class Darts {
public:
    Darts(const FurSurface& surface, const ScatterOptions& options)
        : surface_(surface), options_(options), taken_(std::max(2 * options.distance, 1e-6F), options.wanted) {
        points_.reserve(options.wanted);
    }

    /// Tries the places from `first` to `last`.
    void round(std::uint64_t first, std::uint64_t last) {
        std::vector<std::vector<Candidate>> left(threadCount(options_.threads));
        inChunks(last - first, options_.threads, [&](std::size_t from, std::size_t to, std::size_t chunk) {
            for (std::size_t i = from; i < to; ++i)
                if (auto candidate = at(first + i); candidate && isFree(*candidate)) left[chunk].push_back(*candidate);
        });
        // What is left has room among the roots of earlier rounds; among each other they are taken in their order.
        for (const auto& chunk : left)
            for (const Candidate& candidate : chunk)
                if (points_.size() < options_.wanted && isFree(candidate)) take(candidate);
    }

    [[nodiscard]] bool done() const { return points_.size() >= options_.wanted; }
    std::vector<SurfacePoint> points() && { return std::move(points_); }

private:
    [[nodiscard]] std::optional<Candidate> at(std::uint64_t counter) const {
        Candidate candidate{.point = surface_.point(rootNoise(counter, options_.seed)), .distance = options_.distance};
        if (!options_.density) return candidate;
        const double density = options_.density(candidate.point);
        if (!(rootNoise(counter, options_.seed ^ kThinning).x < density)) return std::nullopt;
        candidate.distance = static_cast<float>(options_.distance / std::sqrt(std::clamp(density, kLeastDensity, 1.0)));
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
    PointGrid taken_;
    std::vector<SurfacePoint> points_;
};

} // namespace

std::vector<SurfacePoint> scatterRoots(const FurSurface& surface, const ScatterOptions& options) {
    if (options.wanted == 0 || !(surface.area() > 0)) return {};
    Darts darts(surface, options);
    const std::uint64_t most = std::uint64_t{options.wanted} * kTriesPerRoot;
    // Early places mostly stay, so that checking them at once is of little use: rounds start small.
    std::uint64_t size = std::max<std::uint64_t>(options.wanted / 8, 1024);
    for (std::uint64_t first = 0; first < most && !darts.done();
         first += size, size = std::min(2 * size, 2 * std::uint64_t{options.wanted}))
        darts.round(first, std::min(first + size, most));
    return std::move(darts).points();
}

} // namespace tegument
