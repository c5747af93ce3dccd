#pragma once
// The shaders of one effect as an engine sees them: linked, each once, with a name.

#include "tools/emit/cross.h"
#include "tools/emit/emit.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument::emit {

/// One entry point, linked to the vertex shader of its pass. A pixel shader behind vertex shaders of different structs is several of these.
struct LinkedShader {
    std::string name; // "FinalPS", then "FinalPS-2"
    const EntryPoint* entry = nullptr;
    std::optional<Shader> dxc;
    std::optional<Shader> glslang;
    Varyings written; // what the vertex shader writes for it; of a vertex shader: its outputs
    std::map<Target, CrossShader> translated;
    std::map<Target, std::string> files; // relative to the effect's folder

    /// DXC's SPIR-V, else glslang's.
    [[nodiscard]] const Shader* spirv() const { return dxc ? &*dxc : glslang ? &*glslang : nullptr; }
};

/// What a target's own compiler made of a shader; of translations, and of what was not compiled, nothing.
struct Form {
    std::string_view bytes;
    const Reflection* reflection = nullptr;
};
[[nodiscard]] Form formOf(const LinkedShader& shader, Target target);

/// Indices into Products::shaders; -1: none.
struct PassShaders {
    int vertex = -1;
    int pixel = -1;
    int geometry = -1;
    int compute = -1;
};

struct Products {
    std::vector<LinkedShader> shaders;
    std::vector<std::vector<PassShaders>> passes;        // of each technique
    std::map<std::string, std::string> files;            // name and bytes of all but the manifest
    std::map<Target, std::string> effects;               // file of fx_2_0, fx_4_0, fx_5_0
    std::vector<std::pair<Target, std::string>> missing; // kinds that were asked for, and why they are not here
};

[[nodiscard]] Products linkShaders(const FileReport& report);

/// The text of manifest.json: the same products give the same bytes.
[[nodiscard]] std::string manifest(const FileReport& report, const EmitOptions& options, const Products& products);

/// True for a text that manifest() wrote.
[[nodiscard]] bool isManifest(std::string_view text);

} // namespace tegument::emit
