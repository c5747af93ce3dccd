#pragma once
// The two spaces in which strands are placed, cut into cells no smaller than the distance that is asked about: whatever lies nearer than
// that is in the cell of the point or in one beside it.

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tegument {

/// A rectangle of width x height whose opposite sides are one, so that the texture repeats without a seam. Lengths in texels.
class TorusSpace {
public:
    TorusSpace(double width, double height) : size_(width, height) {}

    /// Two numbers in [0, 1) to a point, evenly by area.
    [[nodiscard]] glm::dvec3 point(const glm::dvec2& uniform) const { return {uniform * size_, 0.0}; }
    [[nodiscard]] double distance(const glm::dvec3& a, const glm::dvec3& b) const;
    [[nodiscard]] double area() const { return size_.x * size_.y; }

    void divide(double reach);
    [[nodiscard]] std::size_t cellCount() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
    [[nodiscard]] std::size_t cellOf(const glm::dvec3& point) const;
    /// Fills `cells` with the cells around a point, each once, and returns how many.
    int cellsAround(const glm::dvec3& point, std::vector<std::size_t>& cells) const;

private:
    glm::dvec2 size_;
    int columns_ = 1;
    int rows_ = 1;
};

/// The unit sphere; lengths are angles in radians. Cells are parts of bands of equal latitude.
class SphereSpace {
public:
    [[nodiscard]] glm::dvec3 point(const glm::dvec2& uniform) const;
    [[nodiscard]] double distance(const glm::dvec3& a, const glm::dvec3& b) const;
    [[nodiscard]] double area() const;

    void divide(double reach);
    [[nodiscard]] std::size_t cellCount() const { return cellCount_; }
    [[nodiscard]] std::size_t cellOf(const glm::dvec3& point) const;
    int cellsAround(const glm::dvec3& point, std::vector<std::size_t>& cells) const;

private:
    struct Band {
        std::size_t first = 0;
        int cells = 1;
    };
    [[nodiscard]] int bandOf(const glm::dvec3& point) const;

    std::vector<Band> bands_{Band{}};
    std::size_t cellCount_ = 1;
};

/// Points of a space by cell.
template <class Space>
class RootGrid {
public:
    /// `reach`: the largest distance that `visit` is asked about, in the space's lengths. Cells are larger where `points` are few, so that
    /// there are never many more cells than points.
    RootGrid(Space space, double reach, std::size_t points) : space_(std::move(space)) {
        space_.divide(std::max(reach, std::sqrt(space_.area() / static_cast<double>(std::max<std::size_t>(points, 1)))));
        cells_.resize(space_.cellCount());
    }

    [[nodiscard]] const Space& space() const { return space_; }

    void add(const glm::dvec3& point, std::uint32_t index) { cells_[space_.cellOf(point)].push_back({point, index}); }

    /// Calls visit(index, distance) for every point in the cells around `point`.
    template <class Visit>
    void visit(const glm::dvec3& point, Visit&& visit) const {
        thread_local std::vector<std::size_t> around;
        const int count = space_.cellsAround(point, around);
        for (int i = 0; i < count; ++i)
            for (const Entry& entry : cells_[around[static_cast<std::size_t>(i)]])
                visit(entry.index, space_.distance(point, entry.point));
    }

private:
    struct Entry {
        glm::dvec3 point;
        std::uint32_t index;
    };
    Space space_;
    std::vector<std::vector<Entry>> cells_;
};

} // namespace tegument
