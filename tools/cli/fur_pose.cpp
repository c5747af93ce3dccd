#include "tools/cli/fur_pose.h"

#include "host/image/dds.h"
#include "host/support/file.h"
#include "meshprep/fur/ribbons/pose.h"
#include "tools/cli/command_line.h"
#include "tools/cli/names.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRoots = "gFurRootsMap";
constexpr const char* kPose = "gFurPoseMap";
constexpr const char* kPoseBefore = "gFurPoseBeforeMap";

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
        if (const auto exists = fileExists(file, what); !exists) return exists.error();
    const auto rest = loadMesh(arguments.rest, arguments.mesh);
    if (!rest) return rest.error();
    const auto posed = readPose(arguments.posed, *rest, arguments.mesh);
    if (!posed) return posed.error();
    auto roots = loadRootTexture(arguments.roots);
    if (!roots) return roots.error();
    Posed found{.seats = {}, .skin = skinOf(*rest, *posed), .roots = *std::move(roots), .pose = {}};
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

/// Into the cache: a texture has a name.
Result<void> givePose(const char* parameter, Image image, Scene& scene) {
    const std::string_view bytes(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(float));
    const fs::path file = cacheFolder() / "fur" / "made" / fmt::format("pose_{}.dds", contentHash(bytes));
    if (!isWholeDds(file))
        if (const auto written = writeTexture(file, std::move(image)); !written) return written;
    scene.workspace.textures[parameter] = fs::absolute(file).string();
    return {};
}

} // namespace

Result<Mesh> readPose(const std::string& file, const Mesh& rest, MeshOptions load) {
    load.unitMm = rest.unitMm;
    load.guessUnit = false;
    load.expectHead = false;
    auto posed = loadMesh(file, load);
    if (!posed) return posed;
    for (glm::vec3& position : posed->positions)
        position += glm::vec3(posed->origin - rest.origin);
    computeBounds(*posed);
    if (sameTriangles(rest, *posed)) return posed;
    return inputError(8048, {.file = file, .byte = {}},
                      fmt::format("this is no pose of {}: {} vertices and {} triangles, or in another order than its {} and {}", rest.name,
                                  posed->positions.size(), posed->indices.size() / 3, rest.positions.size(), rest.indices.size() / 3),
                      "move the vertices of that file, and neither add nor merge any");
}

Result<void> poseStrands(const Effect& effect, const RunOptions& options, Scene& scene) {
    if (!scene.pose) return {};
    if (!effect.findParameter(kPose))
        return usageError(8047, fmt::format("--pose: {} draws no strands that bend", effect.file.string()),
                          "give the bent mesh itself: --mesh FILE; FurCoat takes --pose");
    const auto set = options.textures.find(kRoots);
    const fs::path named = scene.workspace.file.parent_path() / scene.workspace.textures[kRoots];
    const auto roots = loadRootTexture(set != options.textures.end() ? set->second : named.string());
    if (!roots) return roots.error();
    Mesh& mesh = scene.meshes.front();
    const Mesh skin = skinOf(mesh, *scene.pose);
    const auto seats = seatsOfRoots(skin, *roots);
    if (!seats) return seats.error();
    Image pose = poseTexture(*seats, skin, *scene.pose, *roots);
    if (effect.findParameter(kPoseBefore)) {
        const Mesh& before = scene.poseBefore ? *scene.poseBefore : *scene.pose;
        if (const auto given = givePose(kPoseBefore, poseTexture(*seats, skin, before, *roots), scene); !given) return given;
    }
    applyPose(mesh, *scene.pose, pose);
    return givePose(kPose, std::move(pose), scene);
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

} // namespace tegument::app
