// Module Main: the whole picture of each technique, lit from in front and from behind.

#include "generated/setting_names.h"
#include "lab/reference/picture.h"
#include "lab/verify/truth.h"

#include <algorithm>
#include <functional>

namespace tegument::verify {

namespace {

/// Linear radiance of a point of the surface.
using Radiance = std::function<glm::dvec3(const reference::SurfacePoint&)>;

struct MainPart {
    const char* technique;
    const char* subject;
    bool fromBehind;
    Radiance (*exact)(const Context&, const Truth&); // `truth` outlives what it returns
    Limits limits;
};

Radiance lambert(const Context&, const Truth& truth) {
    return [&truth](const auto& point) { return reference::lambert(truth.skin, point, truth.camera.eye); };
}

Radiance deonLuebke(const Context& context, const Truth& truth) {
    const reference::SkinPicture picture(truth.skin, context.options.mapSize, truth.lightFar - truth.lightNear);
    return [&truth, picture](const auto& point) { return picture.radiance(point, truth.camera.eye); };
}

Radiance gosselin(const Context& context, const Truth& truth) {
    const reference::GosselinPicture picture(truth.skin, context.options.mapSize, reference::gosselinSettings(context.options.setting));
    return [&truth, picture](const auto& point) { return picture.radiance(point, truth.camera.eye); };
}

const char* const kApart = "as for shadows (docs/design/reference.md), and what is lit through the body where its thickness jumps by more "
                           "than 3 mm within three texels "
                           "of the map: the outline seen from the light";

/// Pixels whose shadow and whose thickness the map can tell.
std::vector<std::uint8_t> counted(const Truth& truth, const Seen& seen) {
    auto counts = interior(seen);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        const reference::SurfacePoint& point = *seen.pixels[i];
        const bool turnedAway = glm::dot(point.normal, truth.skin.toLight(point)) < 0;
        counts[i] = turnedAway ? thicknessIsKnown(truth, point) : !truth.skin.nearShadowEdge(point, kShadowEdge);
    }
    return counts;
}

Result<void> comparePart(ModuleReport& report, const Context& context, const MainPart& part) {
    Scene scene = sceneOf(context.options);
    if (part.fromBehind) scene = backlit(std::move(scene));
    const Truth truth = truthOf(scene, context.options);
    const auto run = render(
        context, scene,
        {.effect = "Main.fx", .technique = part.technique, .size = context.options.pictureSize, .defines = {{"TEGUMENT_MAP_BITS", "32"}}});
    if (!run) return run.error();
    const Seen seen = look(truth.skin, truth.camera);
    const auto counts = counted(truth, seen);
    const Radiance radiance = part.exact(context, truth);
    const Image exact = paint(seen, 3, [&](const reference::SurfacePoint& point, std::size_t) { return glm::dvec4(radiance(point), 1); });
    const auto compared = compare(report, context, {part.subject, rgb(run->image), exact, counts, interior(seen)}, part.limits);
    if (!compared) return compared.error();
    noteApart(report, part.subject, counts, covered(seen), kApart);
    return {};
}

Limits pictureLimits(const Context& context, bool fromBehind) {
    if (context.options.setting != kSettingCorrected)
        return {.relativeL2 = 0.15,
                .bias = 0.06,
                .apart = 1.5,
                .why = "false shadows of the printed comparison, widths and gain of the printed kernel (docs/design/modules/TSM.md, "
                       "Convolution.md)"};
    if (fromBehind)
        return {.relativeL2 = 0.015,
                .p99 = 0.15,
                .bias = 8e-3,
                .apart = 0.5,
                .why = "the way through the body is known to a texel of the map; apart: at the outline seen from the light it is not known "
                       "at all"};
    return {.relativeL2 = 0.01,
            .p99 = 0.05,
            .bias = 2e-3,
            .apart = 0.3,
            .why = "edges of shadows are soft in the map and sharp for rays: their blur differs nearby"};
}

/// Tight: without the disc's turn, its own mean or a quarter of its size the picture is 4e-3 to 7e-3 away.
Limits gosselinLimits(const Context& context) {
    if (context.options.setting != kSettingCorrected)
        return {
            .relativeL2 = 0.01, .bias = 3e-3, .apart = 0.5, .why = "false shadows of the printed comparison (docs/design/modules/TSM.md)"};
    return {.relativeL2 = 3e-3,
            .p99 = 0.01,
            .bias = 1e-3,
            .apart = 0.3,
            .why = "look-ups of colour in 8 bits; taps of the discs fall on whole texels, the same ones here and there"};
}

} // namespace

Result<ModuleReport> verifyMain(const Context& context) {
    ModuleReport report{.module = "Main",
                        .summary =
                            "Every pixel against the formula of docs/design/skin.md with shadows and thickness by rays, each map blurred "
                            "by one Gaussian of its whole width, or by the discs, reflectance and albedo evaluated; in front and "
                            "behind"};
    const bool corrected = context.options.setting == kSettingCorrected;
    const Limits plain =
        corrected
            ? Limits{.relativeL2 = 5e-3, .p99 = 0.02, .bias = 2e-3, .apart = 0.4, .why = "look-ups of colour in 8 bits; the albedo table"}
            : pictureLimits(context, false);
    for (const MainPart& part : {MainPart{"Lambert", "without diffusion", false, lambert, plain},
                                 MainPart{"DEonLuebke", "lit from in front", false, deonLuebke, pictureLimits(context, false)},
                                 MainPart{"DEonLuebke", "lit from behind", true, deonLuebke, pictureLimits(context, true)},
                                 MainPart{"Gosselin", "Gosselin", false, gosselin, gosselinLimits(context)}})
        if (const auto compared = comparePart(report, context, part); !compared) return compared.error();
    return report;
}

} // namespace tegument::verify
