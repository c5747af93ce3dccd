// Modules that say how bright things are, point by point: Specular, Irradiance.

#include "generated/setting_names.h"
#include "lab/verify/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace tegument::verify {

Limits shadowLimits(const Context& context) {
    if (context.options.setting == kSettingCorrected)
        return {.relativeL2 = 0.03,
                .p99 = 0,
                .p999 = 0.5,
                .bias = 2e-3,
                .apart = 0.7,
                .why = "exact but for single points where a curved surface leaves the plane it is taken for"};
    return {.relativeL2 = 0.3,
            .bias = 0.06,
            .apart = 1,
            .why =
                "one comparison with a constant tolerance: false shadows on slopes, light behind thin parts (docs/design/modules/TSM.md)"};
}

namespace {

struct SpecularCase {
    const char* technique;
    const char* subject;
    bool shadowed;
    bool mapped;
    Limits limits; // where look-ups are exact
};

/// The picture, its maps looked up that far from where they should be, in texels of the normal map.
Image reflection(const Truth& truth, const Seen& seen, const SpecularCase& which, const std::vector<bool>& lit, const glm::dvec2& texels) {
    return paint(seen, 3, [&](reference::SurfacePoint point, std::size_t pixel) {
        point.uv += texels * truth.skin.texelOfNormals();
        const glm::dvec3 normal = which.mapped ? truth.skin.mappedNormal(point) : glm::normalize(point.normal);
        return glm::dvec4(truth.skin.reflected(point, normal, truth.camera.eye, lit[pixel]), 1);
    });
}

/// Graphics hardware places look-ups with 8 bits between texels: a step off along u and v at most, where it truncates. What that makes of
/// a picture depends on the scene: a lobe is the steeper the nearer its lamp.
Result<Limits> withPlacedLookUps(Limits limits, const Image& exact, const std::vector<std::uint8_t>& counts,
                                 const std::function<Image(const glm::dvec2&)>& displaced) {
    constexpr double kStepOfLookUps = 1.0 / 256;
    Difference most;
    for (const double u : {-kStepOfLookUps, kStepOfLookUps})
        for (const double v : {-kStepOfLookUps, kStepOfLookUps}) {
            const auto found = differenceWhere(counts, displaced({u, v}), exact);
            if (!found) return found.error();
            most.relativeL2 = std::max(most.relativeL2, found->relativeL2);
            most.p99 = std::max(most.p99, found->p99);
            most.largest = std::max(most.largest, found->largest);
        }
    limits.relativeL2 += most.relativeL2;
    limits.p99 += most.p99;
    if (limits.largest >= 0) limits.largest += most.largest;
    return limits;
}

Result<void> compareSpecular(ModuleReport& report, const Context& context, const Scene& scene, const Truth& truth, const Seen& seen,
                             const SpecularCase& which) {
    const auto run = render(context, scene, {.effect = "Specular.fx", .technique = which.technique, .size = context.options.pictureSize});
    if (!run) return run.error();
    const auto counts = which.shadowed ? awayFromShadowEdges(truth, seen) : interior(seen);
    std::vector<bool> lit;
    for (const auto& point : seen.pixels)
        lit.push_back(point && (!which.shadowed || truth.skin.lit(*point)));
    const auto looked = [&](const glm::dvec2& texels) { return reflection(truth, seen, which, lit, texels); };
    const Image exact = looked({0, 0});
    const auto limits = which.limits.p99 < 0 ? which.limits : withPlacedLookUps(which.limits, exact, counts, looked);
    if (!limits) return limits.error();
    const auto compared =
        compare(report, context,
                {which.subject, rgb(run->image), exact, counts, which.shadowed ? interior(seen) : std::vector<std::uint8_t>{}}, *limits);
    if (!compared) return compared;
    noteApart(report, which.subject, counts, covered(seen), which.shadowed ? kShadowApart : kOutline);
    return {};
}

} // namespace

Result<ModuleReport> verifySpecular(const Context& context) {
    ModuleReport report{.module = "Specular",
                        .summary = "Every pixel against the reflectance evaluated at its point, lit if a ray to the light says so"};
    const Scene scene = sceneOf(context.options);
    const Truth truth = truthOf(scene, context.options);
    const Seen seen = look(truth.skin, truth.camera);
    const Limits mapped{.relativeL2 = 5e-4,
                        .p99 = 1e-3,
                        .largest = 5e-3,
                        .bias = 5e-4,
                        .why = "floats, and what the reference changes by where look-ups lie 1/256 texel off, as on graphics hardware"};
    const Limits printed{.relativeL2 = 0.1, .bias = 0.02, .why = "false shadows of the printed comparison (docs/design/modules/TSM.md)"};
    const Limits shadowed{.relativeL2 = 2e-3,
                          .p99 = 3e-3,
                          .bias = 5e-4,
                          .apart = 0.5,
                          .why = "as unshadowed; corners moved to 1/256 pixel, single points of the shadow map"};
    const bool corrected = context.options.setting == kSettingCorrected;
    const std::array cases = {SpecularCase{"SpecularUnshadowed", "unshadowed", false, true, mapped},
                              SpecularCase{"Specular", "shadowed", true, true, corrected ? shadowed : printed},
                              SpecularCase{"SpecularSmooth", "shadowed, normals of the mesh", true, false, corrected ? shadowed : printed}};
    for (const SpecularCase& which : cases)
        if (const auto compared = compareSpecular(report, context, scene, truth, seen, which); !compared) return compared.error();
    return report;
}

namespace {

/// Thickness in alpha, as the setting stores it.
double encoded(const Truth& truth, const reference::SurfacePoint& point) {
    constexpr double kLargest = 0.99;
    const auto t = truth.skin.thickness(point);
    if (!truth.skin.settings().thicknessAsDepth) return t ? std::min(std::exp(-0.2 * *t), kLargest) : 0;
    if (!t) return kLargest;
    // z/w along the light's ray: the share of the depth between the planes, which is not linear in mm.
    const auto found = truth.skin.entry(point);
    const double straight = truth.zOverW(point.position) - truth.zOverW(found->point.position);
    return std::min(kLargest, straight * *t / std::max(found->path, 1e-9));
}

Result<void> compareThickness(ModuleReport& report, const Context& context, const Truth& truth, const Seen& seen, const Image& drawn) {
    auto counts = interior(seen);
    auto turned = counts;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        turned[i] = glm::dot(seen.pixels[i]->normal, truth.skin.toLight(*seen.pixels[i])) < 0 ? 1 : 0;
        counts[i] = thicknessIsKnown(truth, *seen.pixels[i]) ? 1 : 0;
    }
    const Image exact =
        paint(seen, 1, [&](const reference::SurfacePoint& point, std::size_t) { return glm::dvec4(encoded(truth, point)); });
    const auto compared = compare(
        report, context, {"thickness in alpha", channel(drawn, 3), exact, counts},
        {.relativeL2 = 2e-2,
         .p99 = 6e-2,
         .bias = 5e-3,
         .why = "entry points are interpolated between texels of the map; the lit side's normal comes from differences of its depths"});
    if (!compared) return compared;
    noteApart(report, "thickness in alpha", counts, turned,
              "ways that jump by more than 3 mm within three texels of the map, and N.L above -0.15, where they are crossed edge-on");
    return {};
}

} // namespace

Result<ModuleReport> verifyIrradiance(const Context& context) {
    ModuleReport report{
        .module = "Irradiance",
        .summary = "Every texel against C^mix colour V max(N.L, 0) (1 - rho_s rho_dt) in double precision, V by a ray; thickness by rays"};
    const Scene scene = sceneOf(context.options);
    const Truth truth = truthOf(scene, context.options);
    const int size = context.options.mapSize;
    const auto run =
        render(context, scene, {.effect = "Irradiance.fx", .technique = "Irradiance", .size = size, .dump = {"gIrradianceMap"}});
    if (!run) return run.error();
    const Image& drawn = run->dumped.at("gIrradianceMap");
    const Seen seen = lookUnwrapped(scene.mesh, size);
    const auto counts = awayFromShadowEdges(truth, seen);
    const Image exact = paint(seen, 3, [&](const reference::SurfacePoint& point, std::size_t) {
        return glm::dvec4(truth.skin.entering(point, truth.skin.lit(point)), 1);
    });
    const bool corrected = context.options.setting == kSettingCorrected;
    const auto compared =
        compare(report, context, {"gIrradianceMap", rgb(drawn), exact, counts, interior(seen)},
                corrected ? Limits{.relativeL2 = 5e-3,
                                   .p99 = 1e-2,
                                   .bias = 3e-3,
                                   .apart = 0.5,
                                   .why = "a half, truncated; 8 bits of position in the look-ups of colour and normal; the albedo table"}
                          : Limits{.relativeL2 = 0.3,
                                   .bias = 0.06,
                                   .apart = 1,
                                   .why = "false shadows of the printed comparison (docs/design/modules/TSM.md)"});
    if (!compared) return compared.error();
    noteApart(report, "gIrradianceMap", counts, covered(seen), kShadowApart);
    if (const auto thick = compareThickness(report, context, truth, seen, drawn); !thick) return thick.error();
    return report;
}

} // namespace tegument::verify
