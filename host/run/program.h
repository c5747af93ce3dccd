#pragma once
// A pass compiled and linked, and what it uses. Needs no GPU.

#include "host/effect/model.h"
#include "host/run/plan.h"
#include "host/spirv/compile.h"
#include "host/support/layout.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument::run {

struct PassProgram {
    Shader vertex;
    std::optional<Shader> pixel;   // none: depth only
    std::optional<Shader> compute; // then there is nothing else
    std::vector<VertexAttribute> attributes;
    std::vector<Binding> bindings; // of both stages
    std::set<std::string> numbers; // parameters that either stage reads
    std::set<std::string> samplers;
    PassUse use;
};

/// Compiled once, used by every frame and object.
using Programs = std::map<const Pass*, std::shared_ptr<const PassProgram>>;

/// $Globals and every cbuffer.
[[nodiscard]] std::vector<const UniformBlock*> blocksOf(const Reflection& reflection);

/// A shader by what it is compiled from: `code` is its own, or empty, then it is the effect's.
struct StageKey {
    ShaderStage stage;
    std::string_view entry;
    std::string_view code;
    auto operator<=>(const StageKey&) const = default;
};

/// Compiled ahead.
using Stages = std::map<StageKey, Result<Shader>>;

/// What these passes need, each once, up to the first pass that is refused unseen.
[[nodiscard]] std::vector<StageKey> stagesOf(const std::vector<const Pass*>& passes);
[[nodiscard]] Result<Shader> compileStage(const Effect& effect, const StageKey& key, Compiler compiler);
/// How many are compiled at once.
[[nodiscard]] unsigned threadsToCompile();
/// On several processors; hears of each that is done.
[[nodiscard]] Stages compileStages(const Effect& effect, std::span<const StageKey> keys, Compiler compiler,
                                   const std::function<void()>& done = {});

/// What drawable() says, TG4062 a texture that is written and
/// belongs to no target; and what compiler and linker say. Compiles what is not among `stages`.
[[nodiscard]] Result<PassProgram> compilePass(const Effect& effect, const Pass& pass, Compiler compiler, const Stages& stages = {});

} // namespace tegument::run
