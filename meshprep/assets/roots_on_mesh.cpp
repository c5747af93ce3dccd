#include "meshprep/assets/roots_on_mesh.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/prepare/near_surface.h"

#include <algorithm>

namespace tegument::assets {

namespace {

/// Those that no ribbon is made of: their numbers in the mesh.
std::vector<std::uint32_t> skinTriangles(const Mesh& mesh) {
    std::vector<std::uint32_t> numbers;
    for (const MeshPart& part : mesh.parts)
        for (std::uint32_t i = 0; !isRibbons(part) && i < part.indexCount / 3; ++i)
            numbers.push_back(part.firstIndex / 3 + i);
    return numbers;
}

} // namespace

std::vector<std::uint32_t> rootsOnMesh(const Mesh& mesh, const Image& roots) {
    const auto header = rootHeader(roots);
    const std::vector<std::uint32_t> numbers = skinTriangles(mesh);
    if (!header || numbers.empty()) return {};
    const double size = 2 * std::max(1e-6, static_cast<double>(mesh.bounds.radius)); // the tree wants a unit cube
    const auto scaled = [&](const glm::vec3& p) { return (glm::dvec3(p) - glm::dvec3(mesh.bounds.centre)) / size + 0.5; };
    std::vector<glm::dvec3> points;
    for (const glm::vec3& position : mesh.positions)
        points.push_back(scaled(position));
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t number : numbers)
        corners.insert(corners.end(), &mesh.indices[3 * std::size_t{number}], &mesh.indices[3 * std::size_t{number}] + 3);
    const prep::NearSurface surface(points, corners);
    std::vector<std::uint32_t> onto(header->count);
    inChunks(onto.size(), 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            onto[i] = numbers[surface.nearest(scaled(rootAt(roots, i).position)).triangle];
    });
    return onto;
}

} // namespace tegument::assets
