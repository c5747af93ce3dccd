#pragma once
// SPIR-V to other engines' languages, by SPIRV-Cross.

#include "tools/check/check.h"

#include <map>
#include <string>
#include <vector>

namespace tegument {

/// A texture and a sampler that GLSL joins into one uniform.
struct CombinedSampler {
    std::string name;
    std::string texture;
    std::string sampler;
};

struct CrossShader {
    std::string text;
    std::string entry;                     // "main" in GLSL
    std::string globals;                   // uniform block that holds the parameters; empty when none is read
    std::vector<CombinedSampler> samplers; // GLSL
    std::map<std::string, std::uint32_t> buffers, textures, samplerSlots; // MSL indices
};

/// The vertex shader's varyings by location, so that a pixel shader declares the same ones: GLSL and MSL join stages by name and type.
using Varyings = std::map<std::uint32_t, StageVariable>;
[[nodiscard]] Varyings varyingsOf(const Shader& vertex);

/// Glsl: desktop 330; GlslEs: 300 es (WebGL 2); Msl: Metal 2.0. `written` are the varyings that the vertex shader of the same pass writes.
/// TG3302 when SPIRV-Cross refuses.
[[nodiscard]] Result<CrossShader> crossCompile(const Shader& shader, Target language, const Varyings& written);

} // namespace tegument
