#include "tools/cli/fur_pose.h"

#include "host/image/dds.h"
#include "host/support/file.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/strands.h"
#include "meshprep/fur/ribbons/pose.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

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

} // namespace

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
