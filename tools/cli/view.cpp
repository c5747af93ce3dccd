// tegument view: an effect in a window.

#include "tools/view/view.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/roots_on_mesh.h"
#include "meshprep/prepare/levels.h"
#include "tools/cli/command_line.h"
#include "tools/cli/dropped.h"
#include "tools/cli/foreign.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/replay.h"
#include "tools/view/keys.h"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>

namespace tegument::app {

namespace {

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

ViewRequest requestFor(const ViewOptions& options, Job&& read, Progress& progress) {
    const auto job = std::make_shared<const Job>(std::move(read));
    RunOptions run = job->run;
    const auto rules = assets::bindRules(options.job.binds); // loadJob() has read them
    run.compiling = [&progress](std::size_t done, std::size_t total) {
        done < total ? progress.count("compiling shader", done, total) : progress.clear();
    };
    return {.effect = job->effect.file,
            .load = assets::loadOptions(options.job.effect),
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
            .keepView = false,
            .open = {},
            .fewer = prep::quickLevel,
            .rootsOn = assets::rootsOnMesh};
}

/// The request with a way to open what is dropped next.
ViewRequest opening(const ViewOptions& options, ViewRequest request, Progress& progress) {
    request.open = [options, &progress](const std::filesystem::path& file, const Effect& shown) -> Result<ViewRequest> {
        ViewOptions next = options;
        auto job = withDropped(options.job, file, shown);
        if (!job) return job.error();
        next.job = std::move(*job);
        progress.say("reading " + file.string());
        auto read = assets::loadJob(next.job, MeshFor::AnyTechnique, false, told(progress));
        progress.clear();
        if (!read) return read.error();
        warnOf(*read);
        ViewRequest opened = opening(next, requestFor(next, std::move(*read), progress), progress);
        const bool sceneNamed = !options.job.scene.mesh.empty() || !options.job.scene.workspace.empty();
        const auto kind = kindOf(file);
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
    const auto messages = viewEffect(request, tell);
    if (!messages) return fail(messages.error(), false);
    return ended(*messages);
}

} // namespace

void addView(CLI::App& program, Action& action) {
    auto options = std::make_shared<ViewOptions>();
    options->job.size = "900x900";
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
