#pragma once
// Runs a function of hlsl/ on every argument list in one draw.
// Argument lists for a function: stratified, special, hostile.

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "tests/hlsl/function_case.h"

#include <array>
#include <vector>

namespace tegument::test {

struct Samples {
    int components = 0;        // of one argument list
    std::vector<float> values; // list after list
    std::size_t finite = 0;    // lists before this one hold finite numbers, the rest NaN or infinities

    [[nodiscard]] std::size_t count() const { return components == 0 ? 0 : values.size() / static_cast<std::size_t>(components); }
    [[nodiscard]] std::span<const float> list(std::size_t index) const {
        return std::span(values).subspan(index * static_cast<std::size_t>(components), static_cast<std::size_t>(components));
    }
};

/// `samples` lists stratified in every dimension (a Latin hypercube from a fixed seed), each special value of each argument among others
/// drawn likewise, and NaN and both infinities in each component.
[[nodiscard]] Samples makeSamples(const FunctionCase& function);

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
