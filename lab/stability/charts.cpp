// Stretch and blurs under charts that are hard to blur in.

#include "generated/setting_names.h"
#include "lab/reference/profile.h"
#include "lab/stability/work.h"
#include "lab/verify/truth.h"
#include "lab/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::bench::stability {

namespace {

Worst largest(const Image& difference) {
    Worst worst;
    for (int y = 0; y < difference.height; ++y)
        for (int x = 0; x < difference.width; ++x)
            for (int c = 0; c < difference.channels; ++c)
                if (static_cast<double>(difference.at(x, y, c)) > worst.value) worst = {static_cast<double>(difference.at(x, y, c)), x, y};
    return worst;
}

/// Constant light stays what it is, however the charts are stretched: largest deviation from the sum of the weights.
Result<void> measureWhite(const Context& context, const Effect& effect, const char* technique, const HardScene& scene) {
    const auto run = draw(context, effect, technique, scene, context.options.size);
    if (!run) return run.error();
    Worst worst;
    std::size_t texels = 0;
    for (int y = 0; y < run->image.height; ++y)
        for (int x = 0; x < run->image.width; ++x) {
            if (run->image.at(x, y, 3) < 0.5F) continue; // outside the charts
            ++texels;
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(static_cast<double>(run->image.at(x, y, c)) - 1);
                if (error > worst.value || !std::isfinite(error)) worst = {error, x, y};
            }
        }
    context.report.rows.push_back({.part = {},
                                   .module = fmt::format("Convolution, {}", technique),
                                   .hardCase = scene.name,
                                   .figure = "largest deviation of constant light from 1",
                                   .value = worst.value,
                                   .limit = 1e-4,
                                   .cause = fmt::format("{} of {}", at("texel", worst), texels),
                                   .notFinite = notFinite(run->image).count,
                                   .why = "weights of valid texels are renormalised; the profile's columns sum to 1"});
    return {};
}

/// The cascade's answer to an edge of light, texel by texel, against the closed form at the place that the texel shows.
Result<void> measureEdge(const Context& context, const Effect& effect, const HardScene& scene) {
    constexpr double kBorder = 12; // mm from the edges of the plane: 4.4 sigma of the widest Gaussian
    constexpr double kHalfSide = 30;
    const auto run = draw(context, effect, "Convolution", scene, context.options.size);
    if (!run) return run.error();
    const verify::Seen seen = verify::lookUnwrapped(scene.mesh, context.options.size);
    Worst worst;
    double where = 0;
    std::size_t texels = 0;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const auto& point = seen.pixels[seen.index(x, y)];
            if (!point || std::max(std::abs(point->position.x), std::abs(point->position.y)) > kHalfSide - kBorder) continue;
            ++texels;
            const glm::dvec3 exact = reference::halfPlane(reference::skinProfile(), point->position.x);
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(static_cast<double>(run->image.at(x, y, c)) - exact[c]);
                if (error <= worst.value) continue;
                worst = {error, x, y};
                where = point->position.x;
            }
        }
    context.report.rows.push_back({.part = {},
                                   .module = "Convolution, Convolution",
                                   .hardCase = fmt::format("{}: an edge of light", scene.name),
                                   .figure = "largest difference from the closed form, of full light",
                                   .value = worst.value,
                                   .limit = std::nullopt,
                                   .cause = fmt::format("{}, {:.2g} mm from the edge, of {} texels", at("texel", worst), where, texels),
                                   .notFinite = notFinite(run->image).count});
    return {};
}

/// The shorter side of the first quad, texels.
double smallestQuad(const Mesh& mesh, int size) {
    const glm::vec2 a = mesh.uvs[mesh.indices[0]];
    const double along = static_cast<double>(glm::length(mesh.uvs[mesh.indices[1]] - a));
    const double across = static_cast<double>(glm::length(mesh.uvs[mesh.indices[2]] - mesh.uvs[mesh.indices[1]]));
    return size * std::min(along, across);
}

/// The module's own check on this scene; nothing where the chart has no texel whose neighbours all belong to it.
Result<void> measureStretch(const Context& context, const HardScene& scene) {
    constexpr const char* kMap = "gStretchMap";
    constexpr int kNothingToCompare = 5261;
    const auto report = verifyModule(context.device, "Stretch",
                                     {.effects = context.options.effects,
                                      .compiler = context.options.compiler,
                                      .mapSize = context.options.size,
                                      .pictureSize = context.options.size,
                                      .mesh = &scene.mesh,
                                      .workspace = &scene.workspace});
    if (!report && report.error().diagnostics.front().code == kNothingToCompare) return {};
    if (!report) return report.error();
    const auto metric = std::ranges::find(report->metrics, fmt::format("{}: rel_l2", kMap), &Metric::name);
    const auto picture = [&](PictureRole role) -> const Image& {
        return std::ranges::find_if(report->pictures, [&](const auto& p) { return p.subject == kMap && p.role == role; })->image;
    };
    const Worst worst = largest(picture(PictureRole::Difference));
    context.report.rows.push_back({.part = {},
                                   .module = "Stretch",
                                   .hardCase = scene.name,
                                   .figure = fmt::format("{}: relative L2", kMap),
                                   .value = metric->value,
                                   .limit = metric->limit + 1.0 / 256 / smallestQuad(scene.mesh, context.options.size),
                                   .cause = fmt::format("{} differs by {:.2g} of the mean", at("texel", worst), worst.value),
                                   .notFinite = notFinite(picture(PictureRole::Rendered)).count,
                                   .why = "the module's own limit, and 1/256 texel of a quad's side"});
    return {};
}

} // namespace

Result<void> measureCharts(const Context& context) {
    if (!context.wants("Convolution") && !context.wants("Stretch")) return {};
    const auto effect = load(context, context.options.effects / "Convolution.fx", kSettingCorrected, {{"TEGUMENT_MAP_BITS", "32"}});
    if (!effect) return effect.error();
    for (const HardScene& scene : chartScenes()) {
        context.say(fmt::format("charts: {}", scene.name));
        if (context.wants("Stretch"))
            if (const auto measured = measureStretch(context, scene); !measured) return measured.error();
        if (!context.wants("Convolution")) continue;
        for (const char* technique : {"White", "WhitePoisson"})
            if (const auto measured = measureWhite(context, *effect, technique, scene); !measured) return measured.error();
    }
    if (!context.wants("Convolution")) return {};
    for (const HardScene& scene : edgeScenes()) {
        context.say(fmt::format("charts: {}, an edge of light", scene.name));
        if (const auto measured = measureEdge(context, *effect, scene); !measured) return measured.error();
    }
    return {};
}

} // namespace tegument::bench::stability
