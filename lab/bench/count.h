#pragma once
// Shaders that count what they do while they run: how often they are called, and how often they read and write each texture.

#include "host/spirv/compile.h"

#include <cstdint>
#include <tuple>
#include <vector>

namespace tegument::bench {

enum class Access { Call, Read, Write };

/// What one number of the buffer counts.
struct AccessCounter {
    Access access = Access::Call; // Call: the texture's place means nothing
    std::uint32_t set = 0;        // of the texture
    std::uint32_t binding = 0;
    bool operator==(const AccessCounter&) const = default;
    bool operator<(const AccessCounter& other) const {
        return std::tie(access, set, binding) < std::tie(other.access, other.set, other.binding);
    }
};

struct CountedShader {
    Shader shader;                       // the same, with a storage buffer of 32-bit numbers at set and binding
    std::uint32_t set = 0;               // a descriptor set of the shader's own stage
    std::uint32_t binding = 0;           // behind all others
    std::vector<AccessCounter> counters; // in the buffer's order; calls first
};

/// The place of a texture that a function takes as an argument: which one it is cannot be told. The optimisers of both compilers leave none
/// to the shaders of this project.
inline constexpr std::uint32_t kUnknownPlace = UINT32_MAX;

/// Of a pixel or compute shader. A look-up counts once, however many texels its filter takes; calls that only serve derivatives do not
/// count. Depth is tested before the shader runs, where it neither discards pixels nor writes depth, as it would be without counting.
[[nodiscard]] CountedShader countAccesses(const Shader& shader);

} // namespace tegument::bench
