#pragma once
// What engines load: compiled effects and shaders of one checked file, translations for other engines, and a manifest that describes them.

#include "tools/check/check.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace tegument {

enum class EmitKind { Fx2, Fx4, Fx5, Sm5, Dxil, SpirvDxc, SpirvGlslang, Glsl, GlslEs, Msl };
inline constexpr std::array kAllEmitKinds = {EmitKind::Fx2,      EmitKind::Fx4,          EmitKind::Fx5,  EmitKind::Sm5,    EmitKind::Dxil,
                                             EmitKind::SpirvDxc, EmitKind::SpirvGlslang, EmitKind::Glsl, EmitKind::GlslEs, EmitKind::Msl};

/// "fx_2_0", "fx_4_0", "fx_5_0", "sm5", "dxil", "spirv-dxc", "spirv-glslang", "glsl", "glsl-es", "msl".
[[nodiscard]] std::string_view emitKindName(EmitKind kind);
/// "all" is every kind, "spirv" both compilers'; empty for an unknown name.
[[nodiscard]] std::vector<EmitKind> emitKindsByName(std::string_view name);
/// The targets that must be checked for a kind to be written: GLSL and MSL come from DXC's SPIR-V, without DXC from glslang's.
[[nodiscard]] Target targetOf(EmitKind kind);

struct EmitOptions {
    std::filesystem::path folder;
    std::vector<EmitKind> kinds = {kAllEmitKinds.begin(), kAllEmitKinds.end()};
    std::vector<std::pair<std::string, std::string>> defines; // of the variant, for the manifest
};

/// Writes `<folder>/[<variant>/]<effect>/` with manifest.json (docs/emit.md), whole or not at all: into a folder beside it, then by
/// renaming. What was there before is replaced if it is such a folder (TG3304 if not). An effect that failed is not written (TG3301); a
/// kind whose target was not checked is left out, and the manifest says why. TG3302, TG3303: a translation is not possible, or not valid.
/// Returns the folder.
[[nodiscard]] Result<std::filesystem::path> emitEffect(const FileReport& report, const EmitOptions& options);

} // namespace tegument
