#pragma once
// Effects of other hosts on the command line: what was bound by which rule, and what their picture shows.

#include "host/image/image.h"
#include "meshprep/adopt/adopt.h"

#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

/// One line for each parameter: what it got, and why.
void printBindings(const std::vector<ParameterBinding>& bindings);

/// TG4070 a picture of one colour, which a user should not have to find out by looking; none otherwise.
[[nodiscard]] std::optional<Diagnostic> plainPictureNote(const Image& image, const std::string& effect);

} // namespace tegument::app
