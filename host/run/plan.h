#pragma once
// One frame of an effect as a flat list: its scripts executed, loops unrolled, names resolved. Nothing here knows a GPU. Only what stands
// in the plan is compiled and allocated.

#include "host/effect/script_run.h"
#include "host/run/values.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace tegument::run {

/// With several samples a pixel: what the picture's are resolved into. No pass draws to it.
inline constexpr const char* kPictureResolved = "<picture resolved>";
/// The resolve's name among the passes' times.
inline constexpr const char* kResolve = "resolve";
/// That of clears which are timed by themselves; no pass can have it.
inline constexpr const char* kClears = "<clears>";

/// And those that completePlan() adds.
[[nodiscard]] inline bool isCallers(const std::string& target) {
    return target.starts_with('<');
}

struct ClearStep {
    std::string target;
    ClearKind what = ClearKind::Color;
    std::array<float, 4> color{};
    float depth = 1;
    std::uint32_t stencil = 0;
    bool operator==(const ClearStep&) const = default;
};

/// One execution of a pass. A compute pass has no targets: its shader says what it writes (PassUse).
struct DrawStep {
    const Technique* technique = nullptr;
    const Pass* pass = nullptr;
    DrawKind kind = DrawKind::Geometry;
    std::vector<std::optional<std::string>> colors; // up to the last bound one
    std::optional<std::string> depth;
    std::map<std::string, double> written;     // loop indices and counts at this moment
    std::map<std::string, std::string> copies; // targets that the pass samples while it draws into them: what it reads instead
    bool operator==(const DrawStep&) const = default;
};

/// The mip chain of a target is made anew because the next step samples it.
struct MipStep {
    std::string target;
    bool operator==(const MipStep&) const = default;
};

/// What a target holds goes into its copy, because the next step samples it and draws into it.
struct CopyStep {
    std::string from;
    std::string to;
    bool operator==(const CopyStep&) const = default;
};

using Step = std::variant<ClearStep, DrawStep, MipStep, CopyStep>;

struct Plan {
    const Technique* technique = nullptr; // the first that draws; else the one chosen
    std::vector<Step> steps;
    std::set<std::string> read; // parameters that decided what is done: counts, choices, clear values

    /// Every texture name that a step binds or clears, the caller's included.
    [[nodiscard]] std::set<std::string> targets() const;
    [[nodiscard]] std::set<const Pass*> passes() const;
};

/// `background` is what ScriptExternal leaves in the bound targets: this host has nothing below the effect.
[[nodiscard]] Result<Plan> planFrame(const Effect& effect, const std::string& technique, const Values& values,
                                     const std::array<float, 4>& background);

/// What a pass really uses, known after compiling it.
struct PassUse {
    std::set<std::string> sampled;   // texture parameters read by any stage, targets or not
    std::set<std::string> compared;  // of these those that some look-up compares with a depth
    std::set<std::string> stored;    // targets that a compute shader writes
    std::uint32_t writtenColors = 0; // bit n: the pixel shader writes SV_Targetn
    bool discards = false;           // some pixels may be left out
};

/// Completes the plan with what the shaders use:
///  * the depth target of a pass that tests neither depth nor stencil is dropped, and so are colour targets of another size or number of
///    samples that the pass does not write,
///  * TG4024 when a pass samples a target that it has bound, or that its compute shader writes; TG4025 when two of its targets differ in
///  size, TG4039 in samples a pixel. With `added`, for effects of other hosts: such a pass samples a copy of what was there before
///  (warning TG4024), a depth target may be larger than the colours, and where the caller's does not fit, the colour target gets a depth
///  target of its own,
///  * targets that the frame uses before clearing them are cleared first (0, depth 1), so that a frame never depends on the one before;
///    warning TG4026 when the first use is sampling. Not so where the first use overwrites every pixel: a full-screen pass with the
///    annotation `bool CoversTarget = true` that neither tests, blends, masks nor discards, or a compute pass with it,
///  * mip chains are made before they are sampled.
struct TargetShape {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t mips = 1;
    bool depth = false;
    std::uint32_t samples = 1;
    bool keeps = false; // annotation Keeps: what an earlier frame left may be sampled
};
/// Targets that no effect declares, and the one that each goes with.
struct AddedTargets {
    std::map<std::string, std::string> copies; // of what
    std::map<std::string, std::string> depths; // for which colour target
};
[[nodiscard]] Result<void> completePlan(Plan& plan, const std::map<const Pass*, PassUse>& uses,
                                        const std::map<std::string, TargetShape>& shapes, const std::array<float, 4>& background,
                                        std::vector<Diagnostic>& warnings, AddedTargets* added = nullptr);

/// What of a target a pass with this state can change.
[[nodiscard]] bool usesDepth(const PipelineState& state);

} // namespace tegument::run
