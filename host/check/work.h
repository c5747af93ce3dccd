#pragma once
// One file in one variant on its way through the check.

#include "host/check/check.h"
#include "host/effect/model.h"

namespace tegument::check {

enum class ShaderKind { Vertex, Pixel, Geometry, Compute };

struct EntryPoint {
    std::string name;
    ShaderKind kind = ShaderKind::Pixel;
    std::string profile; // as the effect writes it
    SourcePosition at;
};

/// Indices into Work::entries of the two stages of a pass.
struct StagePair {
    std::size_t vertex = 0;
    std::size_t pixel = 0;
};

struct Work {
    std::filesystem::path file;
    const Variant* variant = nullptr;
    Effect effect;
    /// The file distinguishes the targets by FX_D3D10, as hlsl/platform.fxh does: its techniques exist on all of them.
    bool dialect = false;
    std::vector<EntryPoint> entries; // each once
    std::vector<StagePair> pairs;    // each once
    FileReport report;

    [[nodiscard]] bool loaded() const;
    [[nodiscard]] TargetCheck* find(Target target);
};

[[nodiscard]] Work load(const std::filesystem::path& file, const Variant& variant, const std::vector<Target>& targets,
                        const CheckOptions& options);

void checkSpirv(Work& work);
void checkMicrosoft(std::vector<Work>& works);

/// Sets the verdict by what the diagnostics hold, and drops repetitions among them.
void conclude(TargetCheck& report);

} // namespace tegument::check
