#include "meshprep/fur/roots/scatter.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/point_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tegument {

namespace {

// Sparser than a sixteenth, discs do not grow any more (the number of roots still falls): the search for neighbours stays short.
constexpr double kLeastDensity = 1.0 / 16;
constexpr float kShrinking = 0.95F;               // of the distance from one round to the next
constexpr std::uint32_t kOfDensity = 0x5bd1e995U; // streams of the noise of their own
constexpr std::uint32_t kOfTurns = 0x6c8e9cf5U;

/// Which cubes take roots in a round, and how many darts are thrown for each root that they miss.
struct Round {
    double darts = 1;
    unsigned level = 0; // cubes of 2^level strata's sides
    bool shrinks = false;
};

/// Few darts while there is much room, for those of one round are compared with each other by one processor; many when few roots are
/// missing. What a stratum has no room for goes to cubes of 2, then of 4 times its side.
constexpr Round kRounds[] = {{0.5, 0}, {1, 0}, {2, 0}, {4, 0}, {8, 0}, {16, 0}, {24, 1}, {32, 1}, {64, 1}, {64, 2}, {64, 2}};
constexpr std::size_t kMostRounds = 64;

/// After those. One root in a few hundred may stand anywhere; where more are missing, the surface is rougher than they are apart.
Round later(std::size_t missing, std::size_t wanted, bool firstAnywhere) {
    constexpr unsigned kAnywhere = 21;
    if (missing <= std::max<std::size_t>(8, wanted / 400)) return {64, kAnywhere, !firstAnywhere};
    return {12, 1, true};
}

/// A cube that still misses roots.
struct Open {
    Strata::Run run;
    std::size_t missing = 0;
    std::size_t darts = 0;
    std::uint64_t firstDart = 0;
};

struct Candidate {
    SurfacePoint point;
    std::uint32_t stratum = 0;
    std::uint32_t cube = 0; // of those open in this round
    float distance = 0;
    double turn = 0; // when it is its turn
};

class Darts {
public:
    Darts(const ScatterOptions& options, const Strata& strata)
        : options_(options), strata_(strata), distance_(options.distance), taken_(std::max(2 * options.distance, 1e-6F), options.wanted),
          rootsOfStratum_(strata.count(), 0) {
        points_.reserve(options.wanted);
    }

    void play(const Round& round) {
        if (round.shrinks) distance_ *= kShrinking;
        findOpen(round);
        std::vector<Candidate> candidates = throwDarts();
        // What is left has room among the roots of earlier rounds; among each other they are taken in a random order.
        std::ranges::stable_sort(candidates, {}, &Candidate::turn);
        for (const Candidate& candidate : candidates)
            if (missing() > 0 && open_[candidate.cube].missing > 0 && isFree(candidate)) take(candidate);
    }

    [[nodiscard]] std::size_t missing() const { return options_.wanted - points_.size(); }
    ScatteredRoots roots() && { return {.points = std::move(points_), .distance = distance_}; }

private:
    void findOpen(const Round& round) {
        open_.clear();
        strata_.forRuns(round.level, [&](const Strata::Run& run) {
            std::size_t roots = 0;
            for (std::uint32_t i = run.first; i < run.last; ++i)
                roots += rootsOfStratum_[i];
            const std::size_t quota = strata_.quota(run);
            if (roots >= quota) return;
            constexpr double kSparsest = 1.0 / 64; // where nearly all darts meet bald skin, the surroundings take the root
            const double darts = round.darts / std::max(strata_.density(run), kSparsest);
            const auto count = static_cast<std::size_t>(std::ceil(static_cast<double>(quota - roots) * darts));
            open_.push_back({.run = run, .missing = quota - roots, .darts = count, .firstDart = thrown_});
            thrown_ += count;
        });
    }

    [[nodiscard]] std::vector<Candidate> throwDarts() const {
        std::vector<std::vector<Candidate>> left(chunkCount(open_.size()));
        inChunks(open_.size(), options_.threads, [&](std::size_t from, std::size_t to, std::size_t chunk) {
            for (std::size_t i = from; i < to; ++i)
                for (std::size_t dart = 0; dart < open_[i].darts; ++dart)
                    if (auto candidate = at(static_cast<std::uint32_t>(i), dart); candidate && isFree(*candidate))
                        left[chunk].push_back(*candidate);
        });
        std::vector<Candidate> candidates;
        for (const auto& chunk : left)
            candidates.insert(candidates.end(), chunk.begin(), chunk.end());
        return candidates;
    }

    /// One into each of as many parts of equal area as there are darts.
    [[nodiscard]] std::optional<Candidate> at(std::uint32_t cube, std::size_t dart) const {
        const Open& open = open_[cube];
        const std::uint64_t number = open.firstDart + dart;
        glm::dvec3 place = rootNoise(number, options_.seed);
        place.x = (static_cast<double>(dart) + place.x) / static_cast<double>(open.darts);
        const Strata::Place found = strata_.point(open.run, place);
        Candidate candidate{.point = found.point, .stratum = found.stratum, .cube = cube, .distance = distance_};
        candidate.turn = rootNoise(number, options_.seed ^ kOfTurns).x;
        if (!options_.density) return candidate;
        const double density = options_.density(candidate.point);
        if (!(rootNoise(number, options_.seed ^ kOfDensity).x < density)) return std::nullopt;
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
        --open_[candidate.cube].missing;
        ++rootsOfStratum_[candidate.stratum];
        taken_.add(candidate.point.position, candidate.point.normal, candidate.distance);
        points_.push_back(candidate.point);
    }

    const ScatterOptions& options_;
    const Strata& strata_;
    float distance_;
    PointGrid taken_;
    std::vector<std::uint32_t> rootsOfStratum_;
    std::vector<Open> open_;
    std::uint64_t thrown_ = 0;
    std::vector<SurfacePoint> points_;
};

} // namespace

ScatteredRoots scatterRoots(const FurSurface& surface, const ScatterOptions& options) {
    if (options.wanted == 0 || !(surface.area() > 0)) return {};
    const double side = options.stratum > 0 ? static_cast<double>(options.stratum)
                                            : kStratum * std::sqrt(surface.area() / static_cast<double>(options.wanted));
    const Strata strata(surface, side, options.wanted, options.density);
    Darts darts(options, strata);
    bool anywhere = false;
    for (std::size_t i = 0; i < kMostRounds && darts.missing() > 0; ++i) {
        const Round round = i < std::size(kRounds) ? kRounds[i] : later(darts.missing(), options.wanted, !anywhere);
        anywhere = anywhere || round.level > kRounds[std::size(kRounds) - 1].level;
        darts.play(round);
    }
    ScatteredRoots roots = std::move(darts).roots();
    std::ranges::stable_sort(roots.points, {}, &SurfacePoint::triangle);
    return roots;
}

} // namespace tegument
