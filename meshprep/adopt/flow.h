#pragma once
// What reaches a shader's outputs, found by running it on names instead of numbers: whether a matrix places its vertices, in what units
// they are, and on which side of a surface a light's direction is taken to lie.

#include "host/effect/model.h"
#include "meshprep/adopt/code.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace tegument::adopt {

struct PositionFlow {
    bool placed = false;   // a matrix among the parameters reaches the position, other than that of sprites
    bool pixels = false;   // the stream's position is divided by the size of the target
    bool farthest = false; // depth is w: the far plane
};

/// Of the parameters those that hold a size of the target, or its inverse.
using IsTargetSize = std::function<bool(const std::string& parameter)>;

/// Of a vertex shader; nullopt where its code cannot be followed.
[[nodiscard]] std::optional<PositionFlow> positionFlow(const Code& code, const ShaderReference& vertex, const IsTargetSize& isTargetSize);

/// For each parameter that meets another direction in a dot product which reaches a pixel: above zero where it is taken as it is, below
/// where it is turned round first. Members of structures are "light_dir", in arrays without their index. Adds to `signs`.
void addDirectionSigns(const Code& code, const Pass& pass, std::map<std::string, int>& signs);

/// The sign of a parameter among those; 0: the code does not tell.
[[nodiscard]] int directionSign(const std::map<std::string, int>& signs, const std::string& parameter);

} // namespace tegument::adopt
