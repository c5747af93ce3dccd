#include "host/run/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument::run {

namespace {

using Groups = std::array<std::uint32_t, 3>;

constexpr double kMost = 65535; // what every device and Direct3D 11 allow along an axis

Error impossible(const Pass& pass, const std::string& what) {
    return inputError(4063, pass.at, fmt::format("pass {} {}", pass.name, what), "whole numbers from 0 to 65535");
}

Result<Groups> fromNumbers(const Pass& pass, const std::vector<double>& numbers) {
    Groups groups{1, 1, 1};
    for (std::size_t i = 0; i < std::min(numbers.size(), groups.size()); ++i) {
        if (!(numbers[i] >= 0 && numbers[i] <= kMost) || numbers[i] != std::floor(numbers[i]))
            return impossible(pass, fmt::format("would run {} groups of threads", numbers[i]));
        groups[i] = static_cast<std::uint32_t>(numbers[i]);
    }
    return std::ranges::find(groups, 0U) == groups.end() ? groups : Groups{};
}

Groups forTexels(const TargetDesc& target, const Shader& shader) {
    const auto along = [&](std::uint32_t texels, std::size_t axis) {
        const std::uint32_t threads = std::max(1U, shader.reflection.localSize[axis]);
        return (texels + threads - 1) / threads;
    };
    return {along(target.extent.width, 0), along(target.extent.height, 1), 1};
}

} // namespace

Result<Groups> groupsOf(const Effect& effect, const Prepared& prepared, const Pass& pass) {
    if (const auto numbers = pass.annotations.numbers("Groups")) return fromNumbers(pass, *numbers);
    if (const auto name = pass.annotations.string("GroupCount")) {
        const Parameter* parameter = effect.findParameter(*name);
        assert(parameter); // host/effect has checked the annotation
        const auto value = prepared.values.require(*parameter);
        return value ? fromNumbers(pass, *value) : Result<Groups>(value.error());
    }
    const auto threads = prepared.targets.find(pass.annotations.string("Threads").value_or(""));
    if (threads != prepared.targets.end()) return forTexels(threads->second, *prepared.programs.at(&pass)->compute);
    return inputError(4063, pass.at, fmt::format("pass {} does not say how many groups of threads run", pass.name),
                      "give it the annotation Groups, GroupCount, or Threads with a target that the pass reads or writes");
}

} // namespace tegument::run
