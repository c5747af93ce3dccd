// Modules that say where things are: OriginalTexture, Stretch, ShadowMap, TSM.

#include "generated/setting_names.h"
#include "lab/verify/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tegument::verify {

namespace {

struct Largest {
    double value = 0;
    void operator()(double other) { value = std::max(value, other); }
};

/// Covered in one of the two only: never inside, seldom at the outline.
void addCoverage(ModuleReport& report, const Context& context, const Image& rendered, int coverage, const Seen& seen) {
    const auto inside = interior(seen);
    std::size_t differing = 0;
    std::size_t differingInside = 0;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const std::size_t pixel = seen.index(x, y);
            if ((rendered.at(x, y, coverage) > 0) == seen.pixels[pixel].has_value()) continue;
            ++differing;
            differingInside += inside[pixel];
        }
    addMetric(report, context, "texels covered in one only, share",
              static_cast<double>(differing) / static_cast<double>(seen.pixels.size()), 0.005, "texels whose centre lies on the outline");
    addMetric(report, context, "texels covered in one only, inside", static_cast<double>(differingInside), 0, "inside there is no doubt");
}

/// Depth as the setting stores it.
double stored(const Truth& truth, const std::string& setting, const reference::SurfacePoint& point) {
    return setting == kSettingSeed ? truth.zOverW(point.position) : glm::length(point.position - truth.light.origin(point.position));
}

double largestInside(const Image& map, int which, const Seen& seen, const std::vector<std::uint8_t>& counts,
                     const std::function<double(const reference::SurfacePoint&)>& exact) {
    Largest largest;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x)
            if (counts[seen.index(x, y)] != 0) largest(std::abs(map.at(x, y, which) - exact(*seen.pixels[seen.index(x, y)])));
    return largest.value;
}

void addDepth(ModuleReport& report, const Context& context, const Truth& truth, const Image& map, const Seen& seen,
              const std::vector<std::uint8_t>& counts) {
    const bool ratio = context.options.setting == kSettingSeed;
    const double largest =
        largestInside(map, 0, seen, counts, [&](const reference::SurfacePoint& p) { return stored(truth, context.options.setting, p); });
    // A texel is 0.7 mm on the built-in body and slopes reach 4: 1/512 of a texel moves the depth by 0.005 mm.
    addMetric(report, context, ratio ? "depth: largest interior error, z/w" : "depth: largest interior error, mm", largest,
              ratio ? 3e-4 : 0.02, "vertices are snapped to 1/256 texel, where the surface is seen edge-on a texel is many mm deep");
}

} // namespace

Result<ModuleReport> verifyOriginalTexture(const Context& context) {
    ModuleReport report{.module = "OriginalTexture",
                        .summary =
                            "Every pixel against the colour map at the place where its ray meets the mesh, sRGB decoded before filtering"};
    const Scene scene = sceneOf(context.options);
    const Truth truth = truthOf(scene, context.options);
    const int size = context.options.pictureSize;
    const auto run = render(context, scene, {.effect = "OriginalTexture.fx", .size = size});
    if (!run) return run.error();
    const Seen seen = look(truth.skin, truth.camera);
    const auto counts = interior(seen);
    const Image exact = paint(seen, 3, [&](const reference::SurfacePoint& point, std::size_t) { return truth.skin.colour(point); });
    const auto compared = compare(report, context, {"picture", rgb(run->image), exact, counts},
                                  {.relativeL2 = 4e-3,
                                   .p99 = 1e-2,
                                   .largest = 0.03,
                                   .bias = 1e-3,
                                   .why = "look-ups have 8 bits of position between texels; mip levels where the surface turns away"});
    if (!compared) return compared.error();
    addCoverage(report, context, run->image, 3, seen);
    noteApart(report, "picture", counts, covered(seen), kOutline);
    return report;
}

Result<ModuleReport> verifyStretch(const Context& context) {
    ModuleReport report{
        .module = "Stretch",
        .summary = "Every texel against the Jacobian of the triangle that covers its centre, and the gaps against the charts' mean"};
    const Scene scene = sceneOf(context.options);
    const int size = context.options.mapSize;
    const auto run = render(context, scene, {.effect = "Stretch.fx", .size = size, .dump = {"gStretchMap", "gStretchChartsMap"}});
    if (!run) return run.error();
    const Seen seen = lookUnwrapped(scene.mesh, size);
    auto counts = interior(seen);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        constexpr double kOnAnEdge = 1e-3; // in shares of the triangle
        if (counts[i] == 0) continue;
        const glm::dvec3 w = seen.pixels[i]->place.weights;
        counts[i] = std::min({w.x, w.y, w.z}) > kOnAnEdge ? 1 : 0;
    }
    constexpr double kScale = 0.1 * 1024; // docs/design/modules/Stretch.md
    const Image exact = paint(seen, 3, [&](const reference::SurfacePoint& point, std::size_t) {
        const auto j = reference::jacobian(scene.mesh, point.place.triangle);
        return j ? glm::dvec4(kScale / glm::length(j->alongU), kScale / glm::length(j->alongV), 0, 0) : glm::dvec4(0);
    });
    const Image& map = run->dumped.at("gStretchMap");
    const auto compared = compare(
        report, context, {"gStretchMap", rgb(map), exact, counts},
        {.relativeL2 = 3e-3,
         .p99 = 0.01,
         .p999 = 0.012,
         .largest = 0.03,
         .bias = kHalfStep,
         .why = "a half truncated to 10 bits; graphics hardware snaps vertices to 1/256 texel, and triangles are a texel or two wide"});
    if (!compared) return compared.error();
    addCoverage(report, context, run->dumped.at("gStretchChartsMap"), 0, seen);
    glm::dvec2 sum(0);
    double texels = 0;
    glm::dvec2 gap(0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            if (map.at(x, y, 3) > 0.5F) gap = {map.at(x, y, 0), map.at(x, y, 1)};
            if (!seen.pixels[seen.index(x, y)]) continue;
            sum += glm::dvec2(exact.at(x, y, 0), exact.at(x, y, 1));
            texels += 1;
        }
    addMetric(report, context, "gaps: relative difference from the mean of the charts",
              glm::length(gap - sum / texels) / glm::length(sum / texels), 2e-3,
              "a half; texels on the outline that one of the two covers");
    noteApart(report, "gStretchMap", counts, covered(seen),
              std::string(kOutline) + "; texels whose centre lies on the edge of two triangles");
    return report;
}

Result<ModuleReport> verifyTsm(const Context& context) {
    ModuleReport report{.module = "TSM",
                        .summary = "Every texel against a ray from the light through its centre: distance, u, v of the nearest surface"};
    const Scene scene = sceneOf(context.options);
    const Truth truth = truthOf(scene, context.options);
    const int size = context.options.mapSize;
    const auto run = render(context, scene, {.effect = "TSM.fx", .size = size, .dump = {"gTsmMap"}});
    if (!run) return run.error();
    const Seen seen = look(truth.skin, truth.light);
    const auto counts = interior(seen);
    const Image& map = run->dumped.at("gTsmMap");
    addDepth(report, context, truth, map, seen, counts);
    for (int axis = 0; axis < 2; ++axis) {
        const double largest = largestInside(map, 1 + axis, seen, counts, [&](const reference::SurfacePoint& p) { return p.uv[axis]; });
        addMetric(report, context, fmt::format("{}: largest interior error, texels", axis == 0 ? "u" : "v"), largest * size, 0.03,
                  "1/256 texel of the light's map, many texels of the charts where the light grazes");
    }
    addCoverage(report, context, map, 3, seen);
    const bool ratio = context.options.setting == kSettingSeed;
    const Image exact = paint(seen, 3, [&](const reference::SurfacePoint& p, std::size_t) {
        const double depth = stored(truth, context.options.setting, p);
        return glm::dvec4(ratio ? depth : (depth - truth.lightNear) / (truth.lightFar - truth.lightNear), p.uv, 1);
    });
    const auto compared =
        compare(report, context, {"(depth between the planes, u, v)", rgb(run->image), exact, counts},
                {.relativeL2 = 1e-4, .p99 = 3e-4, .p999 = 5e-4, .largest = 1e-3, .bias = 5e-5, .why = "vertices snapped to 1/256 texel"});
    if (!compared) return compared.error();
    noteApart(report, "gTsmMap", counts, covered(seen), kOutline);
    return report;
}

Result<ModuleReport> verifyShadowMap(const Context& context) {
    ModuleReport report{.module = "ShadowMap",
                        .summary = "Depths against rays from the light; shadows on the mesh against rays from each point to the light"};
    const Scene scene = sceneOf(context.options);
    const Truth truth = truthOf(scene, context.options);
    const int size = context.options.mapSize;
    const auto depths = render(context, scene, {.effect = "ShadowMap.fx", .technique = "ShadowMap", .size = size, .dump = {"gShadowMap"}});
    if (!depths) return depths.error();
    const Seen fromLight = look(truth.skin, truth.light);
    const Image& map = depths->dumped.at("gShadowMap");
    addDepth(report, context, truth, map, fromLight, interior(fromLight));
    addCoverage(report, context, map, 0, fromLight);

    const auto shaded = render(context, scene, {.effect = "ShadowMap.fx", .technique = "Shadow", .size = context.options.pictureSize});
    if (!shaded) return shaded.error();
    const Seen seen = look(truth.skin, truth.camera);
    const auto counts = awayFromShadowEdges(truth, seen);
    const Image exact = paint(
        seen, 1, [&](const reference::SurfacePoint& point, std::size_t) { return glm::dvec4(truth.skin.litByFacets(point) ? 1 : 0); });
    const auto compared =
        compare(report, context, {"shadow on the mesh", channel(shaded->image, 0), exact, counts, interior(seen)}, shadowLimits(context));
    if (!compared) return compared.error();
    noteApart(report, "shadow on the mesh", counts, covered(seen), kShadowApart);
    return report;
}

} // namespace tegument::verify
