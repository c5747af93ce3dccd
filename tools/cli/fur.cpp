// tegument fur: the maps that the shells of effects/Fur.fx read.

#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/strands.h"
#include "meshprep/fur/cube_texture.h"
#include "meshprep/fur/fur_map.h"
#include "meshprep/fur/ribbons/pose.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/head_hair.h"
#include "meshprep/fur/roots/root_maps.h"
#include "meshprep/fur/strand_statistics.h"
#include "meshprep/write/write_mesh.h"
#include "tools/cli/command_line.h"
#include "tools/cli/commands.h"
#include "tools/cli/fur_groom.h"
#include "tools/cli/fur_roots.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct StrandArguments {
    RootArguments roots;
    RibbonOptions ribbons;
    std::string given; // roots made before
    std::string output = "out/fur/strands.glb";
    std::string flowMap, colorMap, regionMap;
    std::string flowAttribute, colorAttribute, regionAttribute;
    bool json = false;
};

Result<void> loadMap(const std::string& path, std::optional<FurMap>& map) {
    if (path.empty()) return {};
    auto loaded = FurMap::load(path);
    if (!loaded) return loaded.error();
    map = *std::move(loaded);
    return {};
}

Result<void> readAttribute(const StrandArguments& arguments, const Mesh& mesh, const std::string& name, std::optional<FurMap>& map,
                           Result<FurMap> (*read)(const fs::path&, const std::string&, const Mesh&)) {
    if (name.empty()) return {};
    auto values = read(arguments.roots.input, name, mesh);
    if (!values) return values.error();
    map = *std::move(values);
    return {};
}

Result<void> readMaps(StrandArguments& arguments, const Mesh& mesh) {
    RibbonOptions& ribbons = arguments.ribbons;
    if (const auto read = loadMap(arguments.flowMap, ribbons.flowMap); !read) return read;
    if (const auto read = loadMap(arguments.colorMap, ribbons.colorMap); !read) return read;
    if (const auto read = loadMap(arguments.regionMap, ribbons.regionMap); !read) return read;
    ribbons.encoded = !arguments.colorMap.empty() && toLower(fs::path(arguments.colorMap).extension().string()) != ".exr";
    if (const auto read = readAttribute(arguments, mesh, arguments.flowAttribute, ribbons.flowMap, readVertexDirections); !read)
        return read;
    if (const auto read = readAttribute(arguments, mesh, arguments.colorAttribute, ribbons.colorMap, readVertexColors); !read) return read;
    return readAttribute(arguments, mesh, arguments.regionAttribute, ribbons.regionMap, readVertexShares);
}

/// A mesh and the texture that its strands name.
struct Grown {
    Mesh mesh;
    Image roots;
    RibbonFigures figures;
};

Result<Grown> grow(StrandArguments& arguments, Progress& progress) {
    Grown grown;
    if (arguments.given.empty()) {
        auto built = buildRoots(arguments.roots, progress);
        if (!built) return built.error();
        grown.mesh = std::move(built->mesh);
        grown.roots = std::move(built->texture.image);
    } else {
        progress.say("reading the mesh");
        auto mesh = loadMesh(arguments.roots.input, arguments.roots.mesh);
        if (!mesh) return mesh.error();
        grown.mesh = *std::move(mesh);
        auto roots = assets::loadRoots(arguments.given, grown.mesh);
        if (!roots) return roots.error();
        grown.roots = *std::move(roots);
    }
    if (const auto read = readMaps(arguments, grown.mesh); !read) return read.error();
    progress.say("growing strands");
    arguments.ribbons.threads = arguments.roots.roots.threads;
    const auto figures = addRibbons(grown.mesh, grown.roots, arguments.ribbons);
    if (!figures) return figures.error();
    grown.figures = *figures;
    return grown;
}

Json toJson(const RibbonFigures& figures) {
    return {{"strands", figures.strands},   {"vertices", figures.vertices}, {"triangles", figures.triangles},
            {"clusters", figures.clusters}, {"cone", figures.widestCone},   {"comb", {figures.comb.x, figures.comb.y, figures.comb.z}},
            {"seconds", figures.seconds}};
}

Result<void> checkInputs(const StrandArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {".glb"}); !can) return can.error();
    if (const auto exist = checkRootInputs(arguments.roots); !exist) return exist.error();
    for (const std::string& file : {arguments.given, arguments.flowMap, arguments.colorMap, arguments.regionMap})
        if (!file.empty())
            if (const auto exists = assets::fileExists(file, file == arguments.given ? "--roots" : "the map"); !exists)
                return exists.error();
    return {};
}

int growFile(StrandArguments& arguments) {
    if (const auto fine = checkInputs(arguments); !fine) return fail(fine.error(), arguments.json);
    Progress progress;
    const auto grown = grow(arguments, progress);
    if (!grown) return fail(grown.error(), arguments.json);
    progress.say("writing");
    std::vector<std::string> files{arguments.output};
    if (const auto written = writeGlb(arguments.output, grown->mesh); !written) return fail(written.error(), arguments.json);
    if (arguments.given.empty()) {
        files.push_back(fs::path(arguments.output).replace_extension(".dds").string());
        const DdsTexture dds{.format = DdsFormat::Rgba32F, .images = {grown->roots}};
        if (const auto written = writeDds(files.back(), dds); !written) return fail(written.error(), arguments.json);
    }
    progress.clear();
    warn(grown->mesh.warnings);
    const RibbonFigures& f = grown->figures;
    if (arguments.json) {
        Json json = toJson(f);
        json["files"] = files;
        print(json);
        return 0;
    }
    fmt::print("{} strands, {} vertices, {} triangles, in {} clusters whose normals differ by {:.0f} degrees (median)\n", f.strands,
               f.vertices, f.triangles, f.clusters, f.widestCone);
    fmt::print("combed to ({:.2f}, {:.2f}, {:.2f}); {:.3f} s\n", f.comb.x, f.comb.y, f.comb.z, f.seconds);
    for (const std::string& file : files)
        fmt::print("wrote {}\n", file);
    return 0;
}

/// "x y z".
void addVector(CLI::App& command, const char* name, std::function<void(const glm::dvec3&)> take, const char* help) {
    command
        .add_option_function<std::vector<double>>(
            name,
            [take = std::move(take)](const std::vector<double>& v) {
                take({v[0], v[1], v[2]});
            },
            help)
        ->expected(3);
}

void addShape(CLI::App& command, StrandArguments& arguments) {
    command.add_option("--segments", arguments.ribbons.segments, "Segments of a ribbon")->capture_default_str();
    command.add_option("--cluster", arguments.ribbons.cluster, "Roots of a cluster")->capture_default_str();
    addVector(
        command, "--flow", [&arguments](const glm::dvec3& v) { arguments.ribbons.comb = v; },
        "Direction in which the coat is combed, x y z; default: from the mesh's shape, from the head to the tail and down");
    addVector(
        command, "--down", [&arguments](const glm::dvec3& v) { arguments.ribbons.down = v; }, "Where down is for that, x y z");
    auto* flow = command.add_option("--flow-map", arguments.flowMap,
                                    "Picture (tangent space) or cube map (mesh space) in place of it: direction, 0.5 is 0");
    auto* color = command.add_option("--color-map", arguments.colorMap, "Picture or cube map: albedo of the strands, sRGB (EXR: linear)");
    auto* region = command.add_option("--region-map", arguments.regionMap,
                                      "Picture or cube map: 0 long fur, 1 short; default: short where the body is thin");
    command.add_option("--flow-attribute", arguments.flowAttribute, "Three properties of a PLY file's vertices, X,Y,Z: direction")
        ->excludes(flow);
    command
        .add_option("--color-attribute", arguments.colorAttribute, "Three properties of a PLY file's vertices, as red,green,blue: albedo")
        ->excludes(color);
    command.add_option("--region-attribute", arguments.regionAttribute, "Property of a PLY file's vertices: 0 long fur, 1 short")
        ->excludes(region);
}

void addFurStrands(CLI::App& fur, Action& action) {
    auto arguments = std::make_shared<StrandArguments>();
    CLI::App* command = fur.add_subcommand("strands", "Grow strands on a mesh as ribbons, a part of it (docs/design/fur.md)");
    command->add_option("mesh", arguments->roots.input, "Mesh, as the effect will draw it")->required();
    command->add_option("-o,--output", arguments->output, "glb to write; roots that are made stand beside it as DDS")
        ->capture_default_str();
    command->add_option("--roots", arguments->given, "Roots of tegument fur roots for this mesh; default: made, with these options");
    addRootOptions(*command, arguments->roots);
    addShape(*command, *arguments);
    command->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*command, {{"fur strands bunny.glb -o out/fur/bunny_strands.glb", "roots and ribbons"},
                           {"fur strands bunny.glb --roots out/fur/bunny_roots.dds --flow 1 -0.5 0", "on roots that are there, combed"},
                           {"fur strands fox.ply --color-attribute red,green,blue", "in the colours of a scan"}});
    command->callback([arguments, &action] { action = [arguments] { return growFile(*arguments); }; });
}

struct PoseArguments {
    std::string rest, posed, roots, seats;
    std::string output = "out/fur/pose.dds";
    MeshOptions mesh;
    bool json = false;
};

Result<Image> loadRootTexture(const std::string& file) {
    auto texture = loadDds(file);
    if (!texture) return texture.error();
    return texture->images.front();
}

Result<void> writeTexture(const fs::path& file, Image image) {
    return writeDds(file, {.format = DdsFormat::Rgba32F, .images = {std::move(image)}});
}

/// What `tegument fur pose` has found.
struct Posed {
    RootSeats seats;
    Mesh skin;
    Image roots;
    Image pose;
};

Result<Posed> pose(const PoseArguments& arguments) {
    for (const auto& [file, what] :
         {std::pair(arguments.rest, "the mesh"), std::pair(arguments.posed, "the pose"), std::pair(arguments.roots, "--roots")})
        if (const auto exists = assets::fileExists(file, what); !exists) return exists.error();
    const auto rest = loadMesh(arguments.rest, arguments.mesh);
    if (!rest) return rest.error();
    const auto posed = assets::readPose(arguments.posed, *rest, arguments.mesh);
    if (!posed) return posed.error();
    auto roots = loadRootTexture(arguments.roots);
    if (!roots) return roots.error();
    Posed found{.skin = skinOf(*rest, *posed), .roots = *std::move(roots)};
    auto seats = seatsOfRoots(found.skin, found.roots);
    if (!seats) return seats.error();
    found.seats = *std::move(seats);
    found.pose = poseTexture(found.seats, found.skin, *posed, found.roots);
    return found;
}

int poseFile(const PoseArguments& arguments) {
    for (const std::string& file : {arguments.output, arguments.seats})
        if (!file.empty())
            if (const auto can = checkOutput(file, {".dds"}); !can) return fail(can.error(), arguments.json);
    auto found = pose(arguments);
    if (!found) return fail(found.error(), arguments.json);
    std::vector<std::string> files{arguments.output};
    if (const auto written = writeTexture(arguments.output, std::move(found->pose)); !written) return fail(written.error(), arguments.json);
    if (!arguments.seats.empty()) {
        files.push_back(arguments.seats);
        if (const auto written = writeTexture(arguments.seats, seatTexture(found->seats, found->skin, found->roots)); !written)
            return fail(written.error(), arguments.json);
    }
    if (arguments.json) {
        print({{"roots", found->seats.seats.size()}, {"lost", found->seats.lost}, {"files", files}});
        return 0;
    }
    fmt::print("{} roots follow their triangles, {} have none\n", found->seats.seats.size(), found->seats.lost);
    for (const std::string& file : files)
        fmt::print("wrote {}\n", file);
    return 0;
}

void addFurPose(CLI::App& fur, Action& action) {
    auto arguments = std::make_shared<PoseArguments>();
    CLI::App* command = fur.add_subcommand("pose", "Where a body that bends takes the roots of its strands (docs/design/fur.md)");
    command->add_option("mesh", arguments->rest, "Mesh at rest, that the roots were made for")->required();
    command->add_option("pose", arguments->posed, "The same mesh, bent: the same triangles")->required();
    command->add_option("--roots", arguments->roots, "Roots of tegument fur roots or fur strands for it")->required();
    command->add_option("-o,--output", arguments->output, "DDS to write: how each root has moved and turned")->capture_default_str();
    command->add_option("--seats", arguments->seats, "DDS to write besides: triangle and weights of each root, for an engine's own poses");
    command->add_option("--unit-mm", arguments->mesh.unitMm, "Millimetres in one unit of the mesh files")->check(CLI::PositiveNumber);
    command->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*command, {{"fur pose fox.glb fox_jump.glb --roots fox.dds -o jump.dds", "one pose"},
                           {"fur pose fox.glb fox.glb --roots fox.dds --seats seats.dds", "what an engine needs to pose them itself"}});
    command->callback([arguments, &action] { action = [arguments] { return poseFile(*arguments); }; });
}

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
    Image sheet = plainImage(kColumns * (side + kGap) - kGap, rows * (side + kGap) - kGap, 3, 1.0F);

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
    addFurGroom(*command, action);
    addExamples(*command, {{"fur texture -o out/fur", "maps of fur for shells"},
                           {"fur roots bunny.glb -o out/fur/bunny_roots.dds", "strands on the mesh itself"},
                           {"fur strands bunny.glb -o out/fur/bunny_strands.glb", "the same as ribbons, many times as fast"},
                           {"fur import hair.abc --mesh head.glb -o out/fur/hair.glb", "strands of another program"}});
}

} // namespace tegument::app
