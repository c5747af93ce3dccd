// tegument view: an effect in a window.

#include "host/view/view.h"
#include "host/app/command_line.h"
#include "host/app/fur_textures.h"
#include "host/app/job.h"
#include "host/app/output.h"
#include "host/view/keys.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace {

constexpr const char* kPictures = "out";

struct ViewOptions {
    JobOptions job;
    std::string pictures = kPictures;
};

SessionScene sceneOf(const Scene& scene) {
    if (!scene.objects.empty()) return {.mesh = nullptr, .objects = scene.objects};
    return {.mesh = scene.meshes.empty() ? nullptr : &scene.meshes.front(), .objects = {}};
}

ViewRequest requestFor(const ViewOptions& options, const Job& job) {
    RunOptions run = job.run;
    run.meshTextures = furTextures([](const std::string& made) { fmt::print(stderr, "{}\n", made); });
    return {.effect = job.effect.file,
            .load = loadOptions(options.job.effect),
            .scene = sceneOf(job.scene),
            .workspace = job.scene.workspace,
            .run = std::move(run),
            .device = options.job.device,
            .validate = options.job.validate,
            .pictures = options.pictures};
}

int runView(const ViewOptions& options) {
    if (options.pictures != kPictures) // the usual folder may be needed by nobody
        if (const auto can = checkFolder(options.pictures); !can) return fail(can.error(), false);
    Progress progress;
    progress.say("reading");
    const auto job = loadJob(options.job, MeshFor::AnyTechnique);
    progress.clear();
    if (!job) return fail(job.error(), false);
    warn(job->effect.warnings);
    warn(job->warnings);
    for (const Mesh& mesh : job->scene.meshes)
        warn(mesh.warnings);
    const auto messages = viewEffect(requestFor(options, *job), [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
    if (!messages) return fail(messages.error(), false);
    for (const std::string& message : *messages)
        fmt::print(stderr, "validation: {}\n", message);
    return messages->empty() ? 0 : static_cast<int>(Blame::Machine);
}

} // namespace

void addView(CLI::App& program, Action& action) {
    auto options = std::make_shared<ViewOptions>();
    options->job.size = "900x900";
    CLI::App* command = program.add_subcommand("view", "Show an effect in a window, and again whenever its source changes");
    addJobOptions(*command, options->job);
    command->add_option("-o,--output", options->pictures, "Folder for the pictures that the key s writes")->capture_default_str();
    addExamples(*command, {{"view Main", "the default head"}, {"view Fur -w bunny", "a workspace of ours"}},
                "In the window:\n" + view::bindingsHelp());
    command->callback([options, &action] { action = [options] { return runView(*options); }; });
}

} // namespace tegument::app
