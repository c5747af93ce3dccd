#include "meshprep/fur/roots/roots.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/limits.h"
#include "meshprep/fur/roots/scatter.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace tegument {

namespace {

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

} // namespace tegument
