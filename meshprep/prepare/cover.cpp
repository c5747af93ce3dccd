#include "meshprep/prepare/cover.h"

namespace tegument::prep {

/// Convex.
struct Cover::Polygon {
    static constexpr std::size_t kMost = 12;

    std::array<glm::dvec3, kMost> corners;
    std::size_t count = 0;

    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

/// By a plane.
class Cover::Cut {
public:
    Cut(const Polygon& polygon, const glm::dvec3& at, const glm::dvec3& inwards) : polygon_(polygon) {
        for (std::size_t i = 0; i < polygon.count; ++i) {
            height_[i] = glm::dot(polygon.corners[i] - at, inwards);
            anyOut_ = anyOut_ || height_[i] < 0;
        }
    }

    [[nodiscard]] bool anyOut() const { return anyOut_; }

    /// False: too many corners.
    [[nodiscard]] bool make(Polygon& inside, Polygon& outside) const {
        if (polygon_.count + 2 > Polygon::kMost) return false;
        for (std::size_t i = 0; i < polygon_.count; ++i) {
            const std::size_t next = (i + 1) % polygon_.count;
            (height_[i] < 0 ? outside : inside).add(polygon_.corners[i]);
            if ((height_[i] < 0) == (height_[next] < 0)) continue;
            const glm::dvec3 between = glm::mix(polygon_.corners[i], polygon_.corners[next], height_[i] / (height_[i] - height_[next]));
            inside.add(between);
            outside.add(between);
        }
        return true;
    }

private:
    const Polygon& polygon_;
    std::array<double, Polygon::kMost> height_; // of its corners
    bool anyOut_ = false;
};

class Cover::Walk {
public:
    Walk(const Cover& cover, double most) : cover_(cover), surface_(cover.surface_), most_(most) {}

    /// Whether `polygon` is near enough to the triangle `over`, its neighbours, theirs, and so on but for `from`.
    [[nodiscard]] bool near(const Polygon& polygon, std::uint32_t over, std::uint32_t from) {
        if (steps_-- == 0) return false;
        const std::array<glm::dvec3, 3> t = surface_.triangle(over);
        if (mayBeNear(t, polygon) && nearTo(over, polygon)) return true;
        const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
        const Polygon* rest = &polygon;
        std::array<Polygon, 3> inside;
        bool within = true; // all three sides
        for (std::size_t side = 0; side < 3; ++side) {
            const Cut cut(*rest, t[side], glm::cross(normal, t[(side + 1) % 3] - t[side]));
            if (!cut.anyOut()) continue;
            const std::uint32_t next = cover_.neighbour(over, side);
            within = within && next != from;
            if (next == from) continue; // a fold's wedge is on neither side
            Polygon outside;
            if (next == kNoHint || !cut.make(inside[side], outside) || !near(outside, next, over)) return false;
            if (inside[side].count == 0) return true;
            rest = &inside[side];
        }
        return within ? nearPlane(t[0], normal, *rest) : nearTo(over, *rest);
    }

private:
    template <class Is>
    [[nodiscard]] static bool allCorners(const Polygon& polygon, Is is) {
        return std::all_of(polygon.corners.begin(), polygon.corners.begin() + static_cast<std::ptrdiff_t>(polygon.count), is);
    }

    /// False spares most questions.
    [[nodiscard]] bool mayBeNear(const std::array<glm::dvec3, 3>& t, const Polygon& polygon) const {
        const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
        const double size = std::sqrt(std::max(squared(t[1] - t[0]), squared(t[2] - t[0])));
        return allCorners(polygon, [&](const glm::dvec3& corner) { return squared(corner - t[0]) <= (size + most_) * (size + most_); });
    }

    [[nodiscard]] bool nearTo(std::uint32_t triangle, const Polygon& polygon) const {
        return allCorners(polygon, [&](const glm::dvec3& corner) { return surface_.distanceTo(triangle, corner) <= most_; });
    }

    /// For what lies over the triangle.
    [[nodiscard]] bool nearPlane(const glm::dvec3& at, const glm::dvec3& normal, const Polygon& polygon) const {
        const double most = most_ * glm::length(normal);
        return allCorners(polygon, [&](const glm::dvec3& corner) { return std::abs(glm::dot(corner - at, normal)) <= most; });
    }

    const Cover& cover_;
    const NearSurface& surface_;
    double most_;
    unsigned steps_ = 96;
};

Cover::Cover(const NearSurface& surface) : surface_(surface), first_(surface.points().size() + 1), faces_(surface.corners().size()) {
    for (const std::uint32_t corner : surface.corners())
        ++first_[corner];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_)
        first = sum += first; // behind its faces
    for (std::size_t i = faces_.size(); i-- > 0;)
        faces_[--first_[surface.corners()[i]]] = static_cast<std::uint32_t>(i / 3);
}

std::uint32_t Cover::neighbour(std::uint32_t triangle, std::size_t side) const {
    const auto corners = surface_.corners();
    const std::uint32_t from = corners[3 * std::size_t{triangle} + side];
    const std::uint32_t to = corners[3 * std::size_t{triangle} + (side + 1) % 3];
    for (std::uint32_t i = first_[from]; i < first_[from + 1]; ++i) {
        const auto other = corners.subspan(3 * std::size_t{faces_[i]}, 3);
        if (faces_[i] != triangle && (other[0] == to || other[1] == to || other[2] == to)) return faces_[i];
    }
    return kNoHint;
}

bool Cover::within(const std::array<glm::dvec3, 3>& triangle, std::uint32_t start, double most) const {
    Polygon polygon;
    for (const glm::dvec3& corner : triangle)
        polygon.add(corner);
    return Walk(*this, most).near(polygon, start, kNoHint);
}

} // namespace tegument::prep
