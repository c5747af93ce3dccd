// The Hausdorff distance by branch and bound: no point of a triangle is further away than its farthest corner and the distance to that
// corner. Triangles that cannot hold the greatest distance are never looked into, others are cut in four. Nearest points come from a tree
// of boxes in single precision, so the surfaces are brought to unit size around the origin first.

#include "meshprep/prepare/distance.h"

#include "host/support/rays/surface_tree.h"
#include "meshprep/prepare/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
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

    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
    [[nodiscard]] std::span<const std::uint32_t> corners() const { return triangles_; }
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

/// Every point of a triangle is at most this far from one of its corners: a disc of that radius holds the triangle (Jung's theorem), and
/// the corners' squared distances from the point, weighted as the point is, are at most its square.
double reachOf(const Triangle& t) {
    const double longest = std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    return longest / std::sqrt(3.0);
}

/// A triangle, or a piece of one, whose corners' distances from the other surface are known.
struct Piece {
    double bound = 0; // no point of it is further from the other surface
    bool second = false;
    Triangle corners{};
    std::array<double, 3> apart{};
    std::uint32_t hint = kNoHint; // a triangle of the other surface near it

    bool operator<(const Piece& other) const { return bound < other.bound; }
};

class Greatest {
public:
    Greatest(const Surface& a, const Surface& b) : a_(a), b_(b) {}

    /// The bound, and what was reached. What cannot be 2 % further than that is left alone.
    std::pair<double, double> find() {
        for (const bool second : {false, true})
            measureCorners(second);
        for (const bool second : {false, true})
            queueTriangles(second);
        std::ranges::sort(whole_, std::greater<>(), &Whole::bound);
        // so that the time stays linear; what is left then is bounded as it is
        const std::size_t most = std::max(kLeastEvaluations, (a_.size() + b_.size()) * 3 / 4);
        std::size_t next = 0;
        double bound = 0;
        while (true) {
            const double ofWhole = next < whole_.size() ? whole_[next].bound : 0;
            const double ofPiece = pieces_.empty() ? 0 : pieces_.top().bound;
            bound = std::max(ofWhole, ofPiece);
            if (bound <= std::max(reached_ * kClose, kRounding) || evaluations_ >= most) break;
            if (ofWhole >= ofPiece) {
                split(pieceOf(whole_[next++]));
            } else {
                const Piece piece = pieces_.top();
                pieces_.pop();
                split(piece);
            }
        }
        return {std::max(bound, reached_ * kClose) + kRounding, reached_};
    }

private:
    static constexpr double kClose = 1.02;    // the bound need not be nearer to the truth
    static constexpr double kRounding = 1e-6; // of the tree's floats, the surface being of unit size
    static constexpr std::size_t kLeastEvaluations = 10'000;

    struct Whole {
        double bound = 0;
        std::uint32_t triangle = 0;
        bool second = false;
    };

    [[nodiscard]] const Surface& own(bool second) const { return second ? b_ : a_; }
    [[nodiscard]] const Surface& other(bool second) const { return second ? a_ : b_; }

    /// Corners that both surfaces have lie on both.
    void measureCorners(bool second) {
        std::vector<double>& apart = apart_[second ? 1 : 0];
        apart.assign(a_.points().size(), -1);
        for (const std::uint32_t corner : other(second).corners())
            apart[corner] = 0;
        std::uint32_t hint = kNoHint;
        for (const std::uint32_t corner : own(second).corners()) {
            if (apart[corner] >= 0) continue;
            const Nearest near = other(second).nearest(a_.points()[corner], hint);
            apart[corner] = std::isfinite(near.distance) ? near.distance : 0; // all of the other surface is without area
            hint = std::isfinite(near.distance) ? near.triangle : kNoHint;
            reached_ = std::max(reached_, apart[corner]);
        }
    }

    [[nodiscard]] std::array<double, 3> apartOf(bool second, std::size_t triangle) const {
        const auto t = own(second).corners().subspan(3 * triangle, 3);
        const std::vector<double>& apart = apart_[second ? 1 : 0];
        return {apart[t[0]], apart[t[1]], apart[t[2]]};
    }

    void queueTriangles(bool second) {
        for (std::size_t i = 0; i < own(second).size(); ++i) {
            const double bound = std::ranges::max(apartOf(second, i)) + reachOf(own(second).triangle(i));
            if (bound > std::max(reached_ * kClose, kRounding))
                whole_.push_back({.bound = bound, .triangle = static_cast<std::uint32_t>(i), .second = second});
        }
    }

    [[nodiscard]] Piece pieceOf(const Whole& whole) const {
        return {.bound = whole.bound,
                .second = whole.second,
                .corners = own(whole.second).triangle(whole.triangle),
                .apart = apartOf(whole.second, whole.triangle)};
    }

    /// Into four, by the middles of the sides.
    void split(const Piece& piece) {
        const Triangle& t = piece.corners;
        const Triangle middles = {(t[0] + t[1]) / 2.0, (t[1] + t[2]) / 2.0, (t[2] + t[0]) / 2.0};
        std::array<double, 3> apart{};
        std::uint32_t hint = piece.hint;
        for (std::size_t i = 0; i < 3; ++i) {
            const Nearest near = other(piece.second).nearest(middles[i], hint);
            ++evaluations_;
            if (!std::isfinite(near.distance)) return;
            apart[i] = near.distance;
            hint = near.triangle;
            reached_ = std::max(reached_, near.distance);
        }
        const auto& d = piece.apart;
        queue({.second = piece.second, .corners = {t[0], middles[0], middles[2]}, .apart = {d[0], apart[0], apart[2]}, .hint = hint});
        queue({.second = piece.second, .corners = {middles[0], t[1], middles[1]}, .apart = {apart[0], d[1], apart[1]}, .hint = hint});
        queue({.second = piece.second, .corners = {middles[2], middles[1], t[2]}, .apart = {apart[2], apart[1], d[2]}, .hint = hint});
        queue({.second = piece.second, .corners = middles, .apart = apart, .hint = hint});
    }

    void queue(Piece piece) {
        const double close = std::max(reached_ * kClose, kRounding);
        piece.bound = std::ranges::max(piece.apart) + reachOf(piece.corners);
        if (piece.bound <= close) return;
        double fromOne = 0; // the distance from one triangle is greatest at a corner
        for (const glm::dvec3& corner : piece.corners) {
            const double apart = other(piece.second).distanceTo(piece.hint, corner);
            fromOne = apart >= fromOne ? apart : std::isnan(apart) ? std::numeric_limits<double>::infinity() : fromOne;
        }
        if (fromOne < piece.bound) piece.bound = fromOne;
        if (piece.bound > close) pieces_.push(piece);
    }

    const Surface& a_;
    const Surface& b_;
    std::array<std::vector<double>, 2> apart_; // of each point, from the other surface
    std::vector<Whole> whole_;
    std::priority_queue<Piece> pieces_;
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
