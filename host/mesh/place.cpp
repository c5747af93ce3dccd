// Coordinates of a survey: a body of ten metres, five thousand kilometres from where the coordinates count from. 32-bit floats have steps
// of half a metre there.

#include "host/mesh/extent.h"
#include "host/mesh/mesh_file.h"
#include "host/mesh/welding.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace tegument::meshfile {

namespace {

/// Farther from the origin than so many of its own sides a mesh is moved before it becomes floats: nearer, at most three bits are lost.
constexpr double kFar = 8;
/// Farther than this a file of floats has lost something that can be seen: steps of a ten-thousandth of the mesh.
constexpr double kLost = 1 / (1e4 * static_cast<double>(std::numeric_limits<float>::epsilon()));
/// What is nearer together than this share of the coordinates is the rounding of doubles, and meant to be one.
constexpr double kRoundingOfDoubles = 1e-12;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        if (!isFinite(glm::vec3(p))) return;
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    [[nodiscard]] glm::dvec3 centre() const { return (low + high) / 2.0; }
    [[nodiscard]] double side() const {
        const glm::dvec3 size = high - low;
        return std::max({size.x, size.y, size.z});
    }
    [[nodiscard]] double reach() const {
        const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
        return std::max({far.x, far.y, far.z});
    }
};

Box boxOf(const ReadMesh& file) {
    Box box;
    for (const std::uint32_t index : file.mesh.indices)
        box.add(file.exact.empty() ? glm::dvec3(file.mesh.positions[index]) : file.exactFrom + file.exact[index]);
    return box;
}

/// Whole millimetres, so that the numbers are short; not of a mesh that is itself no larger.
glm::dvec3 shortNumbers(const Box& box) {
    return box.side() > 100 ? glm::round(box.centre()) : box.centre();
}

/// Vertices that are apart in the file and one as floats.
std::size_t merged(const ReadMesh& file, double reach) {
    const std::vector<std::uint32_t> first = weldPositions(file.mesh.positions);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        const glm::dvec3 apart = glm::abs(file.exact[i] - file.exact[first[i]]);
        count += std::max({apart.x, apart.y, apart.z}) > kRoundingOfDoubles * reach;
    }
    return count;
}

} // namespace

Bounds sizeOf(const ReadMesh& file) {
    const Box box = boxOf(file);
    return {.maximum = file.mesh.indices.empty() ? glm::vec3(0) : glm::vec3(box.high - box.low)};
}

void changeUnit(ReadMesh& file, double unitMm) {
    for (std::size_t i = 0; i < file.mesh.positions.size(); ++i)
        file.mesh.positions[i] = scaled(file.exact.empty() ? glm::dvec3(file.mesh.positions[i]) : file.exact[i], unitMm);
    for (glm::dvec3& position : file.exact)
        position *= unitMm;
    file.exactFrom *= unitMm;
}

void settlePlace(const std::filesystem::path& path, ReadMesh& file) {
    Mesh& mesh = file.mesh;
    const bool exact = !file.exact.empty();
    const Box box = boxOf(file);
    const SourcePosition at{.file = path.string()};
    if (!exact && file.floats && box.side() > 0 && box.reach() > kLost * box.side())
        warn(mesh, 5329, at,
             fmt::format("the file's coordinates reach {} mm in 32-bit floats, whose steps there are {} mm, of a mesh {} mm long",
                         lengthText(box.reach()), lengthText(box.reach() * static_cast<double>(std::numeric_limits<float>::epsilon())),
                         lengthText(box.side())),
             "what was finer was lost when the file was written: export it in double precision, or nearer to the origin");
    if (!exact) return;
    if (box.side() > 0 && box.reach() > kFar * box.side()) {
        const bool near = glm::distance(file.exactFrom, box.centre()) <= 2 * box.side();
        mesh.origin = near && file.exactFrom != glm::dvec3(0) ? file.exactFrom : shortNumbers(box);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.positions[i] = glm::vec3(file.exact[i] + (file.exactFrom - mesh.origin));
    }
    if (const std::size_t count = merged(file, box.reach()); count > 0)
        warn(mesh, 5329, at,
             fmt::format("{} vertices lie nearer to another than 32-bit floats tell apart in a mesh {} mm long: they become one place",
                         count, lengthText(box.side())),
             "cut the mesh into smaller ones");
    file.exact = {};
}

} // namespace tegument::meshfile
