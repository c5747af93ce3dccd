#include "meshprep/fur/roots/roots.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/fur_surface.h"
#include "meshprep/fur/roots/scatter.h"
#include "meshprep/rays/surface_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

/// In the surface's unit space.
struct LengthLimits {
    float curvature = 0; // of the concave side, 1 / radius; 0 where the surface is flat or convex
    float opposite = 0;  // distance to the next surface along the normal; infinite if there is none
};

/// Of concave curvature, the share of its radius that a strand may have.
inline constexpr float kShareOfCurvature = 0.8F;

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

/// For each root. The curvature is that of the normals of all roots within `reach` that look to the same side: what strands, at their
/// distance from each other, can show of it.
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

constexpr std::uint32_t kOfLooks = 0x2545f491U; // streams of the noise of their own
constexpr std::uint32_t kOfShape = 0x9e3779b9U;
constexpr std::uint32_t kOfDensity = 0x7f4a7c15U;
constexpr std::uint32_t kOfCoat = 0x1b873593U;
constexpr double kBald = 1e-3; // shares of the length below which no strand stands

class Watch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(since_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

Result<void> checkOptions(const RootOptions& o) {
    const struct {
        const char* what;
        double value, low, high;
    } ranges[] = {{"count", static_cast<double>(o.count), 1, 1e15},
                  {"density", o.density.value_or(1), 1e-30, 1e30},
                  {"spacing", o.spacing, 0.1, 0.8},
                  {"radius", o.radius, 0.01, 2},
                  {"thinnest radius", o.thinnest, 0.01, 1},
                  {"shortest length", o.shortest, 0.01, 1},
                  {"reach", o.reach, o.radius, 4},
                  {"cell", o.cell, 0.25, 8},
                  {"lean", o.lean, 0, 4},
                  {"curl", o.curl, 0, 1},
                  {"length", o.furLength, 0, 1}};
    for (const auto& range : ranges)
        if (!(range.value >= range.low && range.value <= range.high))
            return usageError(7103, fmt::format("the {} of the roots is {}", range.what, range.value),
                              fmt::format("use {} to {}", range.low, range.high));
    return {};
}

Result<void> checkMaps(const Mesh& mesh, const RootOptions& options) {
    const std::pair<const char*, const std::optional<FurMap>*> maps[] = {
        {"density", &options.densityMap}, {"length", &options.lengthMap}, {"direction", &options.directionMap}};
    for (const auto& [name, map] : maps)
        if (*map && (*map)->needsUvs() && mesh.uvs.empty())
            return usageError(
                7106, fmt::format("the {} map is a flat picture, but the mesh has no texture coordinates", name),
                "give a cube map (DDS with six faces), looked up by the direction from the mesh's centre, or values at the vertices");
    return {};
}

/// The mean of the density map over the surface.
double meanDensity(const FurSurface& surface, const RootOptions& options) {
    if (!options.densityMap) return 1;
    constexpr std::uint64_t kSamples = 65536; // the count is good to about 1 / 256 of what varies
    double sum = 0;
    for (std::uint64_t i = 0; i < kSamples; ++i)
        sum += shareAt(*options.densityMap, surface, surface.point(rootNoise(i, options.seed ^ kOfDensity)));
    return sum / static_cast<double>(kSamples);
}

Result<void> plan(RootSet& set, const FurSurface& surface, const RootOptions& options) {
    const double radius = surface.radius();
    set.area = surface.area() * radius * radius;
    if (!(surface.area() > 0) || !std::isfinite(set.area))
        return inputError(7105, {}, "no triangle of the mesh has an area", "roots need a surface: look at the mesh with tegument prep");
    const double full = options.density ? *options.density * set.area : static_cast<double>(options.count);
    if (full > kMostRoots)
        return usageError(7104, fmt::format("{:.4g} roots are more than {:.0f}", full, kMostRoots),
                          "ask for fewer, or for a lower density");
    if (full < 1)
        return usageError(7104, fmt::format("{:.3g} roots are less than one", full),
                          fmt::format("the mesh has {:.4g} mm^2: is its unit right (--unit-mm)?", set.area));
    set.density = full / set.area;
    const double spacing = std::sqrt(set.area / full);
    set.wanted = static_cast<std::size_t>(std::llround(full * meanDensity(surface, options)));
    set.distance = options.spacing * spacing;
    set.radius = options.radius * spacing;
    set.reach = options.reach * spacing;
    set.cell = options.cell * spacing;
    set.centre = surface.centre();
    set.ballRadius = radius;
    set.figures = surfaceFigures(surface.mesh());
    return {};
}

/// What a strand is apart from its place: the noise of its number, and the maps.
class Strands {
public:
    Strands(const FurSurface& surface, const RootOptions& options, const RootSet& set) : surface_(surface), options_(options), set_(set) {}

    [[nodiscard]] Root at(const SurfacePoint& point, const LengthLimits& limits, std::uint64_t number) const {
        const glm::dvec3 looks = rootNoise(number, options_.seed ^ kOfLooks);
        const glm::dvec3 shape = rootNoise(number, options_.seed ^ kOfShape);
        Root root{.position = surface_.toMesh(point.position), .normal = point.normal, .triangle = point.triangle};
        root.lean = glm::vec3(leanAt(point));
        root.radius = static_cast<float>(set_.radius * glm::mix(options_.thinnest, 1.0, shape.x));
        root.share = static_cast<float>(glm::mix(options_.shortest, 1.0, looks.y));
        if (options_.lengthMap) root.share *= static_cast<float>(shareAt(*options_.lengthMap, surface_, point));
        root.limit = static_cast<float>(limitOf(limits) * surface_.radius());
        root.curl = static_cast<float>(options_.curl * shape.y);
        constexpr double kSteps = 16777216; // 2^24: what a float holds
        root.random = static_cast<float>(std::floor(looks.x * kSteps) / kSteps);
        return root;
    }

    [[nodiscard]] static float limitOf(const LengthLimits& limits) {
        return std::min({1.0F, kShareOfCurvature / std::max(limits.curvature, 1e-6F), limits.opposite / 2});
    }

    [[nodiscard]] CoatSample coatAt(const SurfacePoint& point) const {
        double density = options_.densityMap ? shareAt(*options_.densityMap, surface_, point) : 1;
        if (options_.lengthMap && shareAt(*options_.lengthMap, surface_, point) < kBald) density = 0;
        return {.position = surface_.toMesh(point.position),
                .normal = point.normal,
                .lean = glm::vec3(leanAt(point)),
                .density = static_cast<float>(density)};
    }

private:
    [[nodiscard]] glm::dvec3 leanAt(const SurfacePoint& point) const {
        if (!(options_.lean > 0)) return glm::dvec3(0);
        if (options_.directionMap) return options_.lean * directionAt(*options_.directionMap, surface_, point);
        const glm::dvec3 normal(point.normal);
        const double length = glm::length(options_.comb);
        if (!(length > 0)) return glm::dvec3(0);
        const glm::dvec3 comb = options_.comb / length;
        return options_.lean * (comb - normal * glm::dot(normal, comb));
    }

    const FurSurface& surface_;
    const RootOptions& options_;
    const RootSet& set_;
};

/// Lean and density between the roots, where they differ from place to place.
void sampleCoat(RootSet& set, const FurSurface& surface, const RootOptions& options) {
    if (!options.densityMap && !options.lengthMap && !(options.lean > 0)) return;
    const Strands strands(surface, options, set);
    const auto count = static_cast<std::size_t>(std::ceil(set.area * set.density));
    set.coat.resize(count);
    inChunks(count, options.threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            glm::dvec3 place = rootNoise(i, options.seed ^ kOfCoat);
            place.x = (static_cast<double>(i) + place.x) / static_cast<double>(count);
            set.coat[i] = strands.coatAt(surface.point(place));
        }
    });
}

void growStrands(RootSet& set, const FurSurface& surface, const RootOptions& options, const std::vector<SurfacePoint>& points,
                 const std::vector<LengthLimits>& limits) {
    const Strands strands(surface, options, set);
    set.roots.resize(points.size());
    inChunks(points.size(), options.threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            set.roots[i] = strands.at(points[i], limits[i], i);
    });
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double length = set.roots[i].share * options.furLength;
        const bool curved = static_cast<double>(kShareOfCurvature) < length * limits[i].curvature;
        set.shortenedByCurvature += curved;
        set.shortenedByOpposite += !curved && limits[i].opposite / 2 < length;
    }
    std::erase_if(set.roots, [](const Root& root) { return !(root.share >= kBald) || !(root.limit > 0); });
}

} // namespace

Result<RootSet> makeRoots(const Mesh& mesh, const RootOptions& options) {
    if (const auto checked = checkOptions(options); !checked) return checked.error();
    if (const auto checked = checkMaps(mesh, options); !checked) return checked.error();
    RootSet set;
    Watch watch;
    const FurSurface surface(mesh);
    if (const auto planned = plan(set, surface, options); !planned) return planned.error();
    set.seconds.surface = watch.lap();
    ScatterOptions scatter{.wanted = set.wanted,
                           .distance = static_cast<float>(set.distance / surface.radius()),
                           .stratum = static_cast<float>(kStratum / std::sqrt(set.density) / surface.radius()),
                           .seed = options.seed,
                           .threads = options.threads,
                           .density = {}};
    if (options.densityMap) scatter.density = [&](const SurfacePoint& point) { return shareAt(*options.densityMap, surface, point); };
    const auto [points, distance] = scatterRoots(surface, scatter);
    set.distance = static_cast<double>(distance) * surface.radius();
    set.seconds.scatter = watch.lap();
    const double kNeighbours = 2; // spacings: a dozen neighbours
    const auto reach = static_cast<float>(kNeighbours / std::sqrt(set.density) / surface.radius());
    const std::vector<LengthLimits> limits = lengthLimits(surface, points, reach, options.threads);
    set.seconds.limits = watch.lap();
    growStrands(set, surface, options, points, limits);
    sampleCoat(set, surface, options);
    set.seconds.strands = watch.lap();
    return set;
}

CoatField::CoatField(std::span<const CoatSample> samples, float radius)
    : samples_(samples), radius_(radius), grid_(radius, samples.size()) {
    for (const CoatSample& sample : samples) {
        grid_.add(sample.position, sample.normal, 0);
        longest_ = std::max(longest_, glm::length(sample.lean));
    }
}

glm::vec4 CoatField::at(const glm::vec3& place) const {
    // Normal equations of a constant and three slopes, for four values at once; steps in units of the radius.
    glm::mat4 left(0);
    glm::mat4 right(0);
    // A bucket shared by several cells is walked once for each: its points count as often, which their mean does not feel.
    grid_.visit(place, radius_, [&](std::uint32_t i, float squared) {
        const CoatSample& sample = samples_[i];
        const float share = 1 - squared / (radius_ * radius_);
        const glm::vec4 step((sample.position - place) / radius_, 1);
        left += share * share * glm::outerProduct(step, step);
        right += share * share * glm::outerProduct(glm::vec4(sample.lean, sample.density), step);
        return true;
    });
    const float weight = left[3][3];
    if (!(weight > 0)) return glm::vec4(0);
    constexpr float kStiffness = 1e-2F; // of slopes: along the normal samples tell little of them, or nothing
    for (glm::length_t i = 0; i < 3; ++i)
        left[i][i] += kStiffness * weight;
    const glm::vec4 value((glm::dmat4(right) * glm::inverse(glm::dmat4(left)))[3]); // floats would lose three digits
    const glm::vec3 lean(value);
    const float length = glm::length(lean);
    return {length > longest_ ? lean * (longest_ / length) : lean, std::clamp(value.w, 0.0F, 1.0F)};
}

} // namespace tegument
