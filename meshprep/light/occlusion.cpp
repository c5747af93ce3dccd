#include "meshprep/light/occlusion.h"

#include "host/support/parallel.h"
#include "meshprep/base/noise.h"
#include "meshprep/base/texel_owners.h"
#include "meshprep/rays/surface_tree.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace tegument {

namespace {

constexpr float kAbove = 1e-5F; // of the bounding sphere's radius: where rays start

struct Ground {
    glm::vec3 place{0};
    glm::vec3 normal{0};
};

/// van der Corput's sequence in base 2: Hammersley's set with i / n beside it.
double mirroredBits(std::uint32_t i) {
    double result = 0;
    for (double bit = 0.5; i > 0; i >>= 1U, bit *= 0.5)
        result += (i & 1U) != 0 ? bit : 0;
    return result;
}

/// On the unit disc, evenly: projected onto the hemisphere they have the cosine's density (Malley's method).
std::vector<glm::dvec2> discPoints(int count) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const double radius = std::sqrt((i + 0.5) / count);
        const double angle = 2 * std::numbers::pi * mirroredBits(static_cast<std::uint32_t>(i));
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return points;
}

Ground groundUnder(const Mesh& mesh, const TexelOwners& owners, std::uint32_t triangle, const glm::dvec2& texel) {
    const auto corners = owners.corners(triangle);
    const auto weights = owners.weights(triangle, texel);
    Ground ground;
    for (std::size_t c = 0; c < 3; ++c) {
        ground.place += weights.at(c) * mesh.positions[corners.at(c)];
        ground.normal += weights.at(c) * mesh.normals[corners.at(c)];
    }
    const float length = glm::length(ground.normal);
    ground.normal = length > 0 ? ground.normal / length : glm::vec3(0, 0, 1);
    return ground;
}

class Sky {
public:
    Sky(const Mesh& mesh, const OcclusionOptions& options)
        : tree_(mesh.positions, mesh.indices, {.corners = 3, .watertight = true, .quick = false, .threads = 0}),
          points_(discPoints(options.rays)), above_(kAbove * mesh.bounds.radius),
          reach_(options.reachMm > 0 ? static_cast<float>(options.reachMm) : std::numeric_limits<float>::infinity()) {}

    /// As Occlusion::map has it; `turn` in 0..1.
    [[nodiscard]] glm::vec4 seenFrom(const Ground& ground, double turn) const {
        const glm::dvec3 normal(ground.normal);
        const glm::dvec3 side = glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 up = glm::cross(normal, side);
        const glm::dvec2 turned(std::cos(2 * std::numbers::pi * turn), std::sin(2 * std::numbers::pi * turn));
        const glm::vec3 origin = ground.place + above_ * ground.normal;
        glm::dvec3 out(0);
        int count = 0;
        for (const glm::dvec2& p : points_) {
            const glm::dvec2 q(p.x * turned.x - p.y * turned.y, p.x * turned.y + p.y * turned.x);
            const glm::dvec3 d = q.x * side + q.y * up + std::sqrt(std::max(1 - glm::dot(q, q), 0.0)) * normal;
            if (tree_.meetsAny(origin, glm::vec3(d), {.first = 0, .last = reach_})) continue;
            out += d;
            ++count;
        }
        const double length = glm::length(out);
        const glm::dvec3 mean = length > 0 ? out / length : normal;
        return {glm::vec3(0.5 + 0.5 * mean), static_cast<float>(count) / static_cast<float>(points_.size())};
    }

private:
    SurfaceTree tree_;
    std::vector<glm::dvec2> points_;
    float above_;
    float reach_;
};

} // namespace

Result<Occlusion> bakeOcclusion(const Mesh& mesh, const OcclusionOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const Error none =
        inputError(7061, {.file = mesh.name}, "occlusion is baked into a map, and no texture coordinate is in the unit square",
                   "make coordinates: tegument prep MESH --unwrap -o NEW.glb");
    if (mesh.uvs.size() != mesh.positions.size()) return none;
    const TexelOwners owners(mesh.uvs, mesh.indices, options.side);
    const Sky sky(mesh, options);
    const auto side = static_cast<std::size_t>(options.side);
    Occlusion result{.map = {.width = options.side, .height = options.side, .channels = 4, .pixels = std::vector<float>(4 * side * side)}};
    std::vector<std::size_t> covered(side);
    std::vector<double> open(side);
    forEachInParallel(side, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < options.side; ++x) {
            const std::uint32_t triangle = owners.at(x, y);
            if (triangle == TexelOwners::kNone) continue;
            const glm::vec4 seen = sky.seenFrom(groundUnder(mesh, owners, triangle, glm::dvec2(x + 0.5, y + 0.5)),
                                                static_cast<double>(unitRandom({x, y, 0}, options.seed).x));
            for (int c = 0; c < 4; ++c)
                result.map.at(x, y, c) = seen[c];
            ++covered[row];
            open[row] += static_cast<double>(seen.w);
        }
    });
    for (std::size_t row = 0; row < side; ++row) {
        result.covered += covered[row];
        result.open += open[row];
    }
    if (result.covered == 0) return none;
    result.open /= static_cast<double>(result.covered);
    owners.spread(result.map.pixels, 4);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace tegument
