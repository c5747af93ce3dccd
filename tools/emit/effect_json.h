#pragma once
// What an effect file says, as JSON: shared by `tegument info --json` and the manifest.

#include "host/effect/model.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tegument {

/// Keys stay in the order in which they were added.
using Json = nlohmann::ordered_json;

/// "float4", "float4[6]".
[[nodiscard]] std::string typeName(const Type& type);
/// A number, a boolean, a string, or a list of numbers in row order.
[[nodiscard]] Json toJson(const Value& value, const Type& type);
[[nodiscard]] Json toJson(const Annotations& annotations);
/// {name, type, semantic, default, annotations}; default null where there is none.
[[nodiscard]] Json toJson(const Parameter& parameter);

/// Only what a pass has set up: depth, stencil (when on), rasterisation, one entry for each distinct colour target.
[[nodiscard]] Json toJson(const PipelineState& state);
[[nodiscard]] Json toJson(const SamplerState& state);

} // namespace tegument
