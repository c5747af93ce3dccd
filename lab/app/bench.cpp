// tegument bench: techniques against each other, milliseconds beside error.

#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "host/support/temporary.h"
#include "lab/app/bench_page.h"
#include "lab/app/commands.h"
#include "lab/bench/choice.h"
#include "lab/bench/fur.h"
#include "lab/bench/python.h"
#include "lab/bench/report.h"
#include "lab/stability/stability.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/report_options.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct StabilityArguments {
    std::filesystem::path effects;
    std::vector<std::string> parts;   // empty: all
    std::vector<std::string> modules; // likewise
    int size = 128;                   // texels a side of the maps, pixels a side of the pictures
    Compiler compiler = Compiler::Dxc;
    std::string device;
    std::string json; // file, "-": standard output, empty: none
    ReportOptions report;
};

void printReport(const bench::StabilityReport& report) {
    std::vector<std::vector<std::string>> rows;
    for (const bench::StabilityRow& row : report.rows)
        rows.push_back({row.module, row.hardCase, row.figure, fmt::format("{:.2g}", row.value),
                        row.limit ? fmt::format("{:.2g}", *row.limit) : "-", std::to_string(row.notFinite), row.pass() ? "" : "FAIL",
                        row.cause});
    fmt::print("{}", table({"module", "hard case", "figure", "value", "limit", "not finite", "", "caused by"}, rows));
    for (const std::string& note : report.notes)
        fmt::print("{}\n", note);
}

Result<bool> measure(const StabilityArguments& arguments) {
    const auto earlier = earlierRun(arguments.report, stabilityFigures);
    if (!earlier) return earlier.error();
    auto device = gpu::Device::create({.validation = false, .prefer = arguments.device});
    if (!device) return device.error();
    Progress progress;
    const auto report = bench::measureStability(*device, {.effects = arguments.effects,
                                                          .compiler = arguments.compiler,
                                                          .size = arguments.size,
                                                          .parts = arguments.parts,
                                                          .modules = arguments.modules,
                                                          .other = nullptr,
                                                          .say = [&](const std::string& line) { progress.say(line); }});
    progress.clear();
    if (!report) return report.error();
    const std::string json = bench::stabilityJson(*report);
    const Json run = Json::parse(json);
    const auto told = tellReport(arguments.report, *earlier, run, stabilityFigures, [&] { return stabilityPage(run); });
    if (!told) return told.error();
    if (arguments.json == "-") {
        fmt::print("{}", json);
        return report->pass();
    }
    if (!arguments.json.empty())
        if (const auto written = writeFile(arguments.json, json); !written) return written.error();
    printReport(*report);
    fmt::print("\n{} of {} figures pass on {}, {}; maps of {} x {}\n", std::ranges::count_if(report->rows, &bench::StabilityRow::pass),
               report->rows.size(), report->device, report->driver, report->size, report->size);
    return report->pass();
}

/// The tables of such a report's JSON as Markdown; none when it is something else.
std::optional<std::string> stabilityTables(const std::string& json) {
    const auto report = bench::stabilityFromJson(json);
    return report ? std::optional(bench::stabilityMarkdown(*report)) : std::nullopt;
}

/// The exit code: 1 where something is not finite or beyond its limit.
int benchStability(const StabilityArguments& arguments) {
    const auto passed = measure(arguments);
    if (!passed) return fail(passed.error(), arguments.json == "-");
    return *passed ? 0 : static_cast<int>(Blame::Input);
}

struct BenchArguments {
    std::vector<std::string> scenes = {"head"};
    std::vector<std::string> techniques;
    std::vector<std::string> settings;
    std::string lights = bench::kKeyAlone;
    std::string size;
    std::vector<int> mapSizes;
    std::vector<int> shadowSizes;
    int frames = 0;
    std::string reference = "1024";
    int grid = 1;
    std::string referencePart; // empty: all of it, and the comparison
    std::string keepScenes;
    std::string catalogue; // beside ours
    std::string compiler;
    std::string device;
    std::string json;
    std::string csv;
    std::string plot;
    std::string pictures;
    ReportOptions report;
    bool count = false;
    bool pick = false;
    double maxError = 0;
    double maxMs = 0;
    std::string markdown;
    bool growth = false;
    bool ablation = false;
    bool motion = false;
    bool fur = false;
    bool stability = false;
    std::vector<std::string> parts;
    std::vector<std::string> modules;
};

/// What is small enough for a processor, and what a graphics card is measured at.
struct Defaults {
    const char* size;
    int mapSize;
    int warmUp;
    int frames;
};

Defaults defaultsFor(const gpu::Device& device) {
    return device.info().cpu ? Defaults{"320x320", 1024, 2, 5} : Defaults{"1920x1080", 1024, 10, 50};
}

const char* shippedCatalogue(const BenchArguments& arguments) {
    return arguments.fur ? "effects/fur_catalogue.json" : "effects/catalogue.json";
}

/// "full", or a number of pixels.
Result<std::size_t> referencePixels(const std::string& text) {
    if (text == "full") return std::size_t{0};
    std::size_t count = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), count);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || count == 0)
        return usageError(8077, fmt::format("--reference {}: neither 'full' nor a number of pixels", text), "for example --reference 1024");
    return count;
}

/// A choice is one of the maps' size, too: a small picture needs less than is usual. Maps seen from the light stay as they are.
std::vector<int> mapSizesOf(const BenchArguments& arguments, const Defaults& defaults) {
    if (!arguments.mapSizes.empty()) return arguments.mapSizes;
    if (!arguments.pick || arguments.fur) return {defaults.mapSize};
    return {defaults.mapSize / 4, defaults.mapSize / 2, defaults.mapSize};
}

std::vector<int> shadowSizesOf(const BenchArguments& arguments, const Defaults& defaults) {
    if (!arguments.shadowSizes.empty()) return arguments.shadowSizes;
    return {arguments.mapSizes.empty() ? defaults.mapSize : 0};
}

Result<bench::BenchOptions> optionsOf(const BenchArguments& arguments, const gpu::Device& device) {
    const Defaults defaults = defaultsFor(device);
    const auto size = assets::parseSize(arguments.size.empty() ? defaults.size : arguments.size);
    if (!size) return size.error();
    const auto compiler = assets::chosenCompiler(arguments.compiler);
    if (!compiler) return compiler.error();
    const auto pixels = referencePixels(arguments.reference);
    if (!pixels) return pixels.error();
    bench::BenchOptions options{.effects = assets::ownFile(shippedCatalogue(arguments)).parent_path(),
                                .sceneFolder = arguments.keepScenes,
                                .scenes = arguments.scenes,
                                .width = size->first,
                                .height = size->second,
                                .mapSizes = mapSizesOf(arguments, defaults),
                                .shadowSizes = shadowSizesOf(arguments, defaults),
                                .frames = {.warmUp = defaults.warmUp, .timed = arguments.frames > 0 ? arguments.frames : defaults.frames},
                                .compiler = *compiler,
                                .pixels = *pixels,
                                .grid = arguments.grid,
                                .pictures = arguments.pictures,
                                .count = arguments.count,
                                .assets = assets::meshAssets([](const std::string& made) { say(made); }),
                                .lights = arguments.lights};
    return options;
}

bench::Machine machineOf(const gpu::Device& device, Compiler compiler) {
    return {.device = device.info().name,
            .driver = device.info().driver,
            .compiler = compilerName(compiler),
            .date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))),
            .version = TEGUMENT_VERSION,
            .cpu = device.info().cpu};
}

void printRows(const std::vector<bench::Row>& rows, const bench::Machine& machine) {
    const bench::Table cells = bench::toTable(rows);
    fmt::print("{}\n{}, driver {}; {} x {}, {:.0f} % of the first picture is skin{}\n", table(cells.header, cells.rows), machine.device,
               machine.driver, rows.front().width, rows.front().height, 100 * rows.front().coverage,
               machine.cpu ? "; a software device: its times are good as ratios only" : "");
}

/// What is known of a row, for a choice: "PyramidCompute corrected, maps of 512: 3.100 ms (3.0 to 3.4), relative L2 .0120, .21 of no
/// diffusion's".
std::string figuresOf(const std::vector<bench::Row>& rows, std::size_t index) {
    const bench::Row& row = rows[index];
    const bench::Spread& time = row.drawn.milliseconds;
    std::string text = fmt::format("{} {}, maps of {}: {:.3f} ms ({:.3f} to {:.3f}), relative L2 {:.4f}", row.contender.name(),
                                   row.contender.setting, row.mapSize, time.median, time.p5, time.p95, row.errors.relativeL2);
    if (const auto share = bench::shareOfNoDiffusion(rows, index)) text += fmt::format(", {:.2f} of no diffusion's", *share);
    if (row.errors.flip) text += fmt::format(", FLIP {:.4f}", *row.errors.flip);
    return text;
}

/// For each scene its own choice; the worst exit code. No diffusion may be chosen where it is named.
int pickForEachScene(const BenchArguments& arguments, const std::vector<bench::Row>& rows) {
    const bool asked = std::ranges::any_of(rows, [&](const bench::Row& row) {
        return row.contender.claim == bench::Claim::Delta &&
               std::ranges::any_of(arguments.techniques, [&](const std::string& name) { return row.contender.isCalled(name); });
    });
    bench::Limit limit{.error = {}, .milliseconds = {}, .withoutDiffusion = asked};
    if (arguments.maxError > 0) limit.error = arguments.maxError;
    if (arguments.maxMs > 0) limit.milliseconds = arguments.maxMs;
    int code = 0;
    for (std::size_t first = 0; first < rows.size();) {
        std::vector<bench::Row> ofScene;
        for (; first < rows.size() && (ofScene.empty() || rows[first].scene == ofScene.front().scene); ++first)
            ofScene.push_back(rows[first]);
        const auto chosen = bench::pick(ofScene, limit);
        if (!chosen) {
            fmt::print("{}: nothing measured keeps that limit\n", ofScene.front().scene);
            code = static_cast<int>(Blame::Input);
            continue;
        }
        fmt::print("{}: {}\n", ofScene.front().scene, figuresOf(ofScene, chosen->row));
        for (const std::size_t tie : chosen->ties)
            fmt::print("  {} within the spread: {}\n", limit.error ? "as fast" : "may do as well", figuresOf(ofScene, tie));
        fmt::print("{}\n", bench::renderCommand(ofScene[chosen->row]));
    }
    return code;
}

Result<void> writeTo(const std::string& target, const std::string& text) {
    if (target == "-") {
        fmt::print("{}", text);
        return {};
    }
    const auto written = writeFile(target, text);
    if (written) fmt::print(stderr, "wrote {}\n", target);
    return written;
}

/// The table first: a file that cannot be written must not take it along.
Result<int> report(const BenchArguments& arguments, const std::vector<bench::Row>& rows, const bench::Machine& machine) {
    for (const bench::Row& row : rows)
        if (row.failure)
            fmt::print(stderr, "{} {} on {}:\n{}\n", row.contender.name(), row.contender.setting, row.scene, format(*row.failure));
    const bool quiet = arguments.json == "-" || arguments.csv == "-";
    if (!quiet) printRows(rows, machine);
    if (!arguments.json.empty())
        if (const auto written = writeTo(arguments.json, bench::toJson(rows, machine)); !written) return written.error();
    if (!arguments.csv.empty())
        if (const auto written = writeTo(arguments.csv, bench::toCsv(rows, machine)); !written) return written.error();
    return arguments.pick ? pickForEachScene(arguments, rows) : 0;
}

constexpr const char* kPlotScript = "lab/bench/plot.py";
constexpr const char* kFlipScript = "lab/bench/flip.py";

/// The device and what to do on it, for every kind of measurement.
struct Work {
    gpu::Device device;
    bench::BenchOptions options;
    bench::Machine machine;
};

Result<Work> workOf(const BenchArguments& arguments) {
    auto device = gpu::Device::create({.validation = false, .prefer = arguments.device});
    if (!device) return device.error();
    auto options = optionsOf(arguments, *device);
    if (!options) return options.error();
    bench::Machine machine = machineOf(*device, options->compiler);
    return Work{std::move(*device), std::move(*options), std::move(machine)};
}

/// Measures, with what is being done shown meanwhile.
template <class Measure>
auto shown(Measure measure) {
    Progress progress;
    auto result = measure([&](const std::string& what) { progress.say(what); });
    progress.clear();
    return result;
}

/// JSON into a file of the plots' folder, then the plots.
Result<void> plot(const BenchArguments& arguments, const char* kind, const std::string& json) {
    const fs::path data = fs::path(arguments.plot) / (std::string(kind) + ".json");
    if (const auto written = writeTo(data.string(), json); !written) return written.error();
    const auto plotted = bench::runHelper(assets::ownFile(kPlotScript), {kind, data.string(), arguments.plot});
    if (!plotted) return plotted.error();
    std::fflush(stdout); // the table before what follows it
    fmt::print(stderr, "{}", *plotted);
    return {};
}

Result<int> growth(const BenchArguments& arguments, Work& work) {
    const auto measured = shown([&](const bench::Say& say) {
        return bench::measureGrowth(
            work.device,
            {.effects = work.options.effects, .compiler = work.options.compiler, .frames = work.options.frames, .large = !work.machine.cpu},
            say);
    });
    if (!measured) return measured.error();
    const std::string json = bench::toJson(*measured, work.machine);
    if (arguments.growth && !arguments.json.empty())
        if (const auto written = writeTo(arguments.json, json); !written) return written.error();
    const bench::Table cells = bench::toTable(*measured);
    if (arguments.json != "-" && arguments.csv != "-") fmt::print("\n{}", table(cells.header, cells.rows));
    if (!arguments.plot.empty())
        if (const auto plotted = plot(arguments, "growth", json); !plotted) return plotted.error();
    return 0;
}

Result<int> ablation(const BenchArguments& arguments, Work& work) {
    const auto measured =
        shown([&](const bench::Say& say) { return bench::measureAblation(work.device, work.options, {.say = say, .flip = nullptr}); });
    if (!measured) return measured.error();
    if (!arguments.json.empty())
        if (const auto written = writeTo(arguments.json, bench::toJson(*measured, work.machine, work.options.scenes.front())); !written)
            return written.error();
    const bench::Table cells = bench::toTable(*measured);
    if (arguments.json != "-")
        fmt::print("{}\n{}, driver {}; {}, {} x {}, maps of {}\n", table(cells.header, cells.rows), work.machine.device,
                   work.machine.driver, work.options.scenes.front(), work.options.width, work.options.height,
                   work.options.mapSizes.front());
    return 0;
}

Result<int> motion(const BenchArguments& arguments, const std::vector<bench::Contender>& contenders, Work& work) {
    const auto measured = shown(
        [&](const bench::Say& say) { return bench::measureMotion(work.device, contenders, work.options, {.say = say, .flip = nullptr}); });
    if (!measured) return measured.error();
    const std::string scene = work.options.scenes.front();
    if (!arguments.json.empty())
        if (const auto written = writeTo(arguments.json, bench::toJson(*measured, work.machine, scene)); !written) return written.error();
    const bench::Table cells = bench::toTable(*measured);
    if (arguments.json != "-")
        fmt::print("{}\n{}, driver {}; {}, {} x {}, maps of {}\n", table(cells.header, cells.rows), work.machine.device,
                   work.machine.driver, scene, work.options.width, work.options.height, work.options.mapSizes.front());
    return 0;
}

Result<int> keep(const BenchArguments& arguments, const std::vector<bench::Contender>& contenders, Work& work) {
    const auto part = bench::partOf(arguments.referencePart);
    if (!part) return part.error();
    const auto pixels = shown([&](const bench::Say& say) { return bench::keepReferences(contenders, work.options, *part, say); });
    if (!pixels) return pixels.error();
    print({{"reference_pixels", *pixels}, {"part", arguments.referencePart}});
    return 0;
}

/// The report, and what has changed since an earlier run.
Result<void> tell(const BenchArguments& arguments, const std::vector<bench::Row>& rows, const Work& work, const Json& earlier) {
    const Json run = Json::parse(bench::toJson(rows, work.machine));
    return tellReport(arguments.report, earlier, run, benchFigures, [&] { return benchPage(run, work.options.pictures); });
}

Result<int> compare(const BenchArguments& arguments, const std::vector<bench::Contender>& contenders, Work& work) {
    const auto earlier = earlierRun(arguments.report, benchFigures);
    if (!earlier) return earlier.error();
    // Where every pixel has its reference, the page shows them; what it shows is kept for as long as it is made.
    const Temporary scratch(fs::temp_directory_path() / fmt::format("tegument-bench-pictures-{}", ::getpid()));
    if (!arguments.report.html.empty() && work.options.pictures.empty() && work.options.pixels == 0) work.options.pictures = scratch.path();
    const auto rows = shown([&](const bench::Say& say) {
        return bench::runBench(work.device, contenders, work.options, {.say = say, .flip = bench::flipMeter(assets::ownFile(kFlipScript))});
    });
    if (!rows) return rows.error();
    auto code = report(arguments, *rows, work.machine);
    if (!code) return code;
    if (const auto told = tell(arguments, *rows, work, *earlier); !told) return told.error();
    if (arguments.plot.empty()) return code;
    if (const auto plotted = plot(arguments, "pareto", bench::toJson(*rows, work.machine)); !plotted) return plotted.error();
    const auto grown = growth(arguments, work);
    return grown ? code : grown;
}

Result<int> fur(const BenchArguments& arguments, const std::vector<bench::Contender>& contenders, Work& work) {
    const auto earlier = earlierRun(arguments.report, benchFigures);
    if (!earlier) return earlier.error();
    const auto rows =
        shown([&](const bench::Say& say) { return bench::runFur(work.device, contenders, work.options, {.say = say, .flip = nullptr}); });
    if (!rows) return rows.error();
    auto code = report(arguments, *rows, work.machine);
    if (!code) return code;
    if (const auto told = tell(arguments, *rows, work, *earlier); !told) return told.error();
    if (arguments.plot.empty()) return code;
    const auto plotted = plot(arguments, "pareto", bench::toJson(*rows, work.machine));
    return plotted ? code : plotted.error();
}

Result<int> writeMarkdown(const std::string& file) {
    const auto json = readFile(file);
    if (!json) return json.error();
    if (const auto tables = stabilityTables(*json)) {
        fmt::print("{}", *tables);
        return 0;
    }
    const auto markdown = bench::toMarkdown(*json, file);
    if (!markdown) return markdown.error();
    fmt::print("{}", *markdown);
    return 0;
}

Result<int> stability(const BenchArguments& arguments) {
    const auto compiler = assets::chosenCompiler(arguments.compiler);
    if (!compiler) return compiler.error();
    const std::string catalogue = arguments.catalogue.empty() ? shippedCatalogue(arguments) : arguments.catalogue;
    StabilityArguments chosen{.effects = assets::ownFile(catalogue).parent_path(),
                              .parts = arguments.parts,
                              .modules = arguments.modules,
                              .compiler = *compiler,
                              .device = arguments.device,
                              .json = arguments.json,
                              .report = arguments.report};
    if (!arguments.mapSizes.empty()) chosen.size = arguments.mapSizes.front();
    return benchStability(chosen);
}

Result<void> checkFiles(const BenchArguments& arguments) {
    for (const std::string& file : {arguments.json, arguments.csv})
        if (file != "-")
            if (const auto can = checkOutput(file, {}); !can) return can.error();
    for (const std::string& folder : {arguments.plot, arguments.pictures})
        if (!folder.empty())
            if (const auto can = checkFolder(folder); !can) return can.error();
    return {};
}

/// Ours and that of the command line: an entry of its name and setting takes the place of ours.
Result<std::vector<bench::Contender>> wholeCatalogue(const BenchArguments& arguments) {
    auto list = bench::loadCatalogue(assets::ownFile(shippedCatalogue(arguments)));
    if (!list || arguments.catalogue.empty()) return list;
    auto added = bench::loadCatalogue(arguments.catalogue);
    if (!added) return added;
    for (bench::Contender& one : *added) {
        std::erase_if(*list, [&](const bench::Contender& ours) { return ours.name() == one.name() && ours.setting == one.setting; });
        list->push_back(std::move(one));
    }
    return list;
}

/// A choice is told beside no diffusion, measured even where it may not be chosen.
void addNoDiffusion(std::vector<bench::Contender>& contenders, const std::vector<bench::Contender>& catalogue) {
    const auto has = [](const bench::Contender& one) { return one.claim == bench::Claim::Delta; };
    if (std::ranges::any_of(contenders, has)) return;
    if (const auto found = std::ranges::find_if(catalogue, has); found != catalogue.end()) contenders.push_back(*found);
}

Result<int> runChosen(const BenchArguments& arguments) {
    if (!arguments.markdown.empty()) return writeMarkdown(arguments.markdown);
    if (const auto fine = checkFiles(arguments); !fine) return fine.error();
    if (arguments.stability) return stability(arguments);
    if (arguments.pick && arguments.maxError <= 0 && arguments.maxMs <= 0)
        return usageError(8079, "--pick needs a limit", "add --max-error E or --max-ms T");
    const auto catalogue = wholeCatalogue(arguments);
    if (!catalogue) return catalogue.error();
    auto contenders = bench::choose(*catalogue, arguments.techniques, arguments.settings);
    if (!contenders) return contenders.error();
    if (arguments.pick) addNoDiffusion(*contenders, *catalogue);
    for (const std::string& scene : arguments.scenes)
        if (const auto known = bench::checkSceneName(scene); !known) return known.error();
    auto work = workOf(arguments);
    if (!work) return work.error();
    if (arguments.growth) return growth(arguments, *work);
    if (arguments.ablation) return ablation(arguments, *work);
    if (arguments.motion) return motion(arguments, *contenders, *work);
    if (arguments.fur) return fur(arguments, *contenders, *work);
    if (!arguments.referencePart.empty()) return keep(arguments, *contenders, *work);
    return compare(arguments, *contenders, *work);
}

int run(BenchArguments arguments) {
    if (arguments.fur) {
        if (arguments.scenes == std::vector<std::string>{"head"}) arguments.scenes = {"effects/workspaces/bunny_roots.json"};
    }
    const auto result = runChosen(arguments);
    return result ? *result : fail(result.error(), arguments.json == "-");
}

CLI::Option* addPick(CLI::App& command, BenchArguments& arguments) {
    CLI::Option* pick = command.add_flag("--pick", arguments.pick, "Name the technique to take, and the command that draws with it");
    command.add_option("--max-error", arguments.maxError, "With --pick: the cheapest within this relative L2")
        ->check(CLI::PositiveNumber)
        ->needs(pick);
    command.add_option("--max-ms", arguments.maxMs, "With --pick: the most accurate within this time")
        ->check(CLI::PositiveNumber)
        ->needs(pick);
    command.get_option("--max-ms")->excludes("--max-error");
    return pick;
}

} // namespace

void addBench(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = program.add_subcommand("bench", "Time every technique and hold its picture against light by brute force");
    command
        ->add_option("--scene", arguments->scenes, "Names as in docs/bench.md (sphere-10, head@90+4px ...), or workspaces as -w takes them")
        ->capture_default_str();
    command->add_option("-t,--technique", arguments->techniques, "Techniques of the catalogue; default: all");
    command->add_option("--setting", arguments->settings, "Settings of them; default: all");
    command
        ->add_option("--lights", arguments->lights,
                     "What lights every scene: its own light (key), lamps beside it, surroundings alone, or both")
        ->capture_default_str()
        ->transform(oneOf(bench::lightSetNames()));
    command->add_option("--size", arguments->size, "Picture size in pixels; default: 320x320 on a processor, else 1920x1080");
    command
        ->add_option("--map-size", arguments->mapSizes,
                     "Texels along each side of the maps; may be several; default: 1024; with --pick 256, 512 and 1024")
        ->check(CLI::Range(16, 8192));
    command
        ->add_option("--shadow-size", arguments->shadowSizes,
                     "Texels along each side of the maps seen from the light; may be several; default: as many as --map-size")
        ->check(CLI::Range(16, 8192));
    command->add_option("--frames", arguments->frames, "Frames to time; default: 5 after 2 on a processor, else 50 after 10")
        ->check(CLI::Range(1, 100000));
    command->add_option("--reference", arguments->reference, "Pixels that get a reference, or 'full'")->capture_default_str();
    command->add_option("--oversample", arguments->grid, "N: means of N x N samples a pixel are compared, the truth's and the picture's")
        ->check(CLI::Range(1, 8));
    command->add_option("--reference-part", arguments->referencePart,
                        "Only compute and keep a part of the reference, 3/16, and draw nothing (docs/bench.md)");
    command->add_option("--keep-scenes", arguments->keepScenes, "Folder for the scenes' workspaces and meshes; default: the cache");
    command->add_option("--catalogue", arguments->catalogue, "More that can be compared, beside effects/catalogue.json (docs/bench.md)");
    command->add_option("--compiler", arguments->compiler, "dxc or glslang; default: DXC where it is installed")
        ->transform(oneOf({"dxc", "glslang"}));
    command->add_option("--device", arguments->device, "Part of the Vulkan device's name");
    command->add_option("--json", arguments->json, "Write the results as JSON; -: to standard output");
    command->add_option("--csv", arguments->csv, "Write them as CSV; -: to standard output");
    command->add_option("--pictures", arguments->pictures, "Folder for the truth and the pictures held against it, EXR, known pixels only");
    command->add_flag("--count", arguments->count, "Count look-ups, bytes read and bytes written of a frame, too");
    CLI::Option* pick = addPick(*command, *arguments);
    command->add_option("--plot", arguments->plot,
                        "Folder for the plots of time against error and of growth, PNG and SVG, with their JSON");
    CLI::Option* growth =
        command->add_flag("--growth", arguments->growth, "Only measure how cost grows with texels, pixels, passes, layers and faces");
    CLI::Option* ablation =
        command->add_flag("--ablation", arguments->ablation, "Only measure what each optimisation is worth, on the first scene");
    growth->excludes(ablation)->excludes(pick);
    ablation->excludes(pick);
    command
        ->add_flag("--motion", arguments->motion,
                   "Only measure what flickers: how the error changes in a slow zoom, on a turning body, under a moving light")
        ->excludes(pick)
        ->excludes(growth)
        ->excludes(ablation);
    command->add_flag("--fur", arguments->fur, "Only time every technique of fur, and hold its picture against exact strands by rays")
        ->excludes(growth)
        ->excludes(ablation);
    CLI::Option* stability =
        command->add_flag("--stability", arguments->stability,
                          "Only draw every module's hard cases: values that are not finite, largest errors and their causes");
    stability->excludes(pick)->excludes(growth)->excludes(ablation);
    command->add_option("--part", arguments->parts, "With --stability: parts of the report (docs/design/stability.md); default: all")
        ->needs(stability);
    command->add_option("--module", arguments->modules, "With --stability: names of effects, Main for Main.fx; default: all")
        ->needs(stability);
    addReportOptions(*command, arguments->report, "--json");
    for (CLI::Option* only : {growth, ablation, command->get_option("--motion")}) // they have plots and tables of their own
        command->get_option("--html")->excludes(only), command->get_option("--against")->excludes(only);
    command->add_option("--markdown", arguments->markdown, "Measure nothing: print the tables of a file that --json wrote, as Markdown")
        ->check(CLI::ExistingFile);
    addExamples(
        *command,
        {{"bench", "every technique on the default head"},
         {"bench --scene sphere-10 head@90+4px --technique DEonLuebke", "some of it"},
         {"bench --pick --max-error 0.02", "which one to take"},
         {"bench --html out/bench.html --json new.json --against old.json", "a report to look at, and what got slower or less accurate"},
         {"bench --fur --plot out/fur", "every technique of fur, near and far"}},
        "Scenes: plane-edge, plane-disc, sphere-5, sphere-10, sphere-20, cylinder, lobes, head; each as NAME[@LIGHT][+shadow][+bumps]"
        "[+checker][+Npx] with LIGHT in degrees from the camera or 'behind', and N pixels to the mm. docs/bench.md explains the columns.");
    command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

} // namespace tegument::app
