// The reflection at grazing angles and for narrow lobes, and the two precomputed tables at their edges.

#include "generated/setting_names.h"
#include "lab/reference/skin.h"
#include "lab/reference/specular.h"
#include "lab/stability/work.h"
#include "lab/verify/truth.h"
#include "lab/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace tegument::bench::stability {

namespace {

constexpr double kSmallestRoughness = 1e-3; // docs/design/modules/Beckmann.md: smaller m count as this
constexpr double kUsual = 0.05;             // the smallest that the effects' sliders offer

/// Where the eye and the light of one picture stand, seen from the middle of the cap: degrees from its pole.
struct Directions {
    double eye = 0;
    double light = 0;
};
constexpr double kWholeCap = 89; // degrees
constexpr std::array kWide = {Directions{0, 0}, Directions{0, 60}, Directions{0, 89}, Directions{80, -80}, Directions{85, -85}};
/// The highlight is on the pole: only as much of the cap as the lobe covers.
constexpr std::array kNarrow = {Directions{0, 0}, Directions{30, -30}, Directions{80, -80}};

glm::dvec3 tilted(double degrees) {
    const double angle = glm::radians(degrees);
    return {std::sin(angle), 0, std::cos(angle)};
}

struct Lobe {
    double m = 0;
    double error = -1; // relative to the lobe's peak
    std::string cause;
    std::size_t notFinite = 0;
};

std::string causeOf(const reference::SkinScene& skin, const reference::SurfacePoint& point, const glm::dvec3& eye, int x, int y) {
    const glm::dvec3 n = glm::normalize(point.normal);
    const glm::dvec3 l = skin.toLight(point);
    const glm::dvec3 v = glm::normalize(eye - point.position);
    return fmt::format("pixel ({}, {}): N.L {:.3g}, N.V {:.3g}, N.H {:.7g}", x, y, glm::dot(n, l), glm::dot(n, v),
                       glm::dot(n, glm::normalize(l + v)));
}

/// A cap up to so many degrees from its pole, and what the pixels of one view of it see.
struct View {
    Directions directions;
    HardScene scene;
    verify::Scene stage; // the same, as the references take it
    verify::Truth truth;
    verify::Seen seen;
    std::vector<std::uint8_t> counts;

    View(const Context& context, const Directions& from, double degrees)
        : directions(from), scene(capScene(40, degrees, tilted(from.eye), tilted(from.light))), stage{scene.mesh, scene.workspace},
          truth(verify::truthOf(stage, {.mapSize = context.options.size, .pictureSize = 2 * context.options.size})),
          seen(verify::look(truth.skin, truth.camera)), counts(verify::interior(seen)) {}
};

/// Held against the formula at the place where each pixel's ray meets the mesh, with m no smaller than the effect takes it.
void judge(const Image& picture, const View& view, Lobe& lobe) {
    const reference::Lobe reflected{.m = std::max(lobe.m, kSmallestRoughness), .f0 = view.truth.skin.settings().fresnel0};
    for (int y = 0; y < view.seen.height; ++y)
        for (int x = 0; x < view.seen.width; ++x) {
            const std::size_t i = view.seen.index(x, y);
            if (view.counts[i] == 0) continue;
            const reference::SurfacePoint& point = *view.seen.pixels[i];
            const glm::dvec3 n = glm::normalize(point.normal);
            const glm::dvec3 l = view.truth.skin.toLight(point);
            const glm::dvec3 v = glm::normalize(view.truth.camera.eye - point.position);
            const glm::dvec3 h = glm::normalize(l + v);
            const double exact = std::max(0.0, glm::dot(n, l)) * reference::kelemenBrdf(n, l, v, reflected);
            const double peak = glm::dot(h, l) * reference::kelemenBrdf(h, l, v, reflected);
            const double error = std::abs(static_cast<double>(picture.at(x, y, 0)) - exact) / std::max(peak, 1e-30);
            if (error <= lobe.error) continue;
            lobe.error = error;
            lobe.cause = fmt::format("{}; eye at {:g}, light at {:g} degrees", causeOf(view.truth.skin, point, view.truth.camera.eye, x, y),
                                     view.directions.eye, view.directions.light);
        }
}

Result<void> measureLobe(const Context& context, const Effect& effect, View& view, Lobe& lobe) {
    context.say(fmt::format("roughness: m = {:g}, eye at {:g}, light at {:g} degrees", lobe.m, view.directions.eye, view.directions.light));
    view.scene.parameters = {{"gRoughness", {lobe.m}}, {"gSpecularIntensity", {1}}};
    const auto run = draw(context, effect, "SpecularUnshadowed", view.scene, view.seen.width);
    if (!run) return run.error();
    lobe.notFinite += notFinite(run->image).count;
    judge(run->image, view, lobe);
    return {};
}

/// In the wide views, and in narrow ones that the lobe fills.
Result<void> measureLobe(const Context& context, const Effect& effect, std::deque<View>& wide, Lobe& lobe) {
    for (View& view : wide)
        if (const auto measured = measureLobe(context, effect, view, lobe); !measured) return measured.error();
    // Four times m covers the lobe down to exp(-16).
    const double degrees = std::min(80.0, glm::degrees(4 * std::max(lobe.m, kSmallestRoughness)));
    for (const Directions& directions : kNarrow) {
        View view(context, directions, degrees);
        if (const auto measured = measureLobe(context, effect, view, lobe); !measured) return measured.error();
    }
    return {};
}

/// exp(-tan^2 / m^2) multiplies what N.H is off by. In software that is a few ULP of 32-bit floats, times 2 / m^2. A graphics chip snaps
/// vertices to 1/256 pixel: N.H then moves by m times that at the lobe's flank, and N.L by up to 1/100 of itself at grazing angles.
double lobeLimit(double m, bool software) {
    return 2e-6 / (m * m) + (software ? 1e-4 : 4e-4 / m + 4e-3);
}

Result<void> measureLobes(const Context& context) {
    const auto effect = load(context, context.options.effects / "Specular.fx", kSettingCorrected);
    if (!effect) return effect.error();
    std::deque<View> wide;
    for (const Directions& directions : kWide)
        wide.emplace_back(context, directions, kWholeCap);
    for (const double m : {1.0, 0.3, 0.1, 0.05, 0.03, 0.01, 0.003, 0.001, 0.0}) {
        Lobe lobe{.m = m};
        if (const auto measured = measureLobe(context, *effect, wide, lobe); !measured) return measured.error();
        context.report.rows.push_back(
            {.part = {},
             .module = "Specular",
             .hardCase = fmt::format("m = {:g}, {} views and lights up to 89 degrees", m, kWide.size() + kNarrow.size()),
             .figure = "largest error, of the lobe's peak",
             .value = lobe.error,
             .limit = m >= kUsual ? std::optional(lobeLimit(m, context.device.info().cpu)) : std::nullopt,
             .cause = lobe.cause,
             .notFinite = lobe.notFinite,
             .why = "rounding of N.H, 2e-6 / m^2; on a graphics chip vertices snapped to 1/256 pixel, 4e-4 / m + 4e-3"});
    }
    return {};
}

struct Table {
    const char* module;
    const char* map;
    double limit; // of the usual part, relative to the table's mean
};

/// The worst texel of one part of a precomputed table: cosine along x, m along y.
Worst worstTexel(const Image& rendered, const Image& exact, bool usual) {
    double sum = 0;
    for (const float value : exact.pixels)
        sum += static_cast<double>(value);
    const double mean = sum / static_cast<double>(exact.pixels.size());
    Worst worst;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            if (((y + 0.5) / exact.height >= kUsual) != usual) continue;
            const double error = std::abs(static_cast<double>(rendered.at(x, y, 0)) - static_cast<double>(exact.at(x, y, 0))) / mean;
            if (error > worst.value) worst = {error, x, y};
        }
    return worst;
}

Result<void> measureTable(const Context& context, const Table& table) {
    const auto report =
        verifyModule(context.device, table.module, {.effects = context.options.effects, .compiler = context.options.compiler});
    if (!report) return report.error();
    const auto picture = [&](PictureRole role) -> const Image& {
        return std::ranges::find_if(report->pictures, [&](const auto& p) { return p.subject == table.map && p.role == role; })->image;
    };
    const Image& rendered = picture(PictureRole::Rendered);
    const Image& exact = picture(PictureRole::Reference);
    for (const bool usual : {true, false}) {
        const Worst worst = worstTexel(rendered, exact, usual);
        context.report.rows.push_back(
            {.part = {},
             .module = table.module,
             .hardCase = usual ? fmt::format("m from {:g} to 1, every cosine", kUsual) : fmt::format("m below {:g}, every cosine", kUsual),
             .figure = "largest error, of the table's mean",
             .value = worst.value,
             .limit = usual ? std::optional(table.limit) : std::nullopt,
             .cause = fmt::format("texel ({}, {}): cosine {:.4g}, m {:.4g}", worst.x, worst.y, (worst.x + 0.5) / exact.width,
                                  (worst.y + 0.5) / exact.height),
             .notFinite = notFinite(rendered).count,
             .why = "docs/design/modules: a half; midpoints where the horizon cuts the lobe"});
    }
    return {};
}

} // namespace

Result<void> measureRoughness(const Context& context) {
    if (context.wants("Specular"))
        if (const auto measured = measureLobes(context); !measured) return measured.error();
    for (const Table& table : {Table{"Beckmann", "gBeckmannMap", 2.5e-3}, Table{"EnergyAttenuation", "gEnergyAttenuationMap", 0.1}}) {
        if (!context.wants(table.module)) continue;
        context.say(fmt::format("roughness: {}", table.module));
        if (const auto measured = measureTable(context, table); !measured) return measured.error();
    }
    return {};
}

} // namespace tegument::bench::stability
