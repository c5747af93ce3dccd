// Module Fur: the six techniques on a torus, and the layers drawn from outside on a ball, against every fragment of every layer by rays.

#include "lab/reference/fur.h"
#include "generated/setting_names.h"
#include "host/image/dds.h"
#include "host/support/temporary.h"
#include "lab/verify/fur_scene.h"
#include "lab/verify/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace tegument::verify {

namespace {

using reference::FurFragment;
using reference::FurVector;

namespace fs = std::filesystem;

struct Part {
    const char* technique;
    FurVector vector;
    bool cube;
};

constexpr std::array kParts = {Part{"CubePosition", FurVector::Position, true}, Part{"CubeNormal", FurVector::Normal, true},
                               Part{"CubeCombined", FurVector::Combined, true}, Part{"SpherePosition", FurVector::Position, false},
                               Part{"SphereNormal", FurVector::Normal, false},  Part{"SphereCombined", FurVector::Combined, false}};

/// A share of a pixel that is not seen.
constexpr double kUnseen = 0.01;

/// The maps as files for the renderer, removed in the end, and as the reference reads them.
class Maps {
public:
    Maps() : folder_(fs::temp_directory_path() / fmt::format("tegument-verify-fur-{}", ::getpid())) {}

    Result<void> write() {
        const Image sphere = furPattern(kSphereMapSize, 0);
        sphere_ = reference::Texture(sphere, false);
        // Floats: eight bits would be filtered in eight bits, and drown what is looked for.
        if (auto written = writeDds(file(false), makeDds(sphere, DdsFormat::Rgba32F, false)); !written) return written;
        DdsTexture cube{.format = DdsFormat::Rgba32F, .faces = 6, .mips = 1};
        for (std::size_t face = 0; face < faces_.size(); ++face) {
            faces_[face] = furPattern(kCubeMapSize, static_cast<int>(face) + 1);
            cube.images.push_back(faces_[face]);
        }
        return writeDds(file(true), cube);
    }
    [[nodiscard]] fs::path file(bool cube) const { return folder_.path() / (cube ? "cube.dds" : "sphere.dds"); }

    [[nodiscard]] double alpha(bool cube, const glm::dvec3& direction) const {
        return cube ? onFaces(direction) : sphere_.at(reference::onSphereMap(direction)).w;
    }

    /// Whether between the directions of two points, so many pixels apart, lies so little of the map that its finest level is looked up,
    /// bilinearly. In a cube's corners three texels meet, which devices join each in its way.
    [[nodiscard]] static bool isFine(bool cube, const glm::dvec3& a, const glm::dvec3& b, double pixels) {
        const double most = 0.8 * pixels; // at 1 the second level begins; devices estimate the distance
        if (!cube) return glm::length(reference::onSphereMap(a) - reference::onSphereMap(b)) * kSphereMapSize <= most;
        const reference::OnCube from = reference::onCubeMap(a);
        const glm::dvec2 inside = 0.5 - glm::abs(from.uv - 0.5); // from the face's nearest borders
        return std::max(inside.x, inside.y) * kCubeMapSize > 0.51 &&
               glm::length(from.uv - reference::onCubeFace(from.face, b)) * kCubeMapSize <= most;
    }

private:
    static constexpr int kCubeMapSize = 6;
    static constexpr int kSphereMapSize = 14;

    /// Bilinear across the edges of faces, as all devices but Direct3D 9's read cube maps.
    [[nodiscard]] double onFaces(const glm::dvec3& direction) const {
        const reference::OnCube place = reference::onCubeMap(direction);
        const glm::dvec2 texels = place.uv * static_cast<double>(kCubeMapSize) - 0.5;
        const glm::dvec2 low = glm::floor(texels);
        const glm::dvec2 part = texels - low;
        double sum = 0;
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i)
                sum += (i == 1 ? part.x : 1 - part.x) * (j == 1 ? part.y : 1 - part.y) *
                       texel(place.face, static_cast<int>(low.x) + i, static_cast<int>(low.y) + j);
        return sum;
    }
    /// Beyond an edge the texel next to it on the other face.
    [[nodiscard]] double texel(int face, int x, int y) const {
        const auto isOn = [](int i) { return i >= 0 && i < kCubeMapSize; };
        if (isOn(x) && isOn(y)) return static_cast<double>(faces_[static_cast<std::size_t>(face)].at(x, y, 3));
        const auto across = [&](int i) { return isOn(i) ? (i + 0.5) / kCubeMapSize : i < 0 ? -1e-9 : 1 + 1e-9; };
        const reference::OnCube there = reference::onCubeMap(reference::fromCubeMap({face, {across(x), across(y)}}));
        const glm::dvec2 place = glm::clamp(there.uv, 0.0, 1.0 - 1e-12) * static_cast<double>(kCubeMapSize);
        return static_cast<double>(
            faces_[static_cast<std::size_t>(there.face)].at(static_cast<int>(place.x), static_cast<int>(place.y), 3));
    }

    Temporary folder_;
    reference::Texture sphere_;
    std::array<Image, 6> faces_;
};

/// Light that reaches points of the coat, and whether a shadow map can tell.
struct Shadows {
    const Truth& truth;
    double tolerance; // mm

    [[nodiscard]] bool lit(const FurFragment& fragment) const {
        return truth.skin.rays().reaches(truth.light.eye, fragment.position, tolerance);
    }

    /// Within three texels all is light or all is shadow, however large the tolerance.
    [[nodiscard]] bool known(const FurFragment& fragment) const {
        const bool here = lit(fragment);
        const glm::dvec3 eye = truth.light.eye;
        const double step = kShadowEdge * truth.light.footprint(glm::dot(fragment.position - eye, truth.light.forward));
        if (truth.skin.rays().reaches(eye, fragment.position, tolerance + 2 * step) != here) return false;
        const glm::dvec3 toLight = glm::normalize(eye - fragment.position);
        const glm::dvec3 normal = glm::normalize(fragment.normal);
        const double cosine = glm::dot(normal, toLight);
        for (const glm::dvec2& offset : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
            glm::dvec3 aside = step * (offset.x * truth.light.right + offset.y * truth.light.up);
            if (cosine > kSmallestCosine) aside -= toLight * (glm::dot(normal, aside) / cosine); // as the shader's plane
            if (truth.skin.rays().reaches(eye, fragment.position + aside, tolerance) != here) return false;
        }
        return true;
    }

    static constexpr double kSmallestCosine = 0.15;
};

/// One view of one mesh: fragments are found once, and lit once, for all techniques.
class View {
public:
    View(const FurScene& scene, const VerifyOptions& options)
        : truth(truthOf(scene.scene, options)), shells(scene.scene.mesh, scene.coat, truth.camera),
          light{truth.light.eye, truth.skin.lightColour()}, shadows{truth, 0.005 * static_cast<double>(scene.scene.mesh.bounds.radius)} {}

    Truth truth;
    reference::FurShells shells;
    reference::FurLight light;
    Shadows shadows;
};

/// Whether the map's finest level is looked up, bilinearly, at this fragment. Asked also where a look-up finds nothing: it might have.
bool mapIsTold(const View& view, const Part& part, const FurFragment& fragment, int x, int y) {
    if (fragment.layer == 0) return true;
    const glm::dvec3 here = reference::furVector(part.vector, fragment);
    for (int j = -1; j <= 1; ++j) // a device takes differences within any of the four quads that hold the pixel
        for (int i = -1; i <= 1; ++i) {
            const FurFragment there = view.shells.onItsPlane(fragment, x + i, y + j);
            if (!Maps::isFine(part.cube, here, reference::furVector(part.vector, there), std::hypot(i, j))) return false;
        }
    return true;
}

struct Drawn {
    Image picture;
    std::vector<std::uint8_t> counts;
    std::vector<std::uint8_t> covered;
};

/// The reference's picture, and the pixels in which it has a say.
Drawn drawReference(const View& view, const Part& part, const Maps& maps, const glm::dvec3& background) {
    const int size = view.truth.camera.width;
    Drawn drawn{.picture = plainImage(size, size, 3)};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            glm::dvec3 sum = background;
            bool told = view.shells.isClear(x, y) && std::ranges::all_of(view.shells.at(x, y), [&](const FurFragment& fragment) {
                            return mapIsTold(view, part, fragment, x, y);
                        });
            const auto shares = reference::blendFur(view.shells.coat(), view.shells.at(x, y), [&](const FurFragment& fragment) {
                const double alpha = maps.alpha(part.cube, reference::furVector(part.vector, fragment));
                return reference::FurTexel{alpha, view.shells.footprint(part.vector, fragment, x, y)};
            });
            for (const auto& [fragment, weight] : shares) {
                const bool lit = view.shadows.lit(*fragment);
                sum +=
                    weight * (reference::furRadiance(view.shells.coat(), *fragment, view.light, view.truth.camera.eye, lit) - background);
                told = told && (weight < kUnseen || view.shadows.known(*fragment));
            }
            for (int c = 0; c < 3; ++c)
                drawn.picture.at(x, y, c) = static_cast<float>(sum[c]);
            drawn.counts.push_back(told ? 1 : 0);
            drawn.covered.push_back(view.shells.at(x, y).empty() ? 0 : 1);
        }
    return drawn;
}

Limits limitsOf(const Context& context, bool opaque) {
    if (context.options.setting != kSettingCorrected)
        return {
            .relativeL2 = 0.1, .bias = 0.02, .apart = 0.5, .why = "false shadows of the printed comparison (docs/design/modules/TSM.md)"};
    if (opaque)
        return {.relativeL2 = 0.02,
                .p99 = 0.02,
                .bias = 2e-3,
                .apart = 0.5,
                .why = "layers are opaque or not there: where the coverage is one half, rounding decides"};
    return {
        .relativeL2 = 5e-3,
        .p99 = 0.02,
        .p999 = 0.1,
        .bias = 2e-3,
        .apart = 0.3,
        .why = "graphics hardware has 8 bits of position between texels; a layer whose coverage is that of the alpha test is there or not"};
}

Result<void> comparePart(ModuleReport& report, const Context& context, const FurScene& scene, const View& view, const Part& part,
                         const Maps& maps) {
    const int size = context.options.pictureSize;
    Workspace workspace = scene.scene.workspace;
    workspace.textures[part.cube ? "gFurCubeMap" : "gFurSphereMap"] = maps.file(part.cube).string();
    const auto run =
        render(context, {.effect = "Fur.fx", .technique = part.technique, .size = size, .parameters = parametersOf(scene.coat)},
               &scene.scene.mesh, workspace);
    if (!run) return run.error();
    const Drawn exact = drawReference(view, part, maps, glm::dvec3(workspace.background));
    const std::string subject = fmt::format("{}, {}", part.technique, scene.name);
    const auto compared = compare(report, context, {subject, rgb(run->image), exact.picture, exact.counts, exact.covered},
                                  limitsOf(context, scene.coat.outerFirst));
    if (!compared) return compared;
    noteApart(report, subject, exact.counts, exact.covered,
              "outlines of any layer; where the map's texels are finer than the picture's; and what is " + std::string(kShadowApart));
    return {};
}

} // namespace

Result<ModuleReport> verifyFur(const Context& context) {
    ModuleReport report{.module = "Fur",
                        .summary = "Every pixel against the fragments of every layer by rays, blended in order; maps looked up bilinearly, "
                                   "shadows by rays, light by the formulas of docs/design/fur.md"};
    Maps maps;
    if (const auto written = maps.write(); !written) return written.error();
    const FurScene torus = furTorus(context.options);
    const View onTorus(torus, context.options);
    for (const Part& part : kParts)
        if (const auto compared = comparePart(report, context, torus, onTorus, part, maps); !compared) return compared.error();
    const FurScene afar = furAfar(context.options);
    const View fromAfar(afar, context.options);
    if (const auto compared = comparePart(report, context, afar, fromAfar, kParts[0], maps); !compared) return compared.error();
    const FurScene before = furBefore(context.options);
    const View onBefore(before, context.options);
    if (const auto compared = comparePart(report, context, before, onBefore, kParts[0], maps); !compared) return compared.error();
    const FurScene ball = furBall(context.options);
    const View onBall(ball, context.options);
    if (const auto compared = comparePart(report, context, ball, onBall, kParts[0], maps); !compared) return compared.error();
    return report;
}

} // namespace tegument::verify
