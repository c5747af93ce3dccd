// What lights skin besides the light of the workspace: lamps of each kind, their shadows and penumbras; surroundings.

#include "generated/setting_names.h"
#include "host/image/dds.h"
#include "host/support/temporary.h"
#include "lab/reference/picture.h"
#include "lab/verify/truth.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::verify {

namespace {

using reference::Lamp;
using reference::SurfacePoint;

constexpr double kEdgeOn = 0.15; // N.L below which a shadow map cannot tell

/// Parallel; a spot whose edge crosses the body; a point near by. Each has a size, and the bump throws its shadow along the body.
const std::vector<Lamp>& lamps() {
    static const std::vector<Lamp> kLamps = {
        {.place = {0.2, 0.85, 0.55, 0}, .colour = {0.25, 0.27, 0.30, 0}, .axis = {0, 0, -1, 0.15}},
        {.place = {-60, -240, 170, 1},
         .colour = {0.8, 0.7, 0.6, 300},
         .axis = glm::dvec4(glm::normalize(glm::dvec3(60, 240, -170)), 12),
         .spot = {0.997, 0.985, 1, 1}},
        {.place = {60, 170, 100, 1}, .colour = {0.3, 0.5, 0.7, 200}, .axis = {0, 0, -1, 15}, .spot = {-1, -2, 1, 0.5}}};
    return kLamps;
}

/// The scene with the lamp as the light of its workspace: what its shadow map cannot tell, that one's cannot.
Scene litBy(Scene scene, const Lamp& lamp) {
    scene.workspace.lightRelative = false;
    scene.workspace.light.fov.reset();
    scene.workspace.light.width.reset();
    scene.workspace.light.direction.reset();
    if (lamp.place.w > 0.5)
        scene.workspace.light.position = glm::vec3(lamp.place);
    else
        scene.workspace.light.direction = -glm::vec3(lamp.place);
    return scene;
}

/// Of these texels or pixels those whose shadows the maps of all lamps can tell.
std::vector<std::uint8_t> awayFromLampEdges(const Context& context, const Scene& scene, const Seen& seen, std::vector<std::uint8_t> mask) {
    for (const Lamp& lamp : lamps()) {
        const Scene lit = litBy(scene, lamp);
        const auto away = awayFromShadowEdges(truthOf(lit, context.options), seen);
        for (std::size_t i = 0; i < mask.size(); ++i)
            mask[i] = mask[i] != 0 && away[i] != 0 ? 1 : 0;
    }
    return mask;
}

reference::SkinScene skinUnder(const Context& context, const Scene& scene, reference::MoreLight more) {
    const Truth truth = truthOf(scene, context.options);
    return {scene.mesh, truth.light, truth.skin.lightColour(), truth.skin.settings(), std::move(more)};
}

/// Share of the lamp that is seen: of the nodes of its disc, by rays.
double seenOf(Lamp lamp, const reference::SkinScene& skin, const SurfacePoint& point, int side) {
    constexpr double kOutside = 200; // mm: leads out of the body from anywhere
    constexpr double kFacets = 0.3;  // mm by which a surface may lie before itself
    const glm::dvec3 normal = glm::normalize(point.normal);
    const auto visible = [&](const glm::dvec3& direction, double distance) {
        return skin.rays().reaches(point.position + std::min(distance, kOutside) * direction, point.position, kFacets);
    };
    lamp.spot = {-1, -2, 1, 1};
    const auto sum = [&](const reference::Visible& reaches) {
        double light = 0;
        for (const auto& beam : reference::beamsAt({.lamps = {lamp}, .lampSide = side}, {}, point.position, normal, reaches))
            light += beam.light.x;
        return light;
    };
    const double all = sum([](const auto&, double) { return true; });
    return all > 0 ? sum(visible) / all : 0;
}

RenderJob lampJob(const char* effect, const char* technique, int size) {
    return {.effect = effect,
            .technique = technique,
            .size = size,
            .parameters = reference::lampParameters(lamps()),
            .defines = {{"TEGUMENT_LAMPS", std::to_string(lamps().size())}}};
}

/// Texels that the lamp sees under more than this cosine.
std::vector<std::uint8_t> facing(const Seen& seen, const Lamp& lamp, double least) {
    auto mask = interior(seen);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0) continue;
        const SurfacePoint& point = *seen.pixels[i];
        const glm::dvec3 towards = lamp.place.w > 0.5 ? glm::dvec3(lamp.place) - point.position : glm::dvec3(lamp.place);
        if (glm::dot(glm::normalize(point.normal), glm::normalize(towards)) < least) mask[i] = 0;
    }
    return mask;
}

/// Lamp by lamp. In a penumbra what faces the lamp on all of its disc counts; else what is away from edges, lit or not.
Result<void> compareSeen(ModuleReport& report, const Context& context, const Scene& scene, bool soft) {
    constexpr int kNodes = 16; // across a lamp's disc
    const reference::SkinScene skin = skinUnder(context, scene, {});
    const Seen seen = lookUnwrapped(scene.mesh, context.options.mapSize);
    RenderJob job = lampJob("Main.fx", "Lambert", context.options.pictureSize);
    job.dump = {"gLampsSeenMap"};
    if (soft) job.defines.emplace_back("TEGUMENT_SOFT_SHADOWS", "1");
    const auto run = render(context, scene, job);
    if (!run) return run.error();
    const Limits penumbra{.relativeL2 = 0.04,
                          .p99 = 0.25,
                          .bias = 5e-3,
                          .why = "one width for all that hides a lamp (Fernando 2005), where a bump hides it by its sides"};
    for (std::size_t i = 0; i < lamps().size(); ++i) {
        const auto counts =
            soft ? facing(seen, lamps()[i], 2 * kEdgeOn) : awayFromShadowEdges(truthOf(litBy(scene, lamps()[i]), context.options), seen);
        const Image exact = paint(seen, 1, [&](const SurfacePoint& point, std::size_t pixel) {
            return counts[pixel] == 0 ? glm::dvec4(0) : glm::dvec4(seenOf(lamps()[i], skin, point, soft ? kNodes : 1));
        });
        const std::string subject = fmt::format("gLampsSeenMap, lamp {}{}", i + 1, soft ? ", penumbra" : "");
        noteApart(report, subject, counts, covered(seen), soft ? "N.L below 0.3" : kShadowApart);
        const auto done =
            compare(report, context, {subject, channel(run->dumped.at("gLampsSeenMap"), static_cast<int>(i)), exact, counts, {}},
                    soft ? penumbra : shadowLimits(context));
        if (!done) return done;
    }
    return {};
}

Result<void> compareLit(ModuleReport& report, const Context& context, const Scene& scene) {
    const Truth truth = truthOf(scene, context.options);
    const reference::SkinScene skin = skinUnder(context, scene, {.lamps = lamps()});
    RenderJob job = lampJob("Irradiance.fx", "Irradiance", context.options.mapSize);
    job.dump = {"gIrradianceMap"};
    const auto map = render(context, scene, job);
    if (!map) return map.error();
    const Seen texels = lookUnwrapped(scene.mesh, context.options.mapSize);
    const auto known = awayFromLampEdges(context, scene, texels, awayFromShadowEdges(truth, texels));
    const Image entering = paint(texels, 3, [&](const SurfacePoint& point, std::size_t) {
        return glm::dvec4(skin.entering(point, skin.lit(point)) + skin.enteringMore(point), 1);
    });
    const bool corrected = context.options.setting == kSettingCorrected;
    const Limits printed{.relativeL2 = 0.3, .bias = 0.06, .why = "false shadows of the printed comparison (docs/design/modules/TSM.md)"};
    const Limits right{.relativeL2 = 5e-3,
                       .p99 = 0.02,
                       .bias = 3e-3,
                       .why = "a half, truncated; 8 bits of position in the look-ups of colour and normal; the albedo table"};
    if (const auto done = compare(report, context, {"gIrradianceMap", rgb(map->dumped.at("gIrradianceMap")), entering, known, {}},
                                  corrected ? right : printed);
        !done)
        return done;
    noteApart(report, "gIrradianceMap", known, covered(texels), kShadowApart);
    const auto picture = render(context, scene, lampJob("Main.fx", "Lambert", context.options.pictureSize));
    if (!picture) return picture.error();
    const Seen seen = look(truth.skin, truth.camera);
    const auto counts = awayFromLampEdges(context, scene, seen, awayFromShadowEdges(truth, seen));
    const glm::dvec3 eye = truth.camera.eye;
    const Image exact = paint(seen, 3, [&](const SurfacePoint& point, std::size_t) {
        return glm::dvec4(reference::lambert(skin, point, eye) + skin.enteringMore(point) * skin.leaving(point, eye) +
                              skin.reflectedMore(point, skin.mappedNormal(point), eye),
                          1);
    });
    noteApart(report, "picture in four lights", counts, covered(seen), kShadowApart);
    return compare(report, context, {"picture in four lights", rgb(picture->image), exact, counts, {}}, corrected ? right : printed);
}

} // namespace

Result<ModuleReport> verifyLamps(const Context& context) {
    ModuleReport report{.module = "Lamps",
                        .summary =
                            "A parallel lamp, a spot and a point beside the light of the workspace: what is seen of each by rays, to its "
                            "centre or its whole disc; light that enters and is mirrored in double precision"};
    const Scene scene = sceneOf(context.options);
    for (const bool soft : {false, true})
        if (const auto done = compareSeen(report, context, scene, soft); !done) return done.error();
    if (const auto done = compareLit(report, context, scene); !done) return done.error();
    return report;
}

namespace {

/// The studio and what the body hides of it, as files that go with this.
class StudioFiles {
public:
    Result<void> make(const Mesh& mesh) {
        const auto studio = makeEnvironment(defaultEnvironment(DefaultEnvironment::Studio), "studio");
        if (!studio) return studio.error();
        const auto occlusion = bakeOcclusion(mesh, {.side = 256});
        if (!occlusion) return occlusion.error();
        if (const auto written = writeDds(file("studio"), *studio); !written) return written;
        return writeDds(file("occlusion"), makeDds(occlusion->map, DdsFormat::Rgba8, false));
    }
    [[nodiscard]] std::map<std::string, std::string> textures() const {
        return {{"gEnvironmentMap", file("studio").string()}, {"gOcclusionMap", file("occlusion").string()}};
    }

private:
    [[nodiscard]] std::filesystem::path file(const char* name) const { return folder_.path() / (std::string(name) + ".dds"); }

    Temporary folder_{std::filesystem::temp_directory_path() / fmt::format("tegument-verify-light-{}", ::getpid())};
};

struct StudioPart {
    const char* subject;
    double occlusion;   // gOcclusionShare
    double reflections; // gReflections
    Limits limits;
};

Result<void> compareStudio(ModuleReport& report, const Context& context, const Scene& scene, const StudioFiles& files,
                           const StudioPart& part) {
    constexpr int kRows = 40; // of the sky: pieces of 4 degrees, beside lobes of 17 and more
    const Image panorama = defaultEnvironment(DefaultEnvironment::Studio);
    const auto sky = reference::skyPieces(panorama, kRows);
    const reference::MoreLight more{.diffuseSky = sky, .specularSky = sky};
    const Truth truth = truthOf(scene, context.options);
    const reference::SkinScene skin = skinUnder(context, scene, more);
    const auto run = render(context, scene,
                            {.effect = "Main.fx",
                             .technique = "Lambert",
                             .size = context.options.pictureSize,
                             .parameters = {{"gOcclusionShare", {part.occlusion}}, {"gReflections", {part.reflections}}},
                             .defines = {{"TEGUMENT_SURROUNDINGS", "1"}},
                             .textures = files.textures()});
    if (!run) return run.error();
    const Seen seen = look(truth.skin, truth.camera);
    const glm::dvec3 eye = truth.camera.eye;
    const auto open = [&](const SurfacePoint& point, const glm::dvec3& normal) {
        return reference::beamsAt(more, sky, point.position, normal, [](const auto&, double) { return true; });
    };
    const Image exact = paint(seen, 3, [&](const SurfacePoint& point, std::size_t) {
        const glm::dvec3 normal = skin.mappedNormal(point);
        if (part.occlusion > 0)
            return glm::dvec4(
                skin.enteringMore(point) * skin.leaving(point, eye) + part.reflections * skin.reflectedMore(point, normal, eye), 1);
        glm::dvec3 light(0);
        for (const auto& beam : open(point, normal))
            light += beam.light * (glm::dot(normal, beam.towards) * skin.diffuseShare(glm::dot(normal, beam.towards)));
        return glm::dvec4(glm::pow(glm::dvec3(skin.colour(point)), glm::dvec3(skin.settings().mix)) * light * skin.leaving(point, eye), 1);
    });
    return compare(report, context, {part.subject, rgb(run->image), exact, interior(seen), {}}, part.limits);
}

} // namespace

Result<ModuleReport> verifySurroundings(const Context& context) {
    ModuleReport report{.module = "Surroundings",
                        .summary =
                            "The studio alone, as pieces of sky in double precision: all of it seen, what the body hides of it by rays, "
                            "and what is mirrored"};
    Scene scene = sceneOf(context.options);
    scene.workspace.light.color = glm::vec3(0);
    StudioFiles files;
    if (const auto made = files.make(scene.mesh); !made) return made.error();
    const bool corrected = context.options.setting == kSettingCorrected;
    const Limits printed{.relativeL2 = 0.06,
                         .p99 = 0.2,
                         .bias = 0.05,
                         .why =
                             "one share for all that crosses; the printed table takes nearly all at grazing angles, which one cosine does "
                             "not stand for"};
    const Limits open{.relativeL2 = 0.015,
                      .p99 = 0.055,
                      .bias = 8e-3,
                      .why = "one share for all that crosses, as of even light: of the studio's, which comes from above, less is mirrored"};
    const Limits hidden{
        .relativeL2 = 0.02, .p99 = 0.1, .bias = 0.011, .why = "one share, as of even light, and one direction for what is open"};
    const std::array parts = {StudioPart{"all of it is open", 0, 0, corrected ? open : printed},
                              StudioPart{"with what the body hides", 1, 0, corrected ? hidden : printed},
                              StudioPart{"with what is mirrored", 1, 1, corrected ? hidden : printed}};
    for (const StudioPart& part : parts)
        if (const auto done = compareStudio(report, context, scene, files, part); !done) return done.error();
    return report;
}

} // namespace tegument::verify
