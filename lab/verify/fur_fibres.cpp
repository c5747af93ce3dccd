// Technique CoatChance of FurCoat against light on paths through the very strands that it draws: a ball, a torus that shadows itself, or
// the options' mesh, in a coat of locks of one colour in each channel.

#include "host/image/dds.h"
#include "host/support/cache.h"
#include "host/support/temporary.h"
#include "lab/reference/fibre_paths.h"
#include "lab/verify/fur_scene.h"
#include "lab/verify/work.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/fur/roots/roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace tegument::verify {

namespace {

namespace fs = std::filesystem;

constexpr glm::dvec3 kFibreColours{0.1, 0.5, 0.9}; // of the three channels
constexpr std::size_t kFibreRoots = 12'000;
constexpr double kFibreRadius = 0.004;  // of the mesh's radius: as opaque a coat as 70,000 roots of a sixth of that make
constexpr double kFibreCoat = 0.1;      // likewise
constexpr double kFibreUndercoat = 0.1; // of the coat
constexpr double kFibreEye = 12;        // of the eye, radii
constexpr double kFibreSeen = 1.25;     // half of the picture's width, radii
constexpr int kFibreFiner = 4;          // pixels drawn for each of the truth, along a side
constexpr int kFibreBlock = 8;
constexpr int kFibreSegments = 6; // of a strand, of which a lock's has half

/// Largest distances of drawn to traced with the light at this angle from the direction to the eye.
struct FibrePhase {
    double degrees;
    glm::dvec3 means; // of the ratio from 1, of the three colours
    double blocks;
};

struct FibreShape {
    std::string name;
    Mesh mesh;
    glm::dvec3 toEye;
    std::vector<FibrePhase> phases;
};

/// The shape, and its strands as the effect has them in space.
struct FibreStage {
    Mesh skin;  // the layer below the strands
    Mesh furry; // with ribbons
    Image roots;
    glm::dvec3 toEye;
    Workspace workspace;
    std::map<std::string, std::vector<double>> parameters;
    std::vector<reference::FibreAxis> strands;
};

Workspace seenFrom(const FibreStage& stage, double side, double horizontalFov) {
    const glm::dvec3 centre(stage.skin.bounds.centre);
    Workspace workspace = stage.workspace;
    workspace.camera.position = glm::vec3(centre + side * kFibreEye * static_cast<double>(stage.skin.bounds.radius) * stage.toEye);
    workspace.camera.target = stage.skin.bounds.centre;
    workspace.camera.horizontalFov = static_cast<float>(glm::degrees(horizontalFov));
    return workspace;
}

double pictureFov() {
    return 2 * std::atan(kFibreSeen / kFibreEye);
}

Result<RunResult> renderStage(const Context& context, const FibreStage& stage, Workspace workspace, const std::string& technique, int size,
                              const std::vector<std::string>& dump) {
    const Temporary roots(fs::temp_directory_path() / fmt::format("tegument-verify-fibres-{}.dds", ::getpid()));
    if (const auto written = writeDds(roots.path(), makeDds(stage.roots, DdsFormat::Rgba32F, false)); !written) return written.error();
    workspace.textures["gFurRootsMap"] = roots.path().string();
    return render(context, {.effect = "FurCoat.fx", .technique = technique, .size = size, .dump = dump, .parameters = stage.parameters},
                  &stage.furry, workspace);
}

/// Axis and radius of each row of each strand, as CoatCompute notes them for both sides of the shape: an eye so narrow that no strand is
/// drawn wider than it is, and none is left out.
Result<void> takeStrands(const Context& context, FibreStage& stage) {
    constexpr double kNarrow = 1e-4; // radians
    constexpr int kPixels = 64;
    constexpr int kRows = kFibreSegments / 2 + 1;
    std::vector<Image> maps;
    for (const double side : {1.0, -1.0}) {
        auto run = renderStage(context, stage, seenFrom(stage, side, kNarrow), "CoatCompute", kPixels, {"gRibbonPlaceMap"});
        if (!run) return run.error();
        maps.push_back(std::move(run->dumped.at("gRibbonPlaceMap")));
    }
    const double edge = 0.5 * 2 * std::tan(kNarrow / 2) / kPixels * kFibreEye * static_cast<double>(stage.skin.bounds.radius); // gFurEdge
    const Image& front = maps[0];
    for (int y = 0; y + kRows <= front.height; y += kRows)
        for (int x = 0; x < front.width; ++x) {
            const auto seen =
                std::ranges::find_if(maps, [&](const Image& map) { return map.at(x, y, 3) > 0 && map.at(x, y + kRows - 1, 3) > 0; });
            if (seen == maps.end()) continue;
            reference::FibreAxis axis;
            for (int row = 0; row < kRows; ++row)
                axis.emplace_back(seen->at(x, y + row, 0), seen->at(x, y + row, 1), seen->at(x, y + row, 2),
                                  std::max(seen->at(x, y + row, 3) - static_cast<float>(edge), 0.0F));
            stage.strands.push_back(std::move(axis));
        }
    return {};
}

reference::FibreLight lightAtPhase(const FibreStage& stage, double phase) {
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), stage.toEye));
    const double angle = glm::radians(phase);
    return {.kind = reference::FibreLight::Kind::Parallel, .place = std::cos(angle) * stage.toEye - std::sin(angle) * right};
}

Result<FibreStage> makeStage(const Context& context, const FibreShape& shape) {
    FibreStage stage{.skin = shape.mesh, .furry = shape.mesh, .roots = {}, .toEye = shape.toEye, .workspace = worldWorkspace()};
    const auto radius = static_cast<double>(stage.furry.bounds.radius);
    for (std::size_t i = 0; i < stage.skin.positions.size(); ++i)
        stage.skin.positions[i] += static_cast<float>(kFibreUndercoat * kFibreCoat * radius) * stage.skin.normals[i];
    auto set = makeRoots(stage.furry, {.count = kFibreRoots, .shortest = 0.5, .furLength = kFibreCoat});
    if (!set) return set.error();
    auto texture = buildRootTexture(*set);
    if (!texture) return texture.error();
    stage.roots = std::move(texture->image);
    if (const auto ribbons = addRibbons(stage.furry, stage.roots); !ribbons) return ribbons.error();
    stage.workspace.head = false;
    stage.workspace.cameraRelative = false;
    stage.workspace.lightRelative = false;
    stage.workspace.background = glm::vec3(0);
    stage.workspace.light.color = glm::vec3(1);
    stage.workspace.light.direction = glm::vec3(-stage.toEye);
    // Tips are mixed with 1.2 times the colour half-way, a quarter of it on average.
    const auto colour = [](double by) { return std::vector<double>{kFibreColours.x * by, kFibreColours.y * by, kFibreColours.z * by}; };
    stage.parameters = {{"gFurLength", {kFibreCoat}},
                        {"gCoatRadius", {kFibreRadius}},
                        {"gCoatUndercoat", {kFibreUndercoat}},
                        {"gCoatSky", {0, 0, 0}}, // no light but the one that is traced
                        {"gCoatGround", {0, 0, 0}},
                        {"gCoatBelly", {0}},
                        {"gCoatVariation", {0}},
                        {"gCoatShort", {0}},
                        {"gCoatChildren", {4}},
                        {"gCoatUnderfur", {3}},
                        {"gCoatShortColor", {1, 1, 1}},
                        {"gCoatTipColor", colour(0.93)},
                        {"gCoatGuardColor", colour(1)},
                        {"gCoatUnderColor", colour(1)},
                        {"gCoatMidColor", colour(1)},
                        {"gCoatRootColor", colour(1)}};
    if (const auto taken = takeStrands(context, stage); !taken) return taken.error();
    return stage;
}

/// By paths; what has been traced once is kept in the cache, and an interrupted trace goes on.
reference::FibreSums traceStage(const FibreStage& stage, double phase, int size, std::uint64_t samples) {
    CacheKey key("fibres 4");
    key.add(phase).add(size).add(stage.toEye);
    for (const reference::FibreAxis& axis : stage.strands)
        key.add(axis);
    const fs::path file = fs::path("truth") / ("fibres_" + key.text() + ".bin");
    reference::FibreSums sums = reference::sumsOf(loadCachedList<double>(file).value_or(std::vector<double>()));
    if (sums.samples >= samples) return sums;
    const reference::FibrePaths paths({.strands = stage.strands,
                                       .colour = kFibreColours,
                                       .skin = &stage.skin,
                                       .skinColour = kFibreColours,
                                       .lights = {lightAtPhase(stage, phase)}});
    const auto radius = static_cast<double>(stage.skin.bounds.radius);
    const glm::dvec3 centre(stage.skin.bounds.centre);
    const reference::Pinhole camera =
        reference::pinhole(centre + kFibreEye * radius * stage.toEye, centre, {0, 1, 0}, pictureFov(), size, size);
    constexpr std::uint64_t kStep = 4; // samples that an interruption loses
    while (sums.samples < samples) {
        paths.trace(camera, std::min(sums.samples + kStep, samples), sums);
        storeCached(file, bytesOf(reference::numbersOf(sums)));
    }
    return sums;
}

/// As the effect draws it, more pixels a side, and averaged.
Result<Image> drawStage(const Context& context, const FibreStage& stage, double phase, int size) {
    Workspace workspace = seenFrom(stage, 1, pictureFov());
    workspace.light.direction = glm::vec3(-lightAtPhase(stage, phase).place);
    const auto run = renderStage(context, stage, workspace, "CoatChance", kFibreFiner * size, {});
    if (!run) return run.error();
    Image mean = plainImage(size, size, 3);
    for (int y = 0; y < kFibreFiner * size; ++y)
        for (int x = 0; x < kFibreFiner * size; ++x)
            for (int c = 0; c < 3; ++c)
                mean.at(x / kFibreFiner, y / kFibreFiner, c) += run->image.at(x, y, c) / (kFibreFiner * kFibreFiner);
    return mean;
}

/// Means over the picture, drawn over traced, of each channel; and the relative L2 of blocks of pixels, less the truth's noise.
struct FibreError {
    glm::dvec3 ratio{0};
    double blocks = 0;
    double noise = 0;
};

FibreError errorOf(const Image& drawn, const reference::FibreSums& truth) {
    const Image traced = truth.picture();
    FibreError error{.noise = truth.noise(kFibreBlock)};
    glm::dvec3 drawnSum(0), tracedSum(0);
    double apart = 0, all = 0;
    for (int top = 0; top + kFibreBlock <= traced.height; top += kFibreBlock)
        for (int left = 0; left + kFibreBlock <= traced.width; left += kFibreBlock)
            for (int c = 0; c < 3; ++c) {
                double a = 0, b = 0;
                for (int y = top; y < top + kFibreBlock; ++y)
                    for (int x = left; x < left + kFibreBlock; ++x) {
                        a += static_cast<double>(drawn.at(x, y, c));
                        b += static_cast<double>(traced.at(x, y, c));
                    }
                drawnSum[c] += a;
                tracedSum[c] += b;
                apart += (a - b) * (a - b);
                all += b * b;
            }
    error.ratio = drawnSum / glm::max(tracedSum, 1e-12);
    error.blocks = std::sqrt(std::max(apart / std::max(all, 1e-300) - error.noise * error.noise, 0.0));
    return error;
}

const char* const kOfFibres =
    "strands counted by the opacity map, not by rays; three parts of light in place of all paths; strands blended by chance";

/// Limits: a tenth to a third more than lavapipe draws with 32 and 64 pixels a side.
std::vector<FibreShape> shapes(const VerifyOptions& options) {
    if (options.mesh)
        return {{"mesh",
                 *options.mesh,
                 {0, 0, 1},
                 {{0, {0.25, 0.16, 0.12}, 0.18},
                  {60, {0.2, 0.12, 0.13}, 0.21},
                  {90, {0.27, 0.2, 0.14}, 0.26},
                  {120, {0.2, 0.25, 0.25}, 0.27},
                  {150, {0.25, 0.2, 0.2}, 0.27}}}};
    return {
        {"ball",
         verificationBall(96, 48),
         {0, 0, 1},
         {{0, {0.24, 0.16, 0.08}, 0.12}, {60, {0.1, 0.09, 0.16}, 0.19}, {120, {0.2, 0.2, 0.17}, 0.27}, {150, {0.24, 0.28, 0.28}, 0.39}}},
        {"torus",
         verificationTorus(96, 48),
         glm::normalize(glm::dvec3(0, 0.75, 0.66)),
         {{60, {0.13, 0.09, 0.11}, 0.15}, {90, {0.2, 0.09, 0.1}, 0.17}}}};
}

Result<void> judgeShape(ModuleReport& report, const Context& context, const FibreShape& shape) {
    const auto stage = makeStage(context, shape);
    if (!stage) return stage.error();
    const int size = std::clamp(context.options.pictureSize / 4, 32, 128);
    constexpr int kSamples = 64;
    for (const FibrePhase& phase : shape.phases) {
        const auto truth = traceStage(*stage, phase.degrees, size, kSamples);
        const auto drawn = drawStage(context, *stage, phase.degrees, size);
        if (!drawn) return drawn.error();
        const FibreError error = errorOf(*drawn, truth);
        const std::string subject = fmt::format("CoatChance, {}, paths of light, {:g} degrees", shape.name, phase.degrees);
        for (int c = 0; c < 3; ++c)
            addMetric(report, context, fmt::format("{}: mean, colour {:g}", subject, kFibreColours[c]), error.ratio[c] - 1, phase.means[c],
                      kOfFibres);
        addMetric(report, context, subject + ": blocks of 8 pixels", error.blocks, phase.blocks, kOfFibres);
        report.notes.push_back(fmt::format("{}: noise of the truth's blocks {:.3f}, subtracted", subject, error.noise));
        report.pictures.push_back({subject, PictureRole::Rendered, *drawn});
        report.pictures.push_back({subject, PictureRole::Reference, truth.picture()});
        report.pictures.push_back({subject, PictureRole::Difference, differenceImage(*drawn, truth.picture())});
    }
    return {};
}

} // namespace

Result<void> judgeFibres(ModuleReport& report, const Context& context) {
    for (const FibreShape& shape : shapes(context.options))
        if (const auto judged = judgeShape(report, context, shape); !judged) return judged.error();
    return {};
}

} // namespace tegument::verify
