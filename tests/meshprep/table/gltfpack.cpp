#include "tests/meshprep/table/gltfpack.h"

#include "host/mesh/read_mesh.h"
#include "meshprep/write/glb.h"
#include "tools/process/process.h"

#include <chrono>
#include <string>
#include <unistd.h>

namespace tegument::testing_prep {

namespace fs = std::filesystem;

std::optional<Packed> packedBy(const fs::path& tools, const Mesh& mesh, double share) {
    const fs::path program = tools / "node_modules" / "gltfpack" / "cli.js";
    if (!fs::exists(program)) return std::nullopt;
    const std::string stem = (fs::temp_directory_path() / ("tegument-table-" + std::to_string(::getpid()))).string();
    Mesh bare = mesh; // without pictures, which cost time and nothing else
    bare.textures = {};
    bare.materials = {};
    if (!writeGlb(stem + ".glb", bare)) return std::nullopt;
    std::vector<std::string> arguments = {"node", program.string(), "-i", stem + ".glb", "-o", stem + "-packed.glb", "-noq", "-kn"};
    if (share < 1) arguments.insert(arguments.end(), {"-si", std::to_string(share), "-se", "1"});
    const auto start = std::chrono::steady_clock::now();
    const auto ran = runProcess({.arguments = arguments}, 120);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::optional<Packed> packed;
    if (ran && ran->exitCode == 0)
        if (auto read = readMesh(stem + "-packed.glb")) packed = {.mesh = std::move(read->mesh), .seconds = seconds};
    fs::remove(stem + ".glb");
    fs::remove(stem + "-packed.glb");
    return packed;
}

} // namespace tegument::testing_prep
