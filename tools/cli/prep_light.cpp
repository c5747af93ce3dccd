// tegument prep environment, tegument prep occlusion: what surroundings light, and what of them a mesh hides from itself.

#include "host/image/dds.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/cli/prep_mesh.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace {

struct EnvironmentArguments {
    std::string input;
    std::string output = "environment.dds";
    bool studio = false;
    bool sky = false;
    bool json = false;
};

Result<Image> panoramaOf(const EnvironmentArguments& arguments) {
    const int given = (arguments.input.empty() ? 0 : 1) + (arguments.studio ? 1 : 0) + (arguments.sky ? 1 : 0);
    if (given != 1)
        return usageError(8005, "prep environment takes a picture, --studio or --sky",
                          "for example: tegument prep environment --studio -o studio.dds");
    if (arguments.studio) return defaultEnvironment(DefaultEnvironment::Studio);
    if (arguments.sky) return defaultEnvironment(DefaultEnvironment::Sky);
    return loadImage(arguments.input);
}

Json lightJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

int prepEnvironment(const EnvironmentArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {".dds"}); !can) return fail(can.error(), arguments.json);
    const auto panorama = panoramaOf(arguments);
    if (!panorama) return fail(panorama.error(), arguments.json);
    Progress progress;
    progress.say("filtering");
    const auto texture = makeEnvironment(*panorama, arguments.input);
    progress.clear();
    if (!texture) return fail(texture.error(), arguments.json);
    if (const auto written = writeDds(arguments.output, *texture); !written) return fail(written.error(), arguments.json);
    const EnvironmentLight light(*panorama);
    const auto harmonics = light.harmonics();
    const glm::dvec3 up = light.irradiance(glm::dvec3(0, 1, 0));
    const glm::dvec3 front = light.irradiance(glm::dvec3(0, 0, 1));
    const double error = harmonicError(light);
    if (arguments.json) {
        Json coefficients = Json::array();
        for (const glm::dvec3& c : harmonics)
            coefficients.push_back(lightJson(c));
        print({{"file", arguments.output},
               {"irradiance_over_pi", {{"up", lightJson(up)}, {"front", lightJson(front)}}},
               {"harmonics", coefficients},
               {"harmonics_error", error}});
        return 0;
    }
    fmt::print("irradiance / pi: {:.3f} {:.3f} {:.3f} facing up, {:.3f} {:.3f} {:.3f} facing +z\n", up.x, up.y, up.z, front.x, front.y,
               front.z);
    fmt::print("nine harmonics would miss it by up to {:.1f} % of the largest (--json has them); the cube map holds it as it is\n",
               100 * error);
    fmt::print("wrote {}\n", arguments.output);
    return 0;
}

struct OcclusionArguments {
    std::string input;
    std::string output = "occlusion.dds";
    MeshOptions mesh;
    OcclusionOptions occlusion;
    bool json = false;
};

int prepOcclusion(const OcclusionArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {".dds"}); !can) return fail(can.error(), arguments.json);
    Progress progress;
    progress.say("reading the mesh");
    const auto mesh = loadMesh(arguments.input, arguments.mesh);
    if (!mesh) return fail(mesh.error(), arguments.json);
    progress.say("casting rays");
    const auto occlusion = bakeOcclusion(*mesh, arguments.occlusion);
    progress.clear();
    if (!occlusion) return fail(occlusion.error(), arguments.json);
    if (const auto written = writeDds(arguments.output, makeDds(occlusion->map, DdsFormat::Rgba16F, false)); !written)
        return fail(written.error(), arguments.json);
    if (arguments.json) {
        print({{"file", arguments.output}, {"texels", occlusion->covered}, {"open", occlusion->open}, {"seconds", occlusion->seconds}});
        return 0;
    }
    fmt::print("{} texels, {:.1f} % open on average, {:.1f} s\nwrote {}\n", occlusion->covered, 100 * occlusion->open, occlusion->seconds,
               arguments.output);
    return 0;
}

void addEnvironment(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<EnvironmentArguments>();
    CLI::App* environment = command.add_subcommand("environment", "Make a cube map that lights skin from a panorama (docs/settings.md)");
    environment->add_option("panorama", arguments->input, "Equirectangular picture, linear: .hdr, .exr; its middle looks along -z");
    environment->add_flag("--studio", arguments->studio, "Instead: a soft box, a fill, two strips behind");
    environment->add_flag("--sky", arguments->sky, "Instead: a clear sky, the sun in front on the left");
    environment->add_option("-o,--output", arguments->output, "DDS to write")->capture_default_str();
    environment->add_flag("--json", arguments->json, "Print JSON, with nine coefficients of spherical harmonics");
    addExamples(*environment, {{"prep environment hall.hdr -o hall.dds",
                                "then: tegument render Pyramid --set TEGUMENT_SURROUNDINGS=1 --set gEnvironmentMap=hall.dds"},
                               {"prep environment --sky -o sky.dds", ""}});
    environment->callback([arguments, &action] { action = [arguments] { return prepEnvironment(*arguments); }; });
}

void addOcclusion(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<OcclusionArguments>();
    CLI::App* occlusion = command.add_subcommand("occlusion", "Bake what a mesh hides of its surroundings, by rays (docs/settings.md)");
    occlusion->add_option("mesh", arguments->input, "Mesh with texture coordinates, as the effect will draw it")->required();
    occlusion->add_option("-o,--output", arguments->output, "DDS to write: mean open direction, and share that is open")
        ->capture_default_str();
    occlusion->add_option("--unit-mm", arguments->mesh.unitMm, "Millimetres per unit of the mesh file");
    occlusion->add_option("--size", arguments->occlusion.side, "Side of the map in texels")
        ->check(CLI::Range(1, 8192))
        ->capture_default_str();
    occlusion->add_option("--rays", arguments->occlusion.rays, "Rays of a texel")->check(CLI::Range(1, 65536))->capture_default_str();
    occlusion->add_option("--reach", arguments->occlusion.reachMm, "What is farther away hides nothing, mm; 0: no limit")
        ->check(CLI::Range(0.0, 1e9))
        ->capture_default_str();
    occlusion->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*occlusion, {{"prep occlusion head.glb -o occlusion.dds", ""}});
    occlusion->callback([arguments, &action] { action = [arguments] { return prepOcclusion(*arguments); }; });
}

} // namespace

void addPrepLight(CLI::App& command, Action& action) {
    addEnvironment(command, action);
    addOcclusion(command, action);
}

} // namespace tegument::app
