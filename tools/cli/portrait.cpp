// tegument portrait: a head, however it lies in its file, as skin in a studio.

#include "host/mesh/extent.h"
#include "host/mesh/read_mesh.h"
#include "tools/cli/command_line.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/picture_files.h"
#include "tools/cli/unread.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct PortraitOptions {
    std::string head;
    std::string output;
    JobOptions job;
    PortraitHints hints;
    bool json = false;
};

/// Before what the command line sets, which wins.
constexpr std::array<const char*, 4> kStudio = {"TEGUMENT_SURROUNDINGS=1", "TEGUMENT_LAMPS=3", "gSurroundings=0.35",
                                                "gLightColor=1.1,1.05,1"};

JobOptions jobOf(const PortraitOptions& options) {
    JobOptions job = options.job;
    job.file = "Pyramid";
    job.technique = "PyramidLinked";
    job.scene.mesh = options.head;
    job.scene.portrait = options.hints;
    job.scene.portrait->unitMm = job.scene.unitMm;
    job.sets.assign(kStudio.begin(), kStudio.end());
    job.sets.insert(job.sets.end(), options.job.sets.begin(), options.job.sets.end());
    return job;
}

Json portraitJson(const Job& job, const gpu::Device& device, const fs::path& output) {
    const Mesh& mesh = job.scene.meshes.front();
    const glm::vec3 size = mesh.bounds.maximum - mesh.bounds.minimum;
    return {{"output", output.string()},
            {"guesses", job.scene.guesses},
            {"unit_mm", mesh.unitMm},
            {"size_mm", {size.x, size.y, size.z}},
            {"resolution", {job.run.width, job.run.height}},
            {"device", device.info().name}};
}

void printPortrait(const Job& job, const gpu::Device& device, const fs::path& output) {
    const Mesh& mesh = job.scene.meshes.front();
    const glm::dvec3 size(mesh.bounds.maximum - mesh.bounds.minimum);
    fmt::print("the mesh is {} x {} x {} mm: width, height, depth; drawn on {}\n", lengthText(size.x), lengthText(size.y),
               lengthText(size.z), device.info().name);
    if (!mesh.attribution.empty()) fmt::print("mesh: {}\n", mesh.attribution);
    fmt::print("wrote {}\n", output.string());
}

int portrait(const PortraitOptions& options) {
    const PictureOptions pictures{.output = options.output};
    const auto output = outputPath(pictures, fs::path(options.head));
    if (!output) return fail(output.error(), options.json);
    Progress progress;
    progress.say("reading");
    auto job = assets::loadJob(jobOf(options), MeshFor::Technique, false, [&](const std::string& made) {
        progress.clear();
        say(made);
    });
    progress.clear();
    if (!job) return fail(job.error(), options.json);
    for (const std::string& guess : job->scene.guesses)
        say(guess);
    warn(job->warnings);
    warn(job->scene.meshes.front().warnings);
    auto device = gpu::Device::create({.validation = options.job.validate, .prefer = options.job.device});
    if (!device) return fail(device.error(), options.json);
    job->run.compiling = [&](std::size_t done, std::size_t total) {
        done < total ? progress.count("compiling shader", done, total) : progress.say("rendering");
    };
    progress.say("rendering");
    auto result = assets::draw(*device, *job);
    progress.clear();
    if (!result) return fail(result.error(), options.json);
    std::ranges::move(unreadValues(options.job.sets, job->effect, *result), std::back_inserter(result->warnings));
    warn(result->warnings);
    if (const auto written = writePicture(pictures, *output, result->image); !written) return fail(written.error(), options.json);
    if (options.json)
        print(portraitJson(*job, *device, *output));
    else
        printPortrait(*job, *device, *output);
    return 0;
}

glm::dvec3 directionOf(const std::string& axis) {
    glm::dvec3 direction(0);
    direction[axis.back() - 'x'] = axis.front() == '-' ? -1 : 1;
    return direction;
}

} // namespace

void addPortrait(CLI::App& program, Action& action) {
    auto options = std::make_shared<PortraitOptions>();
    options->job.size = "1024x1024";
    CLI::App* command =
        program.add_subcommand("portrait", "Draw a head of any unit and orientation as skin in a studio; says what it guessed");
    command->add_option("head", options->head, fmt::format("Mesh of a head ({})", meshEndings()))->required();
    command->add_option("-o,--output", options->output, "Picture to write (.png, .jpg, .exr, .dds); default: out/<head>.png");
    const auto axis = oneOf({"x", "y", "z", "-x", "-y", "-z"});
    command
        ->add_option_function<std::string>(
            "--up", [options](const std::string& word) { options->hints.up = directionOf(word); },
            "Axis of the file that points up: x, y, z, -x, -y or -z, after '='; default: by the shape")
        ->transform(axis);
    command
        ->add_option_function<std::string>(
            "--front", [options](const std::string& word) { options->hints.front = directionOf(word); },
            "Axis of the file along which the face looks; default: by the shape")
        ->transform(axis);
    command
        ->add_option("--unit-mm", options->job.scene.unitMm, "Millimetres in one unit of the mesh file; default: by the size of the face")
        ->check(CLI::PositiveNumber);
    command->add_flag_function(
        "--flip-v", [options](std::int64_t flipped) { options->hints.flipV = flipped > 0; },
        "The file's v runs against its format's convention; =false: it does not; default: by lips and eyes in the colour map");
    command->add_flag_function(
        "--mirror", [options](std::int64_t mirrored) { options->hints.mirror = mirrored > 0; },
        "The file is mirrored: left and right change; =false: it is not; default: where its surface is inside out");
    command->add_option("--turn", options->job.scene.turn, "Degrees by which the head is turned, counter-clockwise seen from above");
    command->add_option("-p,--preset", options->job.preset, "Named values of parameters, such as oily: tegument info Pyramid");
    repeatable(
        command->add_option("-s,--set", options->job.sets,
                            "NAME=VALUE of effect Pyramid, as for render: gSkinMap=colour.jpg, gSurroundings=0.35; may be repeated"));
    command
        ->add_option("--size", options->job.size,
                     "Picture size in pixels: WIDTHxHEIGHT, or one number for a square; head and neck fit both")
        ->capture_default_str();
    command->add_option("--samples", options->job.samples, "Samples a pixel; default: 4")->check(CLI::IsMember({1, 2, 4, 8}));
    command->add_option("--map-size", options->job.effect.mapSize, "Texels along each side of the texture-space maps")
        ->check(CLI::Range(1, 16384));
    command->add_option("--compiler", options->job.compiler, "dxc or glslang; default: DXC where it is installed")
        ->transform(oneOf({"dxc", "glslang"}));
    command->add_option("--device", options->job.device, "Part of the Vulkan device's name; NAME#2: the second of that name");
    command->add_flag("--validate", options->job.validate, "Run under the Vulkan validation layers");
    command->add_flag("--json", options->json, "Print JSON");
    addExamples(*command, {{"portrait head.glb -o head.png", "any unit, any axes"},
                           {"portrait scan.obj --set gSkinMap=colour.jpg --size 900x1200 -o scan.jpg", "with a colour map of its own"},
                           {"portrait scan.stl --up=z --front=-y --unit-mm 1 -o scan.png", "nothing guessed"}});
    command->callback([options, &action] { action = [options] { return portrait(*options); }; });
}

} // namespace tegument::app
