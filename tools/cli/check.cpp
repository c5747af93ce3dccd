// tegument check: does an effect compile for every target? No GPU is needed.

#include "tools/check/check.h"
#include "host/support/kept_inputs.h"
#include "meshprep/assets/names.h"
#include "tools/check/resources.h"
#include "tools/cli/command_line.h"
#include "tools/cli/commands.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/report_options.h"
#include "tools/emit/emit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace tegument::app {

namespace {

/// The keys of `check --json` for kSm3Limits.
std::string keyOf(const Sm3Limit& limit) {
    constexpr std::array kKeys = {std::pair{&Sm3Usage::instructionSlots, "instruction_slots"}, std::pair{&Sm3Usage::constants, "constants"},
                                  std::pair{&Sm3Usage::samplers, "samplers"}, std::pair{&Sm3Usage::interpolators, "interpolators"}};
    return std::string("/") + std::ranges::find(kKeys, limit.used, [](const auto& entry) { return entry.first; })->second;
}

std::string fileOf(const Json& file) {
    const std::string variant = textAt(file, "/variant");
    return textAt(file, "/file") + (variant.empty() ? "" : fmt::format(" [{}]", variant));
}

std::string placeOf(const Json& diagnostic) {
    std::string place = textAt(diagnostic, "/file");
    for (const char* part : {"/line", "/column"})
        if (const auto value = numberAt(diagnostic, part)) place += fmt::format(":{:.0f}", *value);
    return place;
}

Json targets(const Json& files) {
    Json rows = Json::array();
    for (const Json& file : files)
        for (const Json& target : valueAt(file, "/targets"))
            rows.push_back({textAt(target, "/verdict"), fileOf(file), textAt(target, "/target"), valueAt(target, "/entries"),
                            valueAt(target, "/ms"), textAt(target, "/reason")});
    return report::table(
        "Targets",
        "Each target's own compiler was asked. Not applicable: the file has nothing for it. Not checked: this machine lacks its tool.",
        {{"", "verdict"}, {"effect"}, {"target"}, {"entry points", "number"}, {"ms", "number", "to compile"}, {"why"}}, std::move(rows));
}

void addDiagnostics(Json& rows, const Json& list, const std::string& file, const std::string& target) {
    for (const Json& diagnostic : list)
        rows.push_back({textAt(diagnostic, "/severity"), textAt(diagnostic, "/code"), file, target, placeOf(diagnostic),
                        textAt(diagnostic, "/text"), textAt(diagnostic, "/hint")});
}

Json diagnostics(const Json& files) {
    Json rows = Json::array();
    for (const Json& file : files) {
        addDiagnostics(rows, valueAt(file, "/diagnostics"), fileOf(file), "all");
        for (const Json& target : valueAt(file, "/targets"))
            addDiagnostics(rows, valueAt(target, "/diagnostics"), fileOf(file), textAt(target, "/target"));
    }
    const char* const note = rows.empty() ? "No compiler had anything to say." : "docs/diagnostics.md explains every code.";
    return report::table("Diagnostics", note,
                         {{"severity", "verdict"}, {"code", "code"}, {"effect"}, {"target"}, {"place", "code"}, {"what"}, {"what to do"}},
                         std::move(rows));
}

int limitOf(const Sm3Limit& limit, const std::string& profile) {
    return profile.starts_with("vs") ? limit.vertex : limit.pixel;
}

Json resources(const Json& files) {
    Json rows = Json::array();
    for (const Json& file : files)
        for (const Json& pass : valueAt(file, "/sm3")) {
            const std::string profile = textAt(pass, "/profile");
            Json row = {fileOf(file), textAt(pass, "/technique"), textAt(pass, "/pass"), textAt(pass, "/entry"), profile};
            for (const Sm3Limit& limit : kSm3Limits) {
                const auto used = numberAt(pass, keyOf(limit).c_str());
                row.push_back(used ? Json(*used) : Json(nullptr));
                if (limit.used == &Sm3Usage::instructionSlots) row.push_back(used ? Json(*used / limitOf(limit, profile)) : Json(nullptr));
            }
            rows.push_back(std::move(row));
        }
    std::vector<report::Column> columns = {{"effect"}, {"technique"}, {"pass"}, {"entry", "code"}, {"profile", "code"}};
    for (const Sm3Limit& limit : kSm3Limits) {
        columns.push_back(
            {std::string(limit.what), "number", fmt::format("at most {} in vs_3_0, {} in ps_3_0", limit.vertex, limit.pixel)});
        if (limit.used == &Sm3Usage::instructionSlots) columns.push_back({"of them", "share", "of what every device has"});
    }
    return report::table("Shader model 3", "What each shader takes of what every device of shader model 3 has, read from the binary.",
                         columns, std::move(rows));
}

std::string summaryOf(const Json& files) {
    std::map<std::string, std::size_t> counts;
    for (const Json& file : files)
        for (const Json& target : valueAt(file, "/targets"))
            ++counts[textAt(target, "/verdict")];
    return fmt::format("{} passed, {} failed, {} not applicable, {} not checked", counts["passed"], counts["failed"],
                       counts["not applicable"], counts["not checked"]);
}

/// Of what `check --json` writes: what each pass takes of shader model 3, and 1 for each target that failed, else 0.
std::vector<report::Figure> checkFigures(const Json& run) {
    std::vector<report::Figure> figures;
    for (const Json& file : valueAt(run, "/files")) {
        for (const Json& target : valueAt(file, "/targets"))
            if (const std::string verdict = textAt(target, "/verdict");
                verdict == verdictName(Verdict::Passed) || verdict == verdictName(Verdict::Failed))
                figures.push_back({.subject = fileOf(file),
                                   .name = textAt(target, "/target") + " fails",
                                   .value = verdict == verdictName(Verdict::Failed) ? 1.0 : 0.0});
        for (const Json& pass : valueAt(file, "/sm3"))
            for (const Sm3Limit& limit : kSm3Limits)
                if (const auto used = numberAt(pass, keyOf(limit).c_str()))
                    figures.push_back({.subject = fmt::format("{}, {} {}, {}", fileOf(file), textAt(pass, "/technique"),
                                                              textAt(pass, "/pass"), textAt(pass, "/entry")),
                                       .name = std::string(limit.what),
                                       .value = *used});
    }
    return figures;
}

report::Page checkPage(const Json& run) {
    const Json files = valueAt(run, "/files");
    report::Page page{.title = "tegument check",
                      .summary = summaryOf(files),
                      .verdict = valueAt(run, "/passed") == Json(true) ? "pass" : "fail",
                      .facts = {{"effects", fmt::format("{}", files.size())}},
                      .sections = {targets(files), diagnostics(files)}};
    Json used = resources(files);
    if (!used["rows"].empty()) page.sections.push_back(std::move(used));
    return page;
}

struct CheckArguments {
    std::vector<std::string> files;
    std::vector<std::string> targets = {"all"};
    EffectOptions effect;
    bool allSettings = false;
    bool compatible = false;
    std::string emitFolder;
    std::vector<std::string> emitKinds = {"all"};
    bool resources = false;
    bool skipMissing = false;
    bool json = false;
    ReportOptions report;
    bool server = false;
};

/// Every chosen one once, in their order. What is `written` is an output.
Result<std::vector<Target>> chosenTargets(const std::vector<std::string>& names, bool written) {
    std::set<Target> wanted;
    for (const std::string& name : names) {
        const std::vector<Target> targets = targetsByName(name, written);
        const char* what = written ? "output" : "target";
        if (targets.empty())
            return usageError(written ? 8021 : 8020, fmt::format("unknown {} '{}'", what, name),
                              fmt::format("{}s: {}, spirv, all", what, targetNames(written)));
        wanted.insert(targets.begin(), targets.end());
    }
    return std::vector(wanted.begin(), wanted.end());
}

/// Two files of one name would write to one folder.
Result<void> namesAreDistinct(const std::vector<std::filesystem::path>& files) {
    for (std::size_t i = 0; i < files.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (files[i].stem() == files[j].stem())
                return usageError(8022, fmt::format("{} and {} would be written to the same folder", files[j].string(), files[i].string()),
                                  "emit them into different folders");
    return {};
}

CheckOptions checkOptions(const CheckArguments& arguments) {
    const LoadOptions load = assets::loadOptions(arguments.effect);
    CheckOptions options{.variants = {Variant{.name = load.setting, .defines = load.defines, .setting = load.setting}},
                         .includeFolders = load.includeFolders};
    options.allSettings = arguments.allSettings;
    options.compatible = arguments.compatible;
    options.roots = load.roots;
    if (options.allSettings) options.variants.front() = {.defines = load.defines};
    return options;
}

Json targetJson(const TargetCheck& target) {
    Json json{{"target", targetName(target.target)},
              {"verdict", verdictName(target.verdict)},
              {"entries", target.entries},
              {"ms", target.milliseconds}};
    if (!target.reason.empty()) json["reason"] = target.reason;
    if (!target.diagnostics.empty()) json["diagnostics"] = toJson(target.diagnostics);
    return json;
}

Json usageJson(const PassUsage& entry) {
    return {{"technique", entry.technique},
            {"pass", entry.pass},
            {"entry", entry.entry},
            {"profile", entry.profile},
            {"instruction_slots", entry.usage.instructionSlots},
            {"constants", entry.usage.constants},
            {"samplers", entry.usage.samplers},
            {"interpolators", entry.usage.interpolators}};
}

Json fileJson(const FileReport& file) {
    Json json{
        {"file", file.file.string()}, {"variant", file.variant}, {"diagnostics", toJson(file.diagnostics)}, {"targets", Json::array()}};
    for (const TargetCheck& target : file.targets)
        json["targets"].push_back(targetJson(target));
    if (!file.sm3.empty()) json["sm3"] = Json::array();
    for (const PassUsage& entry : file.sm3)
        json["sm3"].push_back(usageJson(entry));
    return json;
}

Json resourcesJson(const ResourceTable& table) {
    Json json{{"variants", table.variants}, {"limits", Json::object()}, {"passes", Json::array()}};
    for (const Sm3Limit& limit : kSm3Limits)
        json["limits"][std::string(limit.what)] = {{"vs_3_0", limit.vertex}, {"ps_3_0", limit.pixel}};
    for (const ResourceRow& row : table.rows) {
        Json usage = Json::array();
        for (const Sm3Usage& one : row.usage) {
            usage.push_back(Json::object());
            for (const Sm3Limit& limit : kSm3Limits)
                usage.back()[std::string(limit.what)] = one.*limit.used;
        }
        json["passes"].push_back({{"effect", row.effect},
                                  {"technique", row.technique},
                                  {"pass", row.pass},
                                  {"entry", row.entry},
                                  {"profile", row.profile},
                                  {"usage", std::move(usage)}});
    }
    return json;
}

std::string title(const FileReport& file) {
    return file.variant.empty() ? file.file.string() : fmt::format("{} [{}]", file.file.string(), file.variant);
}

/// The entry point that comes nearest to shader model 3's 512 slots.
std::string heaviest(const std::vector<PassUsage>& sm3) {
    const auto most = std::ranges::max_element(sm3, {}, [](const PassUsage& pass) { return pass.usage.instructionSlots; });
    if (most == sm3.end()) return "-";
    return fmt::format("{} {}", most->entry, most->usage.instructionSlots);
}

void printTable(const CheckReport& report) {
    std::vector<std::string> header = {"effect"};
    for (const TargetCheck& target : report.files.front().targets)
        header.emplace_back(targetName(target.target));
    header.emplace_back("most SM3 slots");
    std::vector<std::vector<std::string>> rows;
    for (const FileReport& file : report.files) {
        std::vector<std::string> row = {title(file)};
        for (const TargetCheck& target : file.targets)
            row.emplace_back(verdictName(target.verdict));
        row.push_back(heaviest(file.sm3));
        rows.push_back(std::move(row));
    }
    fmt::print("{}", table(header, rows));
}

/// Why a target has neither passed nor failed: of the file itself, or, with the same words for all files, of the machine.
std::string reasonOf(const FileReport& file, const TargetCheck& target) {
    const std::string reason = fmt::format("{} {}: {}", targetName(target.target), verdictName(target.verdict), target.reason);
    return target.verdict == Verdict::NotApplicable ? fmt::format("{}: {}", title(file), reason) : reason;
}

/// Diagnostics go to standard error; the same reason for many files is said once.
void printProblems(const CheckReport& report) {
    std::vector<std::string> said;
    for (const FileReport& file : report.files) {
        warn(file.diagnostics);
        for (const TargetCheck& target : file.targets) {
            warn(target.diagnostics);
            if (target.verdict == Verdict::Passed || target.verdict == Verdict::Failed || target.reason.empty()) continue;
            const std::string reason = reasonOf(file, target);
            if (std::ranges::find(said, reason) != said.end()) continue;
            said.push_back(reason);
            say(reason);
        }
    }
}

/// What failed is the input's fault; what could not be asked is the machine's, unless that was accepted beforehand. A file of which no
/// target was checked has not passed either.
int exitCode(const CheckReport& report, bool skipMissing) {
    if (report.failed()) return static_cast<int>(Blame::Input);
    return (report.complete() && report.decided()) || skipMissing ? 0 : static_cast<int>(Blame::Machine);
}

/// In one line what the exit code says.
void printSum(const CheckReport& report, bool skipMissing) {
    const auto count = [&](Verdict verdict) {
        std::ptrdiff_t sum = 0;
        for (const FileReport& file : report.files)
            sum += std::ranges::count(file.targets, verdict, &TargetCheck::verdict);
        return sum;
    };
    fmt::print("{} passed, {} failed, {} not applicable, {} not checked\n", count(Verdict::Passed), count(Verdict::Failed),
               count(Verdict::NotApplicable), count(Verdict::NotChecked));
    for (const FileReport& file : report.files)
        if (!file.decided() && !file.failed()) fmt::print(stderr, "{}: no target has a verdict: nothing of it was checked\n", title(file));
    if (exitCode(report, skipMissing) == static_cast<int>(Blame::Machine) && !report.complete())
        fmt::print(stderr, "not checked is not passed: install what is missing, or accept it with --skip-missing\n");
}

/// The folders that were written, or the first thing that went wrong; a file that failed has been reported already.
Result<std::vector<std::string>> emitAll(const CheckReport& report, const CheckArguments& arguments) {
    std::vector<std::string> folders;
    const auto kinds = chosenTargets(arguments.emitKinds, true);
    if (!kinds) return kinds.error();
    for (const FileReport& file : report.files) {
        if (file.failed()) continue;
        const auto folder = emitEffect(file, {.folder = arguments.emitFolder, .kinds = *kinds, .defines = file.effect.defines});
        if (!folder) return folder.error();
        folders.push_back(folder->string());
    }
    return folders;
}

Result<void> argumentsFit(const CheckArguments& arguments, const std::vector<std::filesystem::path>& files) {
    if (arguments.emitFolder.empty()) return {};
    if (const auto kinds = chosenTargets(arguments.emitKinds, true); !kinds) return kinds.error();
    if (const auto distinct = namesAreDistinct(files); !distinct) return distinct.error();
    return checkFolder(arguments.emitFolder);
}

Result<std::vector<std::filesystem::path>> filesOf(const CheckArguments& arguments) {
    std::vector<std::filesystem::path> files;
    for (const std::string& named : arguments.files) {
        auto file = assets::findEffect(named);
        if (!file) return file.error();
        files.push_back(*std::move(file));
    }
    if (const auto fit = argumentsFit(arguments, files); !fit) return fit.error();
    return files;
}

/// A file without a technique that another one includes is checked there.
void dropIncludes(CheckReport& report) {
    std::set<std::filesystem::path> included;
    std::error_code code;
    for (const FileReport& file : report.files)
        for (std::size_t i = 0; !file.effect.techniques.empty() && i < file.effect.includes.size(); ++i)
            included.insert(std::filesystem::weakly_canonical(file.effect.includes[i], code));
    std::erase_if(report.files, [&](const FileReport& file) {
        return !file.failed() && file.effect.techniques.empty() && included.contains(std::filesystem::weakly_canonical(file.file, code));
    });
}

Json runJson(const CheckReport& report, const CheckArguments& arguments, const std::vector<std::string>& emitted) {
    Json json{{"passed", exitCode(report, arguments.skipMissing) == 0},
              {"failed", report.failed()},
              {"complete", report.complete()},
              {"decided", report.decided()},
              {"files", Json::array()}};
    for (const FileReport& file : report.files)
        json["files"].push_back(fileJson(file));
    if (!emitted.empty()) json["emitted"] = emitted;
    if (arguments.resources) json["resources"] = resourcesJson(resourceTable(report));
    return json;
}

void printText(const CheckReport& report, const CheckArguments& arguments, const std::vector<std::string>& emitted) {
    printProblems(report);
    if (arguments.resources) {
        fmt::print("{}", toMarkdown(resourceTable(report)));
    } else {
        printTable(report);
        printSum(report, arguments.skipMissing);
    }
    for (const std::string& folder : emitted)
        fmt::print("wrote {}/\n", folder);
}

int check(const CheckArguments& arguments) {
    if (arguments.server) return serveEditor(assets::loadOptions(arguments.effect));
    const auto targets = chosenTargets(arguments.targets, false);
    if (!targets) return fail(targets.error(), arguments.json);
    const auto files = filesOf(arguments);
    if (!files) return fail(files.error(), arguments.json);
    const auto earlier = earlierRun(arguments.report, checkFigures);
    if (!earlier) return fail(earlier.error(), arguments.json);
    Progress progress;
    progress.say(fmt::format("checking {} files", files->size()));
    const CheckOptions options = checkOptions(arguments);
    CheckReport report = checkEffects(*files, *targets, options);
    dropIncludes(report);
    const Result<std::vector<std::string>> emitted = arguments.emitFolder.empty() ? std::vector<std::string>() : emitAll(report, arguments);
    progress.clear();
    if (!emitted) {
        if (!arguments.json) printText(report, arguments, {});
        return fail(emitted.error(), arguments.json);
    }
    const Json run = runJson(report, arguments, *emitted);
    if (arguments.json)
        print(run);
    else
        printText(report, arguments, *emitted);
    if (!inputsAreKept()) return exitCode(report, arguments.skipMissing); // the report has said it, and its page would replace an input
    const auto told = tellReport(arguments.report, *earlier, run, checkFigures, [&] { return checkPage(run); });
    if (!told) return fail(told.error(), false);
    return exitCode(report, arguments.skipMissing);
}

} // namespace

void addCheck(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<CheckArguments>();
    CLI::App* command = program.add_subcommand("check", "Compile effects for every target, offline and without a GPU");
    CLI::Option* files =
        command->add_option("effects", arguments->files, "Effects: files (.fx), or names of ours, such as Main")->required();
    repeatable(command->add_option("--target", arguments->targets, targetNames() + ", spirv or all; may be repeated"))
        ->capture_default_str();
    command->add_flag("--all-settings", arguments->allSettings, "Check every setting that an effect has");
    command->add_flag("--gec", arguments->compatible,
                      "Microsoft's compiler with its option /Gec: models 1, changed parameters, byte order marks");
    addEffectOptions(*command, arguments->effect);
    CLI::Option* emit = command->add_option("--emit", arguments->emitFolder, "Write what passed into this folder (docs/emit.md)");
    repeatable(command->add_option("--emit-kind", arguments->emitKinds, targetNames(true) + ", spirv or all; may be repeated"))
        ->capture_default_str()
        ->needs(emit);
    command->add_flag("--resources", arguments->resources,
                      "Print what each pass takes of shader model 3 instead (docs/design/tables/resources.csv); needs target fx_2_0");
    command->add_flag("--skip-missing", arguments->skipMissing, "Accept targets whose tool this machine lacks: exit code 0, not 3");
    command->add_flag("--json", arguments->json, "Print JSON");
    addReportOptions(*command, arguments->report, "--json");
    command
        ->add_flag_callback(
            "--lsp",
            [arguments, files] {
                arguments->server = true;
                files->required(false);
            },
            "Serve an editor by the Language Server Protocol on standard input and output, until it says exit (docs/your-effect.md)")
        ->trigger_on_parse();
    addExamples(*command,
                {{"check Main", "every target"},
                 {"check Main --html check.html", "the same as a page: diagnostics, resources"},
                 {"check my.fx --target fx_2_0 --target sm5 --all-settings", "two targets, three settings"},
                 {"check Main --emit out --skip-missing", "and write what engines load"}},
                "passed          the target's own compiler takes the file\n"
                "not applicable  the file has nothing for this target\n"
                "not checked     this machine lacks the target's tool; the message says what brings it\n"
                "Exit code 1 when any target failed, else 3 when any was not checked, or when a file has no verdict at all.");
    command->callback([arguments, &action] { action = [arguments] { return check(*arguments); }; });
}

} // namespace tegument::app
