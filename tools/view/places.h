#pragma once
// Where panels and controls stand, for who drives the window from outside: written as JSON to the file that TEGUMENT_VIEW_PLACES names.

#include "tools/view/layout.h"

#include <string>

namespace tegument::view {

/// Nothing where no file is named.
void notePlace(const std::string& name, const Area& area);
/// What was noted since the last time, if it is other than before.
void writePlaces();

} // namespace tegument::view
