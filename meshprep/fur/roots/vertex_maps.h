#pragma once
// What shapes fur, given at the vertices of the mesh file itself: scans have neither texture coordinates nor maps, but can be painted.

#include "meshprep/fur/roots/root_maps.h"

namespace tegument {

/// One property of the vertices as a share, 0..1. `mesh` is what loadMesh made of the file. TG5313 where there is no such property, TG7108
/// for a value that is not finite or not within 0..1. Vertices at one place have the mean of their values.
[[nodiscard]] Result<FurMap> readVertexShares(const std::filesystem::path& path, const std::string& name, const Mesh& mesh);

/// Three properties, named with commas between, as a vector in mesh space. Whole numbers of 8 or 16 bits, as
/// colours are, hold it as maps do: the middle is 0; others are its coordinates. TG7108 for a value that is not finite.
[[nodiscard]] Result<FurMap> readVertexDirections(const std::filesystem::path& path, const std::string& names, const Mesh& mesh);

/// Three properties as a colour, 0..1: whole numbers are sRGB, as every scanner and painter writes them; others linear. TG7108 as above.
[[nodiscard]] Result<FurMap> readVertexColors(const std::filesystem::path& path, const std::string& names, const Mesh& mesh);

} // namespace tegument
