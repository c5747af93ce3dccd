#pragma once
// Runs a function of hlsl/ on every argument list in one draw.

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "tests/hlsl/samples.h"

#include <array>
#include <vector>

namespace tegument::test {

/// The target holds this before the draw. No function returns it.
inline constexpr float kPoison = -7.25e33F;

struct Evaluated {
    std::vector<std::array<float, 4>> results; // one per argument list
    std::size_t unwritten = 0;                 // results that still held the poison
    std::size_t overwritten = 0;               // pixels behind the last list that no longer do
};

[[nodiscard]] Result<Evaluated> evaluate(gpu::Device& device, const FunctionCase& function, int setting, const Samples& samples,
                                         Compiler compiler);

} // namespace tegument::test
