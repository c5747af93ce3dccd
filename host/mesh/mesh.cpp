// loadMesh: what holds for every format once the file is read.

#include "host/mesh/mesh.h"

#include "host/mesh/extent.h"
#include "host/mesh/facing.h"
#include "host/mesh/mesh_file.h"
#include "host/mesh/normals.h"
#include "host/mesh/triangles.h"
#include "host/mesh/welding.h"
#include "host/support/disjoint_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace tegument {

namespace {

using meshfile::Source;

/// Triangles that repeat a corner have no area and no normal.
void dropDegenerate(Mesh& mesh, const Source& source) {
    const std::size_t dropped =
        keepTriangles(mesh, [](std::span<const std::uint32_t, 3> t, std::size_t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; });
    if (dropped > 0) meshfile::warn(mesh, 5322, source.whole(), fmt::format("{} triangles that repeat a vertex are left out", dropped));
}

/// Rounding alone leaves a float unit vector within this of length 1, so such vectors are kept bit for bit.
constexpr double kUnitTolerance = 1e-6;

/// Makes the file's normals unit; false when one is not usable.
bool normalise(std::vector<glm::vec3>& vectors) {
    for (glm::vec3& vector : vectors) {
        const glm::dvec3 exact(vector);
        const double length = glm::length(exact);
        if (!std::isfinite(length) || !(length > 0)) return false;
        if (std::abs(length - 1) > kUnitTolerance) vector = glm::vec3(exact / length);
    }
    return true;
}

bool usableTangents(const Mesh& mesh) {
    return std::ranges::all_of(mesh.tangents, [](const glm::vec4& tangent) {
        const double length = glm::length(glm::dvec3(tangent));
        return std::abs(length - 1) < 1e-3 && (tangent.w == 1 || tangent.w == -1);
    });
}

void finishFrames(Mesh& mesh, const Source& source) {
    if (!mesh.normals.empty() && !normalise(mesh.normals)) {
        meshfile::warn(mesh, 5324, source.whole(), "some normals of the file have no length: all are made anew");
        mesh.normals.clear();
        mesh.tangents.clear();
    }
    computeNormals(mesh);
    if (mesh.uvs.empty() || !usableTangents(mesh)) mesh.tangents.clear();
    if (mesh.tangents.empty() && !mesh.uvs.empty()) computeTangents(mesh);
}

/// A chart that lies in one other tile of a texture that repeats lies there in the unit square: light is kept for that alone. A chart of
/// several tiles stays.
void shiftTiles(Mesh& mesh) {
    constexpr float kBeside = 1e-4F; // of rounding
    const auto inSquare = [](const glm::vec2& uv) { return uv.x >= 0 && uv.y >= 0 && uv.x <= 1 && uv.y <= 1; };
    if (std::ranges::all_of(mesh.uvs, inSquare)) return;
    DisjointSets charts(mesh.uvs.size());
    for (const MeshPart& part : mesh.parts)
        for (std::size_t i = part.firstIndex; i < std::size_t{part.firstIndex} + part.indexCount && !part.expanded; i += 3)
            for (const std::size_t next : {1U, 2U})
                charts.join(mesh.indices[i], mesh.indices[i + next]);
    std::vector<glm::vec2> low(mesh.uvs.size(), glm::vec2(INFINITY)), high(mesh.uvs.size(), glm::vec2(-INFINITY));
    for (std::uint32_t v = 0; v < mesh.uvs.size(); ++v) {
        const std::uint32_t chart = charts.find(v);
        low[chart] = glm::min(low[chart], mesh.uvs[v]);
        high[chart] = glm::max(high[chart], mesh.uvs[v]);
    }
    for (std::uint32_t v = 0; v < mesh.uvs.size(); ++v) {
        const std::uint32_t chart = charts.find(v);
        const glm::vec2 tile = glm::floor(low[chart] + kBeside);
        const glm::vec2 end = tile + 1.0F + kBeside;
        if (tile != glm::vec2(0) && high[chart].x <= end.x && high[chart].y <= end.y && (low[chart] != high[chart])) mesh.uvs[v] -= tile;
    }
}

std::optional<Error> checkUvs(Mesh& mesh, const Source& source, const MeshOptions& options) {
    if (mesh.uvs.empty()) {
        if (!options.requireUvs) return std::nullopt;
        return inputError(5308, source.whole(), "the mesh has no texture coordinates",
                          "unwrap it before export: skin is lit in texture space");
    }
    shiftTiles(mesh);
    const UvReport report = examineUvs(mesh);
    if (report.overlapping > options.overlapWarning)
        meshfile::warn(
            mesh, 5320, source.whole(), fmt::format("{:.1f} % of the UV area is used by more than one triangle", 100 * report.overlapping),
            "light that is gathered in texture space will mix there; tegument prep MESH --unwrap -o NEW.glb makes charts without overlap");
    if (report.outside > options.overlapWarning)
        meshfile::warn(mesh, 5321, source.whole(),
                       fmt::format("{:.1f} % of the UV area lies outside the unit square", 100 * report.outside),
                       "it is not lit in texture space: move the charts into the square, or tegument prep MESH --unwrap -o NEW.glb");
    return std::nullopt;
}

void warnOfFacing(Mesh& mesh, const Source& source) {
    if (std::ranges::any_of(mesh.parts, &MeshPart::expanded)) return;
    if (auto fault = facingFault(examineFacing(mesh, weldPositions(mesh.positions)), source.name())) mesh.warnings.push_back(*fault);
}

constexpr double kLeastHead = 150; // mm: a small child's head without neck
constexpr double kMostHead = 700;  // mm: a bust to below the chest

/// The unit that makes a height of `height` units a head: a common one if it fits, else what makes it 280 mm, head and neck.
double unitOfHead(double height) {
    for (const double unit : {1.0, 10.0, 100.0, 1000.0})
        if (height * unit >= kLeastHead && height * unit <= kMostHead) return unit;
    const double exact = 280 / height;
    const double step = std::pow(10, std::floor(std::log10(exact)) - 1); // two digits
    return std::round(exact / step) * step;
}

/// `scale`: of the mesh's height where it stands.
std::optional<Error> checkHead(const Mesh& mesh, const Source& source, double scale) {
    const double height = scale * (static_cast<double>(mesh.bounds.maximum.y) - static_cast<double>(mesh.bounds.minimum.y));
    if (height >= kLeastHead && height <= kMostHead) return std::nullopt;
    const std::string suggestion = height > 0 ? fmt::format(": try {:g}", unitOfHead(height / source.unitMm)) : "";
    return inputError(
        5309, source.whole(),
        fmt::format("the head is {:.4g} mm high with {:g} mm per unit{}; {:g} to {:g} mm is plausible", height, source.unitMm,
                    scale == 1 ? "" : fmt::format(", scaled by {:g}", scale), kLeastHead, kMostHead),
        fmt::format("say what one unit of the file is, with --unit-mm X or \"unit_mm\" in the workspace{}; where it is no head: "
                    "--no-head or \"head\": false",
                    suggestion));
}

/// The file's tangents were made for the other direction, so they go.
void flipV(Mesh& mesh) {
    for (glm::vec2& uv : mesh.uvs)
        uv.y = 1 - uv.y;
    mesh.tangents.clear();
}

double greatestSide(const Bounds& bounds) {
    const glm::dvec3 size = glm::dvec3(bounds.maximum) - glm::dvec3(bounds.minimum);
    return std::max({size.x, size.y, size.z});
}

Result<Mesh> load(const std::filesystem::path& path, const MeshOptions& options) {
    Result<ReadMesh> file = readMesh(
        path, {.unitMm = options.unitMm, .guessUnit = options.guessUnit, .ownCoordinates = options.ownCoordinates, .roots = options.roots});
    if (!file) return file.error();
    Mesh mesh = std::move(file->mesh);
    const Source source{.path = path, .unitMm = mesh.unitMm};
    if (file->counts.smallFaces > 0)
        meshfile::warn(mesh, 5322, source.whole(),
                       fmt::format("{} faces of fewer than three corners are left out", file->counts.smallFaces));
    if (options.flipV) flipV(mesh);
    dropDegenerate(mesh, source);
    if (mesh.indices.empty()) return meshfile::noTriangles(source.whole());
    markExpandedParts(mesh);
    keepReferenced(mesh); // so that a stray point cannot stretch the bounds
    computeBounds(mesh);
    if (options.expectHead)
        if (auto error = checkHead(mesh, source, std::abs(static_cast<double>(options.scale.y)))) return *error;
    if (!hasArea(mesh))
        return inputError(5306, source.whole(), "no triangle of the mesh has an area", "look at the mesh: tegument prep MESH --dry-run");
    if (auto error = checkUvs(mesh, source, options)) return *error;
    warnOfFacing(mesh, source);
    finishFrames(mesh, source);
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
    return mesh;
}

} // namespace

void markExpandedParts(Mesh& mesh) {
    if (mesh.uvs.empty()) return; // a shader would have nothing to tell the vertices apart by
    const auto at = [&](std::size_t i) { return mesh.positions[mesh.indices[i]]; };
    for (MeshPart& part : mesh.parts) {
        const std::size_t end = std::size_t{part.firstIndex} + part.indexCount;
        part.expanded = part.indexCount > 0;
        for (std::size_t i = part.firstIndex; part.expanded && i < end; i += 3)
            part.expanded = at(i) == at(i + 1) && at(i) == at(i + 2);
    }
}

namespace {

/// A mesh without a unit: an exporter has made its longest side 1 or 2; or it has a head's proportions, which metres would make larger
/// than any head. A person who stands is less than half as deep as high.
bool isNormalised(const Bounds& bounds, double unitMm) {
    constexpr double kExact = 1e-4;
    constexpr double kCompact = 0.5;
    const glm::dvec3 size = (glm::dvec3(bounds.maximum) - glm::dvec3(bounds.minimum)) / unitMm;
    const double longest = std::max({size.x, size.y, size.z});
    const double shortest = std::min({size.x, size.y, size.z});
    if (!(shortest > 0)) return false; // a panel of side 1 is a panel
    if (std::abs(longest - 1) < kExact || std::abs(longest - 2) < kExact) return true;
    return longest * 1000 > kMostHead && longest <= 3 && shortest >= kCompact * longest;
}

} // namespace

std::optional<double> likelyUnit(const Bounds& bounds, double unitMm) {
    constexpr double kLeast = 10; // mm: a bead
    constexpr double kMost = 20'000;
    const double side = greatestSide(bounds);
    if (!(side > 0) || (side >= kLeast && side <= kMost)) return std::nullopt;
    const double inFile = side / unitMm;
    if (isNormalised(bounds, unitMm)) return unitOfHead(inFile);
    if (inFile >= 0.1 && inFile <= 3) return 1000; // metres: what people scan, people among them
    if (inFile > 3 && inFile < kLeast) return 10;  // centimetres
    return unitOfHead(inFile);                     // nobody's unit: as large as a head
}

Diagnostic guessedUnit(const std::filesystem::path& path, const Bounds& bounds, double unitMm, double likely) {
    const double side = greatestSide(bounds);
    return inputWarning(5327, {.file = path.string()},
                        fmt::format("with {:g} mm per unit the mesh would be {} mm long: {:g} mm per unit are taken, {} mm", unitMm,
                                    lengthText(side), likely, lengthText(side / unitMm * likely)),
                        "effects have true sizes: say what one unit of the file is with --unit-mm X");
}

Result<Mesh> loadMesh(const std::filesystem::path& path, const MeshOptions& options) {
    try {
        return load(path, options);
    } catch (const std::bad_alloc&) {
        return meshfile::outOfMemory(path);
    }
}

} // namespace tegument
