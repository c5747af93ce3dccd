#pragma once
// Pictures side by side: of `tegument sheet` and of a survey.

#include "host/image/image.h"

#include <vector>

namespace tegument::app {

/// Row by row on white, without labels, as large as the first; at least one picture.
[[nodiscard]] Image contactSheet(const std::vector<Image>& images, int columns, int gap);

} // namespace tegument::app
