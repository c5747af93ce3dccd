#pragma once
// Inside host/mesh only: faces of more than three corners.

#include "host/mesh/mesh_file.h"

namespace tegument::meshfile {

/// Puts faces down as fans while a file is read, because their vertices may follow; `cut` then cuts those that a fan does not fill by
/// ears, into as many triangles, in the same place.
class Polygons {
public:
    /// Appends the fan of a face; nothing for fewer than three corners.
    void add(std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& indices);
    /// Call when every index is known to be in range. TG5307 for a polygon too large to cut.
    /// `exact`: the positions in double precision, or none.
    [[nodiscard]] std::optional<Error> cut(const Source& source, const std::vector<glm::vec3>& positions,
                                           const std::vector<glm::dvec3>& exact, std::vector<std::uint32_t>& indices);

private:
    struct Fan {
        std::size_t firstIndex = 0;
        std::size_t corners = 0;
    };
    std::vector<Fan> fans_;
};

} // namespace tegument::meshfile
