// tegument invariance: every technique draws the same picture of the same scene, however it is put.

#include "lab/invariance/invariance.h"
#include "generated/setting_names.h"
#include "host/support/file.h"
#include "lab/app/commands.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct InvarianceArguments {
    std::vector<std::string> files;
    std::string effects = "effects";
    std::string compiler;
    std::string device;
    std::string mesh;
    std::optional<double> unitMm;
    std::string workspace;
    std::string output = "out/invariance";
    InvarianceOptions options;
    bool json = false;
};

Result<std::vector<fs::path>> filesOf(const InvarianceArguments& arguments) {
    std::vector<fs::path> files;
    for (const std::string& named : arguments.files) {
        auto file = assets::findEffect(named);
        if (!file) return file.error();
        files.push_back(*std::move(file));
    }
    if (!files.empty()) return files;
    files = effectFiles(assets::ownFile(arguments.effects));
    if (files.empty())
        return inputError(8060, {.file = arguments.effects}, "this folder holds no effect",
                          "name the folder of the .fx files with --effects");
    return files;
}

/// The mesh of a user's own, or none.
Result<std::optional<Scene>> loadOwnScene(const InvarianceArguments& arguments) {
    if (arguments.mesh.empty() && arguments.workspace.empty()) return std::optional<Scene>();
    const fs::path effect = assets::ownFile("effects/Main.fx");
    std::string workspace;
    if (!arguments.workspace.empty()) {
        const auto found = assets::findWorkspace(arguments.workspace, effect);
        if (!found) return found.error();
        workspace = found->string();
    }
    if (!arguments.mesh.empty())
        if (const auto exists = assets::fileExists(arguments.mesh, "--mesh"); !exists) return exists.error();
    auto scene = assets::loadScene(
        {.effect = effect.string(), .workspace = workspace, .usual = "human.json", .mesh = arguments.mesh, .unitMm = arguments.unitMm},
        true);
    if (!scene) return scene.error();
    return std::optional<Scene>(*std::move(scene));
}

Result<std::vector<InvarianceCell>> measureAll(const InvarianceArguments& arguments, gpu::Device& device,
                                               const InvarianceOptions& options) {
    const auto files = filesOf(arguments);
    if (!files) return files.error();
    std::vector<InvarianceCell> cells;
    Progress progress;
    for (const fs::path& file : *files) {
        progress.say(file.string());
        auto measured = measureInvariance(device, file, options);
        if (!measured) return measured.error();
        cells.insert(cells.end(), measured->begin(), measured->end());
    }
    return cells;
}

int invariance(const InvarianceArguments& arguments) {
    InvarianceOptions options = arguments.options;
    const auto compiler = assets::chosenCompiler(arguments.compiler);
    if (!compiler) return fail(compiler.error(), arguments.json);
    options.compiler = *compiler;
    if (const auto can = checkFolder(arguments.output); !can) return fail(can.error(), arguments.json);
    const auto own = loadOwnScene(arguments);
    if (!own) return fail(own.error(), arguments.json);
    if (*own) {
        options.mesh = &(*own)->meshes.front();
        options.workspace = &(*own)->workspace;
    }
    auto device = gpu::Device::create({.validation = false, .prefer = arguments.device});
    if (!device) return fail(device.error(), arguments.json);
    const auto cells = measureAll(arguments, *device, options);
    if (!cells) return fail(cells.error(), arguments.json);
    if (cells->empty())
        return fail(usageError(8061, "nothing is left to hold: no technique, or no case, of these names",
                               "tegument info EFFECT lists the techniques, docs/design/invariance.md the cases"),
                    arguments.json);
    const fs::path folder = arguments.output;
    const std::string json = invarianceJson(*cells);
    const std::string head =
        fmt::format("{}, {}; {}; {}, maps of {}, pictures of {} pixels a side, setting {}.\n\n", device->info().name, device->info().driver,
                    compilerName(options.compiler), options.mesh ? options.mesh->name : std::string("the generated head"), options.mapSize,
                    options.pictureSize, options.setting);
    const std::string table = head + invarianceMarkdown(*cells);
    for (const auto& [name, text] : {std::pair("invariance.json", &json), std::pair("invariance.md", &table)})
        if (const auto written = writeFile(folder / name, *text); !written) return fail(written.error(), arguments.json);
    fmt::print("{}", arguments.json ? json : table);
    const auto failed = std::ranges::count_if(*cells, [](const InvarianceCell& cell) { return !cell.pass(); });
    if (!arguments.json)
        fmt::print("\n{} of {} pass\nwrote {}\nwrote {}\n", cells->size() - static_cast<std::size_t>(failed), cells->size(),
                   (folder / "invariance.md").string(), (folder / "invariance.json").string());
    return failed == 0 ? 0 : static_cast<int>(Blame::Input);
}

} // namespace

void addInvariance(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<InvarianceArguments>();
    InvarianceOptions& options = arguments->options;
    options.setting = kSettingCorrected;
    CLI::App* command =
        program.add_subcommand("invariance", "Hold techniques against themselves: the same scene in other units, turned, mirrored");
    command->add_option("files", arguments->files, "Effect files; default: all of the folder of effects");
    command->add_option("--effects", arguments->effects, "Folder of the effect files")->capture_default_str();
    repeatable(command->add_option("--technique", options.techniques, "Only this technique; may be repeated"));
    repeatable(command->add_option("--case", options.cases, "Only this case, or column of cases; may be repeated"));
    command->add_option("--mesh", arguments->mesh, "A mesh of your own instead of the generated head");
    command->add_option("--unit-mm", arguments->unitMm, "Millimetres per unit of the mesh file");
    command->add_option("-w,--workspace", arguments->workspace, "Camera, light, textures and parameters of your own");
    command->add_option("--setting", options.setting, "Setting of the effects, by name")
        ->transform(oneOf(std::vector<std::string>(kSettingNames.begin(), kSettingNames.end())))
        ->capture_default_str();
    command->add_option("--map-size", options.mapSize, "Texels along each side of the maps")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    command->add_option("--size", options.pictureSize, "Pixels along each side of the pictures")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    command->add_option("--compiler", arguments->compiler, "dxc or glslang; default: DXC where it is installed")
        ->transform(oneOf({"dxc", "glslang"}));
    command->add_option("--device", arguments->device, "Part of the Vulkan device's name");
    command->add_option("-o,--output", arguments->output, "Folder for invariance.md and invariance.json")->capture_default_str();
    command->add_flag("--json", arguments->json, "Print JSON: a list of cells");
    addExamples(*command,
                {{"invariance", "all techniques"}, {"invariance Main Specular --case \"mesh in metres\"", "two effects, one case"}},
                "Exit code 1 when any picture is beyond its limits.");
    command->callback([arguments, &action] { action = [arguments] { return invariance(*arguments); }; });
}

} // namespace tegument::app
