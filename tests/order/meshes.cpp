#include "tests/order/meshes.h"

#include "host/mesh/read_mesh.h"
#include "meshprep/prepare/clean.h"
#include "meshprep/prepare/points.h"
#include "meshprep/prepare/shapes.h"
#include "meshprep/prepare/vertices.h"
#include "tests/meshprep/scan_files.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <random>
#include <unistd.h>

namespace tegument::testing_order {

namespace fs = std::filesystem;

namespace {

std::optional<Mesh> generated(const std::string& what) {
    const std::size_t colon = what.find(':');
    int detail = 0;
    if (colon != std::string::npos) std::from_chars(what.data() + colon + 1, what.data() + what.size(), detail);
    if (what.substr(0, colon) == "sphere") return prep::makeShape(prep::Shape::Sphere, detail);
    if (what.substr(0, colon) == "terrain") return prep::makeShape(prep::Shape::Terrain, detail);
    return std::nullopt;
}

/// The triangles between places, in the order of the file.
Triangles weld(Mesh mesh, const std::string& name) {
    prep::Surface surface{.mesh = std::move(mesh)};
    prep::findPlaces(surface, {});
    prep::dropCollapsed(surface);
    for (std::uint32_t& index : surface.mesh.indices)
        index = surface.point[index];
    Triangles out{.name = name};
    std::vector<std::uint32_t> number(surface.pointCount, ~0u);
    std::vector<glm::vec3> places(surface.pointCount);
    for (std::size_t v = 0; v < surface.point.size(); ++v)
        places[surface.point[v]] = surface.mesh.positions[v];
    for (const std::uint32_t point : surface.mesh.indices) {
        if (number[point] == ~0u) {
            number[point] = static_cast<std::uint32_t>(out.positions.size());
            out.positions.push_back(places[point]);
        }
        out.indices.push_back(number[point]);
    }
    return out;
}

struct TemporaryFolder {
    fs::path path = fs::temp_directory_path() / ("tegument-order-" + std::to_string(::getpid()));
    TemporaryFolder() { fs::create_directories(path); }
    ~TemporaryFolder() { fs::remove_all(path); }
};

} // namespace

Result<Triangles> loadTriangles(const std::string& what) {
    if (auto mesh = generated(what)) return weld(std::move(*mesh), what);
    const TemporaryFolder folder;
    const fs::path scan = fs::exists(what) ? fs::path(what) : testing_prep::findScan(what, folder.path);
    auto read = readMesh(scan.empty() ? fs::path(what) : scan);
    if (!read) return read.error();
    return weld(std::move(read->mesh), fs::path(what).stem().string());
}

Triangles shuffled(const Triangles& mesh, std::uint32_t seed) {
    if (seed == 0) return mesh;
    std::mt19937 random(seed);
    std::vector<std::uint32_t> vertexTo(mesh.positions.size());
    std::vector<std::uint32_t> faceFrom(mesh.faces());
    std::iota(vertexTo.begin(), vertexTo.end(), 0u);
    std::iota(faceFrom.begin(), faceFrom.end(), 0u);
    std::ranges::shuffle(vertexTo, random);
    std::ranges::shuffle(faceFrom, random);
    Triangles out{.name = mesh.name, .positions = std::vector<glm::vec3>(mesh.positions.size())};
    for (std::size_t v = 0; v < vertexTo.size(); ++v)
        out.positions[vertexTo[v]] = mesh.positions[v];
    for (const std::uint32_t f : faceFrom) {
        const std::uint32_t turn = static_cast<std::uint32_t>(random() % 3);
        for (std::uint32_t c = 0; c < 3; ++c)
            out.indices.push_back(vertexTo[mesh.indices[3 * std::size_t{f} + (c + turn) % 3]]);
    }
    return out;
}

} // namespace tegument::testing_order
