#include "meshprep/prepare/cover.h"

#include "host/support/parallel.h"

#include <algorithm>

namespace tegument::prep {

namespace {

/// Sides that pass a corner of the triangle, where the surface has a vertex, are left out; rounding is a thousandth of this.
constexpr double kShrunk = 1e-8;

/// A place as the triangle sees it: the shares of its second and third corner there, and how high above its plane.
struct Seen {
    double u = 0;
    double v = 0;
    double height = 0;
};

/// Of each corner, less what it is at least in the shrunk triangle.
using Shares = std::array<double, 3>;

Shares sharesOf(const Seen& place) {
    return {1 - place.u - place.v - kShrunk, place.u - kShrunk, place.v - kShrunk};
}

/// A bit for each that is not reached.
unsigned outside(const Shares& shares) {
    return static_cast<unsigned>(shares[0] < 0) | static_cast<unsigned>(shares[1] < 0) << 1u | static_cast<unsigned>(shares[2] < 0) << 2u;
}

Seen mix(const Seen& a, const Seen& b, double t) {
    return {.u = glm::mix(a.u, b.u, t), .v = glm::mix(a.v, b.v, t), .height = glm::mix(a.height, b.height, t)};
}

/// Twice the area of a, b and c, negative when they turn the other way.
double turn(const Seen& a, const Seen& b, const Seen& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Of each side of a triangle, how a point is turned against it.
std::array<double, 3> turnsAt(const std::array<Seen, 3>& corners, const Seen& point) {
    return {turn(corners[0], corners[1], point), turn(corners[1], corners[2], point), turn(corners[2], corners[0], point)};
}

enum class Where { Inside, Outside, Unknown };

/// Whether a triangle hides the point.
Where whereBy(const std::array<double, 3>& turns) {
    constexpr double kRounding = 1e-12;
    const double least = std::min({turns[0], turns[1], turns[2]});
    const double most = std::max({turns[0], turns[1], turns[2]});
    if (least > kRounding || most < -kRounding) return Where::Inside;
    return least < -kRounding && most > kRounding ? Where::Outside : Where::Unknown;
}

/// The side that is between the triangle and the point.
std::size_t sideTowards(const std::array<double, 3>& turns) {
    const double sign = turns[0] + turns[1] + turns[2] < 0 ? -1 : 1;
    return static_cast<std::size_t>(std::ranges::min_element(turns, {}, [&](double turned) { return sign * turned; }) - turns.begin());
}

constexpr Seen kMiddle{.u = 0.3271, .v = 0.3413, .height = 0}; // on no side of a regular pattern
constexpr std::array kCorners = {Seen{.u = kShrunk, .v = kShrunk, .height = 0}, Seen{.u = 1 - 2 * kShrunk, .v = kShrunk, .height = 0},
                                 Seen{.u = kShrunk, .v = 1 - 2 * kShrunk, .height = 0}};

/// The piece of a side within the shrunk triangle.
struct Inside {
    double first = 0;
    double last = 1;

    [[nodiscard]] bool any() const { return first <= last; }
};

Inside insideOf(const Shares& a, const Shares& b) {
    const unsigned outA = outside(a);
    const unsigned outB = outside(b);
    if ((outA & outB) != 0) return {.first = 1, .last = 0};
    Inside piece;
    for (std::size_t i = 0; (outA | outB) >> i != 0; ++i) {
        if ((outA >> i & 1u) != 0) piece.first = std::max(piece.first, a[i] / (a[i] - b[i]));
        if ((outB >> i & 1u) != 0) piece.last = std::min(piece.last, a[i] / (a[i] - b[i]));
    }
    return piece;
}

} // namespace

/// One triangle of the surface as the other one sees it.
class Cover::View {
public:
    View() = default;
    explicit View(const std::array<Seen, 3>& corners) : corners_(corners) {
        const std::array<Shares, 3> shares = {sharesOf(corners[0]), sharesOf(corners[1]), sharesOf(corners[2])};
        for (std::size_t side = 0; side < 3; ++side)
            inside_[side] = insideOf(shares[side], shares[(side + 1) % 3]);
    }

    [[nodiscard]] bool meets(std::size_t side) const { return inside_[side].any(); }

    /// Whether it hides a point.
    [[nodiscard]] Where where(const Seen& point) const { return whereBy(turnsAt(corners_, point)); }

    /// No further than `most` over what both have in common.
    [[nodiscard]] bool within(double most) const {
        const auto low = [&](const Seen& place) { return std::abs(place.height) <= most; };
        if (std::ranges::all_of(corners_, low)) return true;
        for (std::size_t side = 0; side < 3; ++side) {
            const Seen& from = corners_[side];
            const Seen& to = corners_[(side + 1) % 3];
            if (meets(side) && !(low(mix(from, to, inside_[side].first)) && low(mix(from, to, inside_[side].last)))) return false;
        }
        return std::ranges::all_of(kCorners, [&](const Seen& corner) { return where(corner) == Where::Outside || low(over(corner)); });
    }

private:
    [[nodiscard]] Seen over(const Seen& point) const {
        const std::array<double, 3> turns = turnsAt(corners_, point);
        const double sum = turns[0] + turns[1] + turns[2];
        return {.u = point.u,
                .v = point.v,
                .height = (turns[1] * corners_[0].height + turns[2] * corners_[1].height + turns[0] * corners_[2].height) / sum};
    }

    std::array<Seen, 3> corners_;
    std::array<Inside, 3> inside_;
};

/// What lies over one triangle.
class Cover::Sheet {
public:
    Sheet(const Cover& cover, const std::array<glm::dvec3, 3>& triangle, double most) : cover_(cover), at_(triangle[0]) {
        const glm::dvec3 a = triangle[1] - at_;
        const glm::dvec3 b = triangle[2] - at_;
        const glm::dvec3 normal = glm::cross(a, b);
        const double squared = glm::dot(normal, normal);
        const double longest = std::sqrt(std::max(glm::dot(a, a), glm::dot(b, b)));
        constexpr double kLeastSine = 1e-4; // below, rounding counts
        seen_ = squared > kLeastSine * kLeastSine * glm::dot(a, a) * glm::dot(b, b);
        u_ = glm::cross(b, normal) / squared;
        v_ = glm::cross(normal, a) / squared;
        up_ = normal / std::sqrt(squared);
        most_ = most - 4 * kShrunk * longest; // no point is further from the shrunk triangle
    }

    /// Whether a sheet of the surface hides the triangle and is near enough. The sheet grows across all sides that pass over the triangle.
    /// So none of its borders does, and the number of its triangles over a point is odd at all points or even at all.
    [[nodiscard]] bool covers(std::uint32_t& near) {
        if (!seen_ || !(most_ > 0)) return false;
        if (!reachMiddle(near)) return false;
        bool odd = false;
        triangles_[count_++] = near;
        for (std::size_t i = 0; i < count_; ++i) {
            const View view(seenOf(triangles_[i]));
            const Where middle = view.where(kMiddle);
            if (middle == Where::Unknown || !view.within(most_)) return false;
            odd = odd != (middle == Where::Inside);
            for (std::size_t side = 0; side < 3; ++side)
                if (view.meets(side) && !enter(cover_.neighbour(triangles_[i], side))) return false;
        }
        return odd;
    }

private:
    [[nodiscard]] std::array<Seen, 3> seenOf(std::uint32_t triangle) const {
        std::array<Seen, 3> seen;
        const std::array<glm::dvec3, 3> corners = cover_.surface_.triangle(triangle);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 apart = corners[i] - at_;
            seen[i] = {.u = glm::dot(apart, u_), .v = glm::dot(apart, v_), .height = glm::dot(apart, up_)};
        }
        return seen;
    }

    /// From neighbour to neighbour to one over the middle.
    [[nodiscard]] bool reachMiddle(std::uint32_t& near) const {
        constexpr unsigned kMostSteps = 32;
        std::uint32_t triangle = near;
        for (unsigned step = 0; step < kMostSteps && triangle != kNoHint; ++step) {
            const std::array<Seen, 3> corners = seenOf(triangle);
            const std::array<double, 3> turns = turnsAt(corners, kMiddle);
            if (whereBy(turns) == Where::Inside) {
                near = triangle;
                return true;
            }
            triangle = cover_.neighbour(triangle, sideTowards(turns));
        }
        return false;
    }

    /// False: there is none, or no room.
    [[nodiscard]] bool enter(std::uint32_t triangle) {
        if (triangle == kNoHint) return false;
        std::uint32_t known = 0; // no early end: the processor compares several at once
        for (std::size_t i = 0; i < count_; ++i)
            known |= static_cast<std::uint32_t>(triangles_[i] == triangle);
        if (known != 0) return true;
        if (count_ == triangles_.size()) return false;
        triangles_[count_++] = triangle;
        return true;
    }

    const Cover& cover_;
    glm::dvec3 at_;
    glm::dvec3 u_{}, v_{}, up_{};
    double most_ = 0;
    bool seen_ = false;
    std::array<std::uint32_t, 256> triangles_;
    std::size_t count_ = 0;
};

Cover::Cover(const NearSurface& surface) : surface_(surface), neighbours_(surface.corners().size(), kNoHint) {
    const std::span<const std::uint32_t> corners = surface.corners();
    std::vector<std::uint32_t> first(surface.points().size() + 1);
    for (const std::uint32_t corner : corners)
        ++first[corner];
    std::uint32_t sum = 0;
    for (std::uint32_t& behind : first)
        behind = sum += behind;
    std::vector<std::uint32_t> around(corners.size());
    for (std::size_t i = corners.size(); i-- > 0;)
        around[--first[corners[i]]] = static_cast<std::uint32_t>(i / 3);
    inChunks(surface.size(), 0, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t side = 3 * begin; side < 3 * end; ++side) {
            const std::uint32_t from = corners[side];
            const std::uint32_t to = corners[side - side % 3 + (side + 1) % 3];
            unsigned others = 0;
            for (std::uint32_t i = first[from]; i < first[from + 1]; ++i) {
                const auto other = corners.subspan(3 * std::size_t{around[i]}, 3);
                if (around[i] == side / 3 || (other[0] != to && other[1] != to && other[2] != to)) continue;
                neighbours_[side] = around[i];
                ++others;
            }
            if (others != 1) neighbours_[side] = kNoHint;
        }
    });
}

bool Cover::within(const std::array<glm::dvec3, 3>& triangle, std::uint32_t& near, double most) const {
    return Sheet(*this, triangle, most).covers(near);
}

} // namespace tegument::prep
