#pragma once
// Shaders in the assembly of Direct3D 9 as functions of HLSL.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument {

struct Assembly {
    std::string name;                     // of the function to be made
    std::vector<std::string> lines;       // one instruction each, the version first
    std::map<int, std::string> constants; // what the pass gives registers: expressions of four components
    std::map<int, std::string> samplers;  // and stages: their names
};

struct Assembled {
    std::string profile; // "vs_1_1"
    std::string text;
};

/// vs_1_1 to vs_3_0, ps_1_1 to ps_3_0. Nullopt, and the instruction in `why`, where one is not translated.
[[nodiscard]] std::optional<Assembled> translateAssembly(const Assembly& assembly, std::string& why);

} // namespace tegument
