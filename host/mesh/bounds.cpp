// Bounding box and minimal bounding sphere.
//
// The sphere is found as an LP-type problem (Matousek, Sharir, Welzl: A subexponential bound for linear programming, 1996): keep the at
// most four points that define the current sphere, add the point farthest outside it, and take the smallest sphere over subsets of these
// five that holds all five. The radius grows strictly with every exchange, so the loop ends; real meshes need about ten exchanges, each one
// pass over the points. Work is done in double precision on positions scaled to the unit box, so that meshes of size 1e-40 and 1e20 neither
// vanish nor overflow.

#include "host/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tegument {

namespace {

struct Sphere {
    glm::dvec3 centre{0};
    double radius = -1; // holds nothing
};

/// Slack for "holds": far below the float precision of the input.
constexpr double kSlack = 1e-10;

bool holds(const Sphere& sphere, const glm::dvec3& point) {
    return glm::distance(sphere.centre, point) <= sphere.radius * (1 + kSlack) + 1e-15;
}

/// The smallest sphere through all of one to four points; nothing if they are affinely dependent.
std::optional<Sphere> sphereThrough(std::span<const glm::dvec3> points) {
    // Centre = p0 + sum of x_i * e_i with e_i = p_i - p0; |centre - p_i| = |centre - p0| gives the linear system 2 e_i . e_j x_j = e_i .
    // e_i.
    const std::size_t n = points.size() - 1;
    std::array<glm::dvec3, 3> edges{};
    std::array<std::array<double, 4>, 3> rows{};
    for (std::size_t i = 0; i < n; ++i)
        edges[i] = points[i + 1] - points[0];
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            rows[i][j] = 2 * glm::dot(edges[i], edges[j]);
        rows[i][3] = glm::dot(edges[i], edges[i]);
    }
    for (std::size_t column = 0; column < n; ++column) { // Gauss-Jordan with row pivoting
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < n; ++row)
            if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
        if (std::abs(rows[pivot][column]) < 1e-14) return std::nullopt;
        std::swap(rows[pivot], rows[column]);
        for (std::size_t row = 0; row < n; ++row) {
            if (row == column) continue;
            const double factor = rows[row][column] / rows[column][column];
            for (std::size_t k = column; k < 4; ++k)
                rows[row][k] -= factor * rows[column][k];
        }
    }
    glm::dvec3 offset(0);
    for (std::size_t i = 0; i < n; ++i)
        offset += rows[i][3] / rows[i][i] * edges[i];
    return Sphere{points[0] + offset, glm::length(offset)};
}

struct Basis {
    std::array<glm::dvec3, 5> points{};
    std::size_t count = 0;
    Sphere sphere;
};

/// The smallest sphere over the subsets of `points` that holds all of them, with the subset that defines it.
Basis smallestBasis(std::span<const glm::dvec3> points) {
    Basis best;
    best.sphere.radius = std::numeric_limits<double>::infinity();
    for (unsigned mask = 1; mask < 1u << points.size(); ++mask) {
        Basis candidate;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (mask >> i & 1u) candidate.points[candidate.count++] = points[i];
        if (candidate.count > 4) continue;
        const auto sphere = sphereThrough({candidate.points.data(), candidate.count});
        if (!sphere || sphere->radius >= best.sphere.radius) continue;
        candidate.sphere = *sphere;
        if (std::ranges::all_of(points, [&](const glm::dvec3& point) { return holds(*sphere, point); })) best = candidate;
    }
    return best;
}

std::size_t farthest(std::span<const glm::dvec3> points, const glm::dvec3& from) {
    std::size_t found = 0;
    double longest = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 difference = points[i] - from;
        if (const double squared = glm::dot(difference, difference); squared > longest) {
            longest = squared;
            found = i;
        }
    }
    return found;
}

/// `points` lie in the unit box.
Sphere smallestSphere(std::span<const glm::dvec3> points) {
    Basis basis;
    basis.points[0] = points[0];
    basis.count = 1;
    basis.sphere = {points[0], 0};
    constexpr int kMaxExchanges = 1000; // only rounding could loop; the result then still holds everything (see computeBounds)
    for (int exchange = 0; exchange < kMaxExchanges; ++exchange) {
        const glm::dvec3& outermost = points[farthest(points, basis.sphere.centre)];
        if (holds(basis.sphere, outermost)) break;
        basis.points[basis.count++] = outermost;
        const Basis next = smallestBasis({basis.points.data(), basis.count});
        if (next.count == 0 || next.sphere.radius <= basis.sphere.radius) break;
        basis = next;
    }
    return basis.sphere;
}

} // namespace

void computeBounds(Mesh& mesh) {
    mesh.bounds = {};
    if (mesh.positions.empty()) return;
    Bounds& bounds = mesh.bounds;
    bounds.minimum = bounds.maximum = mesh.positions.front();
    for (const glm::vec3& position : mesh.positions) {
        bounds.minimum = glm::min(bounds.minimum, position);
        bounds.maximum = glm::max(bounds.maximum, position);
    }
    const glm::dvec3 origin(bounds.minimum);
    const glm::dvec3 size = glm::dvec3(bounds.maximum) - origin;
    const double scale = std::max({size.x, size.y, size.z});
    bounds.centre = bounds.minimum;
    if (scale == 0) return;

    std::vector<glm::dvec3> points;
    points.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
        points.push_back((glm::dvec3(position) - origin) / scale);
    bounds.centre = glm::vec3(origin + scale * smallestSphere(points).centre);

    // The centre was rounded to float: the radius is measured from where it now is, and rounded up.
    double radius = 0;
    for (const glm::vec3& position : mesh.positions)
        radius = std::max(radius, glm::distance(glm::dvec3(position), glm::dvec3(bounds.centre)));
    bounds.radius = std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::max());
}

} // namespace tegument
