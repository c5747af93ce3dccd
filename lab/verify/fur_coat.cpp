// Module FurCoat.

#include "generated/setting_names.h"
#include "lab/verify/fur_exact.h"
#include "lab/verify/fur_regression.h"
#include "lab/verify/work.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument::verify {

namespace {

struct Techniques {
    const char* name;
    WindowLimits limits;
};

/// What ribbons are judged by in each window.
struct Window {
    const char* name;
    std::array<Techniques, 2> techniques;
};

// Limits: a tenth more than lavapipe draws with 64 or 128 pixels a side in the worst of the three settings. The errors have three causes:
// one sample to a pixel, as of FurRoots; edges blended in the mesh's order; and
const char* const kOnPlane = "edges are blended in the mesh's order; six segments for a curve";
const char* const kAlong = "a ribbon seen along its axis has no breadth, where a round strand shows its section";
const char* const kOnRough =
    "a ribbon bends as the skin at its root says, not as the skin below its tip: on a rough skin normals differ; and as on the torus";
const char* const kFromAfar = "strands thinner than a pixel stand for their coverage one by one, blended in the mesh's order";

const std::array kWindows = {
    Window{"plane", {{{"Strands", {0.225, 0.03, kOnPlane}}, {"StrandsSoft", {0.19, 0.05, kOnPlane}}}}},
    Window{"ball", {{{"Strands", {0.155, 0.044, kAlong}}, {"StrandsSoft", {0.145, 0.042, kAlong}}}}},
    Window{"torus", {{{"Strands", {0.295, 0.07, kAlong}}, {"StrandsSoft", {0.285, 0.098, kAlong}}}}},
    Window{"rough ball", {{{"Strands", {0.34, 0.045, kOnRough}}, {"StrandsSoft", {0.33, 0.07, kOnRough}}}}},
    Window{"ball from afar", {{{"Strands", {0.22, 0.088, kFromAfar}}, {"StrandsSoft", {0.22, 0.088, kFromAfar}}}}},
    Window{"mesh", {{{"Strands", {0.35, 0.1, kOnRough}}, {"StrandsSoft", {0.35, 0.1, kOnRough}}}}},
};

Result<void> judge(ModuleReport& report, const Context& context, const Window& of) {
    auto window = makeWindow(context.options, "Roots", of.name);
    if (!window) return window.error();
    window->shape.round = true;
    VerifyOptions own = context.options;
    own.pictureSize = window->size;
    Mesh furry = window->strands.scene.mesh;
    if (const auto grown = addRibbons(furry, window->strands.roots); !grown) return grown.error();
    const ExactPicture exact = drawExact(*window, context.options);
    for (const Techniques& technique : of.techniques) {
        const auto rendered =
            renderStrands({context.device, own}, window->strands, {.effect = "FurCoat.fx", .technique = technique.name, .mesh = &furry});
        if (!rendered) return rendered.error();
        const std::string subject = fmt::format("{}, {}", technique.name, of.name);
        const Limits limits{.relativeL2 = technique.limits.relativeL2, .bias = technique.limits.bias, .why = technique.limits.why};
        const auto compared = compare(report, context, {subject, *rendered, exact.picture, exact.counts, exact.covered}, limits);
        if (!compared) return compared;
    }
    const char* const apart =
        "where light is cut off: strands half a texel of the shadow map from there, skin three, or seen edge-on by it";
    addMetric(report, context, std::string(of.name) + ": set apart", shareApart(exact.counts, exact.covered),
              mostApart(window->limits.apart, context.options), apart);
    return {};
}

} // namespace

Result<ModuleReport> verifyFurCoat(const Context& context) {
    ModuleReport report{
        .module = "FurCoat",
        .summary = "Every pixel of techniques Strands and StrandsSoft against rays that meet round strands, cones that bend in space, and "
                   "skin, several to a pixel, lit and shadowed by rays; technique CoatChance against paths of light through its strands"};
    for (const std::string& name : windowNames(context.options)) {
        const auto found = std::ranges::find_if(kWindows, [&](const Window& window) { return name == window.name; });
        if (const auto judged = judge(report, context, *found); !judged) return judged.error();
    }
    if (context.options.setting == kSettingCorrected)
        if (const auto judged = judgeFibres(report, context); !judged) return judged.error();
    return report;
}

} // namespace tegument::verify
