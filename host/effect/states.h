#pragma once
// The names of render and sampler states, what their values mean, and how they change a state: one table for each place where states are
// written. docs/effect-files.md lists them.

#include "host/support/state.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// A named value of a state. Names are compared without case and underscores: Direct3D 9 and 10 differ in little else.
struct NamedValue {
    std::string_view name;
    double value;
};

/// Empty: the state takes numbers.
using Vocabulary = std::span<const NamedValue>;

/// A state being built up: some Direct3D 9 states only have an effect together, whatever their order.
struct States {
    PipelineState pipeline;
    bool separateAlpha = false;
    bool twoSidedStencil = false;
    bool independentBlend = false;
};

using Numbers = std::span<const double>;

/// `apply` null: the state does not exist in Vulkan, and only `onlyValue`, which means "off", is accepted.
template <class Target>
struct StateEntry {
    std::string_view name;
    Vocabulary vocabulary;
    void (*apply)(Target&, int index, Numbers value) = nullptr;
    std::optional<double> onlyValue = std::nullopt;
    std::string_view hint = {};
};

[[nodiscard]] std::span<const StateEntry<States>> direct3D9States();
[[nodiscard]] std::span<const StateEntry<States>> depthStencilStates();
[[nodiscard]] std::span<const StateEntry<States>> blendStates();
[[nodiscard]] std::span<const StateEntry<States>> rasterizerStates();
[[nodiscard]] std::span<const StateEntry<SamplerState>> samplerStateEntries();

[[nodiscard]] PipelineState direct3D9Defaults();
[[nodiscard]] PipelineState direct3D10Defaults();
[[nodiscard]] SamplerState direct3D9SamplerDefaults();
[[nodiscard]] SamplerState direct3D10SamplerDefaults();

/// After all states of a Direct3D 9 pass: without SeparateAlphaBlendEnable alpha blends like colour, and so on.
void finishDirect3D9(States& states);
/// After a Direct3D 11 blend state: without IndependentBlendEnable every target blends like the first.
void finishBlend(States& states);

/// Fixed-function states of Direct3D 9 (lighting, fog, texture stages, ...).
[[nodiscard]] bool isFixedFunction(std::string_view name);

/// Equal without case and underscores.
[[nodiscard]] bool sameStateName(std::string_view a, std::string_view b);

} // namespace tegument
