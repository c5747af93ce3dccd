#pragma once
// What the sources of hlsl/ define.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tegument::test {

struct ShaderFunction {
    std::string name;
    std::string file; // relative to the folder
};

/// Every function with a body in the .fxh files below `folder`, in order of path and place.
[[nodiscard]] std::vector<ShaderFunction> functionsIn(const std::filesystem::path& folder);

/// Every constant in those files, and every macro with parameters: some define entry points, a line for each, and their cases bear the
/// macro's name.
[[nodiscard]] std::set<std::string> constantsAndMacrosIn(const std::filesystem::path& folder);

} // namespace tegument::test
