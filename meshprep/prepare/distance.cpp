// The Hausdorff distance by branch and bound: no point of a triangle is further away than its farthest corner and the distance to that
// corner, nor than its farthest corner is from one triangle of the other surface. Triangles that cannot hold the greatest distance are left
// alone, others are cut in four. Nearest points come from a tree of boxes in single precision, so the surfaces are brought into the unit
// cube first. All is done in runs that do not depend on one another, so that the result does not depend on the processors.

#include "meshprep/prepare/distance.h"

#include "host/support/parallel.h"
#include "meshprep/prepare/cover.h"
#include "meshprep/prepare/near_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <queue>
#include <unordered_map>

namespace tegument::prep {

namespace {

/// A point, or a triangle, far from the other surface.
struct DistancePeak {
    double apart = 0;
    std::uint32_t number = 0;
    glm::dvec3 at{};
    std::uint32_t nearest = 0; // corner of the other surface
};

/// What is further than this share of the greatest distance is worth mending.
inline constexpr double kPeak = 0.5;

/// More would not change the first two digits.
constexpr std::size_t kMostSamples = 40'000;

/// Of corners and centroids of the first surface from the second. `dear`: answers take long, so few are asked.
double rootMeanSquare(const NearSurface& from, const NearSurface& to, bool dear) {
    const std::size_t most = dear ? kMostSamples / 64 : kMostSamples;
    const std::size_t step = std::max<std::size_t>(1, 4 * from.size() / most);
    const std::size_t samples = (from.size() + step - 1) / step;
    struct Sum {
        double squares = 0;
        std::size_t count = 0;
    };
    std::vector<Sum> ofRun(chunkCount(samples));
    inChunks(samples, 0, [&](std::size_t first, std::size_t last, std::size_t run) {
        std::uint32_t hint = kNoHint;
        for (std::size_t i = first; i < last; ++i) {
            const std::array<glm::dvec3, 3> t = from.triangle(from.alongCurve()[i * step]);
            for (const glm::dvec3& point : {(t[0] + t[1] + t[2]) / 3.0, t[0], t[1], t[2]}) {
                const NearestTriangle near = to.nearest(point, hint);
                if (!std::isfinite(near.distance)) continue;
                hint = near.triangle;
                ofRun[run].squares += near.distance * near.distance;
                ++ofRun[run].count;
            }
        }
    });
    Sum all;
    for (const Sum& sum : ofRun)
        all = {.squares = all.squares + sum.squares, .count = all.count + sum.count};
    return all.count == 0 ? 0 : std::sqrt(all.squares / static_cast<double>(all.count));
}

/// From the farthest on, `most` of them; none within twice the distance of one before, for that is the same hill.
std::vector<DistancePeak> summits(std::vector<DistancePeak> peaks, double reached, std::size_t most) {
    constexpr std::size_t kMostLookedAt = 4096;
    std::erase_if(peaks, [&](const DistancePeak& peak) { return peak.apart <= kPeak * reached; });
    std::ranges::sort(peaks, [](const DistancePeak& a, const DistancePeak& b) {
        return a.apart > b.apart || (a.apart == b.apart && a.number < b.number);
    });
    if (peaks.size() > kMostLookedAt) peaks.resize(kMostLookedAt);
    std::vector<DistancePeak> kept;
    for (const DistancePeak& peak : peaks) {
        const auto near = [&](const DistancePeak& other) { return glm::distance(other.at, peak.at) < 2 * other.apart; };
        if (kept.size() < most && std::ranges::none_of(kept, near)) kept.push_back(peak);
    }
    return kept;
}

using Triangle = std::array<glm::dvec3, 3>;
using Nearest = NearestTriangle;
using Surface = NearSurface;

glm::dvec3 centroid(const Triangle& t) {
    return (t[0] + t[1] + t[2]) / 3.0;
}

/// Every point of a triangle is at most this far from one of its corners: a disc of that radius holds the triangle (Jung's theorem), and
/// the corners' squared distances from the point, weighted as the point is, are at most its square.
double reachOf(const Triangle& t) {
    const double longest = std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    return longest / std::sqrt(3.0);
}

/// What is known of a point of one surface: how far it is from the other one, at most, and a triangle there that is so near.
struct Place {
    double apart = kUnknown;
    std::uint32_t hint = kNoHint;

    static constexpr double kUnknown = -1;
};

constexpr double kClose = 1.02;    // the bound need not be nearer to the truth
constexpr double kRounding = 1e-6; // of the tree's floats, the surface being of unit size

/// A point nearer than this share of what was reached cannot matter: where it is exactly is not asked.
constexpr double kNear = 0.3;

/// How many nearest points are asked for: so that the time stays linear. What is left then is bounded as it is.
struct Effort {
    std::size_t perTriangle = 0;
    std::size_t atLeast = 0;
    std::size_t atMost = 0;
};
constexpr Effort kThorough{.perTriangle = 8, .atLeast = 30'000, .atMost = 400'000};
constexpr Effort kDear{.perTriangle = 0, .atLeast = 256, .atMost = 256};
constexpr Effort kRough{.perTriangle = 1, .atLeast = 3'000, .atMost = 500'000};

/// Corners whose greatest distance is a first guess.
constexpr std::size_t kMostSampled = 4096;

/// One surface's distance from the other.
class OneWay {
public:
    OneWay(const Surface& own, const Surface& other) : own_(own), other_(other), places_(own.points().size()) {
        for (std::size_t i = 0; i < other.corners().size(); ++i)
            places_[other.corners()[i]] = {.apart = 0, .hint = static_cast<std::uint32_t>(i / 3)};
    }

    /// The greatest distance of the corners that the other surface does not have. Once `enough` is passed the rest is not looked at.
    double measureCorners(double reached, double enough) {
        std::vector<std::uint32_t> asked;
        for (const std::uint32_t triangle : own_.alongCurve())
            for (const std::uint32_t corner : own_.corners().subspan(3 * std::size_t{triangle}, 3)) {
                Place& place = places_[corner];
                if (place.apart != Place::kUnknown) continue;
                place.apart = 0; // so that it is asked once
                asked.push_back(corner);
            }
        const std::size_t samples = std::clamp<std::size_t>(asked.size() / 64, 512, kMostSampled);
        const std::size_t step = asked.size() / samples + 1; // their greatest distance spares most others an exact answer
        for (std::size_t i = 0; i < asked.size(); i += step)
            reached = std::max(reached, measure(asked[i], kNoHint, reached));
        if (reached > enough) return reached;
        return inRuns(asked.size(), reached, [&](std::size_t first, std::size_t last, double ofRun) {
            std::uint32_t hint = kNoHint;
            for (std::size_t i = first; i < last; ++i) {
                ofRun = std::max(ofRun, measure(asked[i], hint, ofRun));
                hint = places_[asked[i]].hint;
            }
            return ofRun;
        });
    }

    /// Of a few of them, and of those near the farthest few.
    double sampleCorners(double reached) {
        constexpr std::size_t kHills = 24;
        constexpr std::size_t kRound = 64; // triangles along the curve on either side
        const std::size_t step = own_.size() / kMostSampled + 1;
        std::vector<std::pair<double, std::size_t>> far;
        for (std::size_t i = 0; i < own_.size(); i += step)
            far.emplace_back(sampleAt(i, reached), i);
        const auto hills = far.begin() + static_cast<std::ptrdiff_t>(std::min(kHills, far.size()));
        std::ranges::partial_sort(far, hills, std::ranges::greater());
        for (auto hill = far.begin(); hill != hills; ++hill)
            for (std::size_t i = hill->second - std::min(hill->second, kRound); i < std::min(hill->second + kRound, own_.size()); ++i)
                sampleAt(i, reached);
        return reached;
    }

    using Peak = DistancePeak;

    /// The greatest distance of every triangle's middle and of the middles of its sides; triangles that are far off join `peaks`.
    [[nodiscard]] double measureMiddles(double reached, std::vector<Peak>& peaks) const {
        std::vector<std::vector<Peak>> ofRun(chunkCount(own_.size()));
        inChunks(own_.size(), 0, [&](std::size_t first, std::size_t last, std::size_t run) {
            for (std::size_t i = first; i < last; ++i)
                if (const Peak peak = middleOf(static_cast<std::uint32_t>(i), kPeak * reached); peak.apart > kPeak * reached)
                    ofRun[run].push_back(peak);
        });
        for (const std::vector<Peak>& found : ofRun)
            for (const Peak& peak : found) {
                peaks.push_back(peak);
                reached = std::max(reached, peak.apart);
            }
        return reached;
    }

    /// Whether answers take more than they are worth, on a few triangles.
    [[nodiscard]] bool dear() const {
        constexpr std::size_t kAsked = 64;
        constexpr std::size_t kMostInexact = 8;
        const std::size_t step = own_.size() / kAsked + 1;
        std::size_t inexact = 0;
        for (std::size_t i = 0; i < own_.size(); i += step)
            inexact += !other_.nearest(centroid(own_.triangle(i))).exact;
        return inexact > kMostInexact;
    }

    /// No corner is further.
    [[nodiscard]] double corners() const { return std::ranges::max(places_, {}, &Place::apart).apart; }

    void addPeaks(double reached, std::vector<Peak>& peaks) const {
        for (std::uint32_t point = 0; point < places_.size(); ++point)
            if (places_[point].apart > kPeak * reached)
                peaks.push_back({.apart = places_[point].apart, .number = point, .at = own_.points()[point], .nearest = point});
    }

    struct Found {
        double bound = 0;
        double reached = 0;
        std::vector<Peak> highest{}; // of the runs that reached more than was known
    };
    /// A bound, and what was reached: what cannot be 2 % further than that is left alone.
    [[nodiscard]] Found bound(double reached, const Effort& effort, const Cover* cover = nullptr) const;

private:
    /// Of the first corner of a triangle, in their order along the curve.
    double sampleAt(std::size_t place, double& reached) {
        const std::uint32_t corner = own_.corners()[3 * std::size_t{own_.alongCurve()[place]}];
        if (places_[corner].apart == Place::kUnknown) reached = std::max(reached, measure(corner, kNoHint, reached));
        return places_[corner].apart;
    }

    /// `work(first, last, reached)` gives the greatest that it reached.
    template <class Work>
    static double inRuns(std::size_t count, double reached, Work work) {
        std::vector<double> ofRun(chunkCount(count), reached);
        inChunks(count, 0, [&](std::size_t first, std::size_t last, std::size_t run) { ofRun[run] = work(first, last, reached); });
        return ofRun.empty() ? reached : std::ranges::max(ofRun);
    }

    [[nodiscard]] Peak middleOf(std::uint32_t triangle, double enough) const {
        const Triangle t = own_.triangle(triangle);
        std::uint32_t hint = places_[own_.corners()[3 * std::size_t{triangle}]].hint;
        Peak peak{.apart = 0, .number = triangle, .nearest = 0};
        for (const glm::dvec3& point : {(t[0] + t[1]) / 2.0, (t[1] + t[2]) / 2.0, (t[2] + t[0]) / 2.0, centroid(t)}) {
            const Nearest near = other_.nearest(point, hint, enough);
            if (!std::isfinite(near.distance)) break;
            hint = near.triangle;
            if (near.distance > peak.apart)
                peak = {.apart = near.distance, .number = triangle, .at = point, .nearest = other_.nearestCorner(near.triangle, point)};
        }
        return peak;
    }

    double measure(std::uint32_t point, std::uint32_t hint, double reached) {
        const Nearest near = other_.nearest(own_.points()[point], hint, kNear * reached);
        if (!std::isfinite(near.distance)) return 0; // all of the other surface is without area
        places_[point] = {.apart = near.distance, .hint = near.triangle};
        return near.reached();
    }

    const Surface& own_;
    const Surface& other_;
    std::vector<Place> places_; // by point; points of both surfaces lie on both
};

/// A triangle, or a piece of one, whose corners' distances from the other surface are known.
struct Piece {
    double bound = 0; // no point of it is further from the other surface
    Triangle corners{};
    std::array<Place, 3> places{};
    std::uint32_t triangle = 0; // that it belongs to

    bool operator<(const Piece& other) const { return bound < other.bound; }
};

/// A run of triangles: the pieces that may hold the greatest distance, the likeliest first.
class Undecided {
public:
    /// `cover`: of the other surface, or null.
    Undecided(const Surface& other, double reached, const Cover* cover) : other_(other), cover_(cover), reached_(reached) {}

    /// What was reached, and where if it is more than what was known.
    [[nodiscard]] double reached() const { return reached_; }
    [[nodiscard]] const OneWay::Peak& highest() const { return highest_; }

    /// What is not known of `places` is found out, unless all of the triangle is near.
    void add(std::uint32_t triangle, const Triangle& corners, std::array<Place, 3> places) {
        if (places[0].hint != kNoHint) near_ = places[0].hint;
        if (near_ != kNoHint && isNear(corners, closeTo(reached_))) return;
        for (std::size_t i = 0; i < 3; ++i) {
            if (places[i].apart == Place::kUnknown) places[i] = at(corners[i], near_, triangle);
            if (places[i].hint == kNoHint) return;
            near_ = places[i].hint;
        }
        add({.corners = corners, .places = places, .triangle = triangle});
    }

    void add(Piece piece) {
        const double close = closeTo(reached_);
        double apart = 0;
        for (const Place& place : piece.places)
            apart = std::max(apart, place.apart);
        piece.bound = apart + reachOf(piece.corners);
        for (std::size_t i = 0; i < 3 && piece.bound > close; ++i)
            if (const std::uint32_t hint = piece.places[i].hint; i == 0 || hint != piece.places[i - 1].hint)
                piece.bound = std::min(piece.bound, farthestCorner(piece, i, piece.bound));
        if (piece.bound > close) pieces_.push(piece);
    }

    /// Cuts until nothing can be further than what was reached, or so many nearest points were asked for. Gives the bound of what is left.
    double cut(std::size_t most) {
        // A point whose distance is not exact may hold a piece up however small it is: its cuts ask nothing new, and count as well.
        const std::size_t before = asked_.size();
        for (std::size_t cuts = 0; !pieces_.empty() && pieces_.top().bound > closeTo(reached_);) {
            if (std::max(asked_.size() - before, cuts) >= most) return pieces_.top().bound;
            const Piece piece = pieces_.top();
            pieces_.pop();
            if (within(piece, closeTo(reached_))) continue;
            split(piece);
            ++cuts;
        }
        return 0;
    }

    static double closeTo(double reached) { return std::max(reached * kClose, kRounding); }

private:
    /// How far the corners are from the triangle near one of them, and so all of the piece: the distance from one triangle is greatest at a
    /// corner. What is further than `least` does not matter.
    [[nodiscard]] double farthestCorner(const Piece& piece, std::size_t corner, double least) const {
        const std::uint32_t hint = piece.places[corner].hint;
        if (hint == kNoHint) return least;
        double farthest = 0;
        for (std::size_t i = 1; i <= 3 && farthest < least; ++i) // itself last: it is near
            farthest = std::max(farthest, other_.distanceTo(hint, piece.corners[(corner + i) % 3]));
        return farthest;
    }

    /// All of a triangle: to the last one that was near, for the distance from one triangle is greatest at a corner, or to what lies below.
    [[nodiscard]] bool isNear(const Triangle& corners, double most) {
        const auto near = [&](const glm::dvec3& corner) { return other_.distanceTo(near_, corner) <= most; };
        return std::ranges::all_of(corners, near) || (cover_ != nullptr && cover_->within(corners, near_, most));
    }

    [[nodiscard]] bool within(const Piece& piece, double most) const {
        std::uint32_t start = piece.places[0].hint;
        return cover_ != nullptr && start != kNoHint && cover_->within(piece.corners, start, most);
    }

    /// Into four, by the middles of the sides.
    void split(const Piece& piece) {
        const Triangle& t = piece.corners;
        const Triangle middles = {(t[0] + t[1]) / 2.0, (t[1] + t[2]) / 2.0, (t[2] + t[0]) / 2.0};
        std::array<Place, 3> m{};
        for (std::size_t i = 0; i < 3; ++i) {
            m[i] = at(middles[i], piece.places[i].hint, piece.triangle);
            if (m[i].hint == kNoHint) return;
        }
        const auto& p = piece.places;
        add({.corners = {t[0], middles[0], middles[2]}, .places = {p[0], m[0], m[2]}, .triangle = piece.triangle});
        add({.corners = {middles[0], t[1], middles[1]}, .places = {m[0], p[1], m[1]}, .triangle = piece.triangle});
        add({.corners = {middles[2], middles[1], t[2]}, .places = {m[2], m[1], p[2]}, .triangle = piece.triangle});
        add({.corners = middles, .places = m, .triangle = piece.triangle});
    }

    /// Two pieces share most of these points.
    Place at(const glm::dvec3& point, std::uint32_t hint, std::uint32_t triangle) {
        const auto [known, isNew] = asked_.try_emplace({point.x, point.y, point.z});
        if (!isNew) return known->second;
        const Nearest near = other_.nearest(point, hint, kNear * reached_);
        if (std::isfinite(near.distance)) {
            known->second = {.apart = near.distance, .hint = near.triangle};
            if (near.reached() > reached_) {
                reached_ = near.distance;
                highest_ = {.apart = near.distance, .number = triangle, .at = point, .nearest = other_.nearestCorner(near.triangle, point)};
            }
        }
        return known->second;
    }

    struct Hash {
        std::size_t operator()(const std::array<double, 3>& point) const {
            std::uint64_t hash = 0;
            for (const double x : point)
                hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
            return hash ^ (hash >> 32);
        }
    };

    const Surface& other_;
    const Cover* cover_;
    double reached_;
    OneWay::Peak highest_;
    std::uint32_t near_ = kNoHint; // the last triangle
    std::priority_queue<Piece> pieces_;
    std::unordered_map<std::array<double, 3>, Place, Hash> asked_;
};

/// Triangles that share what they may ask, which goes where it is worth most: so many at least, in so many runs at most.
constexpr std::size_t kLeastRun = 64;
constexpr std::size_t kMostRuns = 256;

OneWay::Found OneWay::bound(double reached, const Effort& effort, const Cover* cover) const {
    const std::size_t runs = std::clamp(own_.size() / kLeastRun, std::size_t{1}, kMostRuns);
    const std::size_t most = std::clamp(effort.perTriangle * own_.size(), effort.atLeast, effort.atMost) / runs;
    struct Run {
        double bound = 0;
        Peak highest;
    };
    std::vector<Run> ofRun(runs);
    forEachInParallel(runs, [&](std::size_t run) {
        Undecided undecided(other_, reached, cover);
        const std::size_t last = own_.size() * (run + 1) / runs;
        for (std::size_t i = own_.size() * run / runs; i < last; ++i) {
            const std::uint32_t triangle = own_.alongCurve()[i];
            const auto corners = own_.corners().subspan(3 * std::size_t{triangle}, 3);
            undecided.add(triangle, own_.triangle(triangle), {places_[corners[0]], places_[corners[1]], places_[corners[2]]});
        }
        ofRun[run] = {.bound = undecided.cut(most), .highest = undecided.highest()};
    });
    Found all{.bound = 0, .reached = reached};
    for (const Run& run : ofRun) {
        all.bound = std::max(all.bound, run.bound);
        all.reached = std::max(all.reached, run.highest.apart);
        if (run.highest.apart > reached) all.highest.push_back(run.highest);
    }
    return all;
}

} // namespace

struct DistanceFrom::State {
    double scale = 1;
    std::vector<glm::dvec3> points;
    std::unique_ptr<Surface> surface;
    std::unique_ptr<Cover> cover; // of it
};

DistanceFrom::DistanceFrom(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> triangles)
    : state_(std::make_unique<State>()) {
    if (triangles.empty()) return;
    glm::dvec3 low(positions[triangles[0]]);
    glm::dvec3 high = low;
    for (const std::uint32_t index : triangles) {
        low = glm::min(low, glm::dvec3(positions[index]));
        high = glm::max(high, glm::dvec3(positions[index]));
    }
    const glm::dvec3 size = high - low;
    state_->scale = std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    state_->points.reserve(positions.size());
    for (const glm::vec3& p : positions)
        state_->points.push_back((glm::dvec3(p) - low) / state_->scale);
    state_->surface = std::make_unique<Surface>(state_->points, triangles);
    state_->cover = std::make_unique<Cover>(*state_->surface);
}

DistanceFrom::~DistanceFrom() = default;

/// Both ways to one other surface.
class DistanceFrom::Both {
public:
    Both(const State& state, std::span<const std::uint32_t> triangles)
        : state_(state), other_(state.points, triangles), there_(*state.surface, other_), back_(other_, *state.surface) {}

    /// Nothing more is looked at once `enough` is passed.
    OneWay::Found bound(double enough) {
        const double sampled = back_.sampleCorners(there_.sampleCorners(0));
        if (sampled > enough) return {.bound = kFar, .reached = sampled};
        dear_ = there_.dear() || back_.dear();
        const Effort& effort = dear_ ? kDear : kThorough;
        if (!dear_) cover_.emplace(other_);
        const OneWay::Found first = there_.bound(sampled, effort, dear_ ? nullptr : &*cover_);
        if (first.reached > enough) return {.bound = kFar, .reached = first.reached};
        const OneWay::Found last = back_.bound(first.reached, effort, dear_ ? nullptr : state_.cover.get());
        return {.bound = std::max({first.bound, last.bound, Undecided::closeTo(last.reached)}) + kRounding, .reached = last.reached};
    }

    [[nodiscard]] double rms() const { return rootMeanSquare(*state_.surface, other_, dear_); }

private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();

    const State& state_;
    Surface other_;
    OneWay there_;
    OneWay back_;
    std::optional<Cover> cover_;
    bool dear_ = false;
};

SurfaceDistance DistanceFrom::to(std::span<const std::uint32_t> triangles) const {
    if (!state_->surface || triangles.empty()) return {};
    Both both(*state_, triangles);
    const OneWay::Found found = both.bound(std::numeric_limits<double>::infinity());
    return {.greatest = state_->scale * found.bound, .reached = state_->scale * found.reached, .rms = state_->scale * both.rms()};
}

double DistanceFrom::reached(std::span<const std::uint32_t> triangles, double enough) const {
    if (!state_->surface || triangles.empty()) return 0;
    return state_->scale * Both(*state_, triangles).bound(enough / state_->scale).reached;
}

RoughDistance DistanceFrom::roughly(std::span<const std::uint32_t> triangles, std::size_t most, double enough, TooFar tooFar) const {
    if (!state_->surface || triangles.empty()) return {.greatest = std::numeric_limits<double>::infinity()};
    const Surface other(state_->points, triangles);
    OneWay there(*state_->surface, other);
    const OneWay back(other, *state_->surface);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const double far = enough / state_->scale;
    double reached = there.measureCorners(0, tooFar == TooFar::HasPeaks ? kFar : far);
    std::vector<OneWay::Peak> peaks, bridges;
    if (reached <= far) {
        if (there.dear() || back.dear()) return {.greatest = state_->scale * there.corners()};
        reached = back.measureMiddles(reached, bridges);
    }
    if (reached <= far) {
        const OneWay::Found found = back.bound(reached, kRough);
        const OneWay::Found last = there.bound(found.reached, kRough);
        reached = last.reached;
        bridges.insert(bridges.end(), found.highest.begin(), found.highest.end());
        for (OneWay::Peak peak : last.highest) {
            peak.number = state_->surface->nearestCorner(peak.number, peak.at);
            peaks.push_back(peak);
        }
    }
    there.addPeaks(reached, peaks);
    RoughDistance rough{.greatest = state_->scale * reached};
    for (const OneWay::Peak& peak : summits(std::move(peaks), reached, most))
        rough.peaks.push_back(peak.number);
    for (const OneWay::Peak& peak : summits(std::move(bridges), reached, most))
        rough.bridges.push_back({.triangle = peak.number, .nearest = peak.nearest});
    return rough;
}

SurfaceDistance distance(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to) {
    return DistanceFrom(positions, from).to(to);
}

} // namespace tegument::prep
