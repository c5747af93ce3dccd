#pragma once
// A pass compiled and linked, and what it uses. Needs no GPU.

#include "host/effect/model.h"
#include "host/run/plan.h"
#include "host/spirv/compile.h"
#include "host/support/layout.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
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

/// TG4002 a pass without vertex shader, TG4003 a stage or an argument that this host does not have, TG4062 a texture that is written and
/// belongs to no target; and what compiler and linker say.
[[nodiscard]] Result<PassProgram> compilePass(const Effect& effect, const Pass& pass, Compiler compiler);

} // namespace tegument::run
