#include "lab/verify/fur_exact.h"

#include "generated/setting_names.h"
#include "host/support/parallel.h"
#include "lab/verify/fur_regression.h"
#include "lab/verify/truth.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::verify {

namespace {

using reference::FurExact;
using reference::FurFragment;

int heightOf(const FurWindow& window) {
    return window.height > 0 ? window.height : window.size;
}

/// The window as one sees it who knows only strands, skin and light.
struct Sight {
    Sight(const FurWindow& window, const VerifyOptions& options)
        : scene(window.strands), truth(truthOf(window.strands.scene, options)), samples(window.samples), rays(truth.camera),
          strands(truth.skin.rays(), window.shape, strandsOf(window, truth.skin.rays(), truth.camera), window.pieces),
          light{truth.light.eye, truth.skin.lightColour()} {
        const int height = heightOf(window);
        rays.tangentY *= static_cast<double>(height) / rays.height;
        rays.width *= samples;
        rays.height = height * samples;
    }

    const StrandsScene& scene;
    Truth truth;
    int samples;
    reference::Pinhole rays; // a pixel of this one is a sample
    FurExact strands;
    reference::FurLight light;

    struct Seen {
        glm::dvec3 radiance{0};
        bool covered = false;
        bool told = true; // whether the shadow map can say what the light's ray says
    };

    [[nodiscard]] Seen look(int x, int y, bool asksShadow) const {
        const glm::dvec3 direction = rays.ray(x, y);
        const auto hit = strands.meet(rays.eye, direction);
        if (!hit) return {.radiance = glm::dvec3(scene.scene.workspace.background)};
        const FurFragment at = fragmentOf(*hit, rays.eye + hit->distance * direction);
        const bool lit = isLit(at, at.position);
        reference::FurCoat coat = scene.coat;
        if (hit->strand) coat.kajiyaKay = 1; // strands are lit as strands whatever lights the skin
        const glm::dvec3 albedo = reference::furAlbedo(coat, hit->along) * (hit->strand ? hit->strand->tint : 1.0);
        return {.radiance = reference::furRadiance(coat, at, albedo, light, rays.eye, lit),
                .covered = true,
                .told = !asksShadow || shadowIsTold(at, lit)};
    }

private:
    static FurFragment fragmentOf(const FurExact::Hit& hit, const glm::dvec3& position) {
        return {.layer = hit.strand ? 1 : 0,
                .height = hit.height,
                .normal = hit.normal,
                .position = position,
                .lean = hit.strand ? hit.strand->lean : glm::dvec3(0)};
    }

    /// Whether the light's ray through `through` meets no skin before it comes as far as the point, but for `slack` radii of the mesh.
    [[nodiscard]] bool isLit(const FurFragment& at, const glm::dvec3& through, double slack = 1e-5) const {
        slack *= static_cast<double>(scene.scene.mesh.bounds.radius);
        const auto hit = truth.skin.rays().nearest(light.position, glm::normalize(through - light.position));
        return !hit || glm::length(at.position - light.position) <= hit->distance + slack;
    }

    [[nodiscard]] bool shadowIsTold(const FurFragment& at, bool lit) const {
        if (at.layer == 0) return !truth.skin.nearShadowEdge({.position = at.position, .normal = at.normal}, kShadowEdge);
        const double texel = truth.light.footprint(glm::dot(at.position - light.position, truth.light.forward));
        // One texel is looked up, whose centre lies up to half a texel aside, where the skin may be that much nearer to the light.
        constexpr double kAside = 0.55;
        constexpr double kTolerance = 0.005;
        for (const glm::dvec2& offset : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)})
            if (isLit(at, at.position + kAside * texel * (offset.x * truth.light.right + offset.y * truth.light.up), kTolerance) != lit)
                return false;
        return true;
    }
};

} // namespace

ExactPicture drawExact(const FurWindow& window, const VerifyOptions& options) {
    VerifyOptions own = options;
    own.pictureSize = window.size;
    const Sight sight(window, own);
    const auto width = static_cast<std::size_t>(window.size);
    const std::size_t pixels = width * static_cast<std::size_t>(heightOf(window));
    ExactPicture exact{.picture = plainImage(window.size, heightOf(window), 3),
                       .counts = std::vector<std::uint8_t>(pixels),
                       .covered = std::vector<std::uint8_t>(pixels)};
    forEachInParallel(pixels, [&](std::size_t pixel) {
        const int x = static_cast<int>(pixel % width);
        const int y = static_cast<int>(pixel / width);
        glm::dvec3 sum(0);
        bool told = true;
        bool covered = false;
        for (int j = 0; j < window.samples; ++j)
            for (int i = 0; i < window.samples; ++i) {
                // Every other sample along each side asks what shadows are near: they are wider than that.
                const bool asks = window.asks && i % 2 == 0 && j % 2 == 0;
                const Sight::Seen seen = sight.look(x * window.samples + i, y * window.samples + j, asks);
                sum += seen.radiance;
                told = told && seen.told;
                covered = covered || seen.covered;
            }
        for (int c = 0; c < 3; ++c)
            exact.picture.at(x, y, c) = static_cast<float>(sum[c] / (window.samples * window.samples));
        exact.counts[pixel] = told && covered ? 1 : 0;
        exact.covered[pixel] = covered ? 1 : 0;
    });
    return exact;
}

namespace {

/// The printed settings throw false shadows upon the skin between strands: one comparison, no slope (docs/design/modules/TSM.md).
Limits limitsOf(const Context& context, const WindowLimits& window) {
    const bool corrected = context.options.setting == kSettingCorrected;
    return {.relativeL2 = corrected ? window.relativeL2 : 2.2 * window.relativeL2,
            .bias = corrected ? window.bias : window.bias + 0.02,
            .why = corrected ? window.why : std::string(window.why) + "; false shadows of the printed comparison"};
}

Result<void> judge(ModuleReport& report, const Context& context, const FurWindow& window) {
    VerifyOptions own = context.options;
    own.pictureSize = window.size;
    const auto rendered = renderStrands({context.device, own}, window.strands);
    if (!rendered) return rendered.error();
    const ExactPicture exact = drawExact(window, context.options);
    const std::string subject = fmt::format("{}, {}", window.strands.technique, window.strands.name);
    const auto compared =
        compare(report, context, {subject, *rendered, exact.picture, exact.counts, exact.covered}, limitsOf(context, window.limits));
    if (!compared) return compared;
    const char* const apart =
        "where light is cut off: strands half a texel of the shadow map from there, skin three, or seen edge-on by it";
    addMetric(report, context, subject + ": set apart", shareApart(exact.counts, exact.covered),
              mostApart(window.limits.apart, context.options), apart);
    noteApart(report, subject, exact.counts, exact.covered, apart);
    return {};
}

} // namespace

Result<void> judgeStrands(ModuleReport& report, const Context& context) {
    for (const std::string& name : windowNames(context.options))
        for (const char* technique : {"Cellular", "Roots"}) {
            const auto window = makeWindow(context.options, technique, name);
            if (!window) return window.error();
            if (const auto judged = judge(report, context, *window); !judged) return judged;
        }
    return {};
}

} // namespace tegument::verify
