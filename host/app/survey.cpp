// tegument survey: what of a folder of effects is read, compiles, draws, and what its pictures show.

#include "host/app/command_line.h"
#include "host/app/foreign.h"
#include "host/app/job.h"
#include "host/app/output.h"
#include "host/app/picture_files.h"
#include "host/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct SurveyOptions {
    std::string folder;
    std::vector<std::string> targets = {"spirv-dxc"};
    EffectOptions effect;
    std::string size = "128";
    std::string pictures; // folder; empty: none are written
    std::string device;
    bool json = false;
};

/// What became of one file: "" where it did not get so far.
struct Row {
    std::string file;
    std::string read;                           // "read", "refused: TG1101"
    std::map<std::string, std::string> targets; // verdict by target
    std::string drawn;                          // "drawn", "black", "one colour", "not drawn: TG4003"
    std::string why;                            // the first message of what went wrong
};

Result<std::vector<fs::path>> effectsIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (toLower(entry->path().extension().string()) == ".fx") files.push_back(entry->path());
    if (error) return usageError(8006, fmt::format("cannot read the folder {}", folder.string()));
    std::ranges::sort(files);
    return files;
}

std::string codeOf(const Error& error) {
    return error.diagnostics.empty() ? std::string("?") : fmt::format("TG{:04}", error.diagnostics.front().code);
}

std::string firstLine(const Error& error) {
    const std::string text = format(error);
    return text.substr(0, text.find('\n'));
}

/// Whether every pixel of the picture is the same, and black.
std::string pictureOf(const Image& image) {
    const auto plain = plainPictureNote(image, {});
    if (!plain) return "drawn";
    return plain->text.find("black") != std::string::npos ? "black" : "one colour";
}

void draw(const SurveyOptions& options, const fs::path& file, gpu::Device& device, Row& row) {
    JobOptions wanted;
    wanted.file = file.string();
    wanted.effect = options.effect;
    wanted.size = options.size;
    wanted.samples = 1;
    auto job = loadJob(wanted, MeshFor::Technique);
    const auto refused = [&](const Error& error) {
        row.drawn = "not drawn: " + codeOf(error);
        row.why = firstLine(error);
    };
    if (!job) return refused(job.error());
    const auto result = runScene(device, job->effect, job->scene, job->run);
    if (!result) return refused(result.error());
    row.drawn = pictureOf(result->image);
    if (options.pictures.empty()) return;
    const PictureOptions pictures{.displayReferred = job->effect.adopted};
    std::string name = fs::relative(file, options.folder).replace_extension(".png").string();
    std::ranges::replace(name, '/', '.');
    if (const auto written = writePicture(pictures, fs::path(options.pictures) / name, result->image); !written)
        row.why = firstLine(written.error());
}

/// The targets' verdicts of all files at once: Microsoft's compiler is started once for many.
void check(const std::vector<fs::path>& files, const std::vector<Target>& targets, const SurveyOptions& options, std::vector<Row>& rows) {
    if (targets.empty()) return;
    const LoadOptions load = loadOptions(options.effect);
    const CheckReport report =
        checkEffects(files, targets, {.variants = {Variant{.name = {}, .defines = load.defines}}, .includeFolders = load.includeFolders});
    for (const FileReport& file : report.files)
        for (Row& row : rows) {
            if (row.file != file.file.string()) continue;
            for (const TargetCheck& target : file.targets) {
                row.targets[std::string(targetName(target.target))] = std::string(verdictName(target.verdict));
                if (target.verdict == Verdict::Failed && row.why.empty())
                    for (const Diagnostic& diagnostic : target.diagnostics)
                        if (diagnostic.severity == Severity::Error && row.why.empty()) row.why = firstLine({Blame::Input, {diagnostic}});
            }
        }
}

void count(const std::string& what, const std::map<std::string, int>& counts) {
    for (const auto& [name, number] : counts)
        fmt::print("{:<14} {:<28} {}\n", what, name, number);
}

void printSums(const std::vector<Row>& rows) {
    std::map<std::string, int> read;
    std::map<std::string, std::map<std::string, int>> targets;
    std::map<std::string, int> drawn;
    for (const Row& row : rows) {
        ++read[row.read];
        for (const auto& [target, verdict] : row.targets)
            ++targets[target][verdict];
        if (!row.drawn.empty()) ++drawn[row.drawn];
    }
    fmt::print("\n{} files\n", rows.size());
    count("reading", read);
    for (const auto& [target, counts] : targets)
        count(target, counts);
    count("drawing", drawn);
}

Json rowsJson(const std::vector<Row>& rows) {
    Json json = Json::array();
    for (const Row& row : rows)
        json.push_back({{"file", row.file}, {"read", row.read}, {"targets", row.targets}, {"drawn", row.drawn}, {"why", row.why}});
    return json;
}

void printRows(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        std::string line = fmt::format("{}: {}", row.file, row.read);
        for (const auto& [target, verdict] : row.targets)
            line += fmt::format(", {} {}", target, verdict);
        if (!row.drawn.empty()) line += ", " + row.drawn;
        fmt::print("{}\n", line);
        if (!row.why.empty()) fmt::print("    {}\n", row.why);
    }
}

Result<std::vector<Target>> targetsOf(const SurveyOptions& options) {
    std::vector<Target> targets;
    for (const std::string& name : options.targets) {
        if (name == "none") continue;
        const auto named = targetsByName(name);
        if (named.empty()) return usageError(8020, fmt::format("unknown target '{}'", name));
        targets.insert(targets.end(), named.begin(), named.end());
    }
    return targets;
}

int survey(const SurveyOptions& options) {
    const auto targets = targetsOf(options);
    if (!targets) return fail(targets.error(), options.json);
    const auto files = effectsIn(options.folder);
    if (!files) return fail(files.error(), options.json);
    auto device = gpu::Device::create({.validation = false, .prefer = options.device});
    if (!device) return fail(device.error(), options.json);
    Progress progress;
    std::vector<Row> rows;
    std::vector<fs::path> good;
    for (std::size_t i = 0; i < files->size(); ++i) {
        progress.count("reading and drawing", i + 1, files->size());
        Row row{.file = (*files)[i].string()};
        const auto effect = loadEffect((*files)[i], loadOptions(options.effect));
        if (!effect) {
            row.read = "refused: " + codeOf(effect.error());
            row.why = firstLine(effect.error());
        } else {
            row.read = "read";
            good.push_back((*files)[i]);
            draw(options, (*files)[i], *device, row);
        }
        rows.push_back(std::move(row));
    }
    progress.say("compiling");
    check(good, *targets, options, rows);
    progress.clear();
    if (options.json) {
        print({{"files", rowsJson(rows)}});
    } else {
        printRows(rows);
        printSums(rows);
    }
    return 0;
}

} // namespace

void addSurvey(CLI::App& program, Action& action) {
    auto options = std::make_shared<SurveyOptions>();
    CLI::App* command = program.add_subcommand("survey", "What of a folder of effects is read, compiles and draws");
    command->add_option("folder", options->folder, "Folder; all files *.fx below it")->required();
    repeatable(command->add_option("--target", options->targets,
                                   "fx_2_0, fx_4_0, fx_5_0, sm5, spirv-dxc, spirv-glslang, all or none; may be repeated"))
        ->capture_default_str();
    command->add_option("--size", options->size, "Picture size in pixels")->capture_default_str();
    command->add_option("-o,--output", options->pictures, "Folder for the pictures; without it none are written");
    command->add_option("--device", options->device, "Part of the Vulkan device's name");
    command->add_flag("--json", options->json, "Print JSON");
    addEffectOptions(*command, options->effect);
    addExamples(*command,
                {{"survey my_effects", "a line for each file, and sums"}, {"survey my_effects -o pictures", "with their pictures"}});
    command->callback([options, &action] { action = [options] { return survey(*options); }; });
}

} // namespace tegument::app
