// tegument view: an effect in a window.

#include "tools/view/view.h"
#include "host/image/dds.h"
#include "host/image/image.h"
#include "host/support/file.h"
#include "host/support/result.h"
#include "host/support/temporary.h"
#include "host/support/text.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/given_values.h"
#include "meshprep/assets/roots_on_mesh.h"
#include "meshprep/light/environment.h"
#include "meshprep/prepare/levels.h"
#include "tools/cli/command_line.h"
#include "tools/cli/dropped.h"
#include "tools/cli/foreign.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/view/keys.h"
#include "tools/view/reactions.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

namespace tegument::app {

namespace {

using JsonStep = nlohmann::json;

constexpr int kNoReplay = 8049;
constexpr std::size_t kMostSteps = 1000000; // hours of input

Error refused(const std::filesystem::path& file, const std::string& why) {
    return inputError(kNoReplay, {.file = file.string()}, "this is no replay: " + why,
                      R"(a list of steps such as {"drag": [0.1, 0]}, {"wheel": 1}, {"key": "t"}, {"edit": FILE, "from": A, "to": B})");
}

bool readMove(const JsonStep& step, const char* name, glm::dvec2& move) {
    const auto found = step.find(name);
    if (found == step.end() || !found->is_array() || found->size() != 2 || !found->at(0).is_number() || !found->at(1).is_number())
        return false;
    move = {found->at(0).get<double>(), found->at(1).get<double>()};
    return true;
}

/// "t" itself; "right" and "Esc" by the names in the help.
std::optional<char32_t> keyOf(const JsonStep& value) {
    if (!value.is_string()) return std::nullopt;
    const auto keys = view::keyBindings();
    const auto found = std::ranges::find_if(keys, [&](const view::KeyBinding& key) { return key.label == value.get<std::string>(); });
    return found == keys.end() ? std::nullopt : std::optional(found->key);
}

bool readEdit(const JsonStep& step, view::ReplayStep& read) {
    for (const char* name : {"edit", "from", "to"})
        if (!step.contains(name) || !step.at(name).is_string()) return false;
    read.file = step.at("edit").get<std::string>();
    read.from = step.at("from").get<std::string>();
    read.to = step.at("to").get<std::string>();
    return !read.from.empty();
}

bool readEditBack(const JsonStep& step, view::ReplayStep& read) {
    if (!step.contains("back") || !step.at("back").is_string()) return false;
    read.file = step.at("back").get<std::string>();
    return !read.file.empty();
}

bool readMore(const JsonStep& step, view::ReplayStep& read) {
    if (step.contains("meanwhile") && !readMove(step, "meanwhile", read.meanwhile)) return false;
    if (step.contains("cursor") && !readMove(step, "cursor", read.input.cursor)) return false;
    if (step.contains("soon") && !step.at("soon").is_boolean()) return false;
    if (step.contains("as") && !step.at("as").is_string()) return false;
    read.soon = step.value("soon", false);
    read.kind = step.value("as", read.kind);
    return true;
}

std::optional<view::ReplayStep> readStep(const JsonStep& step) {
    if (!step.is_object()) return std::nullopt;
    view::ReplayStep read;
    read.input.any = true;
    if (readMove(step, "drag", read.input.camera)) {
        read.kind = "drag";
    } else if (readMove(step, "pan", read.input.pan)) {
        read.kind = "pan";
    } else if (readMove(step, "light", read.input.light)) {
        read.kind = "light";
    } else if (step.contains("wheel") && step.at("wheel").is_number()) {
        read.kind = "wheel";
        read.input.wheel = step.at("wheel").get<double>();
    } else if (const auto key = step.contains("key") ? keyOf(step.at("key")) : std::nullopt) {
        read.kind = "key " + step.at("key").get<std::string>();
        read.input.keys = {*key};
    } else if (readEdit(step, read) || readEditBack(step, read)) {
        read.kind = "edit";
        read.input = {};
    } else {
        return std::nullopt;
    }
    return readMore(step, read) ? std::optional(read) : std::nullopt;
}

/// None where the step says no number of times that can be.
std::optional<std::size_t> timesOf(const JsonStep& step) {
    const auto asked = step.find("times");
    if (asked == step.end()) return 1;
    if (!asked->is_number_unsigned() || asked->get<std::uint64_t>() > kMostSteps) return std::nullopt;
    return asked->get<std::size_t>();
}

/// {"drag": [x, y]} (also "pan", "light": shares of the window's height, right and up), {"wheel": n}, {"key": "t"}, {"edit": FILE, "from":
/// A, "to": B}; "as" names the kind, "times" repeats the step. TG8049 for anything else. Files are named from the working folder.
Result<std::vector<view::ReplayStep>> readReplay(const std::filesystem::path& file) {
    const auto text = readFile(file);
    if (!text) return text.error();
    const JsonStep list = JsonStep::parse(*text, nullptr, false);
    if (!list.is_array()) return refused(file, "it is no JSON list");
    std::vector<view::ReplayStep> steps;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto step = readStep(list[i]);
        const auto times = step ? timesOf(list[i]) : std::nullopt;
        if (!times) return refused(file, fmt::format("step {} is none of ours", i + 1));
        if (steps.size() + *times > kMostSteps) return refused(file, fmt::format("more than {} steps", kMostSteps));
        steps.insert(steps.end(), *times, *step);
    }
    return steps;
}

constexpr const char* kPictures = "out";

struct ViewOptions {
    JobOptions job;
    std::string pictures = kPictures;
    std::string beside;
    std::string replay;
};

/// What the render line needs besides what the viewer knows.
std::vector<std::string> renderArguments(const JobOptions& options) {
    std::vector<std::string> words;
    for (const std::string& define : options.effect.defines)
        words.insert(words.end(), {"-D", define});
    for (const std::string& folder : options.effect.includeFolders)
        words.insert(words.end(), {"-I", folder});
    if (options.effect.anywhere) words.emplace_back("--anywhere");
    if (options.effect.mapSize > 0) words.insert(words.end(), {"--map-size", std::to_string(options.effect.mapSize)});
    if (options.effect.shadowSize > 0) words.insert(words.end(), {"--shadow-size", std::to_string(options.effect.shadowSize)});
    if (options.picture != JobOptions().picture) words.insert(words.end(), {"--picture", options.picture});
    if (options.samples > 0) words.insert(words.end(), {"--samples", std::to_string(options.samples)});
    if (!options.compiler.empty()) words.insert(words.end(), {"--compiler", options.compiler});
    if (!options.device.empty()) words.insert(words.end(), {"--device", options.device});
    return words;
}

void warnOf(const Job& job) {
    warn(job.effect.warnings);
    warn(job.warnings);
    for (const Mesh& mesh : job.scene.meshes)
        warn(mesh.warnings);
}

bool hasDisplay() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value != '\0';
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

/// Says what was made, above the line of progress, which outlives the viewer.
assets::Say told(Progress& progress) {
    return [&progress](const std::string& made) {
        progress.clear();
        say(made);
    };
}

/// As controls of the window: those that make a difference to this effect, without those that are there to measure.
std::vector<Switch> switchControls(const Effect& effect) {
    std::vector<Switch> controls;
    if (!assets::takesSwitches(effect)) return controls;
    const auto has = [&](std::string_view start) {
        return std::ranges::any_of(effect.parameters, [&](const Parameter& parameter) { return parameter.name.starts_with(start); });
    };
    const bool fur = has("gFur") || has("gCoat");
    const std::map<std::string, int> usual = {
        {"MAP_SIZE", 1024}, {"SHADOW_SIZE", 1024}, {"MAP_BITS", 16}, {"RIBBON_ROWS", 2048}, {"LAMP_SHADOWS", 3}};
    for (const assets::Switch& one : assets::switches()) {
        std::string label = one.name.substr(std::string_view("TEGUMENT_").size());
        const auto of = [&](std::initializer_list<std::string_view> words) {
            return std::ranges::any_of(words, [&](std::string_view word) { return label.find(word) != std::string::npos; });
        };
        const bool measures = of({"SEAM_REPAIR", "CULL", "SHADOW_FROM_TSM", "PEERS"});
        const bool ofFur = of({"FUR", "RIBBON", "MOTION"});
        const bool ofSkin = of({"LOBES", "SLAB", "NORMAL_XY"});
        if (measures || (ofFur && !fur) || (ofSkin && fur) || (of({"POST_HALF"}) && !has("gPost"))) continue;
        const bool ofLight = of({"SURROUNDINGS", "LAMP", "SOFT_SHADOWS"});
        const auto known = usual.find(label);
        label = toLower(label);
        std::ranges::replace(label, '_', ' ');
        label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
        controls.push_back({.name = one.name,
                            .label = std::move(label),
                            .help = one.meaning,
                            .least = one.least,
                            .most = one.most,
                            .step = one.step,
                            .usual = known == usual.end() ? 0 : known->second,
                            .ofLight = ofLight});
    }
    return controls;
}

ViewRequest requestFor(const ViewOptions& options, Job&& read, Progress& progress) {
    const auto job = std::make_shared<const Job>(std::move(read));
    RunOptions run = job->run;
    const auto rules = assets::bindRules(options.job.binds); // loadJob() has read them
    run.compiling = [&progress](std::size_t done, std::size_t total) {
        done < total ? progress.count("compiling shader", done, total) : progress.clear();
    };
    return {.effect = job->effect.file,
            .load = job->load,
            .binds = rules ? *rules : std::map<std::string, std::string>(),
            .scene = assets::sessionScene(job->scene),
            .workspace = job->scene.workspace,
            .run = std::move(run),
            .device = options.job.device,
            .validate = options.job.validate,
            .window = options.replay.empty() || hasDisplay(),
            .beside = options.beside,
            .pictures = options.pictures,
            .renderArguments = renderArguments(options.job),
            .keeps = job,
            .switches = switchControls(job->effect),
            .keepView = false,
            .fewer = prep::quickLevel,
            .rootsOn = assets::rootsOnMesh};
}

/// A panorama as the cube map that `tegument prep environment` makes of it, kept in the cache.
Result<std::string> cubeMapOf(const std::filesystem::path& file) {
    const std::string ending = toLower(file.extension().string());
    if (ending != ".hdr" && ending != ".exr") return file.string();
    const auto bytes = readFile(file);
    if (!bytes) return bytes.error();
    const std::filesystem::path kept = cacheFolder() / "light" / (contentHash(*bytes) + ".dds");
    if (std::filesystem::exists(kept)) return kept.string();
    const auto panorama = loadImage(file);
    if (!panorama) return panorama.error();
    const auto made = makeEnvironment(*panorama, file.string());
    if (!made) return made.error();
    std::error_code failed;
    std::filesystem::create_directories(kept.parent_path(), failed);
    if (const auto written = writeDds(kept, *made); !written) return written.error();
    return kept.string();
}

/// The options with these values; one without a value is as if it had not been given.
Result<JobOptions> withSets(JobOptions options, const std::vector<std::string>& sets) {
    for (const std::string& set : sets) {
        const std::string name = set.substr(0, set.find('=') + 1);
        std::erase_if(options.sets, [&](const std::string& before) { return before.starts_with(name); });
        if (set == name) continue;
        const auto value = assets::findSwitch(name.substr(0, name.size() - 1)) ? Result<std::string>(set.substr(name.size()))
                                                                               : cubeMapOf(set.substr(name.size()));
        if (!value) return value.error();
        options.sets.push_back(name + *value);
    }
    return options;
}

/// The request with a way to open what is dropped or chosen next.
ViewRequest opening(const ViewOptions& options, ViewRequest request, Progress& progress) {
    request.open = [options, &progress](const Opening& asked, const Effect& shown) -> Result<ViewRequest> {
        const std::filesystem::path& file = asked.file;
        ViewOptions next = options;
        auto job = asked.sets.empty() ? withDropped(options.job, file, shown) : withSets(options.job, asked.sets);
        if (!job) return job.error();
        next.job = std::move(*job);
        progress.say("reading " + (asked.sets.empty() ? file.string() : asked.sets.back()));
        auto read = assets::loadJob(next.job, MeshFor::AnyTechnique, false, told(progress));
        progress.clear();
        if (!read) return read.error();
        warnOf(*read);
        ViewRequest opened = opening(next, requestFor(next, std::move(*read), progress), progress);
        const bool sceneNamed = !options.job.scene.mesh.empty() || !options.job.scene.workspace.empty();
        const auto kind = asked.sets.empty() ? kindOf(file) : Dropped::Texture;
        opened.keepView = *kind == Dropped::Texture || (*kind == Dropped::Effect && sceneNamed);
        return opened;
    };
    return request;
}

void printReactions(const std::vector<view::Reaction>& reactions) {
    std::vector<std::vector<std::string>> rows;
    for (const view::ReactionRow& row : view::reactionRows(reactions))
        rows.push_back({row.kind, std::to_string(row.count), fmt::format("{:.1f}", row.median), fmt::format("{:.1f}", row.p95),
                        fmt::format("{:.1f}", row.most), fmt::format("{:.1f}", row.unanswered)});
    fmt::print("{}", table({"milliseconds to the picture", "steps", "median", "p95", "most", "longest without an answer"}, rows));
}

int ended(const std::vector<std::string>& messages) {
    for (const std::string& message : messages)
        fmt::print(stderr, "validation: {}\n", message);
    return messages.empty() ? 0 : static_cast<int>(Blame::Machine);
}

int replay(const ViewRequest& request, const std::string& file, const std::function<void(const std::string&)>& tell) {
    const auto steps = readReplay(file);
    if (!steps) return fail(steps.error(), false);
    const auto replayed = replayEffect(request, *steps, tell);
    if (!replayed) return fail(replayed.error(), false);
    printReactions(replayed->reactions);
    return ended(replayed->validation);
}

int runView(const ViewOptions& options) {
    if (options.pictures != kPictures) // the usual folder may be needed by nobody
        if (const auto can = checkFolder(options.pictures); !can) return fail(can.error(), false);
    Progress progress;
    progress.say("reading");
    auto job = assets::loadJob(options.job, MeshFor::AnyTechnique, false, told(progress));
    progress.clear();
    if (!job) return fail(job.error(), false);
    warnOf(*job);
    const ViewRequest request = opening(options, requestFor(options, std::move(*job), progress), progress);
    const auto tell = [&](const std::string& text) {
        progress.clear();
        say(text);
    };
    if (!options.replay.empty()) return replay(request, options.replay, tell);
    const auto viewed = viewEffect(request, tell);
    if (!viewed) return fail(viewed.error(), false);
    const int code = ended(viewed->validation);
    if (!viewed->unfinished) return code;
    std::fflush(nullptr); // the window closes at once: no compiler can be stopped, and what it makes is of no use any more
    removeTemporaries();
    std::_Exit(code);
}

} // namespace

void addView(CLI::App& program, Action& action) {
    auto options = std::make_shared<ViewOptions>();
    options->job.usualSize = "900x900";
    options->job.fit = "both";
    CLI::App* command = program.add_subcommand("view", "Show an effect in a window, and again whenever its source changes");
    addJobOptions(*command, options->job);
    command->add_option("-o,--output", options->pictures, "Folder for the pictures and workspaces that the keys s, w and c write")
        ->capture_default_str();
    command->add_option("--beside", options->beside, "A saved picture to the left of a border, with the error against it");
    command->add_option("--replay", options->replay,
                        "A file of input, and how long each step takes to its picture; without a display, without a window");
    addExamples(*command, {{"view Main", "the default head"}, {"view Fur -w bunny", "a workspace of ours"}},
                "In the window:\n" + view::bindingsHelp());
    command->callback([options, &action] { action = [options] { return runView(*options); }; });
}

} // namespace tegument::app
