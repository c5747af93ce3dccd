// How wrong a shadow is for every tolerance: lit points that it darkens (acne), and how far from what throws it a shadow begins
// (peter-panning).

#include "generated/setting_names.h"
#include "lab/stability/work.h"
#include "lab/verify/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::bench::stability {

namespace {

constexpr int kPicture = 256;
constexpr double kHorizon = 0.05; // N.L from which on a smooth surface counts as lit (docs/design/modules/ShadowMap.md)
constexpr double kElevation = 45; // of the light over the floor, degrees

struct Seen {
    verify::Seen pixels;
    glm::dvec3 light{0};
};

Seen look(const Context& context, const HardScene& scene) {
    const verify::Scene stage{scene.mesh, scene.workspace};
    const verify::Truth truth = verify::truthOf(stage, {.mapSize = context.options.size, .pictureSize = kPicture});
    return {verify::look(truth.skin, truth.camera), truth.light.eye};
}

/// Lit points of a convex body that the map darkens.
struct Acne {
    double share = 0; // darkened to less than a half
    double lost = 0;  // of the light on all of them
    std::string cause;
};

Acne acneOf(const Image& picture, const Seen& seen) {
    const auto counts = verify::interior(seen.pixels);
    std::size_t lit = 0;
    std::size_t dark = 0;
    double lost = 0;
    double darkest = 2;
    Acne acne;
    for (int y = 0; y < kPicture; ++y)
        for (int x = 0; x < kPicture; ++x) {
            const std::size_t i = seen.pixels.index(x, y);
            if (counts[i] == 0) continue;
            const reference::SurfacePoint& point = *seen.pixels.pixels[i];
            const double cosine = glm::dot(glm::normalize(point.normal), glm::normalize(seen.light - point.position));
            if (cosine < kHorizon) continue;
            const auto shadow = static_cast<double>(picture.at(x, y, 0));
            ++lit;
            dark += shadow < 0.5 ? 1 : 0;
            lost += 1 - shadow;
            if (shadow >= darkest) continue;
            darkest = shadow;
            acne.cause = fmt::format("pixel ({}, {}): N.L {:.3g}, {:.2g} of the light", x, y, cosine, shadow);
        }
    acne.share = lit > 0 ? static_cast<double>(dark) / static_cast<double>(lit) : 0;
    acne.lost = lit > 0 ? lost / static_cast<double>(lit) : 0;
    return acne;
}

/// mm from the wall's foot to the farthest point of the floor in its shadow that is more than half lit.
struct Offset {
    double millimetres = 0;
    std::string cause = "-";
};

Offset offsetOf(const Image& picture, const Seen& seen) {
    constexpr double kMiddle = 15; // mm to both sides: the wall ends at 40
    constexpr double kDeep = 20;   // mm before the wall: its shadow ends at 30
    Offset offset;
    for (int y = 0; y < kPicture; ++y)
        for (int x = 0; x < kPicture; ++x) {
            const auto& pixel = seen.pixels.pixels[seen.pixels.index(x, y)];
            if (!pixel) continue;
            const glm::dvec3& p = pixel->position;
            if (std::abs(p.x) > kMiddle || p.z <= offset.millimetres || p.z > kDeep || p.y > 1e-6) continue;
            if (picture.at(x, y, 0) < 0.5F) continue;
            offset = {p.z, fmt::format("pixel ({}, {})", x, y)};
        }
    return offset;
}

struct Tolerances {
    const char* setting;
    std::vector<double> values;
    double usual;
    bool ratio; // in shares of z/w, not mm
};

/// mm along the light's ray that a difference of z/w means in the middle of the scene.
double millimetres(double ratio, const HardScene& scene) {
    const auto distance = static_cast<double>(glm::length(scene.workspace.light.position - scene.mesh.bounds.centre));
    const auto radius = static_cast<double>(scene.mesh.bounds.radius);
    const double nearPlane = distance - radius;
    const double farPlane = distance + radius;
    return ratio * distance * distance * (farPlane - nearPlane) / (farPlane * nearPlane);
}

std::string named(const Tolerances& tolerances, double value, const HardScene& scene) {
    return tolerances.ratio ? fmt::format("tolerance {:g} of z/w ({:.2g} mm)", value, millimetres(value, scene))
                            : fmt::format("tolerance {:g} mm", value);
}

void addRow(const Context& context, const Tolerances& tolerances, const std::string& hardCase, const char* figure, double value,
            std::optional<double> limit, std::string cause, const char* why) {
    context.report.rows.push_back({.part = {},
                                   .module = fmt::format("ShadowMap [{}]", tolerances.setting),
                                   .hardCase = hardCase,
                                   .figure = figure,
                                   .value = value,
                                   .limit = limit,
                                   .cause = std::move(cause),
                                   .why = why});
}

Result<void> sweep(const Context& context, const Effect& effect, const Tolerances& tolerances) {
    const glm::dvec3 aslant(std::sin(glm::radians(kElevation)), 0, std::cos(glm::radians(kElevation)));
    HardScene cap = capScene(40, 89, glm::dvec3(0, 0, 1), aslant);
    HardScene wall = wallScene();
    const Seen capSeen = look(context, cap);
    const Seen wallSeen = look(context, wall);
    const bool corrected = std::string(tolerances.setting) == kSettingCorrected;
    for (const double value : tolerances.values) {
        context.say(fmt::format("shadow: [{}], tolerance {:g}", tolerances.setting, value));
        cap.parameters = wall.parameters = {{"gShadowTolerance", {value}}};
        const auto onCap = draw(context, effect, "Shadow", cap, kPicture);
        if (!onCap) return onCap.error();
        const auto onFloor = draw(context, effect, "Shadow", wall, kPicture);
        if (!onFloor) return onFloor.error();
        const bool judged = corrected && value == tolerances.usual;
        const Acne acne = acneOf(onCap->image, capSeen);
        addRow(context, tolerances, "cap lit at 45 degrees, " + named(tolerances, value, cap), "share of lit points falsely in shadow",
               acne.share, judged ? std::optional(0.0) : std::nullopt, acne.cause,
               "the default tolerance of setting corrected has no acne");
        const Offset offset = offsetOf(onFloor->image, wallSeen);
        const double texel = 2 * 100.0 / context.options.size; // mm: the light's pyramid holds a sphere of 57 mm
        addRow(context, tolerances, "wall on a floor, " + named(tolerances, value, wall), "shadow begins behind the wall by, mm",
               offset.millimetres, judged ? std::optional(value * std::cos(glm::radians(kElevation)) + 3 * texel) : std::nullopt,
               offset.cause, "tolerance times the cosine of the light's elevation, and three texels of the filter");
    }
    return {};
}

} // namespace

Result<void> measureShadow(const Context& context) {
    if (!context.wants("ShadowMap")) return {};
    const std::vector<Tolerances> all = {{kSettingSeed, {0, 1e-4, 1e-3, 5e-3, 2e-2, 1e-1}, 5e-3, true},
                                         {kSettingDeon2007, {0, 0.1, 0.3, 1, 2, 5}, 2, false},
                                         {kSettingCorrected, {0, 0.03, 0.1, 0.3, 1, 3, 10}, 0.3, false}};
    for (const Tolerances& tolerances : all) {
        const auto effect = load(context, context.options.effects / "ShadowMap.fx", tolerances.setting);
        if (!effect) return effect.error();
        if (const auto swept = sweep(context, *effect, tolerances); !swept) return swept.error();
    }
    return {};
}

} // namespace tegument::bench::stability
