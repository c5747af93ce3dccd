#pragma once
// Effects of other hosts on the command line: what was bound by which rule, the ball that they are shown on, and what their picture shows.

#include "host/adopt/adopt.h"
#include "host/image/image.h"
#include "host/mesh/mesh.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

/// --bind NAME=RULE. TG8011 no '='.
[[nodiscard]] Result<std::map<std::string, std::string>> bindRules(const std::vector<std::string>& given);

/// A ball of radius 1 with texture coordinates and tangents: foreign effects expect objects of about one unit.
[[nodiscard]] Mesh ball();

/// One line for each parameter: what it got, and why.
void printBindings(const std::vector<ParameterBinding>& bindings);

/// TG4070 a picture of one colour, which a user should not have to find out by looking; none otherwise.
[[nodiscard]] std::optional<Diagnostic> plainPictureNote(const Image& image, const std::string& effect);

} // namespace tegument::app
