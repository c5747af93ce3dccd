// tegument render: runs an effect on a scene and writes what it drew.

#include "host/app/commands.h"
#include "host/app/effect_options.h"
#include "host/app/output.h"
#include "host/app/picture_files.h"
#include "host/app/scene.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct RenderOptions {
    std::string file;
    EffectOptions effect;
    std::string technique;
    SceneOptions scene;
    std::vector<std::string> sets;
    std::string size = "1024x1024";
    std::string compiler;
    std::vector<std::string> dump;
    PictureOptions pictures;
    std::string device;
    int frames = 1;
    bool validate = false;
    bool json = false;
};

/// Everything that is read from disk before the device is touched.
struct Job {
    Effect effect;
    Scene scene;
    RunOptions run;
};

Result<std::pair<int, int>> parseSize(const std::string& text) {
    std::pair<int, int> size{0, 0};
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.first);
    const bool separator = width.ec == std::errc() && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X');
    const auto height = separator ? std::from_chars(width.ptr + 1, end, size.second) : width;
    if (!separator || height.ec != std::errc() || height.ptr != end || size.first < 1 || size.second < 1)
        return usageError(8010, fmt::format("--size {} is not a picture size", text),
                          "write WIDTHxHEIGHT in pixels, for example 1024x1024");
    return size;
}

std::optional<std::vector<double>> parseNumbers(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view item = trim(text.substr(0, comma));
        double number = 0;
        const auto parsed = std::from_chars(item.data(), item.data() + item.size(), number);
        if (parsed.ec != std::errc() || parsed.ptr != item.data() + item.size()) return std::nullopt;
        numbers.push_back(number);
        if (comma == std::string_view::npos) return numbers;
        text.remove_prefix(comma + 1);
    }
}

std::vector<std::string> parameterNames(const Effect& effect) {
    std::vector<std::string> names;
    for (const Parameter& parameter : effect.parameters)
        names.push_back(parameter.name);
    return names;
}

/// NAME=VALUE: numbers for a numeric parameter, a file for a texture.
Result<void> applySet(const std::string& set, const Effect& effect, RunOptions& run) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
        return usageError(8011, fmt::format("--set {} has no '='", set), "write --set NAME=VALUE, for example --set gMix=0.5");
    const std::string name = set.substr(0, equals);
    const std::string value = set.substr(equals + 1);
    const Parameter* parameter = effect.findParameter(name);
    if (!parameter)
        return inputError(8012, {.file = effect.file.string(), .byte = {}}, fmt::format("no parameter '{}' to set", name),
                          didYouMean(name, parameterNames(effect)));
    if (parameter->type.isTexture()) {
        run.textures[name] = value;
        return {};
    }
    auto numbers = parseNumbers(value);
    if (!numbers)
        return usageError(8013, fmt::format("--set {}: '{}' is not a number or a list of numbers", name, value),
                          "separate the numbers by commas: --set gTint=1,0.9,0.8");
    run.parameters[name] = std::move(*numbers);
    return {};
}

bool drawsGeometry(const Pass& pass) {
    if (!pass.script.given) return true;
    for (const Command& command : pass.script.commands)
        if (command.kind == CommandKind::Draw && command.options.front() != "Buffer") return true;
    return false;
}

bool needsMesh(const Effect& effect, const std::string& technique) {
    const Technique* chosen = technique.empty() ? effect.defaultTechnique() : effect.findTechnique(technique);
    return chosen && std::ranges::any_of(chosen->passes, drawsGeometry);
}

Result<Job> loadJob(const RenderOptions& options) {
    const auto size = parseSize(options.size);
    if (!size) return size.error();
    auto effect = loadEffect(options.file, loadOptions(options.effect));
    if (!effect) return effect.error();
    Job job{.effect = std::move(*effect), .scene = {}, .run = {}};
    job.run.technique = options.technique;
    job.run.width = size->first;
    job.run.height = size->second;
    job.run.frames = options.frames;
    job.run.warmUpFrames = options.frames > 1 ? 2 : 0;
    job.run.dump = options.dump;
    job.run.compiler = options.compiler.empty() ? defaultCompiler() : options.compiler == "dxc" ? Compiler::Dxc : Compiler::Glslang;
    if (!compilerAvailable(job.run.compiler))
        return machineError(8015, fmt::format("the compiler {} is not available", options.compiler),
                            "run ./bootstrap build, or use --compiler glslang");
    for (const std::string& set : options.sets)
        if (const auto applied = applySet(set, job.effect, job.run); !applied) return applied.error();

    SceneOptions sceneOptions = options.scene;
    sceneOptions.effect = options.file;
    auto scene = loadScene(sceneOptions, needsMesh(job.effect, options.technique));
    if (!scene) return scene.error();
    job.scene = std::move(*scene);
    return job;
}

int mapSize(const RenderOptions& options, const RunResult& result) {
    if (options.effect.mapSize > 0) return options.effect.mapSize;
    const auto found = result.image.metadata.find("map_size");
    return found == result.image.metadata.end() ? 0 : std::atoi(found->second.c_str());
}

Json vectorJson(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Json objectsJson(const std::vector<RunObject>& objects) {
    Json json = Json::array();
    for (const RunObject& object : objects)
        json.push_back({{"mesh", object.mesh->name},
                        {"attribution", object.mesh->attribution},
                        {"position", vectorJson(object.placement.position)},
                        {"rotation", vectorJson(object.placement.rotation)},
                        {"scale", object.placement.scale}});
    return json;
}

Json passesJson(const RunResult& result, bool several) {
    Json passes = Json::array();
    for (const PassReport& pass : result.passes) {
        passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
        if (several) passes.back()["object"] = pass.object;
    }
    return passes;
}

Json resultJson(const RenderOptions& options, const Job& job, const gpu::Device& device, const RunResult& result,
                const std::vector<fs::path>& files) {
    Json targets = Json::array();
    for (const TargetReport& target : result.targets)
        targets.push_back({{"name", target.name},
                           {"width", target.width},
                           {"height", target.height},
                           {"format", target.format},
                           {"bytes", target.bytes}});
    const bool several = !job.scene.objects.empty();
    Json json{{"effect", job.effect.file.string()},
              {"technique", result.technique},
              {"setting", options.effect.setting.empty() ? "corrected" : options.effect.setting},
              {"compiler", compilerName(job.run.compiler)},
              {"device", device.info().name},
              {"driver", device.info().driver},
              {"resolution", {job.run.width, job.run.height}},
              {"map_size", mapSize(options, result)},
              {"passes", passesJson(result, several)},
              {"targets", targets},
              {"bytes", result.bytes},
              {"device_bytes", result.deviceBytes},
              {"output", files.back().string()}};
    if (several) json["objects"] = objectsJson(job.scene.objects);
    Json dumps = Json::object();
    for (const auto& dumped : result.dumped)
        dumps[dumped.first] = dumpPath(files.back(), dumped.first, options.pictures.formats.front()).string();
    if (!dumps.empty()) json["dumped"] = dumps;
    for (const fs::path& file : files)
        json["files"].push_back(file.string());
    if (!result.warnings.empty()) json["warnings"] = toJson(result.warnings);
    if (options.validate) json["validation_messages"] = device.validationMessages();
    return json;
}

/// The passes' times; of several objects summed over them.
std::vector<std::vector<std::string>> timeRows(const RunResult& result) {
    double total = 0;
    std::vector<std::pair<std::string, double>> times;
    int object = 0;
    std::size_t next = 0; // of this object's passes
    for (const PassReport& pass : result.passes) {
        if (pass.object != object) next = 0;
        object = pass.object;
        if (next < times.size() && times[next].first == pass.name)
            times[next].second += pass.milliseconds;
        else
            times.emplace_back(pass.name, pass.milliseconds);
        ++next;
        total += pass.milliseconds;
    }
    times.emplace_back("total", total);
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, milliseconds] : times)
        rows.push_back({name, fmt::format("{:.3f}", milliseconds)});
    return rows;
}

void printReport(const Job& job, const gpu::Device& device, const RunResult& result, const std::vector<fs::path>& files) {
    fmt::print("{} {}, {}x{}, {}\n{} ({}){}\n\n{}", job.effect.file.filename().string(), result.technique, job.run.width, job.run.height,
               compilerName(job.run.compiler), device.info().name, device.info().driver,
               device.info().cpu ? ", a software device: times are good as ratios only" : "", table({"pass", "ms"}, timeRows(result)));
    fmt::print("\n{} targets, {:.1f} MiB\n", result.targets.size(), static_cast<double>(result.bytes) / (1024.0 * 1024.0));
    if (!job.scene.objects.empty()) fmt::print("{} objects, {} meshes\n", job.scene.objects.size(), job.scene.meshes.size());
    if (const auto found = result.image.metadata.find("attribution"); found != result.image.metadata.end())
        fmt::print("mesh: {}\n", found->second);
    for (const fs::path& file : files)
        fmt::print("wrote {}\n", file.string());
}

int render(const RenderOptions& options) {
    const auto output = outputPath(options.pictures, options.file);
    if (!output) return fail(output.error(), options.json);
    Progress progress;
    progress.say("reading");
    const auto job = loadJob(options);
    if (!job) return fail(job.error(), options.json);
    progress.clear();
    warn(job->effect.warnings);
    for (const Mesh& mesh : job->scene.meshes)
        warn(mesh.warnings);

    auto device = gpu::Device::create({.validation = options.validate, .prefer = options.device});
    if (!device) return fail(device.error(), options.json);
    progress.say("rendering");
    const auto result = runScene(*device, job->effect, job->scene, job->run);
    progress.clear();
    if (!result) return fail(result.error(), options.json);
    warn(result->warnings);
    const auto files = writePictures(options.pictures, *output, *result);
    if (!files) return fail(files.error(), options.json);

    if (options.json) {
        print(resultJson(options, *job, *device, *result, *files));
    } else {
        printReport(*job, *device, *result, *files);
    }
    const auto messages = device->validationMessages();
    for (const std::string& message : messages)
        fmt::print(stderr, "validation: {}\n", message);
    return messages.empty() ? 0 : static_cast<int>(Blame::Machine);
}

} // namespace

void addRender(CLI::App& program, Action& action) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = program.add_subcommand("render", "Run an effect on a mesh and write the picture");
    command->add_option("effect", options->file, "Effect file (.fx)")->required();
    command->add_option("-t,--technique", options->technique, "Technique; default: the one the effect's script names");
    command->add_option("-m,--mesh", options->scene.mesh, "Mesh (.glb, .gltf, .ply, .obj); default: the workspace's");
    command->add_option("-w,--workspace", options->scene.workspace,
                        "Workspace file (docs/workspace.md); default: workspaces/human.json beside the effect");
    command->add_option("--unit-mm", options->scene.unitMm, "Millimetres in one unit of the mesh file")->check(CLI::PositiveNumber);
    command->add_option("-s,--set", options->sets, "NAME=VALUE: numbers separated by commas, or a file for a texture; may be repeated");
    command->add_option("--size", options->size, "Picture size in pixels")->capture_default_str();
    command->add_option("--compiler", options->compiler, "dxc or glslang; default: DXC where it is installed")
        ->check(CLI::IsMember({"dxc", "glslang"}));
    command->add_option("--dump", options->dump, "Write this target beside the picture, or all of them; may be repeated");
    addPictureOptions(*command, options->pictures);
    command->add_option("--device", options->device, "Part of the Vulkan device's name");
    command->add_option("--frames", options->frames, "Frames to time; the table shows medians")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_flag("--validate", options->validate, "Run under the Vulkan validation layers; any message is a failure");
    addEffectOptions(*command, options->effect);
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options, &action] { action = [options] { return render(*options); }; });
}

} // namespace tegument::app
