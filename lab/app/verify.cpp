// tegument verify: every module alone against its reference in double precision.

#include "lab/verify/verify.h"
#include "generated/setting_names.h"
#include "host/support/file.h"
#include "lab/app/commands.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/report_options.h"
#include "tools/report/plane.h"
#include "tools/report/report.h"
#include "tools/view/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

/// A module as it was verified, or why it could not be.
struct VerifiedModule {
    std::string module;
    std::string setting;
    ModuleReport report;
    std::optional<Error> error;

    [[nodiscard]] bool pass() const { return !error && report.pass(); }
};

struct PageHeader {
    std::string device;
    std::string driver;
    std::string compiler;
    std::string mesh;
    int mapSize = 0;
};

/// Of a figure's limit: between two runs on one machine nothing moves by so little, and nothing is lost by it.
constexpr double kNoiseOfLimit = 0.01;

Json numberOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double strain(const Metric& metric) {
    const double share = std::abs(metric.value) / std::max(metric.limit, 1e-300);
    return std::isfinite(share) ? share : std::numeric_limits<double>::infinity();
}

const char* verdictOf(bool pass) {
    return pass ? "pass" : "fail";
}

/// The metric nearest to its limit, or farthest beyond.
const Metric* tightest(const ModuleReport& report) {
    const auto found = std::ranges::max_element(report.metrics, {}, strain);
    return found == report.metrics.end() ? nullptr : &*found;
}

Json moduleRow(const VerifiedModule& module) {
    const Metric* metric = tightest(module.report);
    if (!metric) return {verdictOf(module.pass()), module.module, module.setting, "did not run", nullptr, module.report.summary};
    return {verdictOf(module.pass()), module.module, module.setting, metric->name, numberOrNull(strain(*metric)), module.report.summary};
}

Json overview(const std::vector<VerifiedModule>& modules) {
    Json rows = Json::array();
    for (const VerifiedModule& module : modules)
        rows.push_back(moduleRow(module));
    return report::table(
        "Modules",
        "Each module is drawn alone and compared with a reference in double precision, by code that shares nothing with the "
        "shaders. Share: of the limit, by the figure that comes nearest to it; the bar's left end is a thousandth.",
        {{"", "verdict"}, {"module"}, {"setting"}, {"nearest to its limit"}, {"share", "share"}, {"what is compared"}}, std::move(rows));
}

Json figures(const std::vector<VerifiedModule>& modules) {
    Json rows = Json::array();
    for (const VerifiedModule& module : modules)
        for (const Metric& metric : module.report.metrics)
            rows.push_back({verdictOf(metric.pass), module.module, module.setting, metric.name, numberOrNull(metric.value), metric.limit,
                            numberOrNull(strain(metric)), metric.why});
    return report::table("Figures", "Relative figures are to the reference's mean over the pixels that count.",
                         {{"", "verdict"},
                          {"module"},
                          {"setting"},
                          {"figure"},
                          {"value", "number"},
                          {"limit", "number"},
                          {"share", "share", "of the limit"},
                          {"where the limit comes from"}},
                         std::move(rows));
}

struct Subject {
    std::string name;
    const Image* rendered = nullptr;
    const Image* reference = nullptr;
    const Image* difference = nullptr;
};

std::vector<Subject> subjectsOf(const ModuleReport& report) {
    std::vector<Subject> subjects;
    for (const VerifyPicture& picture : report.pictures) {
        auto found = std::ranges::find(subjects, picture.subject, &Subject::name);
        if (found == subjects.end()) found = subjects.insert(subjects.end(), Subject{.name = picture.subject});
        if (picture.role == PictureRole::Rendered) found->rendered = &picture.image;
        if (picture.role == PictureRole::Reference) found->reference = &picture.image;
        if (picture.role == PictureRole::Difference) found->difference = &picture.image;
    }
    return subjects;
}

Json levelsJson(const view::Levels& levels) {
    return {{"scale", levels.scale},
            {"offset", levels.offset},
            {"channel", levels.channel},
            {"toneMap", levels.toneMap},
            {"encode", levels.encode}};
}

Json subjectJson(const VerifiedModule& module, const Subject& subject) {
    Json json{{"name", subject.name},
              {"group", fmt::format("{} [{}]", module.module, module.setting)},
              {"levels", levelsJson(view::levelsOf(subject.reference ? *subject.reference : *subject.rendered))},
              {"rendered", report::plane(*subject.rendered)}};
    if (subject.reference) json["reference"] = report::plane(*subject.reference);
    if (!subject.difference) return json;
    json["difference"] = report::plane(*subject.difference);
    double worst = 0;
    for (const float value : subject.difference->pixels)
        worst = std::max(worst, std::abs(static_cast<double>(value)));
    json["worst"] = worst;
    return json;
}

Json pictures(const std::vector<VerifiedModule>& modules) {
    Json subjects = Json::array();
    for (const VerifiedModule& module : modules)
        for (const Subject& subject : subjectsOf(module.report))
            if (subject.rendered) subjects.push_back(subjectJson(module, subject));
    return {{"kind", "pictures"},
            {"title", "Picture, reference, difference"},
            {"note",
             "All three under one slider. Picture and reference are shown with the same levels; a difference is |a - b| over the "
             "reference's mean, on a logarithmic scale, and 0 where a pixel does not count. The number behind a name is its largest."},
            {"subjects", std::move(subjects)}};
}

Json remarks(const std::vector<VerifiedModule>& modules) {
    Json rows = Json::array();
    for (const VerifiedModule& module : modules) {
        for (const std::string& note : module.report.notes)
            rows.push_back({"note", module.module, module.setting, note});
        for (const Diagnostic& warning : module.report.warnings)
            rows.push_back({"warning", module.module, module.setting, format(warning)});
        if (module.error)
            for (const Diagnostic& diagnostic : module.error->diagnostics)
                rows.push_back({"error", module.module, module.setting, format(diagnostic)});
    }
    return report::table("Notes and diagnostics", "Pixels treated apart, their share and why; what kept a module from running.",
                         {{"severity", "verdict"}, {"module"}, {"setting"}, {"what"}}, std::move(rows));
}

/// verify.json: {module, setting, metric, value, limit, pass} of every figure.
Json metricsJson(const std::vector<VerifiedModule>& modules) {
    Json list = Json::array();
    for (const VerifiedModule& module : modules) {
        for (const Metric& metric : module.report.metrics)
            list.push_back({{"module", module.module},
                            {"setting", module.setting},
                            {"metric", metric.name},
                            {"value", metric.value},
                            {"limit", metric.limit},
                            {"pass", metric.pass}});
        if (module.error)
            list.push_back({{"module", module.module},
                            {"setting", module.setting},
                            {"metric", "runs"},
                            {"value", nullptr},
                            {"limit", nullptr},
                            {"pass", false},
                            {"diagnostics", toJson(module.error->diagnostics)}});
    }
    return list;
}

/// Each figure's size, from such a list; a hundredth of its limit counts as noise.
std::vector<report::Figure> verifyFigures(const Json& metrics) {
    std::vector<report::Figure> figures;
    if (!metrics.is_array()) return figures;
    for (const Json& metric : metrics) {
        const std::string module = textAt(metric, "/module");
        const auto limit = numberAt(metric, "/limit");
        if (module.empty() || !limit) continue; // of a module that did not run no figure is known
        const auto value = numberAt(metric, "/value");
        figures.push_back({.subject = fmt::format("{} [{}]", module, textAt(metric, "/setting")),
                           .name = textAt(metric, "/metric"),
                           .value = value ? std::abs(*value) : std::numeric_limits<double>::quiet_NaN(),
                           .noise = kNoiseOfLimit / 2 * *limit});
    }
    return figures;
}

report::Page verifyPage(const PageHeader& header, const std::vector<VerifiedModule>& modules) {
    const auto passed = static_cast<std::size_t>(std::ranges::count_if(modules, &VerifiedModule::pass));
    return {.title = "tegument verify",
            .summary = fmt::format("{} of {} modules are within their limits", passed, modules.size()),
            .verdict = verdictOf(passed == modules.size()),
            .facts = {{"device", header.device},
                      {"driver", header.driver},
                      {"compiler", header.compiler},
                      {"maps", fmt::format("{0} x {0}", header.mapSize)},
                      {"mesh", header.mesh}},
            .sections = {overview(modules), pictures(modules), figures(modules), remarks(modules)}};
}

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
            VerifiedModule& entry = verified.emplace_back(VerifiedModule{.module = module, .setting = setting});
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
        return inputError(8060, {.file = arguments.effects}, "this folder holds no module that has a reference",
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
