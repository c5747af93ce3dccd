#include "meshprep/fur/roots/limits.h"

#include "host/support/parallel.h"
#include "host/support/rays/surface_tree.h"
#include "meshprep/fur/roots/point_grid.h"

#include <cmath>
#include <limits>

namespace tegument {

namespace {

constexpr float kFarthest = 2; // no strand is longer than the ball's radius: what is further away than twice that limits none

/// One short ray a root does not repay a better tree.
SurfaceTree treeOf(const FurSurface& surface, unsigned threads) {
    return {surface.positions(), surface.mesh().indices, {.quick = true, .threads = threads}};
}

/// Along the normal to the next surface, infinite where there is none. `start` lies beyond the rounding of the root's own triangle.
float opposite(const SurfaceTree& tree, const SurfacePoint& root, float start) {
    const auto hit = tree.nearest(root.position, root.normal, {.first = start, .last = kFarthest});
    return hit ? hit->distance : std::numeric_limits<float>::infinity();
}

/// Two directions that are perpendicular to a unit vector and each other (T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT
/// 6(1), 2017).
std::pair<glm::vec3, glm::vec3> tangents(const glm::vec3& n) {
    const float sign = std::copysign(1.0F, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// The linear map M from steps on the tangent plane to changes of the normal that fits all neighbours best; the concave curvature is minus
/// its least eigenvalue.
class NormalFit {
public:
    void add(const glm::vec2& step, const glm::vec2& change) {
        steps_ += glm::outerProduct(step, step);
        changes_ += glm::outerProduct(change, step);
        ++count_;
    }

    [[nodiscard]] float concaveCurvature() const {
        const float determinant = glm::determinant(steps_);
        const float trace = steps_[0][0] + steps_[1][1];
        if (count_ < 3 || !(determinant > 1e-3F * trace * trace)) return 0; // all in one line: no plane to fit
        const glm::mat2 m = changes_ * glm::inverse(steps_);
        const float mean = (m[0][0] + m[1][1]) / 2;
        const float half = (m[0][0] - m[1][1]) / 2;
        const float shear = (m[0][1] + m[1][0]) / 2;
        return std::max(0.0F, std::sqrt(half * half + shear * shear) - mean);
    }

private:
    glm::mat2 steps_{0};
    glm::mat2 changes_{0};
    int count_ = 0;
};

float curvatureAt(const PointGrid& grid, const SurfacePoint& root, float reach) {
    const std::pair<glm::vec3, glm::vec3> frame = tangents(root.normal);
    const auto onPlane = [&](const glm::vec3& d) { return glm::vec2(glm::dot(d, frame.first), glm::dot(d, frame.second)); };
    NormalFit fit;
    grid.visit(root.position, reach, [&](std::uint32_t i, float) {
        const PointGrid::Entry& other = grid.entries()[i];
        const glm::vec3 step = other.position - root.position;
        const glm::vec3 change = other.normal - root.normal;
        if (glm::dot(other.normal, root.normal) > 0) fit.add(onPlane(step), onPlane(change));
        return true;
    });
    return fit.concaveCurvature();
}

} // namespace

std::vector<LengthLimits> lengthLimits(const FurSurface& surface, const std::vector<SurfacePoint>& roots, float reach, unsigned threads) {
    PointGrid grid(reach, roots.size());
    for (const SurfacePoint& root : roots)
        grid.add(root.position, root.normal, 0);
    const SurfaceTree tree = treeOf(surface, threads);
    std::vector<LengthLimits> limits(roots.size());
    const float start = 1e-3F * reach;
    inChunks(roots.size(), threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            limits[i] = {.curvature = curvatureAt(grid, roots[i], reach), .opposite = opposite(tree, roots[i], start)};
    });
    return limits;
}

} // namespace tegument
