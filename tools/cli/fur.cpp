// tegument fur: the maps that the shells of effects/Fur.fx read.

#include "host/image/dds.h"
#include "meshprep/fur/cube_texture.h"
#include "meshprep/fur/fur_map.h"
#include "meshprep/fur/strand_statistics.h"
#include "tools/cli/command_line.h"
#include "tools/cli/fur_pose.h"
#include "tools/cli/fur_roots.h"
#include "tools/cli/fur_strands.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct TextureArguments {
    FurOptions fur;
    int size = 1024;
    std::string output = "out/fur";
    std::string seeds;
    bool json = false;
};

struct SeedRange {
    std::uint32_t first = 1;
    std::uint32_t last = 1;
};

constexpr std::uint32_t kMostSeeds = 256;

Result<SeedRange> parseSeeds(const std::string& text) {
    SeedRange range;
    char rest = 0;
    const int read = std::sscanf(text.c_str(), "%u..%u%c", &range.first, &range.last, &rest);
    if (read != 2 || text.find('-') != std::string::npos || range.last < range.first || range.last - range.first >= kMostSeeds)
        return usageError(8050, fmt::format("--seeds {} is no range", text), "write it as 1..16, at most 256 of them");
    return range;
}

Json toJson(const StrandStatistics& figures) {
    return {{"strands", figures.count},
            {"wanted", figures.wanted},
            {"nearest_min", figures.nearestLeast},
            {"nearest_mean", figures.nearestMean},
            {"nearest_cv", figures.nearestCv},
            {"patch_cv", figures.patchCv},
            {"poisson_cv", figures.poissonCv}};
}

std::vector<std::string> row(const std::string& name, const StrandStatistics& figures, double coverage) {
    return {name,
            fmt::format("{}", figures.count),
            fmt::format("{}", figures.wanted),
            fmt::format("{:.2f}", figures.nearestLeast),
            fmt::format("{:.2f}", figures.nearestMean),
            fmt::format("{:.3f}", figures.nearestCv),
            fmt::format("{:.4f}", figures.patchCv),
            fmt::format("{:.4f}", figures.poissonCv),
            fmt::format("{:.2f} %", 100 * coverage)};
}

const std::vector<std::string> kHeader{"map", "strands", "N", "nearest min", "mean", "nearest CV", "patch CV", "Poisson CV", "covered"};

struct Maps {
    StrandSet plane;
    StrandSet sphere;
    StrandSet cube;
    Image texture;
    Image sphereMap;
    std::array<Image, 6> cubeMap;
};

Result<Maps> makeMaps(const TextureArguments& arguments, Progress& progress) {
    const int side = cubeMapSide(arguments.size);
    progress.say("placing strands");
    auto plane = strandsOnTexture(arguments.size, arguments.size, arguments.fur);
    if (!plane) return plane.error();
    auto sphere = strandsOnSphere(sphereMapTexels(arguments.size), arguments.fur);
    if (!sphere) return sphere.error();
    auto cube = strandsOnSphere(cubeMapTexels(side), arguments.fur);
    if (!cube) return cube.error();
    progress.say("drawing the texture");
    Maps maps;
    maps.texture = drawFurTexture(*plane, arguments.size, arguments.size, arguments.fur);
    progress.say("drawing the sphere map");
    maps.sphereMap = drawSphereMap(*sphere, arguments.size, arguments.fur);
    progress.say("drawing the cube map");
    maps.cubeMap = drawCubeMap(*cube, side, arguments.fur);
    maps.plane = std::move(*plane);
    maps.sphere = std::move(*sphere);
    maps.cube = std::move(*cube);
    return maps;
}

Result<void> writeBoth(const fs::path& folder, const std::string& name, const Image& picture, const DdsTexture& texture) {
    if (const auto written = writePng(folder / (name + ".png"), picture, PngEncoding::Raw); !written) return written.error();
    return writeDds(folder / (name + ".dds"), texture);
}

Result<void> writeMaps(const fs::path& folder, const Maps& maps) {
    if (const auto written = writeBoth(folder, "fur", maps.texture, makeDds(maps.texture, DdsFormat::Rgba8, true)); !written)
        return written.error();
    if (const auto written = writeBoth(folder, "fur_sphere", maps.sphereMap, makeDds(maps.sphereMap, DdsFormat::Rgba8, true)); !written)
        return written.error();
    return writeBoth(folder, "fur_cube", unfoldCube(maps.cubeMap), cubeTexture(maps.cubeMap, DdsFormat::Rgba8));
}

std::vector<std::string> filesIn(const fs::path& folder) {
    std::vector<std::string> files;
    for (const char* name : {"fur", "fur_sphere", "fur_cube"})
        for (const char* ending : {".png", ".dds"})
            files.push_back((folder / (std::string(name) + ending)).string());
    return files;
}

void describe(Image& image, const TextureArguments& arguments) {
    image.metadata["Software"] = fmt::format("Tegument {}", TEGUMENT_VERSION);
    image.metadata["tegument:seed"] = fmt::format("{}", arguments.fur.seed);
    image.metadata["tegument:density"] = fmt::format("{}", arguments.fur.density);
    image.metadata["tegument:spacing"] = fmt::format("{}", arguments.fur.spacing);
}

int one(const TextureArguments& arguments) {
    if (const auto can = checkFolder(arguments.output); !can) return fail(can.error(), arguments.json);
    Progress progress;
    progress.expect({{"placing", 8},
                     {"drawing the texture", 7},
                     {"drawing the sphere", 9},
                     {"drawing the cube", 14},
                     {"writing", 55},
                     {"measuring", 7}}); // percent
    auto maps = makeMaps(arguments, progress);
    if (!maps) return progress.clear(), fail(maps.error(), arguments.json);
    progress.say("writing");
    describe(maps->texture, arguments);
    describe(maps->sphereMap, arguments);
    const auto written = writeMaps(arguments.output, *maps);
    if (!written) return progress.clear(), fail(written.error(), arguments.json);
    progress.say("measuring");

    const auto plane = statisticsOnTexture(maps->plane, arguments.size, arguments.size);
    const auto sphere = statisticsOnSphere(maps->sphere, sphereMapTexels(arguments.size));
    const auto cube = statisticsOnSphere(maps->cube, cubeMapTexels(cubeMapSide(arguments.size)));
    const HeightStatistics heights = statisticsOfHeights(maps->texture);
    const double grain = heights.grain * texelAngle(cubeMapTexels(cubeMapSide(arguments.size)));
    progress.clear();
    if (arguments.json) {
        print({{"seed", arguments.fur.seed},
               {"texture", toJson(plane)},
               {"sphere", toJson(sphere)},
               {"cube", toJson(cube)},
               {"height_deviation", heights.deviation},
               {"height_grain", grain},
               {"files", filesIn(arguments.output)}});
        return 0;
    }
    fmt::print("{}",
               table(kHeader, {row("texture", plane, coverage(maps->texture)), row("sphere map", sphere, sphereCoverage(maps->sphereMap)),
                               row("cube map", cube, cubeCoverage(maps->cubeMap))}));
    if (arguments.fur.taper) fmt::print("with gFurTaper = 1: gFurDeviation = {:.3f}, gFurGrain = {:.5f}\n", heights.deviation, grain);
    for (const std::string& file : filesIn(arguments.output))
        fmt::print("wrote {}\n", file);
    return 0;
}

/// The middle of a texture, large enough to see single strands.
void paste(Image& sheet, const Image& texture, int left, int top, int side) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float height = texture.at(x % texture.width, y % texture.height, 3);
            for (int c = 0; c < 3; ++c)
                sheet.at(left + x, top + y, c) = height;
        }
}

int several(const TextureArguments& arguments) {
    const auto range = parseSeeds(arguments.seeds);
    if (!range) return fail(range.error(), arguments.json);
    if (const auto can = checkFolder(arguments.output); !can) return fail(can.error(), arguments.json);
    constexpr int kColumns = 4;
    constexpr int kGap = 8;
    constexpr int kLargestThumbnail = 256;
    const int count = static_cast<int>(range->last - range->first + 1);
    const int side = std::min(arguments.size, kLargestThumbnail);
    const int rows = (count + kColumns - 1) / kColumns;
    Image sheet{
        .width = kColumns * (side + kGap) - kGap, .height = rows * (side + kGap) - kGap, .channels = 3, .pixels = {}, .metadata = {}};
    sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3, 1.0F);

    std::vector<StrandStatistics> figures;
    std::vector<std::vector<std::string>> lines;
    Json list = Json::array();
    Progress progress;
    for (int i = 0; i < count; ++i) {
        FurOptions options = arguments.fur;
        options.seed = range->first + static_cast<std::uint32_t>(i);
        progress.say(fmt::format("seed {}", options.seed));
        const auto set = strandsOnTexture(arguments.size, arguments.size, options);
        if (!set) return fail(set.error(), arguments.json);
        const Image texture = drawFurTexture(*set, arguments.size, arguments.size, options);
        paste(sheet, texture, i % kColumns * (side + kGap), i / kColumns * (side + kGap), side);
        figures.push_back(statisticsOnTexture(*set, arguments.size, arguments.size));
        lines.push_back(row(fmt::format("seed {}", options.seed), figures.back(), coverage(texture)));
        Json entry = toJson(figures.back());
        entry["seed"] = options.seed;
        entry["covered"] = coverage(texture);
        list.push_back(entry);
    }
    progress.clear();
    const fs::path picture = fs::path(arguments.output) / "fur_seeds.png";
    if (const auto written = writePng(picture, sheet, PngEncoding::Raw); !written) return fail(written.error(), arguments.json);
    const std::uint32_t best = range->first + static_cast<std::uint32_t>(evenest(figures));
    if (arguments.json) {
        print({{"seeds", list}, {"evenest", best}, {"files", {picture.string()}}});
        return 0;
    }
    std::vector<std::string> header = kHeader;
    header.front() = "fur";
    fmt::print("{}\nseed {} is the evenest: most strands, least patch CV\nwrote {}\n", table(header, lines), best, picture.string());
    return 0;
}

void addTexture(CLI::App& fur, Action& action) {
    auto arguments = std::make_shared<TextureArguments>();
    CLI::App* command = fur.add_subcommand("texture", "Make fur as a texture, a sphere map and a cube map (docs/design/fur.md)");
    command->add_option("-o,--output", arguments->output, "Folder to write to")->capture_default_str();
    command->add_option("--size", arguments->size, "Side of the texture and of the sphere map; the cube map takes as many texels")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    command->add_option("--density", arguments->fur.density, "Strands per texel; N = density * width * height")->capture_default_str();
    command->add_option("--spacing", arguments->fur.spacing, "Least distance between two roots, in texels")->capture_default_str();
    command->add_option("--radius", arguments->fur.radius, "Radius of a strand, in texels")->capture_default_str();
    command->add_option("--shortest", arguments->fur.shortest, "Shortest strand as a share of the longest")->capture_default_str();
    command->add_flag("--taper", arguments->fur.taper, "Strands are cones: alpha is the height over each texel");
    command->add_option("--seed", arguments->fur.seed, "Seed of the noise")->capture_default_str();
    command->add_option("--seeds", arguments->seeds, "Compare a range of seeds, such as 1..16, as a table and one sheet");
    command->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*command, {{"fur texture -o out/fur", "all three maps, with statistics"},
                           {"fur texture --seeds 1..16", "which seed is the evenest?"}});
    command->callback(
        [arguments, &action] { action = [arguments] { return arguments->seeds.empty() ? one(*arguments) : several(*arguments); }; });
}

} // namespace

void addFur(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("fur", "Make what fur needs");
    command->require_subcommand(1);
    addTexture(*command, action);
    addFurRoots(*command, action);
    addFurStrands(*command, action);
    addFurPose(*command, action);
    addExamples(*command, {{"fur texture -o out/fur", "maps of fur for shells"},
                           {"fur roots bunny.glb -o out/fur/bunny_roots.dds", "strands on the mesh itself"},
                           {"fur strands bunny.glb -o out/fur/bunny_strands.glb", "the same as ribbons, many times as fast"}});
}

} // namespace tegument::app
