// tegument verify: every module alone against its reference in double precision.

#include "generated/setting_names.h"
#include "host/support/file.h"
#include "lab/app/commands.h"
#include "lab/app/verify_page.h"
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

struct VerifyArguments {
    std::vector<std::string> modules;
    std::string effects = "effects";
    std::vector<std::string> settings = {kSettingCorrected};
    std::string compiler;
    std::string device;
    std::string output = "out/verify";
    ReportOptions report;
    int mapSize = 256;
    int pictureSize = 256;
    bool json = false;
};

void printTable(const std::vector<VerifiedModule>& modules) {
    std::vector<std::vector<std::string>> rows;
    for (const VerifiedModule& module : modules) {
        const std::string name = fmt::format("{} [{}]", module.module, module.setting);
        for (const Metric& metric : module.report.metrics)
            rows.push_back({name, metric.name, fmt::format("{:.3g}", metric.value), fmt::format("{:.3g}", metric.limit),
                            metric.pass ? "pass" : "FAIL"});
        if (module.error) rows.push_back({name, "did not run", "", "", "FAIL"});
    }
    fmt::print("{}", table({"module", "figure", "value", "limit", ""}, rows));
}

/// Errors of the machine end the run; those of a module are its result.
Result<std::vector<VerifiedModule>> verifyAll(const VerifyArguments& arguments, gpu::Device& device, VerifyOptions options) {
    const std::vector<std::string> modules = arguments.modules.empty() ? verifiableModules(options.effects) : arguments.modules;
    std::vector<VerifiedModule> verified;
    Progress progress;
    const std::size_t count = modules.size() * arguments.settings.size();
    for (const std::string& setting : arguments.settings) {
        options.setting = setting;
        for (const std::string& module : modules) {
            progress.say(fmt::format("{} of {}: {} [{}]", verified.size() + 1, count, module, setting));
            auto report = verifyModule(device, module, options);
            if (!report && report.error().blame != Blame::Input) return report.error();
            VerifiedModule& entry = verified.emplace_back(VerifiedModule{.module = module, .setting = setting, .report = {}, .error = {}});
            if (report)
                entry.report = std::move(*report);
            else
                entry.error = report.error();
        }
    }
    return verified;
}

void tell(const std::vector<VerifiedModule>& modules) {
    for (const VerifiedModule& module : modules) {
        warn(module.report.warnings);
        if (module.error) say(format(*module.error));
    }
}

Result<VerifyOptions> optionsOf(const VerifyArguments& arguments) {
    VerifyOptions options;
    options.effects = assets::ownFile(arguments.effects);
    options.mapSize = arguments.mapSize;
    options.pictureSize = arguments.pictureSize;
    const auto compiler = assets::chosenCompiler(arguments.compiler);
    if (!compiler) return compiler.error();
    options.compiler = *compiler;
    if (arguments.modules.empty() && verifiableModules(options.effects).empty())
        return inputError(8060, {.file = arguments.effects, .byte = {}}, "this folder holds no module that has a reference",
                          "name the folder of the .fx files with --effects");
    return options;
}

int verify(VerifyArguments arguments) {
    const auto options = optionsOf(arguments);
    if (!options) return fail(options.error(), arguments.json);
    const fs::path folder = arguments.output;
    if (arguments.report.html.empty()) arguments.report.html = (folder / "index.html").string();
    const auto earlier = earlierRun(arguments.report, verifyFigures);
    if (!earlier) return fail(earlier.error(), arguments.json);
    if (const auto can = checkOutput((folder / "verify.json").string(), {}); !can) return fail(can.error(), arguments.json);
    auto device = gpu::Device::create({.validation = false, .prefer = arguments.device});
    if (!device) return fail(device.error(), arguments.json);
    const auto modules = verifyAll(arguments, *device, *options);
    if (!modules) return fail(modules.error(), arguments.json);
    tell(*modules);
    const PageHeader header{.device = device->info().name,
                            .driver = device->info().driver,
                            .compiler = compilerName(options->compiler),
                            .mesh = "the built-in body",
                            .mapSize = options->mapSize};
    const Json metrics = metricsJson(*modules);
    if (const auto written = writeFile(folder / "verify.json", metrics.dump(2) + "\n"); !written)
        return fail(written.error(), arguments.json);
    if (arguments.json) {
        print(metrics);
    } else {
        printTable(*modules);
        fmt::print("\n{} of {} pass on {}\nwrote {}\n", std::ranges::count_if(*modules, &VerifiedModule::pass), modules->size(),
                   header.device, (folder / "verify.json").string());
    }
    const auto told = tellReport(arguments.report, *earlier, metrics, verifyFigures, [&] { return verifyPage(header, *modules); });
    if (!told) return fail(told.error(), arguments.json);
    return std::ranges::all_of(*modules, &VerifiedModule::pass) ? 0 : static_cast<int>(Blame::Input);
}

} // namespace

void addVerify(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<VerifyArguments>();
    CLI::App* command = program.add_subcommand("verify", "Hold every module against its reference in double precision");
    command->add_option("modules", arguments->modules, "Modules, for example Beckmann TSM; default: all");
    command->add_option("--effects", arguments->effects, "Folder of the effect files")->capture_default_str();
    repeatable(command->add_option("--setting", arguments->settings, "Setting of the effects, by name; may be repeated"))
        ->transform(oneOf(std::vector<std::string>(kSettingNames.begin(), kSettingNames.end())))
        ->capture_default_str();
    command->add_option("--map-size", arguments->mapSize, "Texels along each side of the texture-space maps")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    command->add_option("--size", arguments->pictureSize, "Pixels along each side of the camera's pictures")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    command->add_option("--compiler", arguments->compiler, "dxc or glslang; default: DXC where it is installed")
        ->transform(oneOf({"dxc", "glslang"}));
    command->add_option("--device", arguments->device, "Part of the Vulkan device's name");
    command->add_option("-o,--output", arguments->output, "Folder for verify.json, and for index.html without --html")
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "Print JSON: a list of {module, setting, metric, value, limit, pass}");
    addReportOptions(*command, arguments->report, "verify.json");
    addExamples(*command,
                {{"verify", "all modules; then open out/verify/index.html"},
                 {"verify Beckmann TSM --setting seed", "two of them, as first printed"},
                 {"verify --html after.html --against before/verify.json", "what has changed since"}},
                "Exit code 1 when any figure is beyond its limit; --against does not change it.");
    command->callback([arguments, &action] { action = [arguments] { return verify(*arguments); }; });
}

} // namespace tegument::app
