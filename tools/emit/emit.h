#pragma once
// What engines load: compiled effects and shaders of one checked file, translations for other engines, and a manifest that describes them.

#include "tools/check/check.h"

#include <filesystem>
#include <vector>

namespace tegument {

/// What must have been checked for a target to be written: GLSL and MSL come from DXC's SPIR-V, without DXC from glslang's.
[[nodiscard]] Target sourceOf(Target target);

struct EmitOptions {
    std::filesystem::path folder;
    std::vector<Target> kinds = allTargets(true);
    std::vector<std::pair<std::string, std::string>> defines; // of the variant, for the manifest
};

/// Whether techniques with compute shaders alone have this one: what GLSL 330 cannot say of it is no loss there.
[[nodiscard]] bool belongsToCompute(const Effect& effect, std::string_view entry);

/// Writes `<folder>/[<variant>/]<effect>/` with manifest.json (docs/emit.md), whole or not at all: into a folder beside it, then by
/// renaming. What was there before is replaced if it is such a folder (TG3304 if not). An effect that failed is not written (TG3301); a
/// kind whose target was not checked is left out, and the manifest says why. TG3302, TG3303: a translation is not possible, or not valid.
/// Returns the folder.
[[nodiscard]] Result<std::filesystem::path> emitEffect(const FileReport& report, const EmitOptions& options);

} // namespace tegument
