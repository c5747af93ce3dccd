// tegument render: runs an effect on a scene and writes what it drew.

#include "host/app/commands.h"
#include "host/app/effect_options.h"
#include "host/app/output.h"
#include "host/run/run.h"

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
    std::string mesh;
    std::string workspace;
    std::optional<double> unitMm;
    std::vector<std::string> sets;
    std::string size = "1024x1024";
    std::string compiler;
    std::vector<std::string> dump;
    std::string output;
    std::string device;
    int frames = 1;
    bool validate = false;
    bool json = false;
};

/// Everything that is read from disk before the device is touched.
struct Scene {
    Effect effect;
    Workspace workspace;
    std::optional<Mesh> mesh;
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

/// --workspace, else the human of the effects' own folder, else built-in defaults. With --mesh only its camera and light stay.
Result<Workspace> chooseWorkspace(const RenderOptions& options, bool mesh) {
    const WorkspaceOptions load{.requireMesh = mesh && options.mesh.empty()};
    if (!options.workspace.empty()) return loadWorkspace(options.workspace, load);
    const fs::path human = fs::path(options.file).parent_path() / "workspaces" / "human.json";
    std::error_code code;
    if (!fs::exists(human, code)) return Workspace{};
    Result<Workspace> workspace = loadWorkspace(human, load);
    if (!workspace || options.mesh.empty()) return workspace;
    workspace->attribution.clear(); // these spoke of the human
    workspace->textures.clear();
    workspace->unitMm.reset();
    workspace->flipV = false;
    return workspace;
}

Result<Mesh> chooseMesh(const RenderOptions& options, const Workspace& workspace) {
    const std::string& path = options.mesh.empty() ? workspace.meshPath : options.mesh;
    if (path.empty()) return usageError(8014, "this technique draws a mesh and none was given", "add --mesh FILE or --workspace FILE");
    MeshOptions load = meshOptions(workspace);
    if (options.unitMm) load.unitMm = options.unitMm;
    Result<Mesh> mesh =
        loadMesh(options.mesh.empty() && workspace.file.has_parent_path() ? workspace.file.parent_path() / path : fs::path(path), load);
    if (mesh && mesh->attribution.empty()) mesh->attribution = workspace.attribution;
    return mesh;
}

Result<Scene> loadScene(const RenderOptions& options) {
    const auto size = parseSize(options.size);
    if (!size) return size.error();
    auto effect = loadEffect(options.file, loadOptions(options.effect));
    if (!effect) return effect.error();
    Scene scene{.effect = std::move(*effect), .workspace = {}, .mesh = {}, .run = {}};
    scene.run.technique = options.technique;
    scene.run.width = size->first;
    scene.run.height = size->second;
    scene.run.frames = options.frames;
    scene.run.warmUpFrames = options.frames > 1 ? 2 : 0;
    scene.run.dump = options.dump;
    scene.run.compiler = options.compiler.empty() ? defaultCompiler() : options.compiler == "dxc" ? Compiler::Dxc : Compiler::Glslang;
    if (!compilerAvailable(scene.run.compiler))
        return machineError(8015, fmt::format("the compiler {} is not available", options.compiler),
                            "run ./bootstrap build, or use --compiler glslang");
    for (const std::string& set : options.sets)
        if (const auto applied = applySet(set, scene.effect, scene.run); !applied) return applied.error();

    const bool drawsMesh = needsMesh(scene.effect, options.technique);
    auto workspace = chooseWorkspace(options, drawsMesh);
    if (!workspace) return workspace.error();
    scene.workspace = std::move(*workspace);
    if (!drawsMesh) return scene;
    auto mesh = chooseMesh(options, scene.workspace);
    if (!mesh) return mesh.error();
    scene.mesh = std::move(*mesh);
    return scene;
}

Result<void> writePicture(const fs::path& path, const Image& image) {
    return toLower(path.extension().string()) == ".exr" ? writeExr(path, image) : writePng(path, image, PngEncoding::Display);
}

/// <output without extension>.<target>.exr
fs::path dumpPath(const fs::path& output, const std::string& target) {
    fs::path path = output;
    return path.replace_extension("." + target + ".exr");
}

Result<void> writeAll(const fs::path& output, const RunResult& result) {
    if (const auto written = writePicture(output, result.image); !written) return written;
    for (const auto& [name, image] : result.dumped)
        if (const auto written = writeExr(dumpPath(output, name), image); !written) return written;
    return {};
}

int mapSize(const RenderOptions& options, const RunResult& result) {
    if (options.effect.mapSize > 0) return options.effect.mapSize;
    const auto found = result.image.metadata.find("map_size");
    return found == result.image.metadata.end() ? 0 : std::atoi(found->second.c_str());
}

Json resultJson(const RenderOptions& options, const Scene& scene, const gpu::Device& device, const RunResult& result,
                const fs::path& output) {
    Json passes = Json::array();
    for (const PassReport& pass : result.passes)
        passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
    Json targets = Json::array();
    for (const TargetReport& target : result.targets)
        targets.push_back({{"name", target.name},
                           {"width", target.width},
                           {"height", target.height},
                           {"format", target.format},
                           {"bytes", target.bytes}});
    Json json{{"effect", scene.effect.file.string()},
              {"technique", result.technique},
              {"setting", options.effect.setting.empty() ? "corrected" : options.effect.setting},
              {"compiler", compilerName(scene.run.compiler)},
              {"device", device.info().name},
              {"driver", device.info().driver},
              {"resolution", {scene.run.width, scene.run.height}},
              {"map_size", mapSize(options, result)},
              {"passes", passes},
              {"targets", targets},
              {"output", output.string()}};
    Json dumps = Json::object();
    for (const auto& dumped : result.dumped)
        dumps[dumped.first] = dumpPath(output, dumped.first).string();
    if (!dumps.empty()) json["dumped"] = dumps;
    if (!result.warnings.empty()) json["warnings"] = toJson(result.warnings);
    if (options.validate) json["validation_messages"] = device.validationMessages();
    return json;
}

void printReport(const Scene& scene, const gpu::Device& device, const RunResult& result, const fs::path& output) {
    double total = 0;
    std::vector<std::vector<std::string>> rows;
    for (const PassReport& pass : result.passes) {
        rows.push_back({pass.name, fmt::format("{:.3f}", pass.milliseconds)});
        total += pass.milliseconds;
    }
    rows.push_back({"total", fmt::format("{:.3f}", total)});
    fmt::print("{} {}, {}x{}, {}\n{} ({}){}\n\n{}", scene.effect.file.filename().string(), result.technique, scene.run.width,
               scene.run.height, compilerName(scene.run.compiler), device.info().name, device.info().driver,
               device.info().cpu ? ", a software device: times are good as ratios only" : "", table({"pass", "ms"}, rows));
    fmt::print("\n{} targets, {:.1f} MiB\n", result.targets.size(), static_cast<double>(result.bytes) / (1024.0 * 1024.0));
    if (scene.mesh && !scene.mesh->attribution.empty()) fmt::print("mesh: {}\n", scene.mesh->attribution);
    for (const auto& dumped : result.dumped)
        fmt::print("wrote {}\n", dumpPath(output, dumped.first).string());
    fmt::print("wrote {}\n", output.string());
}

fs::path outputPath(const RenderOptions& options) {
    if (!options.output.empty()) return options.output;
    return fs::path("out") / fs::path(options.file).stem().concat(".png");
}

Result<void> checkOutput(const fs::path& output) {
    const std::string extension = toLower(output.extension().string());
    if (extension == ".png" || extension == ".exr") return {};
    return usageError(8016, fmt::format("{} is neither a .png nor a .exr", output.string()),
                      "PNG is for looking, EXR holds the linear floats");
}

int render(const RenderOptions& options) {
    const fs::path output = outputPath(options);
    if (const auto checked = checkOutput(output); !checked) return fail(checked.error(), options.json);
    Progress progress;
    progress.say("reading");
    const auto scene = loadScene(options);
    if (!scene) return fail(scene.error(), options.json);
    progress.clear();
    warn(scene->effect.warnings);
    if (scene->mesh) warn(scene->mesh->warnings);

    auto device = gpu::Device::create({.validation = options.validate, .prefer = options.device});
    if (!device) return fail(device.error(), options.json);
    progress.say("rendering");
    const auto result = runEffect(*device, scene->effect, scene->mesh ? &*scene->mesh : nullptr, scene->workspace, scene->run);
    progress.clear();
    if (!result) return fail(result.error(), options.json);
    warn(result->warnings);
    if (const auto written = writeAll(output, *result); !written) return fail(written.error(), options.json);

    if (options.json) {
        print(resultJson(options, *scene, *device, *result, output));
    } else {
        printReport(*scene, *device, *result, output);
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
    command->add_option("-m,--mesh", options->mesh, "Mesh (.glb, .gltf, .ply, .obj); default: the workspace's");
    command->add_option("-w,--workspace", options->workspace,
                        "Workspace file (docs/workspace.md); default: workspaces/human.json beside the effect");
    command->add_option("--unit-mm", options->unitMm, "Millimetres in one unit of the mesh file")->check(CLI::PositiveNumber);
    command->add_option("-s,--set", options->sets, "NAME=VALUE: numbers separated by commas, or a file for a texture; may be repeated");
    command->add_option("--size", options->size, "Picture size in pixels")->capture_default_str();
    command->add_option("--compiler", options->compiler, "dxc or glslang; default: DXC where it is installed")
        ->check(CLI::IsMember({"dxc", "glslang"}));
    command->add_option("--dump", options->dump, "Write this target as EXR beside the picture, or all of them; may be repeated");
    command->add_option("-o,--output", options->output, "Picture to write (.png or .exr); default: out/<effect>.png");
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
