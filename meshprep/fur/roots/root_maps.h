#pragma once
// Pictures that shape fur: density, length, direction. On meshes with texture coordinates they lie as every texture does; on others a cube
// map (DDS) is looked up by the direction from the middle of the mesh's ball, which needs no coordinates and has no seam. Or values at the
// vertices.
// What shapes fur, given at the vertices of the mesh file itself: scans have neither texture coordinates nor maps, but can be painted.

#include "host/image/dds.h"
#include "meshprep/fur/roots/fur_surface.h"

#include <filesystem>

namespace tegument {

class FurMap {
public:
    /// DDS with six faces, or any picture.
    [[nodiscard]] static Result<FurMap> load(const std::filesystem::path& path);
    explicit FurMap(DdsTexture texture) : texture_(std::move(texture)) {}
    /// One value for each vertex of the mesh.
    explicit FurMap(std::vector<glm::dvec3> ofVertices) : ofVertices_(std::move(ofVertices)) {}

    /// A picture lies in texture coordinates; all others are the same in mesh space.
    [[nodiscard]] bool needsUvs() const { return ofVertices_.empty() && !texture_.isCube(); }
    /// Bilinear; repeats beyond the unit square, clamps at the edges of a cube's faces. Grey counts as red, green and blue.
    [[nodiscard]] glm::dvec3 at(const FurSurface& surface, const SurfacePoint& point) const;

private:
    DdsTexture texture_; // one mip
    std::vector<glm::dvec3> ofVertices_;
};

/// The length's or the density's map: red, held to 0..1.
[[nodiscard]] double shareAt(const FurMap& map, const FurSurface& surface, const SurfacePoint& point);

/// The direction's map, 0.5 is 0: in tangent space (x along the tangent, y along the bitangent), or, from a cube map or vertices, in mesh
/// space. Made perpendicular to the normal; at most 1 long.
[[nodiscard]] glm::dvec3 directionAt(const FurMap& map, const FurSurface& surface, const SurfacePoint& point);

/// One property of the vertices as a share, 0..1. `mesh` is what loadMesh made of the file. TG5313 where there is no such property, TG7108
/// for a value that is not finite or not within 0..1. Vertices at one place have the mean of their values.
[[nodiscard]] Result<FurMap> readVertexShares(const std::filesystem::path& path, const std::string& name, const Mesh& mesh);

/// Three properties, named with commas between, as a vector in mesh space. Whole numbers of 8 or 16 bits, as
/// colours are, hold it as maps do: the middle is 0; others are its coordinates. TG7108 for a value that is not finite.
[[nodiscard]] Result<FurMap> readVertexDirections(const std::filesystem::path& path, const std::string& names, const Mesh& mesh);

/// Three properties as a colour, 0..1: whole numbers are sRGB, as every scanner and painter writes them; others linear. TG7108 as above.
[[nodiscard]] Result<FurMap> readVertexColors(const std::filesystem::path& path, const std::string& names, const Mesh& mesh);

} // namespace tegument
