#pragma once
// Plain pictures for textures whose files are not there: what a foreign effect shows is then its own doing.

#include "host/image/image.h"

#include <string>
#include <vector>

namespace tegument::run {

/// "white", "grey", "normal" (flat: 0.5, 0.5, 1), "ramp" (black to white along u), "noise", and a checker for every other name. RGBA, 0
/// to 1.
[[nodiscard]] Image plainPicture(const std::string& name);

/// Six faces in Direct3D's order. "normals": each direction's unit vector, halved and raised by a half; for every other name a sky: blue
/// above, a bright horizon, dark ground.
[[nodiscard]] std::vector<Image> plainCube(const std::string& name);

} // namespace tegument::run
