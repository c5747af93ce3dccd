#pragma once
// Does an effect compile everywhere? Every target's own compiler is asked; what the machine lacks is `not checked`, never passed.

#include "host/effect/entry_points.h"
#include "host/effect/model.h"
#include "host/spirv/compile.h"
#include "host/spirv/dxil.h"
#include "host/support/result.h"
#include "tools/direct3d/microsoft.h"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tegument {

/// What an effect is compiled to. The last three are written in SPIR-V's stead (tools/emit), and not checked.
enum class Target { Fx2, Fx4, Fx5, Sm5, Dxil, SpirvDxc, SpirvGlslang, Glsl, GlslEs, Msl };

struct TargetRow {
    Target target;
    std::string_view name;
    std::string_view ending{};   // of a file with one shader, behind its stage
    std::string_view language{}; // that SPIR-V is translated into; empty: it is checked
};
inline constexpr std::array<TargetRow, 10> kTargets = {{{Target::Fx2, "fx_2_0"},
                                                        {Target::Fx4, "fx_4_0"},
                                                        {Target::Fx5, "fx_5_0"},
                                                        {Target::Sm5, "sm5", ".cso"},
                                                        {Target::Dxil, "dxil", ".dxil"},
                                                        {Target::SpirvDxc, "spirv-dxc", ".spv"},
                                                        {Target::SpirvGlslang, "spirv-glslang", ".spv"},
                                                        {Target::Glsl, "glsl", "", "GLSL"},
                                                        {Target::GlslEs, "glsl-es", "", "GLSL ES"},
                                                        {Target::Msl, "msl", ".metal", "MSL"}}};
[[nodiscard]] constexpr const TargetRow& rowOf(Target target) {
    return kTargets[static_cast<std::size_t>(target)];
}
[[nodiscard]] constexpr std::string_view targetName(Target target) {
    return rowOf(target).name;
}

/// Those that are checked; `written`: all that can be written, too.
[[nodiscard]] std::vector<Target> allTargets(bool written = false);
/// Their names, as a text lists them: "fx_2_0, fx_4_0" ...
[[nodiscard]] std::string targetNames(bool written = false);
/// One of them, "all", or "spirv", both compilers'; empty for an unknown name.
[[nodiscard]] std::vector<Target> targetsByName(std::string_view name, bool written = false);

/// One way to compile every file: defines in addition to those that the target brings.
struct Variant {
    std::string name; // for the report; may be empty
    std::vector<std::pair<std::string, std::string>> defines;
    std::string setting; // of the effect, by name; empty: as it and the defines have it
};

/// One for each setting of the effect; of an effect without settings, or that cannot be read, one without a name.
[[nodiscard]] std::vector<Variant> settingVariants(const std::filesystem::path& effect, const LoadOptions& options = {});

struct CheckOptions {
    std::vector<Variant> variants = {Variant{}};
    std::vector<std::filesystem::path> includeFolders;
    bool allSettings = false; // each variant once for each setting that a file has
    bool compatible = false;  // Microsoft's compiler with its option /Gec
    Roots roots = {};         // as in LoadOptions
};

/// NotApplicable: the file has nothing for this target, which is no fault of anybody. NotChecked: the machine lacks the target's tool.
enum class Verdict { Passed, Failed, NotApplicable, NotChecked };

/// "passed", "failed", "not applicable", "not checked".
[[nodiscard]] std::string_view verdictName(Verdict verdict);

struct TargetCheck {
    Target target = Target::Fx2;
    Verdict verdict = Verdict::NotChecked;
    std::string reason; // why not applicable, or not checked: then with the command that brings what is missing
    std::vector<Diagnostic> diagnostics;
    int entries = 0; // entry points compiled
    double milliseconds = 0;
};

/// What a stage of a pass takes of shader model 3, read from the shader inside the fx_2_0 effect.
struct PassUsage {
    std::string technique;
    std::string pass;
    std::string entry;
    std::string profile; // "vs_3_0", "ps_3_0"
    Sm3Usage usage;
};

/// A resource that shader model 3 counts, and how much of it every device has.
struct Sm3Limit {
    std::string_view what;
    int Sm3Usage::*used;
    int vertex;
    int pixel;
};

/// What Direct3D 9 promises for shader model 3 (MaxVertexShader30InstructionSlots and MaxPixelShader30InstructionSlots are at least 512).
/// A vertex shader may write 11 registers besides the position, but a pixel shader reads 10.
inline constexpr std::array kSm3Limits = {
    Sm3Limit{"instruction slots", &Sm3Usage::instructionSlots, 512, 512}, Sm3Limit{"constant registers", &Sm3Usage::constants, 256, 224},
    Sm3Limit{"samplers", &Sm3Usage::samplers, 4, 16}, Sm3Limit{"interpolators", &Sm3Usage::interpolators, 10, 10}};

/// One entry point of an effect and what the compilers made of it; empty where they were not asked or refused.
struct EntryPoint {
    std::string name;
    ShaderStage stage = ShaderStage::Pixel;
    std::string profile; // as the effect writes it
    SourcePosition at;
    std::vector<std::string> arguments{};         // that the pass compiles it with
    std::string code{};                           // for DXC where the file's own words are Direct3D 9's (meshprep/adopt); empty: the file's
    std::string symbol{};                         // its name there
    std::shared_ptr<const Diagnostic> obstacle{}; // why it cannot be respelt
    bool undrawn = false;                         // only passes with stages that this host does not run have it
    std::string sm5;                              // the blob
    std::optional<Sm5Reflection> sm5Reflection;
    std::optional<Dxil> dxil;
    std::optional<Shader> dxc;
    std::optional<Shader> glslang;
};

struct FileReport {
    std::filesystem::path file;
    std::string variant;
    std::vector<Diagnostic> diagnostics; // of the front end; with an error among them every target has failed
    std::vector<TargetCheck> targets;    // in the order asked for
    std::vector<PassUsage> sm3;          // with target fx_2_0

    Effect effect;                          // when it could be loaded
    std::map<Target, std::string> binaries; // of fx_2_0, fx_4_0, fx_5_0
    std::vector<EntryPoint> entries;        // each once, in the order of passes

    [[nodiscard]] bool failed() const;
    [[nodiscard]] bool decided() const; // some target has passed or failed
};

struct CheckReport {
    std::vector<FileReport> files; // for each variant, every file
    [[nodiscard]] bool failed() const;
    [[nodiscard]] bool complete() const; // the machine has all that was asked for
    [[nodiscard]] bool decided() const;  // of every file something has been checked
};

/// Loads each file, then:
///   spirv-*  every pass as host/run makes it: compiled, validated, stages linked by semantic, the vertex stream bound; when both are asked
///            for, their reflections are held against each other (TG3201). By DXC an effect of another host is what meshprep/adopt makes of
///            it, and the technique that is drawn decides: of others errors are warnings.
///   sm5      every entry point by Microsoft's compiler as vs_5_0, ps_5_0, gs_5_0 or cs_5_0, as Direct3D 11 without effects loads it;
///            stages linked by register (TG3205).
///   dxil     every entry point by DXC as vs_6_0, ps_6_0 or cs_6_0, as Direct3D 12 loads it, held valid by its validator; stages linked by
///            register (TG3205).
///   fx_*     the whole file by Microsoft's compiler; techniques, passes and shaders inside the binary are counted against the front end's
///            (TG3202). fx_2_0: every shader inside is held against the limits of shader model 3 (TG3203).
[[nodiscard]] CheckReport checkEffects(const std::vector<std::filesystem::path>& files, const std::vector<Target>& targets,
                                       const CheckOptions& options = {});

} // namespace tegument
