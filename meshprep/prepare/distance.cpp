// The Hausdorff distance by branch and bound: a run of triangles that lie together is no further away than one of its points and the radius
// of the run round that point. Runs that cannot hold the greatest distance are never looked into. Nearest points come from a tree of boxes
// in single precision, so the surfaces are brought to unit size around the origin first.

#include "meshprep/prepare/distance.h"

#include "host/support/rays/surface_tree.h"
#include "meshprep/prepare/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace tegument::prep {

namespace {

using Triangle = std::array<glm::dvec3, 3>;

constexpr std::uint32_t kNoHint = UINT32_MAX;

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
};

class Surface {
public:
    Surface(const std::vector<glm::dvec3>& points, std::span<const std::uint32_t> triangles)
        : points_(points), triangles_(triangles),
          tree_(std::vector<glm::vec3>(points.begin(), points.end()), triangles, {.quick = true, .threads = 0}) {}

    [[nodiscard]] std::size_t size() const { return triangles_.size() / 3; }
    [[nodiscard]] Triangle triangle(std::size_t i) const {
        const std::uint32_t* t = &triangles_[3 * i];
        return {points_[t[0]], points_[t[1]], points_[t[2]]};
    }

    /// `hint`: a triangle that is probably near.
    [[nodiscard]] Nearest nearest(const glm::dvec3& point, std::uint32_t hint = kNoHint) const {
        Nearest found;
        float radius = std::numeric_limits<float>::infinity();
        if (hint != kNoHint)
            if (const double apart = distanceTo(hint, point); std::isfinite(apart)) {
                found = {.distance = apart, .triangle = hint};
                radius = std::nextafter(static_cast<float>(apart), 1e30f);
            }
        tree_.visitNear(glm::vec3(point), radius, [&](std::uint32_t triangle) {
            const double apart = distanceTo(triangle, point);
            if (apart < found.distance) { // not a number where two corners are equal: such a triangle is a side of others
                found = {.distance = apart, .triangle = triangle};
                radius = std::nextafter(static_cast<float>(apart), 1e30f);
            }
            return radius;
        });
        return found;
    }

    [[nodiscard]] double distanceTo(std::uint32_t triangle, const glm::dvec3& point) const {
        const std::uint32_t* t = &triangles_[3 * std::size_t{triangle}];
        return glm::distance(nearestOnTriangle(point, points_[t[0]], points_[t[1]], points_[t[2]]), point);
    }

private:
    const std::vector<glm::dvec3>& points_;
    std::span<const std::uint32_t> triangles_;
    SurfaceTree tree_;
};

glm::dvec3 centroid(const Triangle& t) {
    return (t[0] + t[1] + t[2]) / 3.0;
}

/// Triangles of one of both surfaces in a row, or a piece of one of them.
struct Run {
    double bound = 0; // no point of it is further from the other surface
    bool second = false;
    std::size_t first = 0;
    std::size_t count = 0;        // 0: the piece
    std::uint32_t hint = kNoHint; // a triangle of the other surface near it
    Triangle piece{};

    bool operator<(const Run& other) const { return bound < other.bound; }
};

class Greatest {
public:
    Greatest(const Surface& a, const Surface& b) : a_(a), b_(b) {}

    /// The bound, and what was reached. What cannot be 2 % further than that is left alone.
    std::pair<double, double> find() {
        for (const bool second : {false, true})
            for (std::size_t first = 0; first < own(second).size(); first += kRun)
                add({.second = second, .first = first, .count = std::min(kRun, own(second).size() - first)});
        while (!runs_.empty() && evaluations_ < kMostEvaluations && runs_.top().bound > std::max(reached_ * kClose, kRounding)) {
            const Run run = runs_.top();
            runs_.pop();
            split(run);
        }
        const double bound = std::max(runs_.empty() ? 0 : runs_.top().bound, reached_ * kClose);
        return {bound + kRounding, reached_};
    }

private:
    static constexpr std::size_t kRun = 256;                 // triangles at first: drawn in an order that keeps them together
    static constexpr std::size_t kFew = 4;                   // triangles that one triangle of the other surface may span
    static constexpr double kClose = 1.02;                   // the bound need not be nearer to the truth
    static constexpr double kRounding = 1e-6;                // of the tree's floats, the surface being of unit size
    static constexpr std::size_t kMostEvaluations = 400'000; // what is left then is bounded as it is

    [[nodiscard]] const Surface& own(bool second) const { return second ? b_ : a_; }
    [[nodiscard]] const Surface& other(bool second) const { return second ? a_ : b_; }

    template <class Visit>
    void forCorners(const Run& run, Visit visit) const {
        if (run.count == 0)
            for (const glm::dvec3& corner : run.piece)
                visit(corner);
        for (std::size_t i = run.first; i < run.first + run.count; ++i)
            for (const glm::dvec3& corner : own(run.second).triangle(i))
                visit(corner);
    }

    /// The distance from one triangle is greatest at a corner.
    [[nodiscard]] double fromOne(const Run& run, std::uint32_t triangle) const {
        double greatest = 0;
        forCorners(run, [&](const glm::dvec3& corner) { greatest = std::max(greatest, other(run.second).distanceTo(triangle, corner)); });
        return std::isfinite(greatest) ? greatest : std::numeric_limits<double>::infinity();
    }

    void add(Run run) {
        if (run.hint != kNoHint && run.count <= kFew && fromOne(run, run.hint) <= reached_ * kClose) return;
        ++evaluations_;
        const glm::dvec3 centre = centroid(run.count == 0 ? run.piece : own(run.second).triangle(run.first + run.count / 2));
        const Nearest near = other(run.second).nearest(centre, run.hint);
        if (!std::isfinite(near.distance)) return;
        reached_ = std::max(reached_, near.distance);
        double radius = 0;
        forCorners(run, [&](const glm::dvec3& corner) { radius = std::max(radius, glm::distance(corner, centre)); });
        run.hint = near.triangle;
        run.bound = near.distance + radius;
        if (run.bound > reached_ * kClose && run.count <= kFew) run.bound = std::min(run.bound, fromOne(run, near.triangle));
        if (run.bound > reached_ * kClose) runs_.push(std::move(run));
    }

    void split(const Run& run) {
        if (run.count > 1) {
            const std::size_t parts = std::min<std::size_t>(run.count, 4);
            for (std::size_t i = 0; i < parts; ++i) {
                const std::size_t from = run.first + run.count * i / parts;
                add({.second = run.second, .first = from, .count = run.first + run.count * (i + 1) / parts - from, .hint = run.hint});
            }
            return;
        }
        const Triangle t = run.count == 0 ? run.piece : own(run.second).triangle(run.first);
        const glm::dvec3 ab = (t[0] + t[1]) / 2.0, bc = (t[1] + t[2]) / 2.0, ca = (t[2] + t[0]) / 2.0;
        for (const Triangle& piece : {Triangle{t[0], ab, ca}, Triangle{ab, t[1], bc}, Triangle{ca, bc, t[2]}, Triangle{ab, bc, ca}})
            add({.second = run.second, .first = run.first, .count = 0, .hint = run.hint, .piece = piece});
    }

    const Surface& a_;
    const Surface& b_;
    std::priority_queue<Run> runs_;
    double reached_ = 0;
    std::size_t evaluations_ = 0;
};

/// More would not change the first two digits.
constexpr std::size_t kMostSamples = 40'000;

double rootMeanSquare(const Surface& from, const Surface& to) {
    const std::size_t step = std::max<std::size_t>(1, 4 * from.size() / kMostSamples);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < from.size(); i += step) {
        const Triangle t = from.triangle(i);
        for (const glm::dvec3& point : {centroid(t), t[0], t[1], t[2]}) {
            const double apart = to.nearest(point).distance;
            if (!std::isfinite(apart)) continue;
            sum += apart * apart;
            ++count;
        }
    }
    return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

} // namespace

struct DistanceFrom::State {
    double scale = 1;
    std::vector<glm::dvec3> points;
    std::unique_ptr<Surface> surface;
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
}

DistanceFrom::~DistanceFrom() = default;

SurfaceDistance DistanceFrom::to(std::span<const std::uint32_t> triangles) const {
    if (!state_->surface || triangles.empty()) return {};
    const Surface other(state_->points, triangles);
    const auto [greatest, reached] = Greatest(*state_->surface, other).find();
    return {.greatest = state_->scale * greatest,
            .reached = state_->scale * reached,
            .rms = state_->scale * rootMeanSquare(*state_->surface, other)};
}

SurfaceDistance distance(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to) {
    return DistanceFrom(positions, from).to(to);
}

} // namespace tegument::prep
