#include "lab/verify/fur_regression.h"

#include "generated/setting_names.h"
#include "host/image/compare.h"
#include "host/image/dds.h"
#include "host/support/parallel.h"
#include "host/support/temporary.h"
#include "lab/verify/corner_grid.h"
#include "lab/verify/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unistd.h>

namespace tegument::verify {

namespace {

using reference::FurFragment;

namespace fs = std::filesystem;

/// A share of a pixel that is not seen.
constexpr double kUntold = 0.01;
constexpr double kTolerance = 0.005; // of the shadow's comparison, share of the mesh's radius

/// The roots as a file for the renderer, removed in the end.
class RootFile {
public:
    RootFile() : file_(fs::temp_directory_path() / fmt::format("tegument-verify-roots-{}.dds", ::getpid())) {}
    Result<void> write(const Image& roots) const { return writeDds(file_.path(), makeDds(roots, DdsFormat::Rgba32F, false)); }
    [[nodiscard]] std::string path() const { return file_.path().string(); }

private:
    Temporary file_;
};

struct LayersView {
    LayersView(const StrandsScene& strands, const VerifyOptions& options, double grid)
        : scene(strands), truth(truthOf(strands.scene, options)),
          shells(strands.scene.mesh, strands.coat, truth.camera, strands.grown, grid), light{truth.light.eye, truth.skin.lightColour()},
          eye{truth.camera.eye, 2 * truth.camera.tangentX / truth.camera.width},
          tolerance(kTolerance * static_cast<double>(strands.scene.mesh.bounds.radius)), filtered(options.setting == kSettingCorrected) {}

    const StrandsScene& scene;
    Truth truth;
    reference::FurShells shells;
    reference::FurLight light;
    reference::FurEye eye;
    double tolerance; // mm
    bool filtered;    // the skin's shadow: elsewhere one texel is looked up for it as for strands

    /// Whether the skin met by the light's ray through `at` lies before this point of the coat.
    [[nodiscard]] bool lit(const FurFragment& fragment, const glm::dvec3& at) const {
        const auto hit = truth.skin.rays().nearest(truth.light.eye, glm::normalize(at - truth.light.eye));
        return !hit || glm::length(fragment.position - truth.light.eye) - tolerance <= hit->distance;
    }
    [[nodiscard]] bool lit(const FurFragment& fragment) const {
        return isFiltered(fragment) ? truth.skin.lit(onSkin(fragment)) : lit(fragment, fragment.position);
    }
    /// Where one texel is looked up its centre lies up to half a texel aside along both axes: all say the same.
    [[nodiscard]] bool shadowIsTold(const FurFragment& fragment) const {
        if (isFiltered(fragment)) return !truth.skin.nearShadowEdge(onSkin(fragment), kShadowEdge);
        // What the coat has outside of the light's pyramid, which is fitted to the mesh, is looked up at the map's border.
        const glm::dvec2 onMap = truth.light.project(fragment.position);
        if (std::min({onMap.x, onMap.y, 1 - onMap.x, 1 - onMap.y}) < 0) return false;
        const bool here = lit(fragment);
        const double step = 0.55 * truth.light.footprint(glm::dot(fragment.position - truth.light.eye, truth.light.forward));
        for (const glm::dvec2& offset : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)})
            if (lit(fragment, fragment.position + step * (offset.x * truth.light.right + offset.y * truth.light.up)) != here) return false;
        return true;
    }

private:
    [[nodiscard]] bool isFiltered(const FurFragment& fragment) const { return filtered && fragment.layer == 0; }
    static reference::SurfacePoint onSkin(const FurFragment& fragment) {
        return {.place = {}, .position = fragment.position, .normal = fragment.normal};
    }
};

/// What a pixel shows, fragment after fragment.
struct Shown {
    const FurFragment* fragment = nullptr;
    reference::FurMet met;
    double weight = 0;
};

/// Depth test and blending. `decided` becomes false where rounding says which layers are drawn.
std::vector<Shown> blend(const LayersView& view, const std::vector<FurFragment>& fragments, bool& decided) {
    std::vector<Shown> shown;
    double nearest = std::numeric_limits<double>::infinity();
    for (const FurFragment& fragment : fragments) {
        if (fragment.depth > nearest) continue;
        reference::FurMet met{.covered = 1};
        if (fragment.layer > 0) {
            const auto seen = reference::sweepLayer(view.scene.fur, view.scene.strands, fragment, view.shells.facet(fragment), view.eye);
            decided = decided && seen.decided;
            if (!seen.drawn) continue;
            met = seen.met;
        }
        for (Shown& below : shown)
            below.weight *= 1 - met.covered;
        shown.push_back({&fragment, met, met.covered});
        nearest = fragment.depth;
    }
    return shown;
}

} // namespace

SweptPicture drawSwept(const StrandsScene& scene, const VerifyOptions& options, double grid) {
    const LayersView view(scene, options, grid);
    const glm::dvec3 background(scene.scene.workspace.background);
    const int size = view.truth.camera.width;
    const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    SweptPicture drawn{.picture = plainImage(size, size, 3)};
    drawn.counts.resize(pixels);
    drawn.covered.resize(pixels);
    forEachInParallel(pixels, [&](std::size_t pixel) {
        const int x = static_cast<int>(pixel % static_cast<std::size_t>(size));
        const int y = static_cast<int>(pixel / static_cast<std::size_t>(size));
        glm::dvec3 sum = background;
        bool told = view.shells.isClear(x, y);
        for (const Shown& shown : blend(view, view.shells.at(x, y), told)) {
            const FurFragment& fragment = *shown.fragment;
            const bool lit = view.lit(fragment);
            const glm::dvec3 radiance =
                fragment.layer == 0 ? reference::furRadiance(view.scene.coat, fragment, view.light, view.eye.position, lit)
                                    : reference::sweptRadiance(view.scene.coat, fragment, shown.met, view.light, view.eye.position, lit);
            sum += shown.weight * (radiance - background);
            told = told && (shown.weight < kUntold || view.shadowIsTold(fragment));
        }
        for (int c = 0; c < 3; ++c)
            drawn.picture.at(x, y, c) = static_cast<float>(sum[c]);
        drawn.counts[pixel] = told ? 1 : 0;
        drawn.covered[pixel] = view.shells.at(x, y).empty() ? 0 : 1;
    });
    return drawn;
}

double mostApart(double share, const VerifyOptions& options) {
    return std::min(1.0, share * 256 / options.mapSize);
}

Result<Image> renderStrands(const Context& context, const StrandsScene& scene, const StrandsBy& by) {
    Workspace workspace = scene.scene.workspace;
    const RootFile file;
    if (!scene.roots.pixels.empty()) {
        if (const auto written = file.write(scene.roots); !written) return written.error();
        workspace.textures["gFurRootsMap"] = file.path();
    }
    const int size = context.options.pictureSize;
    const auto run = render(context,
                            {.effect = by.effect,
                             .technique = by.technique.empty() ? scene.technique : by.technique,
                             .size = size,
                             .parameters = parametersOf(scene)},
                            by.mesh ? by.mesh : &scene.scene.mesh, workspace);
    if (!run) return run.error();
    return rgb(run->image);
}

namespace {

Limits layersLimits(const Context& context, bool far) {
    if (far)
        return {.relativeL2 = 0.015,
                .p99 = 0.05,
                .bias = 5e-3,
                .apart = 0.3,
                .why = "coverage to expect: the trapezoid of the strands' radii at the ends of a segment stands for their integral"};
    const bool corrected = context.options.setting == kSettingCorrected;
    return {.relativeL2 = corrected ? 0.02 : 0.03,
            .p99 = corrected ? 1e-3 : 0.02,
            .p999 = 0.1,
            .bias = 1e-3,
            .apart = 0.3,
            .why = corrected
                       ? "single pixels where rounding decides: whether a ray grazes a strand, which of two layers at one depth is seen"
                       : "the shadow's tolerance is a share of z/w, which is not quite that share of the way to the light"};
}

/// A tenth more than lavapipe has. In the printed settings the skin's shadow is one texel, too.
double mostApartOf(const Context& context, bool far) {
    if (context.options.setting == kSettingCorrected) return far ? 0.21 : 0.13;
    return far ? 0.65 : 0.38;
}

Result<void> checkPart(ModuleReport& report, const Context& context, const StrandsScene& scene, bool far, double grid) {
    const auto rendered = renderStrands(context, scene);
    if (!rendered) return rendered.error();
    const SweptPicture swept = drawSwept(scene, context.options, grid);
    const std::string subject = fmt::format("{}, {}, regression", scene.technique, scene.name);
    const auto compared =
        compare(report, context, {subject, *rendered, swept.picture, swept.counts, swept.covered}, layersLimits(context, far));
    if (!compared) return compared;
    addMetric(report, context, subject + ": set apart", shareApart(swept.counts, swept.covered),
              mostApart(mostApartOf(context, far), context.options), kShadowApart);
    noteApart(report, subject, swept.counts, swept.covered,
              "outlines of any layer within 1/128 pixel; strands, and skin in the printed settings, half a texel of the shadow map from "
              "where light is cut off, or outside of it; skin " +
                  std::string(kShadowApart));
    return {};
}

} // namespace

Result<void> checkSwept(ModuleReport& report, const Context& context) {
    const auto grid = measureCornerGrid(context);
    if (!grid) return grid.error();
    report.notes.push_back(fmt::format("corners: places drawn are {:.2g} pixels (RMS) from those between exact corners{}", grid->exact,
                                       grid->step > 0 ? fmt::format(", {:.2g} from those between corners moved to a grid of 1/{:.0f} pixel",
                                                                    grid->remaining, 1 / grid->step)
                                                      : ""));
    for (const char* technique : {"Cellular", "Roots"})
        for (const bool far : {false, true}) {
            const auto scene = far ? strandsFarAway(context.options, technique) : strandsNearBy(context.options, technique);
            if (!scene) return scene.error();
            if (const auto checked = checkPart(report, context, *scene, far, grid->step); !checked) return checked;
        }
    return {};
}

} // namespace tegument::verify
