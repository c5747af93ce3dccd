// tegument survey: what of a folder of effects is read, compiles, draws, what its pictures show, and whether Microsoft's are the same.

#include "host/effect/reshade.h"
#include "host/support/children.h"
#include "host/support/system.h"
#include "host/support/temporary.h"
#include "tools/check/check.h"
#include "tools/cli/command_line.h"
#include "tools/cli/foreign.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/picture_files.h"
#include "tools/cli/sheet.h"
#include "tools/direct3d9/job.h"
#include "tools/direct3d9/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <future>
#include <map>
#include <memory>
#include <thread>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct SurveyOptions {
    std::string folder;
    std::vector<std::string> targets = {"spirv-dxc"};
    EffectOptions effect;
    std::string size = "128";
    std::string pictures; // folder; empty: none are written
    std::string sheet;    // file; empty: none is written
    std::string pictureIn;
    std::string device;
    bool againstMicrosoft = false;
    fs::path reference; // folder of what that needs
    bool json = false;
};

/// What became of one file: "" where it did not get so far.
struct Row {
    std::string file;
    std::string read;                           // "read", "refused: TG1101"
    std::map<std::string, std::string> targets; // verdict by target
    std::string drawn;                          // "drawn", "black", "one colour", "not drawn: TG4003"
    std::string picture;                        // what it shows: pictureClass()
    std::string why;                            // the first message of what went wrong, with its place
    std::string construct;                      // its text alone
    std::string microsoft;                      // "equal", "differs", "black", "not compared: it is not of Direct3D 9"
    std::optional<double> error;                // of ours, as a part of Microsoft's
    bool changes = false;                       // a picture that it is given: an effect of ReShade
};

constexpr const char* kMicrosofts = ".microsoft.png";
const std::string kNotCompared = "not compared: ";
constexpr double kLongestFile = 300; // seconds for one file; the longest seen takes 9

struct Found {
    std::vector<fs::path> effects;
    std::vector<Diagnostic> unread; // a warning for each folder that cannot be read
};

/// All effects below the folder; links to folders are not followed.
Result<Found> effectsIn(const fs::path& folder) {
    Found found;
    std::vector<fs::path> folders = {folder};
    while (!folders.empty()) {
        const fs::path here = std::move(folders.back());
        folders.pop_back();
        std::error_code error;
        for (fs::directory_iterator entry(here, error), end; !error && entry != end; entry.increment(error)) {
            std::error_code ignored;
            if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) folders.push_back(entry->path());
            if (toLower(entry->path().extension().string()) == ".fx") found.effects.push_back(entry->path());
        }
        if (!error) continue;
        const std::string text = fmt::format("cannot read the folder {}: {}", here.string(), error.message());
        if (here == folder) return usageError(8006, text);
        found.unread.push_back(inputWarning(8006, {}, text, "the effects below it are left out"));
    }
    if (found.effects.empty())
        return usageError(8006, fmt::format("there is no effect below the folder {}", folder.string()),
                          "files named *.fx are read; one of another name is checked by itself: tegument check FILE");
    std::ranges::sort(found.effects);
    return found;
}

std::string codeOf(const Error& error) {
    return error.diagnostics.empty() ? std::string("?") : fmt::format("TG{:04}", error.diagnostics.front().code);
}

std::string firstLine(const Error& error) {
    const std::string text = format(error);
    return text.substr(0, text.find('\n'));
}

void blame(Row& row, const Error& error) {
    if (!row.why.empty()) return;
    row.why = firstLine(error);
    row.construct = error.diagnostics.empty() ? std::string() : error.diagnostics.front().text;
}

/// The effects of a folder may include each other's files.
LoadOptions loadIn(const SurveyOptions& options) {
    LoadOptions load = assets::loadOptions(options.effect);
    load.roots.folders.emplace_back(options.folder);
    return load;
}

/// Whether every pixel of the picture is the same, and black.
std::string pictureOf(const Image& image) {
    const auto plain = plainPictureNote(image, {});
    if (!plain) return "drawn";
    return plain->text.find("black") != std::string::npos ? "black" : "one colour";
}

/// What eight bits of it show: one colour that covers 95 % of what is not the background is a flat shape.
std::string pictureClass(const Image& image) {
    constexpr double kFlat = 0.95;
    std::map<std::uint32_t, std::size_t> colours;
    const auto channels = static_cast<std::size_t>(image.channels);
    const auto colourAt = [&](std::size_t pixel) {
        std::uint32_t colour = 0;
        for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c) {
            const float value = image.pixels[pixel * channels + c];
            colour = colour << 8U | static_cast<std::uint32_t>(value >= 0 ? std::lround(std::min(value, 1.0F) * 255) : 0); // of NaN, too
        }
        return colour;
    };
    const std::size_t pixels = image.pixels.size() / channels;
    for (std::size_t i = 0; i < pixels; ++i)
        ++colours[colourAt(i)];
    if (colours.size() == 1) return colours.contains(0) ? "nothing" : "one colour";
    if (colours.size() == 2) return "two colours";
    const std::size_t background = colours[colourAt(0)];
    colours.erase(colourAt(0));
    const std::size_t most = std::ranges::max_element(colours, {}, &std::pair<const std::uint32_t, std::size_t>::second)->second;
    return static_cast<double>(most) >= kFlat * static_cast<double>(pixels - background) ? "flat shape" : "picture";
}

/// Whether eight bits of them are the same.
bool sameOnDisplay(const Image& a, const Image& b) {
    return std::ranges::equal(a.pixels, b.pixels, [](float x, float y) { return std::abs(x - y) < 0.5F / 255; });
}

fs::path pictureFile(const SurveyOptions& options, const fs::path& file, const char* ending = ".png") {
    std::string name = fs::relative(file, options.folder).replace_extension(ending).string();
    std::ranges::replace(name, '/', '.');
    return fs::path(options.pictures) / name;
}

void draw(const SurveyOptions& options, const fs::path& file, gpu::Device& device, Row& row) {
    JobOptions wanted;
    wanted.file = file.string();
    wanted.effect = options.effect;
    wanted.size = options.size;
    wanted.samples = 1;
    wanted.pictureIn = row.changes ? options.pictureIn : "";
    auto job = assets::loadJob(wanted, MeshFor::Technique);
    const auto refused = [&](const Error& error) {
        row.drawn = "not drawn: " + codeOf(error);
        blame(row, error);
    };
    if (!job) return refused(job.error());
    const auto result = assets::runScene(device, job->effect, job->scene, job->run);
    if (!result) return refused(result.error());
    row.drawn = pictureOf(result->image);
    row.picture = pictureClass(result->image);
    if (row.changes) {
        job->run.technique = kPictureTechnique;
        const auto before = assets::runScene(device, job->effect, job->scene, job->run);
        if (before && sameOnDisplay(before->image, result->image)) row.picture = "unchanged";
    }
    if (options.againstMicrosoft) {
        ReferencePicture reference{.name = contentHash(row.file), .file = file, .load = loadIn(options)};
        const Mesh* mesh = job->scene.meshes.empty() ? nullptr : &job->scene.meshes.front();
        drawForReference(device, reference, mesh, job->scene.workspace, job->run, options.reference);
        row.microsoft = reference.why.empty() ? "" : kNotCompared + reference.why;
    }
    if (options.pictures.empty()) return;
    const PictureOptions pictures{.displayReferred = job->effect.displayColours};
    if (const auto written = writePicture(pictures, pictureFile(options, file), result->image); !written) blame(row, written.error());
}

/// The targets' verdicts of all these files at once: Microsoft's compiler is started once for many.
void check(const std::vector<fs::path>& files, const std::vector<Target>& targets, const SurveyOptions& options, std::vector<Row>& rows) {
    if (targets.empty()) return;
    const LoadOptions load = loadIn(options);
    CheckOptions wanted{.variants = {Variant{.defines = load.defines}}, .includeFolders = load.includeFolders};
    wanted.roots = load.roots;
    const CheckReport report = checkEffects(files, targets, wanted);
    for (const FileReport& file : report.files)
        for (Row& row : rows) {
            if (row.file != file.file.string()) continue;
            for (const TargetCheck& target : file.targets) {
                row.targets[std::string(targetName(target.target))] = std::string(verdictName(target.verdict));
                if (target.verdict != Verdict::Failed) continue;
                for (const Diagnostic& diagnostic : target.diagnostics)
                    if (diagnostic.severity == Severity::Error) blame(row, {Blame::Input, {diagnostic}});
            }
        }
}

/// How often each reason, the most frequent first.
using Reasons = std::map<std::string, std::map<std::string, int>>; // of a verdict, by its text

void printCounts(const std::string& what, const std::map<std::string, int>& counts, const Reasons& reasons) {
    constexpr std::size_t kMost = 8; // reasons of one verdict
    for (const auto& [name, number] : counts) {
        fmt::print("{:<14} {:<28} {}\n", what, name, number);
        const auto found = reasons.find(name);
        if (found == reasons.end()) continue;
        std::vector<std::pair<std::string, int>> list(found->second.begin(), found->second.end());
        std::ranges::stable_sort(list, std::greater<>{}, &std::pair<std::string, int>::second);
        for (std::size_t i = 0; i < std::min(list.size(), kMost); ++i)
            fmt::print("    {:>6}  {}\n", list[i].second, list[i].first);
        if (list.size() > kMost) fmt::print("            and {} more\n", list.size() - kMost);
    }
}

void printSums(const std::vector<Row>& rows) {
    std::map<std::string, int> read;
    std::map<std::string, std::map<std::string, int>> targets;
    std::map<std::string, int> drawn;
    std::map<std::string, int> pictures;
    std::map<std::string, int> microsoft;
    Reasons refused;
    Reasons notDrawn;
    Reasons notCompared;
    std::map<std::string, Reasons> failed; // by target
    for (const Row& row : rows) {
        ++read[row.read];
        if (row.read != "read") ++refused[row.read][row.construct];
        for (const auto& [target, verdict] : row.targets) {
            ++targets[target][verdict];
            if (verdict == verdictName(Verdict::Failed)) ++failed[target][verdict][row.construct];
        }
        if (row.drawn.empty()) continue;
        ++drawn[row.drawn];
        if (!row.picture.empty()) ++pictures[row.picture];
        if (row.microsoft.starts_with(kNotCompared)) ++notCompared["not compared"][row.microsoft.substr(kNotCompared.size())];
        if (!row.microsoft.empty()) ++microsoft[row.microsoft.substr(0, row.microsoft.find(':'))];
        if (row.drawn.starts_with("not drawn")) ++notDrawn[row.drawn][row.construct];
    }
    fmt::print("\n{} files\n", rows.size());
    printCounts("reading", read, refused);
    for (const auto& [target, counts] : targets)
        printCounts(target, counts, failed[target]);
    printCounts("drawing", drawn, notDrawn);
    printCounts("picture", pictures, {});
    printCounts("Microsoft's", microsoft, notCompared);
}

Json rowsJson(const std::vector<Row>& rows) {
    Json json = Json::array();
    for (const Row& row : rows)
        json.push_back({{"file", row.file},
                        {"read", row.read},
                        {"targets", row.targets},
                        {"drawn", row.drawn},
                        {"picture", row.picture},
                        {"microsoft", row.microsoft},
                        {"error", row.error ? Json(*row.error) : Json()},
                        {"why", row.why},
                        {"construct", row.construct}});
    return json;
}

void printRows(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        std::string line = fmt::format("{}: {}", row.file, row.read);
        for (const auto& [target, verdict] : row.targets)
            line += fmt::format(", {} {}", target, verdict);
        if (!row.drawn.empty()) line += ", " + row.drawn;
        if (!row.picture.empty() && row.drawn == "drawn") line += ", " + row.picture;
        if (!row.microsoft.empty()) line += ", Microsoft's: " + row.microsoft;
        if (row.error) line += fmt::format(", error {:.4f}", *row.error);
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

bool isSpirv(Target target) {
    return target == Target::SpirvDxc || target == Target::SpirvGlslang;
}

/// In another process: what brings it down is said of this file, and the next one gets a new process.
std::string answerFor(const SurveyOptions& options, const std::vector<Target>& targets, std::string_view file) {
    static auto device = gpu::Device::create({.validation = false, .prefer = options.device});
    std::vector<Row> rows{{.file = std::string(file)}};
    Row& row = rows.front();
    const auto effect = loadEffect(row.file, loadIn(options));
    if (!effect) {
        row.read = "refused: " + codeOf(effect.error());
        blame(row, effect.error());
    } else {
        row.read = "read";
        row.changes = effect->reshade;
        if (device) {
            draw(options, row.file, *device, row);
        } else {
            row.drawn = "not drawn: " + codeOf(device.error());
            blame(row, device.error());
        }
        check({row.file}, targets, options, rows);
    }
    return rowsJson(rows).front().dump(-1, ' ', false, Json::error_handler_t::replace);
}

Row rowOf(const ChildAnswer& answer, const std::string& file) {
    Row row{.file = file};
    const Json json = answer.answered ? Json::parse(answer.bytes, nullptr, false) : Json();
    if (json.is_object()) {
        row.read = json.value("read", "");
        row.drawn = json.value("drawn", "");
        row.picture = json.value("picture", "");
        row.microsoft = json.value("microsoft", "");
        row.targets = json.value("targets", std::map<std::string, std::string>());
        row.why = json.value("why", "");
        row.construct = json.value("construct", "");
        return row;
    }
    row.read = "read";
    row.drawn = "not drawn: TG4071";
    row.construct = answer.timedOut      ? fmt::format("did not end in {} s", kLongestFile)
                    : answer.signal != 0 ? fmt::format("the process was ended by signal {} ({})", answer.signal, signalName(answer.signal))
                                         : std::string("the process left without an answer");
    row.why = fmt::format("{}: error TG4071: {}", file, row.construct);
    return row;
}

/// One process for each processor. Threads of host/support/parallel.h would leave locks held in the copies of this process.
std::vector<Row> rowsOf(const SurveyOptions& options, const std::vector<fs::path>& files, const std::vector<Target>& targets) {
    std::shared_mutex busy; // nothing else of this program runs meanwhile
    // Small pictures, each of shaders of its own: Mesa's software device would take longer to optimise than to draw. The bits are the same.
    setByDefault("GALLIVM_PERF", "nopt");
    Children workers([&](std::string_view file) { return answerFor(options, targets, file); }, busy);
    const std::size_t processors = std::max<std::size_t>(std::min<std::size_t>(std::thread::hardware_concurrency(), files.size()), 1);
    workers.prepare(processors);
    std::vector<Row> rows(files.size());
    std::atomic<std::size_t> next = 0;
    std::atomic<std::size_t> done = 0;
    std::mutex mutex;
    Progress progress;
    const auto work = [&] {
        for (std::size_t i = next++; i < files.size(); i = next++) {
            rows[i] = rowOf(workers.ask(files[i].string(), kLongestFile), files[i].string());
            const std::lock_guard lock(mutex);
            progress.count("reading, compiling and drawing", ++done, files.size());
        }
    };
    std::vector<std::future<void>> threads;
    for (std::size_t i = 1; i < processors; ++i)
        threads.push_back(std::async(std::launch::async, work));
    work();
    for (std::future<void>& thread : threads)
        thread.get();
    progress.clear();
    return rows;
}

/// Of those that are drawn and not yet said not to be compared.
Result<void> compareWithMicrosoft(const SurveyOptions& options, std::vector<Row>& rows) {
    std::vector<ReferencePicture> pictures;
    std::vector<Row*> compared;
    for (Row& row : rows) {
        if (row.picture.empty() || !row.microsoft.empty()) continue;
        pictures.push_back({.name = contentHash(row.file), .file = row.file, .load = loadIn(options)});
        compared.push_back(&row);
    }
    if (auto drawn = drawByMicrosoft(pictures, options.reference); !drawn) return drawn;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        Row& row = *compared[i];
        const std::string& name = pictures[i].name;
        const auto error = pictures[i].why.empty() ? referenceError(options.reference, name) : Result<ReferenceError>(ReferenceError{});
        if (!error) return error.error();
        row.microsoft = !pictures[i].why.empty() ? kNotCompared + pictures[i].why
                        : error->equal()         ? "equal"
                        : error->black           ? "black"
                                                 : "differs";
        if (!pictures[i].why.empty()) continue;
        row.error = error->relative;
        if (options.pictures.empty()) continue;
        const auto image = readFloats(options.reference / (name + ".picture.f32"));
        if (!image) return image.error();
        if (auto written = writePicture({.displayReferred = true}, pictureFile(options, row.file, kMicrosofts), *image); !written)
            return written;
    }
    return {};
}

/// All that were drawn, in the order of the table; Microsoft's to the right of each.
Result<void> writeSheet(const SurveyOptions& options, const std::vector<Row>& rows) {
    constexpr int kColumns = 12;
    constexpr int kGap = 4;
    std::vector<Image> images;
    for (const Row& row : rows) {
        if (row.picture.empty()) continue;
        auto image = loadImage(pictureFile(options, row.file));
        if (!image) return image.error();
        images.push_back(*image);
        if (!options.againstMicrosoft) continue;
        if (row.error) image = loadImage(pictureFile(options, row.file, kMicrosofts));
        if (!image) return image.error();
        if (!row.error) std::ranges::fill(image->pixels, 1.0F); // nothing to compare with
        images.push_back(std::move(*image));
    }
    if (images.empty()) return {};
    return writePng(options.sheet, contactSheet(images, kColumns, kGap), PngEncoding::Raw);
}

int survey(SurveyOptions options) {
    const auto targets = targetsOf(options);
    if (!targets) return fail(targets.error(), options.json);
    if (!options.sheet.empty())
        if (const auto can = checkOutput(options.sheet, {}); !can) return fail(can.error(), options.json);
    if (!options.pictures.empty())
        if (const auto folder = checkFolder(options.pictures); !folder) return fail(folder.error(), options.json);
    std::optional<Temporary> reference;
    if (options.againstMicrosoft) {
        if (const std::string missing = direct3dClientMissing(); !missing.empty())
            return fail(
                machineError(3104, "Microsoft's pictures cannot be drawn: " + missing,
                             "./bootstrap test brings Wine, Microsoft's compiler and d3d_client.exe; TEGUMENT_D3D_CLIENT names the last"),
                options.json);
        reference.emplace(newTemporaryFolder());
        options.reference = reference->path();
    }
    const auto found = effectsIn(options.folder);
    if (!found) return fail(found.error(), options.json);
    warn(found->unread);
    std::vector<Target> here;
    std::vector<Target> inWine; // once for all files
    for (const Target target : *targets)
        (isSpirv(target) ? here : inWine).push_back(target);
    std::vector<Row> rows = rowsOf(options, found->effects, here);
    std::vector<fs::path> good;
    for (const Row& row : rows)
        if (row.read == "read") good.emplace_back(row.file);
    check(good, inWine, options, rows);
    if (options.againstMicrosoft)
        if (const auto compared = compareWithMicrosoft(options, rows); !compared) return fail(compared.error(), options.json);
    if (!options.sheet.empty())
        if (const auto written = writeSheet(options, rows); !written) return fail(written.error(), options.json);
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
    repeatable(command->add_option("--target", options->targets, targetNames() + ", spirv, all or none; may be repeated"))
        ->capture_default_str();
    command->add_option("--size", options->size, "Picture size in pixels")->capture_default_str();
    CLI::Option* output = command->add_option("-o,--output", options->pictures, "Folder for the pictures; without it none are written");
    command->add_option("--sheet", options->sheet, "All of them in one PNG, in the order of the table")->needs(output);
    command->add_flag("--against-microsoft", options->againstMicrosoft,
                      "Draw those of Direct3D 9 by Microsoft's binaries in Wine, too, and say how far ours are off");
    command->add_option("--picture-in", options->pictureIn, "What effects of ReShade change; default: a scene of our own");
    command->add_option("--device", options->device, "Part of the Vulkan device's name");
    command->add_flag("--json", options->json, "Print JSON");
    addEffectOptions(*command, options->effect);
    addExamples(*command,
                {{"survey my_effects", "a line for each file, and sums"}, {"survey my_effects -o pictures", "with their pictures"}});
    command->callback([options, &action] { action = [options] { return survey(*options); }; });
}

} // namespace tegument::app
