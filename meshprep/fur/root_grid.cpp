#include "meshprep/fur/root_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

using std::numbers::pi;

constexpr int kMostDivisions = 4096; // along one direction: a tiny reach must not ask for more cells than there can be strands

int divisions(double length, double reach) {
    return static_cast<int>(std::clamp(std::floor(length / reach), 1.0, static_cast<double>(kMostDivisions)));
}

/// The neighbours of `index` among `count` on a ring, each once.
template <class Visit>
void onRing(int index, int count, Visit&& visit) {
    if (count <= 3) {
        for (int i = 0; i < count; ++i)
            visit(i);
        return;
    }
    for (int step = -1; step <= 1; ++step)
        visit((index + step + count) % count);
}

double around(const glm::dvec3& point) { // longitude as a share of the full turn
    const double turn = std::atan2(point.y, point.x) / (2 * pi);
    return turn < 0 ? turn + 1 : turn;
}

} // namespace

double TorusSpace::distance(const glm::dvec3& a, const glm::dvec3& b) const {
    glm::dvec2 gap = glm::abs(glm::dvec2(a) - glm::dvec2(b));
    gap = glm::min(gap, size_ - gap);
    return glm::length(gap);
}

void TorusSpace::divide(double reach) {
    columns_ = divisions(size_.x, reach);
    rows_ = divisions(size_.y, reach);
}

std::size_t TorusSpace::cellOf(const glm::dvec3& point) const {
    const int column = std::clamp(static_cast<int>(point.x / size_.x * columns_), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(point.y / size_.y * rows_), 0, rows_ - 1);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
}

int TorusSpace::cellsAround(const glm::dvec3& point, std::vector<std::size_t>& cells) const {
    cells.clear();
    const std::size_t own = cellOf(point);
    const auto wide = static_cast<std::size_t>(columns_);
    onRing(static_cast<int>(own / wide), rows_, [&](int row) {
        onRing(static_cast<int>(own % wide), columns_,
               [&](int column) { cells.push_back(static_cast<std::size_t>(row) * wide + static_cast<std::size_t>(column)); });
    });
    return static_cast<int>(cells.size());
}

glm::dvec3 SphereSpace::point(const glm::dvec2& uniform) const {
    const double z = 1 - 2 * uniform.x; // Archimedes: equal heights are equal areas
    const double ring = std::sqrt(std::max(0.0, 1 - z * z));
    return {ring * std::cos(2 * pi * uniform.y), ring * std::sin(2 * pi * uniform.y), z};
}

double SphereSpace::distance(const glm::dvec3& a, const glm::dvec3& b) const {
    return 2 * std::asin(std::min(1.0, glm::length(a - b) / 2)); // acos of the product loses half the digits of a small angle
}

double SphereSpace::area() const {
    return 4 * pi;
}

void SphereSpace::divide(double reach) {
    const int count = divisions(pi, reach);
    bands_.assign(static_cast<std::size_t>(count), Band{});
    cellCount_ = 0;
    for (int i = 0; i < count; ++i) {
        // Two points of this band and of those beside it, no nearer to a pole than the sine s says and not further apart than the reach
        // r, differ in longitude by at most 2 asin(r / (2 s)) <= pi r / (2 s): a cell must be that wide.
        const double s = std::min(std::sin(pi * std::max(0, i - 1) / count), std::sin(pi * std::min(count, i + 2) / count));
        Band& band = bands_[static_cast<std::size_t>(i)];
        band.first = cellCount_;
        band.cells = divisions(4 * std::max(s, 0.0), reach);
        cellCount_ += static_cast<std::size_t>(band.cells);
    }
}

int SphereSpace::bandOf(const glm::dvec3& point) const {
    const int count = static_cast<int>(bands_.size());
    return std::clamp(static_cast<int>(std::acos(std::clamp(point.z, -1.0, 1.0)) / pi * count), 0, count - 1);
}

std::size_t SphereSpace::cellOf(const glm::dvec3& point) const {
    const Band& band = bands_[static_cast<std::size_t>(bandOf(point))];
    return band.first + static_cast<std::size_t>(std::clamp(static_cast<int>(around(point) * band.cells), 0, band.cells - 1));
}

int SphereSpace::cellsAround(const glm::dvec3& point, std::vector<std::size_t>& cells) const {
    cells.clear();
    const int own = bandOf(point);
    const int last = static_cast<int>(bands_.size()) - 1;
    for (int i = std::max(0, own - 1); i <= std::min(last, own + 1); ++i) {
        const Band& band = bands_[static_cast<std::size_t>(i)];
        onRing(std::clamp(static_cast<int>(around(point) * band.cells), 0, band.cells - 1), band.cells,
               [&](int cell) { cells.push_back(band.first + static_cast<std::size_t>(cell)); });
    }
    return static_cast<int>(cells.size());
}

} // namespace tegument
