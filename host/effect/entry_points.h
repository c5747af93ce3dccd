#pragma once
// The entry points of an effect: running, checking, writing out and the editor's server take them from here.

#include "host/effect/model.h"
#include "host/support/shader_stage.h"

#include <vector>

namespace tegument {

struct ShaderUse {
    ShaderStage stage = ShaderStage::Pixel;
    const ShaderReference* shader = nullptr;
    bool undrawn = false; // only passes with stages that this host does not run have it
};

/// Each shader once, by stage, name, arguments and source: in the order of passes, in a pass vertex, pixel, geometry and compute shader.
[[nodiscard]] std::vector<ShaderUse> entryPoints(const std::vector<const Pass*>& passes);
[[nodiscard]] std::vector<ShaderUse> entryPoints(const Effect& effect);

/// Geometry shaders, tessellation, stream output.
[[nodiscard]] bool needsOtherStages(const Pass& pass);

/// TG4002 a pass without vertex shader, TG4003 a stage or an argument that this host does not have; why a shader could not be respelt.
[[nodiscard]] Result<void> drawable(const Pass& pass);

/// TG3206: the vertex shader compiles, and places nothing.
[[nodiscard]] Error writesNoPosition(const std::string& entry, const SourcePosition& at);

} // namespace tegument
