#pragma once
// Does an effect compile everywhere? Every target's own compiler is asked; what could not be asked is `not checked`, never passed.

#include "host/compile/microsoft.h"
#include "host/support/result.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tegument {

enum class Target { Fx2, Fx4, Fx5, SpirvDxc, SpirvGlslang };
inline constexpr std::array kAllTargets = {Target::Fx2, Target::Fx4, Target::Fx5, Target::SpirvDxc, Target::SpirvGlslang};

/// "fx_2_0", "fx_4_0", "fx_5_0", "spirv-dxc", "spirv-glslang".
[[nodiscard]] std::string_view targetName(Target target);
/// The targets of one name; "all" is every target; empty for an unknown name.
[[nodiscard]] std::vector<Target> targetsByName(std::string_view name);

/// One way to compile every file: defines in addition to those that the target brings.
struct Variant {
    std::string name; // for the report; may be empty
    std::vector<std::pair<std::string, std::string>> defines;
};

/// TEGUMENT_SETTING 0, 1 and 2: "seed", "deon2007", "corrected".
[[nodiscard]] std::vector<Variant> settingVariants();

struct CheckOptions {
    std::vector<Variant> variants = {Variant{}};
    std::vector<std::filesystem::path> includeFolders;
};

enum class Verdict { Passed, Failed, NotChecked };

struct TargetCheck {
    Target target = Target::Fx2;
    Verdict verdict = Verdict::NotChecked;
    std::string reason; // why not checked
    std::vector<Diagnostic> diagnostics;
    int entries = 0; // entry points compiled
    double milliseconds = 0;
};

/// What an entry point takes of shader model 3.
struct EntryUsage {
    std::string entry;
    std::string profile;
    Sm3Usage usage;
};

struct FileReport {
    std::filesystem::path file;
    std::string variant;
    std::vector<Diagnostic> diagnostics; // of the front end; with an error among them every target has failed
    std::vector<TargetCheck> targets;    // in the order asked for
    std::vector<EntryUsage> sm3;         // with target fx_2_0
};

struct CheckReport {
    std::vector<FileReport> files; // for each variant, every file
    [[nodiscard]] bool failed() const;
    [[nodiscard]] bool complete() const; // nothing was left unchecked
};

/// Loads each file, then:
///   spirv-*  every entry point that a pass names: compiled, validated, vertex and pixel stage linked by semantic; when both are asked for,
///            their reflections are held against each other (TG3201).
///   fx_*     the whole file through Microsoft's compiler, one process for all files; techniques and passes or shaders inside the binary
///   are
///            counted against the front end's (TG3202).
///   fx_2_0   also every entry point as vs_3_0 or ps_3_0, held against the limits of shader model 3 (TG3203).
[[nodiscard]] CheckReport checkEffects(const std::vector<std::filesystem::path>& files, const std::vector<Target>& targets,
                                       const CheckOptions& options = {});

} // namespace tegument
