#pragma once
// Argument lists for a function: stratified, special, hostile.

#include "tests/hlsl/function_case.h"

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

} // namespace tegument::test
