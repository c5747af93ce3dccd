#include "tools/cli/job_options.h"

#include "host/mesh/read_mesh.h"
#include "tools/cli/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace tegument::app {

void addEffectOptions(CLI::App& command, EffectOptions& options) {
    repeatable(command.add_option("-D,--define", options.defines, "Preprocessor definition NAME or NAME=VALUE; may be repeated"));
    repeatable(command.add_option("-I,--include", options.includeFolders, "Folder searched for #include files; may be repeated"));
    command.add_flag("--anywhere", options.anywhere,
                     "Includes, and what effects and meshes name, may lie outside of their projects and -I");
    command.add_option("--setting", options.setting, "Setting of the effect, by name; tegument info lists them (docs/settings.md)");
    command.add_option("--map-size", options.mapSize, "Texels along each side of the texture-space maps")->check(CLI::Range(1, 16384));
    command
        .add_option("--shadow-size", options.shadowSize,
                    "Texels along each side of the maps seen from the light; default: as many as --map-size")
        ->check(CLI::Range(1, 16384));
}

namespace {

/// NAME=WEIGHT.
std::pair<std::string, double> morphOf(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    double weight = 0;
    const char* end = text.data() + text.size();
    const char* number = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto parsed = std::from_chars(number, end, weight);
    if (number == end || parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(weight))
        throw CLI::ValidationError("--morph " + text, "is not NAME=WEIGHT, such as smile=0.7");
    return {text.substr(0, equals), weight};
}

void addMotionOptions(CLI::App& command, PoseChoice& choice, CLI::Option* pose) {
    command.add_option("--animation", choice.animation, "Animation of the mesh file, by name or number; tegument info MESH lists them")
        ->excludes(pose);
    command
        .add_option_function<double>(
            "--time", [&choice](double seconds) { choice.time = seconds; },
            "Seconds of its animation, default: of the first; before its first and after its last key it stands still")
        ->check(CLI::Number)
        ->excludes(pose);
    repeatable(
        command.add_option_function<std::vector<std::string>>(
            "--morph",
            [&choice](const std::vector<std::string>& given) { std::ranges::transform(given, std::back_inserter(choice.morphs), morphOf); },
            "NAME=WEIGHT of a morph target of the mesh file, by name or number; may be repeated"))
        ->excludes(pose);
}

} // namespace

void addJobOptions(CLI::App& command, JobOptions& options) {
    command.add_option("effect", options.file, "Effect: a file (.fx), or the name of one of ours, such as Main")->required();
    command.add_option("-t,--technique", options.technique, "Technique; default: the one the effect's script names");
    command.add_option("-m,--mesh", options.scene.mesh, fmt::format("Mesh ({}); default: the workspace's", meshEndings()));
    CLI::Option* pose = command.add_option(
        "--pose", options.scene.pose, "The same mesh, bent: a file with its vertices moved; strands of FurCoat follow their triangles");
    command.add_option("--pose-before", options.scene.poseBefore, "The same in the frame before, for gMotionMap")->needs(pose);
    addMotionOptions(command, options.scene.motion, pose);
    command.add_option(
        "-w,--workspace", options.scene.workspace,
        "Workspace: a file (docs/workspace.md), or the name of one of ours, such as bunny; default: the one that the effect names, else "
        "human.json, of workspaces/ beside it");
    command.add_option("--unit-mm", options.scene.unitMm, "Millimetres in one unit of the mesh file")->check(CLI::PositiveNumber);
    command.add_flag_callback(
        "--head", [&options] { options.scene.head = true; }, "The mesh is a human head: refuse a size that no head has");
    command.add_flag_callback(
        "--no-head", [&options] { options.scene.head = false; }, "It is none, whatever the workspace says");
    command
        .add_option_function<std::string>(
            "--up", [&options](const std::string& axis) { options.scene.up = axis == "z" ? UpAxis::Z : UpAxis::Y; },
            fmt::format("Which axis of --mesh points up: y or z; default: {}", meshUps()))
        ->transform(oneOf({"y", "z"}));
    command.add_option(
        "--turn", options.scene.turn,
        "Degrees by which the scene is turned, counter-clockwise seen from above; camera and light stay: 180 shows the back");
    command.add_option("-p,--preset", options.preset,
                       "Named values of parameters, such as oily: those of NAME.presets.json beside NAME.fx");
    repeatable(
        command.add_option("-s,--set", options.sets, "NAME=VALUE: numbers separated by commas, or a file for a texture; may be repeated"));
    repeatable(command.add_option("--bind", options.binds,
                                  "NAME=RULE: what a parameter of a foreign effect gets, such as WORLDVIEWPROJECTION; may be repeated"));
    command.add_option("--picture-in", options.pictureIn, "What an effect of ReShade changes; default: a scene of our own, or --mesh");
    command.add_option("--depth-in", options.depthIn, "Its depth: a picture with 0 near and 1 far");
    command.add_option("--size", options.size,
                       fmt::format("Picture size in pixels: WIDTHxHEIGHT, or one number for a square; default: the workspace's, else {}",
                                   options.usualSize));
    command
        .add_option(
            "--fit", options.fit,
            "What a picture of another shape than the scene's keeps of it: width, height, or both (the default); a scene without a size "
            "is square, and keeps its width where -w names a file of yours")
        ->check(CLI::IsMember({"width", "height", "both"}));
    command
        .add_option("--samples", options.samples,
                    "Samples a pixel of the caller's targets: 1, 2, 4 or 8; the picture is their mean; default: 4; 1 where the technique "
                    "cannot have several or has Direct3D 9's half pixel, and for render --frames")
        ->check(CLI::IsMember({1, 2, 4, 8}));
    command
        .add_option("--picture", options.picture,
                    "What the picture is drawn into: float (RGBA32F), or half (RGBA16F), as engines do, into which blending costs less")
        ->transform(oneOf({"float", "half"}))
        ->capture_default_str();
    command.add_option("--compiler", options.compiler, "dxc or glslang; default: DXC where it is installed")
        ->transform(oneOf({"dxc", "glslang"}));
    command.add_option("--device", options.device, "Part of the Vulkan device's name; NAME#2: the second of that name");
    command.add_flag("--validate", options.validate, "Run under the Vulkan validation layers; any message is a failure");
    addEffectOptions(command, options.effect);
}

} // namespace tegument::app
