#pragma once
// GLSL, held against the language by glslang.

#include "host/spirv/compile.h"

#include <string>

namespace tegument {

/// Why the text is no valid GLSL (of the version that it names); empty when it is.
[[nodiscard]] std::string checkGlsl(ShaderStage stage, const std::string& text);
/// Why the two do not make one program; empty when they do.
[[nodiscard]] std::string checkGlslProgram(const std::string& vertex, const std::string& pixel);

} // namespace tegument
