// tegument prep bunny: the mesh, maps and roots that effects/workspaces/bunny*.json name.

#include "host/support/file.h"
#include "host/support/system.h"
#include "tools/cli/command_line.h"
#include "tools/cli/fetch.h"
#include "tools/cli/output.h"
#include "tools/cli/prep_mesh.h"
#include "tools/process/process.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct BunnyArguments {
    bool keep = false;
    bool json = false;
};

/// A command of this program, as anybody would type it.
struct Step {
    std::string says;
    std::vector<std::string> arguments;
};

fs::path folder() {
    return cacheFolder() / "fur";
}

std::vector<fs::path> products() {
    std::vector<fs::path> files;
    for (const char* name : {"bunny.glb", "fur_cube.dds", "fur_sphere.dds", "bunny_roots.dds"})
        files.push_back(folder() / name);
    return files;
}

/// The file has no unit: at 75 mm the Bunny is as large as Stanford's. The maps hold cones that stand 3 texels apart.
std::vector<Step> stepsFrom(const fs::path& scan) {
    const std::string mesh = (folder() / "bunny.glb").string();
    return {{"preparing the Bunny", {"prep", scan.string(), "--unit-mm", "75", "-o", mesh}},
            {"drawing fur maps",
             {"fur", "texture", "-o", folder().string(), "--size", "2048", "--density", "0.05", "--spacing", "2.8", "--radius", "3.4",
              "--shortest", "0.45", "--taper"}},
            {"placing roots", {"fur", "roots", mesh, "--shortest", "0.5", "-o", (folder() / "bunny_roots.dds").string()}}};
}

Result<void> runStep(const Step& step) {
    constexpr double kTimeLimit = 1800; // seconds; the maps take 20 on two cores
    std::vector<std::string> command = {programFile().string()};
    command.insert(command.end(), step.arguments.begin(), step.arguments.end());
    const auto done = runProcess({.arguments = command}, kTimeLimit);
    if (!done) return done.error();
    if (!done->timedOut && done->exitCode == 0) return {};
    return machineError(8026, fmt::format("{} failed: tegument {}", step.says, fmt::join(step.arguments, " ")),
                        std::string(trim(done->output)));
}

Result<bool> makeBunny(const BunnyArguments& arguments, Progress& progress) {
    const std::vector<fs::path> files = products();
    if (arguments.keep && std::ranges::all_of(files, [](const fs::path& file) { return fs::is_regular_file(file); })) return false;
    if (const auto can = canWrite(files.front()); !can) return can.error();
    const fs::path source = cacheFolder() / "data" / "bunny";
    progress.expect({{"fetching", 10}, {"preparing", 5}, {"drawing", 80}, {"placing", 5}}); // percent
    progress.say("fetching the Bunny");
    if (const auto fetched = fetch("bunny", source); !fetched) return fetched.error();
    for (const Step& step : stepsFrom(source / "bunny.obj")) {
        progress.say(step.says);
        if (const auto done = runStep(step); !done) return done.error();
    }
    return true;
}

int prepBunny(const BunnyArguments& arguments) {
    Progress progress;
    const auto made = makeBunny(arguments, progress);
    progress.clear();
    if (!made) return fail(made.error(), arguments.json);
    Json list = Json::array();
    for (const fs::path& file : products())
        list.push_back(file.string());
    if (arguments.json) {
        print({{"kept", !*made}, {"files", list}});
        return 0;
    }
    for (const fs::path& file : products())
        fmt::print("{} {}\n", *made ? "wrote" : "there is", file.string());
    return 0;
}

} // namespace

void addPrepBunny(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<BunnyArguments>();
    CLI::App* bunny = command.add_subcommand("bunny", "Make the furry Bunny of the workspaces bunny and bunny_roots, once, in the cache");
    bunny->add_flag("--keep", arguments->keep, "Do nothing when its files are there");
    bunny->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*bunny, {{"prep bunny", "then: tegument render Fur -w bunny"}});
    bunny->callback([arguments, &action] { action = [arguments] { return prepBunny(*arguments); }; });
}

} // namespace tegument::app
