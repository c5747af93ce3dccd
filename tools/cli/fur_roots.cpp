// tegument fur roots: roots on a mesh, evenly by area, as one float texture (docs/design/fur.md, "Roots").

#include "tools/cli/fur_roots.h"

#include "host/image/dds.h"
#include "host/support/file.h"
#include "meshprep/assets/names.h"
#include "meshprep/fur/roots/root_maps.h"
#include "tools/cli/command_line.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

Result<void> loadMaps(RootArguments& arguments) {
    const std::pair<const std::string*, std::optional<FurMap>*> maps[] = {{&arguments.densityMap, &arguments.roots.densityMap},
                                                                          {&arguments.lengthMap, &arguments.roots.lengthMap},
                                                                          {&arguments.directionMap, &arguments.roots.directionMap}};
    for (const auto& [path, map] : maps) {
        if (path->empty()) continue;
        auto loaded = FurMap::load(*path);
        if (!loaded) return loaded.error();
        *map = *std::move(loaded);
    }
    return {};
}

/// Maps that travel at the vertices of the mesh file.
Result<void> readAttributes(RootArguments& arguments, const Mesh& mesh) {
    struct Wanted {
        const std::string* name;
        std::optional<FurMap>* map;
        Result<FurMap> (*read)(const fs::path&, const std::string&, const Mesh&);
    };
    const Wanted all[] = {{&arguments.densityAttribute, &arguments.roots.densityMap, readVertexShares},
                          {&arguments.lengthAttribute, &arguments.roots.lengthMap, readVertexShares},
                          {&arguments.directionAttribute, &arguments.roots.directionMap, readVertexDirections}};
    for (const Wanted& wanted : all) {
        if (wanted.name->empty()) continue;
        auto map = wanted.read(arguments.input, *wanted.name, mesh);
        if (!map) return map.error();
        *wanted.map = *std::move(map);
    }
    return {};
}

} // namespace

Result<BuiltRoots> buildRoots(RootArguments& arguments, Progress& progress) {
    if (const auto loaded = loadMaps(arguments); !loaded) return loaded.error();
    BuiltRoots built;
    progress.say("reading the mesh");
    const auto start = std::chrono::steady_clock::now();
    auto mesh = loadMesh(arguments.input, arguments.mesh);
    if (!mesh) return mesh.error();
    built.mesh = *std::move(mesh);
    built.readSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (const auto read = readAttributes(arguments, built.mesh); !read) return read.error();
    progress.say("placing roots");
    auto set = makeRoots(built.mesh, arguments.roots);
    if (!set) return set.error();
    built.set = *std::move(set);
    auto texture = buildRootTexture(built.set, arguments.roots.threads);
    if (!texture) return texture.error();
    built.texture = *std::move(texture);
    return built;
}

namespace {

double buildSeconds(const BuiltRoots& built) {
    const RootSet::Seconds& s = built.set.seconds;
    return s.surface + s.scatter + s.limits + s.strands + built.texture.seconds;
}

Json toJson(const BuiltRoots& built, const RootArguments& arguments) {
    const RootSet& set = built.set;
    const RootTexture& texture = built.texture;
    const RootSet::Seconds& s = set.seconds;
    return {{"mesh", arguments.input},
            {"seed", arguments.roots.seed},
            {"roots", set.roots.size()},
            {"wanted", set.wanted},
            {"area_mm2", set.area},
            {"density_per_mm2", set.density},
            {"least_distance_mm", set.distance},
            {"radius_mm", set.radius},
            {"reach_mm", set.reach},
            {"cell_mm", set.cell},
            {"ball", {{"centre", {set.centre.x, set.centre.y, set.centre.z}}, {"radius", set.ballRadius}}},
            {"shortened",
             {{"fur_length", arguments.roots.furLength},
              {"by_curvature", set.shortenedByCurvature},
              {"by_opposite_sheet", set.shortenedByOpposite}}},
            {"grid",
             {{"bricks", {texture.bricks.x, texture.bricks.y, texture.bricks.z}},
              {"cells_along_brick", texture.brick},
              {"used_bricks", texture.usedBricks},
              {"used_cells", texture.usedCells},
              {"entries", texture.listed},
              {"longest_list", texture.mostListed},
              {"longest_list_texels", texture.mostTexels}}},
            {"texture",
             {{"width", texture.image.width},
              {"height", texture.image.height},
              {"texels", texture.texels},
              {"bytes", texture.image.pixels.size() * sizeof(float)}}},
            {"seconds",
             {{"read", built.readSeconds},
              {"surface", s.surface},
              {"scatter", s.scatter},
              {"limits", s.limits},
              {"strands", s.strands},
              {"texture", texture.seconds},
              {"build", buildSeconds(built)}}}};
}

void printSummary(const BuiltRoots& built, const RootArguments& arguments) {
    const RootSet& set = built.set;
    const RootTexture& texture = built.texture;
    fmt::print("{} roots of {} wanted on {:.5g} mm^2, none nearer than {:.4g} mm\n", set.roots.size(), set.wanted, set.area, set.distance);
    fmt::print("with a coat of {} radii ({:.4g} mm), {} strands are shortened where the surface is concave, {} by the sheet opposite\n",
               arguments.roots.furLength, arguments.roots.furLength * set.ballRadius, set.shortenedByCurvature, set.shortenedByOpposite);
    fmt::print("{} cells of {:.4g} mm in {} bricks of {}^3 cells; a cell lists {:.2f} roots, at most {} ({} texels)\n", texture.usedCells,
               set.cell, texture.usedBricks, texture.brick, static_cast<double>(texture.listed) / static_cast<double>(texture.usedCells),
               texture.mostListed, texture.mostTexels);
    fmt::print("texture of {} x {} texels, {:.1f} MB\n", texture.image.width, texture.image.height,
               static_cast<double>(texture.image.pixels.size() * sizeof(float)) / 1e6);
    const RootSet::Seconds& s = set.seconds;
    fmt::print("{:.3f} s to read; {:.3f} s to build: surface {:.3f}, places {:.3f}, lengths {:.3f}, strands {:.3f}, texture {:.3f}\n",
               built.readSeconds, buildSeconds(built), s.surface, s.scatter, s.limits, s.strands, texture.seconds);
}

fs::path besideOf(const RootArguments& arguments) {
    return fs::path(arguments.output).replace_extension(".json");
}

Result<void> checkFiles(const RootArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {".dds"}, "tegument render FurRoots draws the strands"); !can) return can.error();
    if (const auto can = checkOutput(besideOf(arguments).string(), {}); !can) return can.error();
    return checkRootInputs(arguments);
}

int run(RootArguments& arguments) {
    if (const auto fine = checkFiles(arguments); !fine) return fail(fine.error(), arguments.json);
    Progress progress;
    const auto built = buildRoots(arguments, progress);
    progress.clear();
    if (!built) return fail(built.error(), arguments.json);
    const Json json = toJson(*built, arguments);
    const fs::path beside = besideOf(arguments);
    const DdsTexture dds{.format = DdsFormat::Rgba32F, .images = {built->texture.image}};
    if (const auto written = writeDds(arguments.output, dds); !written) return fail(written.error(), arguments.json);
    if (const auto written = writeFile(beside, json.dump(2) + "\n"); !written) return fail(written.error(), arguments.json);
    if (arguments.json) {
        Json shown = json;
        shown["files"] = {arguments.output, beside.string()};
        print(shown);
        return 0;
    }
    printSummary(*built, arguments);
    fmt::print("wrote {}\nwrote {}\n", arguments.output, beside.string());
    return 0;
}

void addPlaces(CLI::App& command, RootOptions& roots) {
    auto* count = command.add_option("--count", roots.count, "Roots on the mesh")->capture_default_str();
    command.add_option("--density", roots.density, "Roots per square millimetre, instead of --count")->excludes(count);
    command.add_option("--spacing", roots.spacing, "Least distance of two roots, in mean spacings 1/sqrt(density)")->capture_default_str();
    command.add_option("--seed", roots.seed, "Seed of the noise")->capture_default_str();
    command.add_option("--reach", roots.reach, "How far from its root a strand is found, in mean spacings")->capture_default_str();
    command.add_option("--cell", roots.cell, "Side of the grid's cells, in mean spacings")->capture_default_str();
    command.add_option("--threads", roots.threads, "Threads; 0: one a processor")->capture_default_str();
}

void addLooks(CLI::App& command, RootOptions& roots) {
    command.add_option("--radius", roots.radius, "Radius of a strand at its root, in mean spacings")->capture_default_str();
    command.add_option("--thinnest", roots.thinnest, "Thinnest strand as a share of that radius")->capture_default_str();
    command.add_option("--shortest", roots.shortest, "Shortest strand as a share of the longest")->capture_default_str();
    command.add_option("--lean", roots.lean, "How far tips lean along the direction, in lengths of the strand")->capture_default_str();
    command
        .add_option_function<std::vector<double>>(
            "--comb",
            [&roots](const std::vector<double>& v) {
                roots.comb = {v[0], v[1], v[2]};
            },
            "Direction in which strands lean, x y z")
        ->expected(3);
    command.add_option("--curl", roots.curl, "Most curled strand, 0 to 1 of the effect's curl")->capture_default_str();
    command.add_option("--length", roots.furLength, "Coat length for which shortened strands are counted, a share of the mesh's radius")
        ->capture_default_str();
}

void addMaps(CLI::App& command, RootArguments& arguments) {
    auto* density = command.add_option("--density-map", arguments.densityMap, "Picture or cube map: share of the density");
    auto* length = command.add_option("--length-map", arguments.lengthMap, "Picture or cube map: share of the length");
    auto* direction = command.add_option("--direction-map", arguments.directionMap,
                                         "Picture (tangent space) or cube map (mesh space): direction, 0.5 is 0");
    command.add_option("--density-attribute", arguments.densityAttribute, "Property of the vertices of a PLY file: share of the density")
        ->excludes(density);
    command.add_option("--length-attribute", arguments.lengthAttribute, "Property of the vertices of a PLY file: share of the length")
        ->excludes(length);
    command
        .add_option("--direction-attribute", arguments.directionAttribute,
                    "Three properties of the vertices of a PLY file, X,Y,Z: direction in mesh space")
        ->excludes(direction);
}

} // namespace

Result<void> checkRootInputs(const RootArguments& arguments) {
    if (const auto exists = assets::fileExists(arguments.input, "the mesh"); !exists) return exists.error();
    for (const std::string& map : {arguments.densityMap, arguments.lengthMap, arguments.directionMap})
        if (!map.empty())
            if (const auto exists = assets::fileExists(map, "the map"); !exists) return exists.error();
    return {};
}

void addRootOptions(CLI::App& command, RootArguments& arguments) {
    command.add_option("--unit-mm", arguments.mesh.unitMm, "Millimetres per unit of the mesh file");
    addPlaces(command, arguments.roots);
    addLooks(command, arguments.roots);
    addMaps(command, arguments);
}

void addFurRoots(CLI::App& fur, Action& action) {
    auto arguments = std::make_shared<RootArguments>();
    CLI::App* command = fur.add_subcommand("roots", "Place roots of fur on a mesh, evenly by area, as a texture (docs/design/fur.md)");
    command->add_option("mesh", arguments->input, "Mesh, as the effect will draw it")->required();
    command->add_option("-o,--output", arguments->output, "DDS to write; a JSON file of the same name says what is in it")
        ->capture_default_str();
    addRootOptions(*command, *arguments);
    command->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*command, {{"fur roots bunny.glb -o out/fur/bunny_roots.dds", "as many as usual"},
                           {"fur roots bunny.glb --density 0.5", "by area"},
                           {"fur roots bunny.glb --comb 0 -1 0 --lean 0.5", "combed down"}});
    command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

} // namespace tegument::app
