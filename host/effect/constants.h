#pragma once
// Values that are known when a file is read, and what HLSL's operators and intrinsics make of them.

#include "host/effect/model.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tegument {

/// A constant while it is computed: `integral` decides how '/' divides. Of an array or a matrix, how `[i]` cuts it.
struct Constant {
    std::vector<double> numbers;
    bool integral = false;
    int elements = 0; // 0: no array
    int rows = 1;
    std::shared_ptr<const std::vector<TypeMember>> members = nullptr; // of a structure: their numbers one behind the other
};

/// A value of this type; its numbers are as many as the type holds.
[[nodiscard]] Constant constantOf(const Type& type, std::vector<double> numbers);

/// An operator of one or two signs, such as "<=" or "+". Componentwise; a scalar meets every component of the other side, two vectors are
/// cut to the shorter one as HLSL does. Nullopt where the result is no finite number.
[[nodiscard]] std::optional<Constant> applyOperator(std::string_view op, const Constant& a, const Constant& b);

/// An intrinsic on constants: nullopt when there is none of that name and number of arguments, or it has no finite result.
[[nodiscard]] std::optional<Constant> applyIntrinsic(std::string_view name, std::span<const Constant> arguments);
[[nodiscard]] bool isConstantIntrinsic(std::string_view name);

/// `value[index]`; outside nullopt, or the nearest one.
[[nodiscard]] std::optional<Constant> elementOf(const Constant& value, double index, bool clamped);
/// `value.member` of a structure, `value.xyz` of a vector; nullopt when it has no such part.
[[nodiscard]] std::optional<Constant> partOf(const Constant& value, std::string_view name);
} // namespace tegument
