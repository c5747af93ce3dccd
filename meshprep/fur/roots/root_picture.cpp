#include "meshprep/fur/roots/root_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

constexpr int kViews = 3;
constexpr double kMargin = 1.05; // of the longest strand around the ball

/// A point on the picture: pixels, and how near it is.
using Shown = glm::dvec3;

class View {
public:
    View(Image& picture, int left, int side) : picture_(picture), left_(left), side_(side) {
        depth_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), -std::numeric_limits<double>::infinity());
    }

    /// `p` in -1..1: x to the right, y up, z towards the viewer.
    [[nodiscard]] Shown at(const glm::dvec3& p) const { return {(p.x + 1) / 2 * side_, (1 - p.y) / 2 * side_, p.z}; }

    void draw(const Shown& where, const glm::dvec3& colour) {
        const int x = static_cast<int>(std::floor(where.x));
        const int y = static_cast<int>(std::floor(where.y));
        if (x < 0 || y < 0 || x >= side_ || y >= side_) return;
        double& nearest = depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x)];
        if (where.z < nearest) return;
        nearest = where.z;
        for (glm::length_t c = 0; c < 3; ++c)
            picture_.at(left_ + x, y, c) = static_cast<float>(colour[c]);
    }

    void fill(const std::array<Shown, 3>& t, const glm::dvec3& colour) {
        const double area = cross(t[1] - t[0], t[2] - t[0]);
        if (area == 0) return;
        const auto low = glm::floor(glm::min(glm::min(t[0], t[1]), t[2]));
        const auto high = glm::max(glm::max(t[0], t[1]), t[2]);
        const auto clamped = [this](double d) { return static_cast<int>(std::clamp(d, 0.0, static_cast<double>(side_))); };
        for (int y = clamped(low.y); y < clamped(std::ceil(high.y)); ++y)
            for (int x = clamped(low.x); x < clamped(std::ceil(high.x)); ++x) {
                const Shown p(x + 0.5, y + 0.5, 0);
                const double b = cross(p - t[0], t[2] - t[0]) / area;
                const double c = cross(t[1] - t[0], p - t[0]) / area;
                if (b >= 0 && c >= 0 && b + c <= 1) draw({p.x, p.y, t[0].z + b * (t[1].z - t[0].z) + c * (t[2].z - t[0].z)}, colour);
            }
    }

private:
    static double cross(const Shown& a, const Shown& b) { return a.x * b.y - a.y * b.x; }

    Image& picture_;
    int left_;
    int side_;
    std::vector<double> depth_;
};

/// Axes to the right, up, and towards the viewer.
glm::dmat3 axesOf(int view) {
    if (view == 1) return {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    if (view == 2) return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    return glm::dmat3(1);
}

void drawMesh(View& view, const Mesh& mesh, const glm::dmat3& toView, const glm::dvec3& centre) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = toView * (glm::dvec3(mesh.positions[mesh.indices[i + c]]) - centre);
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(normal);
        if (!(normal.z > 0)) continue;
        view.fill({view.at(p[0]), view.at(p[1]), view.at(p[2])}, glm::dvec3(0.25 + 0.5 * normal.z / length));
    }
}

void drawStrand(View& view, const Root& root, double coat, const glm::dmat3& toView, const glm::dvec3& centre) {
    const double wanted = root.share * coat;
    const double length = std::min(wanted, static_cast<double>(root.limit));
    const double cut = wanted > 0 ? 1 - length / wanted : 0;
    const auto at = [&](double t) {
        const glm::dvec3 along = glm::dvec3(root.normal) * t + glm::dvec3(root.lean) * t * t;
        return view.at(toView * (glm::dvec3(root.position) + length * along - centre));
    };
    const double pixels = glm::distance(glm::dvec2(at(0)), glm::dvec2(at(1)));
    const int steps = static_cast<int>(std::ceil(pixels)) + 1;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double shade = (0.25 + 0.75 * t) * (0.75 + 0.25 * root.random);
        view.draw(at(t), shade * glm::mix(glm::dvec3(0.85, 0.68, 0.45), glm::dvec3(0.95, 0.1, 0.05), std::min(1.0, 2 * cut)));
    }
}

} // namespace

Image drawRoots(const Mesh& mesh, const RootSet& set, double furLength, int side) {
    Image picture{.width = kViews * side, .height = side, .channels = 3};
    picture.pixels.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(side) * 3, 1.0F);
    const double coat = furLength * set.ballRadius;
    for (int i = 0; i < kViews; ++i) {
        View view(picture, i * side, side);
        const glm::dmat3 toView = glm::transpose(axesOf(i)) / (kMargin * (set.ballRadius + coat));
        drawMesh(view, mesh, toView, set.centre);
        for (const Root& root : set.roots)
            drawStrand(view, root, coat, toView, set.centre);
    }
    return picture;
}

} // namespace tegument
