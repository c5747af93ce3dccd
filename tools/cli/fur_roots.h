#pragma once
// tegument fur roots: where strands stand on a mesh, as a texture; and the same for fur strands.

#include "meshprep/fur/roots/root_texture.h"
#include "tools/cli/commands.h"
#include "tools/cli/output.h"

#include <string>

namespace tegument::app {

struct RootArguments {
    RootOptions roots;
    MeshOptions mesh;
    std::string input;
    std::string output = "out/fur/roots.dds";
    std::string densityMap;
    std::string lengthMap;
    std::string directionMap;
    std::string densityAttribute;
    std::string lengthAttribute;
    std::string directionAttribute;
    bool json = false;
};

struct BuiltRoots {
    Mesh mesh;
    RootSet set;
    RootTexture texture;
    double readSeconds = 0;
};

/// --unit-mm, how many, where, what they look like, and the maps.
void addRootOptions(CLI::App& command, RootArguments& arguments);
/// The mesh and the maps exist.
[[nodiscard]] Result<void> checkRootInputs(const RootArguments& arguments);
/// Reads the mesh, its maps and attributes, and makes roots and texture.
[[nodiscard]] Result<BuiltRoots> buildRoots(RootArguments& arguments, Progress& progress);

void addFurRoots(CLI::App& fur, Action& action);

} // namespace tegument::app
