#pragma once
// Numbers that a mesh file gives its vertices under names of its own: a scan's quality, its colours, what somebody has painted.

#include "host/support/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tegument {

struct VertexValues {
    std::vector<glm::vec3> positions;        // mm, exactly as loadMesh gives them; all of the file's vertices, in its order
    std::vector<std::vector<double>> values; // one row of them for each name
    std::vector<bool> whole;                 // for each name: stored in 8 or 16 bits, the greatest of which are 1 here
};

/// From PLY and glb, the formats read here that name their values. TG5313 for another format, and for a name that the vertices do not have:
/// the message lists those they have. Values are not checked.
[[nodiscard]] Result<VertexValues> readVertexValues(const std::filesystem::path& path, std::span<const std::string> names, double unitMm);

} // namespace tegument
