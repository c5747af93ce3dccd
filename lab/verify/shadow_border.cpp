// How far the borders of shadows in the pyramid's picture lie from those of rays.

#include "lab/reference/profile.h"
#include "lab/verify/pyramid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::verify {

namespace {

constexpr int kBorderPicture = 1024; // its pixels are a tenth of a millimetre: less than what is measured
constexpr double kBorderReach = 5;   // mm
constexpr double kLeastCosine = 0.1; // N.L of the mesh: below it the mesh's own horizon is near
constexpr double kOnePlace = 1;      // mm between neighbouring pixels of one surface

/// Places where visibility passes a half, between neighbouring pixels.
template <class Visibility>
std::vector<glm::dvec3> bordersOf(const Truth& truth, const Seen& seen, Visibility visibility) {
    std::vector<glm::dvec3> borders;
    const auto counts = [&](std::size_t i) {
        return seen.pixels[i] && glm::dot(glm::normalize(seen.pixels[i]->normal), truth.skin.toLight(*seen.pixels[i])) > kLeastCosine;
    };
    for (int y = 0; y + 1 < seen.height; ++y)
        for (int x = 0; x + 1 < seen.width; ++x)
            for (const std::size_t there : {seen.index(x + 1, y), seen.index(x, y + 1)}) {
                const std::size_t here = seen.index(x, y);
                if (!counts(here) || !counts(there)) continue;
                const glm::dvec3& from = seen.pixels[here]->position;
                const glm::dvec3& to = seen.pixels[there]->position;
                const double a = visibility(here) - 0.5;
                const double b = visibility(there) - 0.5;
                if (a * b < 0 && glm::length(to - from) < kOnePlace) borders.push_back(glm::mix(from, to, a / (a - b)));
            }
    return borders;
}

struct Apart {
    double squares = 0;
    std::size_t near = 0;
    std::size_t far = 0; // farther than kBorderReach
};

void addApart(Apart& apart, const std::vector<glm::dvec3>& some, const std::vector<glm::dvec3>& others) {
    for (const glm::dvec3& place : some) {
        double least = kBorderReach * kBorderReach;
        for (const glm::dvec3& other : others) {
            const glm::dvec3 way = other - place;
            least = std::min(least, glm::dot(way, way));
        }
        if (least < kBorderReach * kBorderReach) {
            apart.squares += least;
            ++apart.near;
        } else {
            ++apart.far;
        }
    }
}

/// The bump throws its shadow over the body at N.L of about a third.
Scene lowLight(Scene scene) {
    scene.mesh.textures.clear();
    scene.workspace.light.position = {-560, 190, 210};
    scene.workspace.light.color = {1, 1, 1};
    return scene;
}

} // namespace

Result<void> verifyShadowBorder(ModuleReport& report, const Context& context) {
    VerifyOptions options = context.options;
    options.pictureSize = kBorderPicture;
    options.mesh = nullptr; // what is known of the border is of this body
    const Scene scene = lowLight(sceneOf(options));
    const Truth truth = truthOf(scene, options);
    const Seen seen = look(truth.skin, truth.camera);
    // All of the profile in the first Gaussian, which is the pixel's: the picture is colour, cosine and shadow.
    std::vector<double> narrow(24, 0);
    for (const std::size_t i : {0U, 1U, 2U})
        narrow[i] = 1;
    for (std::size_t i = 0; i < 6; ++i)
        narrow[4 * i + 3] = reference::skinProfile()[i].variance;
    const auto run = render(context, scene,
                            {.effect = "Pyramid.fx",
                             .technique = "Pyramid",
                             .size = kBorderPicture,
                             .parameters = {{"gGaussianWeight", narrow}, {"gSpecularIntensity", {0}}, {"gPlainIntensity", {0}}}});
    if (!run) return run.error();
    constexpr double kRed = 0.8; // of skin without a colour map
    const auto drawn = bordersOf(truth, seen, [&](std::size_t i) {
        const auto& point = *seen.pixels[i];
        const double cosine = glm::dot(glm::normalize(point.normal), truth.skin.toLight(point));
        return static_cast<double>(run->image.pixels[i * static_cast<std::size_t>(run->image.channels)]) / (kRed * cosine);
    });
    const auto exact = bordersOf(truth, seen, [&](std::size_t i) { return truth.skin.lit(*seen.pixels[i]) ? 1.0 : 0.0; });
    Apart apart;
    addApart(apart, drawn, exact);
    addApart(apart, exact, drawn);
    const double rms = apart.near > 0 ? std::sqrt(apart.squares / static_cast<double>(apart.near)) : kBorderReach;
    addMetric(report, context, "borders of shadows: mm from those of rays, rms", rms, 0.1,
              "texels of the shadow map of a third of a millimetre, smoothed; pixels of a tenth");
    addMetric(report, context, "borders of shadows: share farther than 5 mm from any of rays",
              apart.near > 0 ? static_cast<double>(apart.far) / static_cast<double>(apart.near) : 1, 0, "no shadow where rays see none");
    report.notes.push_back(fmt::format("borders of shadows at {} places of the picture, {} by rays", drawn.size(), exact.size()));
    return {};
}

} // namespace tegument::verify
