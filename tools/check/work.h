#pragma once
// One file in one variant on its way through the check.

#include "tools/check/check.h"

#include <functional>
#include <optional>

namespace tegument::check {

/// Indices into FileReport::entries of the two stages of a pass.
struct StagePair {
    std::size_t vertex = 0;
    std::size_t pixel = 0;
};

struct Work {
    std::filesystem::path file;
    Variant variant;
    std::vector<std::filesystem::path> includeFolders;
    /// The file distinguishes the targets by FX_D3D10, as hlsl/platform.fxh does: its techniques exist on all of them.
    bool dialect = false;
    std::vector<StagePair> pairs; // each once
    bool compatible = false;      // CheckOptions
    bool respelt = false;         // DXC cannot take the file's own words
    std::optional<Effect> drawn;  // of another host's effect: what meshprep/adopt makes of it
    /// What fx_2_0 reads of a file of the dialect, where it may have more passes.
    std::optional<Effect> nine;
    FileReport report;

    [[nodiscard]] bool loaded() const;
    [[nodiscard]] const Effect& effect() const { return report.effect; }
    [[nodiscard]] TargetCheck* find(Target target);
};

[[nodiscard]] Work load(const std::filesystem::path& file, const Variant& variant, const std::vector<Target>& targets,
                        const CheckOptions& options);

/// Why no entry point of this file can be tried by compilers that know Direct3D 10's spelling only; empty when they can.
[[nodiscard]] std::string spellingObstacle(const Work& work);

void addError(TargetCheck& report, int code, SourcePosition at, std::string text, std::string hint);

/// Why a target is not checked: its compiler is missing.
[[nodiscard]] std::string noCompiler(Compiler compiler);

/// TG3004.
void addUnwritten(const EntryPoint& vertex, const EntryPoint& pixel, std::string_view semantic, TargetCheck& report);

/// TG3205: Direct3D 11 and 12 join stages by register.
void addApart(const EntryPoint& vertex, const EntryPoint& pixel, std::string_view semantic, std::uint32_t written, std::uint32_t read,
              TargetCheck& report);

/// TG3206.
void addMissingPosition(const EntryPoint& vertex, TargetCheck& report);

/// TG3204: the same parameters everywhere. What sm5 and SPIR-V see in the same entry point: types, offsets, sizes; and the defaults that
/// sm5 and fx_2_0 hold against those that the file gives.
void compareTargets(Work& work);

/// Why none of the file's entry points can be tried by this compiler; empty when they can.
[[nodiscard]] std::string obstacleFor(const Work& work, Compiler compiler);

/// Compiles every entry point that this host draws; what `compile` gives back are errors and warnings.
void compileEach(Work& work, TargetCheck& report,
                 const std::function<std::vector<Diagnostic>(EntryPoint& entry, const ShaderRequest& request)>& compile);

void checkSpirv(Work& work);
void checkDxil(Work& work);
void checkMicrosoft(std::vector<Work>& works);
/// Of the fx_2_0 binaries that checkMicrosoft has put into the reports.
void measureShaderModel3(std::vector<Work>& works);

/// The techniques that the binary of a target must hold, in their order.
[[nodiscard]] std::vector<const Technique*> techniquesIn(const Work& work, Target target);

/// The file has nothing for this target: the verdict is NotApplicable.
void leaveOut(TargetCheck& report, std::string reason);
[[nodiscard]] bool wasChecked(const TargetCheck& report);

/// Sets the verdict by what the diagnostics hold, and drops repetitions among them.
void conclude(TargetCheck& report);

} // namespace tegument::check
