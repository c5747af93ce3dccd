// mesh_table [--files-only] [--no-levels] [--gltfpack FOLDER] FILE...: a line for each mesh: how often the vertex shader runs after `best`,
// after meshoptimizer's best order and after gltfpack; the times; the errors of levels. Below the table: where ours loses. Generated meshes
// come first. tests/tools/mesh_table.py calls it with all the meshes of docs/design/mesh-table.md.
#include "host/support/parallel.h"
#include "meshprep/prepare/distance.h"
#include "meshprep/prepare/prepare.h"
#include "meshprep/prepare/shapes.h"
#include "tests/meshprep/table/gltfpack.h"
#include "tests/meshprep/table/peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <thread>

using namespace tegument;
using namespace tegument::prep;
using testing_prep::Indices;

namespace {

const std::vector<std::pair<std::string, order::CacheModel>> kModels = {{"fifo:16", order::fifo(16)},
                                                                        {"fifo:24", order::fifo(24)},
                                                                        {"fifo:32", order::fifo(32)},
                                                                        {"lru:16", order::lru(16)},
                                                                        {"warp", order::kWarp}};

/// Smaller ones take less than a millisecond, of either.
constexpr std::size_t kLeastTimed = 8'000;

struct Figures {
    double ours = 0;
    double theirs = 0;
};

struct Row {
    std::string name;
    std::size_t triangles = 0;
    std::vector<Figures> reuse;         // of each model: transformed vertices per vertex
    Figures milliseconds;               // fifo:16, of all threads, beside meshoptimizer's vertex cache order
    Figures elapsed;                    // the same by the clock on the wall, with the cores that are there
    std::vector<Figures> levels;        // greatest distance in per cent of the radius, each with as many triangles as the other
    std::optional<Figures> packedReuse; // gltfpack: fifo:16 and warp
    std::vector<double> shares;         // of the triangles in each level
    double packedLevel = NAN;           // its level with as many triangles as our second
};

/// One part of a mesh by itself, as it is drawn.
struct Part {
    Indices indices;
    std::vector<glm::vec3> positions;
};

std::span<const float> placesOf(const Part& part) {
    return {&part.positions[0].x, 3 * part.positions.size()};
}

std::vector<Part> partsOf(const Mesh& mesh) {
    std::vector<Part> parts;
    for (const MeshPart& part : mesh.parts) {
        std::vector<std::uint32_t> number(mesh.positions.size(), UINT32_MAX);
        Part own;
        for (std::uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; ++i) {
            std::uint32_t& n = number[mesh.indices[i]];
            if (n == UINT32_MAX) {
                n = static_cast<std::uint32_t>(own.positions.size());
                own.positions.push_back(mesh.positions[mesh.indices[i]]);
            }
            own.indices.push_back(n);
        }
        parts.push_back(std::move(own));
        if (parts.size() == 64) break; // the rest is like them
    }
    return parts;
}

/// Of the processor, all threads together: what else runs on the machine does not count. The least of the turns.
struct Taken {
    double processor = 1e30; // ms
    double elapsed = 1e30;
};

template <class Work>
void measureTime(Taken& least, Work work) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t start = std::clock();
    work();
    least.processor = std::min(least.processor, 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    least.elapsed = std::min(least.elapsed, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
}

std::size_t trianglesOf(const std::vector<Part>& parts) {
    std::size_t triangles = 0;
    for (const Part& part : parts)
        triangles += part.indices.size() / 3;
    return triangles;
}

/// By turns, so that what else runs on the machine counts for both.
void measureTimes(const std::vector<Part>& parts, Row& row) {
    constexpr int kTurns = 25;
    Taken ours, theirs;
    for (int i = 0; i < kTurns; ++i) {
        measureTime(ours, [&] {
            order::PartsReorder reorder(order::Method::Best, order::fifo(16), trianglesOf(parts));
            forEachInParallel(parts.size(), [&](std::size_t part) {
                (void)reorder(parts[part].indices, parts[part].positions.size(), placesOf(parts[part]));
            });
        });
        measureTime(theirs, [&] {
            for (const Part& part : parts)
                (void)testing_prep::peerVertexCache(part.indices, part.positions.size());
        });
    }
    row.milliseconds = {ours.processor, theirs.processor};
    row.elapsed = {ours.elapsed, theirs.elapsed};
}

void measureOrders(const std::vector<Part>& parts, Row& row) {
    for (const auto& [name, model] : kModels) {
        std::size_t ours = 0, theirs = 0, vertices = 0;
        order::PartsReorder reorder(order::Method::Best, model, trianglesOf(parts));
        for (const Part& part : parts) {
            const std::size_t count = part.positions.size();
            ours += order::measure(model, *reorder(part.indices, count, placesOf(part)), count).misses;
            std::size_t least = SIZE_MAX;
            for (const Indices& theirOrder : testing_prep::peerOrders(part.indices, part.positions, model.entries))
                least = std::min(least, order::measure(model, theirOrder, count).misses);
            theirs += least;
            vertices += count;
        }
        row.reuse.push_back(
            {static_cast<double>(ours) / static_cast<double>(vertices), static_cast<double>(theirs) / static_cast<double>(vertices)});
    }
    measureTimes(parts, row);
}

void measureLevels(const Mesh& mesh, Row& row) {
    const Levels made = makeLevels(mesh, 4);
    const DistanceFrom distance(mesh.positions, mesh.indices);
    for (const Level& level : made.levels) {
        double least = 1e30;
        for (const Indices& theirs :
             testing_prep::peerLevels(mesh.indices, mesh.positions, mesh.normals, mesh.uvs, level.mesh.indices.size() / 3))
            if (theirs.size() <= level.mesh.indices.size() * 21 / 20) least = std::min(least, distance.to(theirs).reached);
        const double radius = static_cast<double>(mesh.bounds.radius);
        row.shares.push_back(static_cast<double>(level.mesh.indices.size()) / static_cast<double>(mesh.indices.size()));
        row.levels.push_back({100 * level.error.reached / radius, least > 1e29 ? NAN : 100 * least / radius});
    }
}

std::size_t missesOf(const order::CacheModel& model, const Mesh& mesh) {
    std::size_t misses = 0;
    for (const Part& part : partsOf(mesh))
        misses += order::measure(model, part.indices, part.positions.size()).misses;
    return misses;
}

/// gltfpack merges parts and vertices that are equal: its runs count per vertex of what it makes.
void measurePacked(const std::filesystem::path& tools, const Mesh& mesh, Row& row) {
    if (mesh.parts.size() > 64) return;
    if (const auto whole = testing_prep::packedBy(tools, mesh, 1)) {
        std::size_t vertices = 0;
        for (const Part& part : partsOf(whole->mesh))
            vertices += part.positions.size();
        const auto runs = [&](const order::CacheModel& model) {
            return static_cast<double>(missesOf(model, whole->mesh)) / static_cast<double>(vertices);
        };
        row.packedReuse = {runs(order::fifo(16)), runs(order::kWarp)};
    }
    if (row.shares.size() < 2) return;
    const auto level = testing_prep::packedBy(tools, mesh, row.shares[1]);
    const double most = 1.05 * row.shares[1] * static_cast<double>(mesh.indices.size());
    if (!level || level->mesh.indices.empty() || static_cast<double>(level->mesh.indices.size()) > most) return;
    std::vector<glm::vec3> positions = mesh.positions;
    Indices theirs;
    for (const std::uint32_t index : level->mesh.indices)
        theirs.push_back(static_cast<std::uint32_t>(positions.size()) + index);
    positions.insert(positions.end(), level->mesh.positions.begin(), level->mesh.positions.end());
    row.packedLevel = 100 * distance(positions, mesh.indices, theirs).reached / static_cast<double>(mesh.bounds.radius);
}

std::optional<Row> rowOf(const std::string& name, const Mesh& mesh, const std::filesystem::path& tools, bool levels) {
    if (mesh.indices.size() < 300) return std::nullopt;
    Row row;
    row.name = name;
    row.triangles = mesh.indices.size() / 3;
    measureOrders(partsOf(mesh), row);
    if (levels) measureLevels(mesh, row);
    if (!tools.empty()) measurePacked(tools, mesh, row);
    return row;
}

std::optional<Row> rowOf(const std::filesystem::path& file, const std::filesystem::path& tools, bool levels) {
    PrepOptions options;
    options.order = std::nullopt;
    options.levels = 1;
    options.read.dropNotFinite = true;
    auto prepared = prepareMesh(file, options);
    if (!prepared) return std::nullopt;
    return rowOf(file.filename().string(), prepared->mesh, tools, levels);
}

std::vector<std::pair<std::string, Mesh>> generated() {
    std::vector<std::pair<std::string, Mesh>> meshes;
    for (const auto& [name, shape, details] : {std::tuple("sphere", Shape::Sphere, std::array{12, 20, 30, 40, 55, 70}),
                                               std::tuple("terrain", Shape::Terrain, std::array{20, 35, 60, 90, 140, 200}),
                                               std::tuple("torus", Shape::Torus, std::array{0, 0, 0, 0, 0, 0})})
        for (const int detail : details) {
            Mesh mesh = makeShape(shape, detail);
            Surface surface{.mesh = std::move(mesh)};
            findPlaces(surface, {});
            makeNormals(surface, {});
            computeBounds(surface.mesh);
            meshes.emplace_back(fmt::format("{} {}", name, detail), std::move(surface.mesh));
            if (detail == 0) break;
        }
    return meshes;
}

void print(const Row& row) {
    std::string line = fmt::format("| {} | {} |", row.name, row.triangles);
    for (const Figures& figures : row.reuse)
        line += fmt::format(" {:.3f} {:.3f} |", figures.ours, figures.theirs);
    line += fmt::format(" {:.1f} {:.1f} | {:.2f} |", row.milliseconds.ours, row.milliseconds.theirs, row.elapsed.ours / row.elapsed.theirs);
    line += row.packedReuse ? fmt::format(" {:.3f}, {:.3f} |", row.packedReuse->ours, row.packedReuse->theirs) : " |";
    for (std::size_t i = 0; i < 3; ++i)
        line += i < row.levels.size() ? fmt::format(" {:.2f} {:.2f} |", row.levels[i].ours, row.levels[i].theirs) : std::string(" |");
    line += std::isnan(row.packedLevel) ? " |" : fmt::format(" {:.2f} |", row.packedLevel);
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

void printLosses(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.reuse.size(); ++i)
            if (row.reuse[i].ours > row.reuse[i].theirs * (1 + 1e-9))
                fmt::print("loses: {}, {}: {:.4f} against {:.4f}\n", row.name, kModels[i].first, row.reuse[i].ours, row.reuse[i].theirs);
        for (std::size_t i = 0; i < row.levels.size(); ++i)
            if (row.levels[i].ours > 1.05 * row.levels[i].theirs)
                fmt::print("loses: {}, level {}: {:.3f} against {:.3f} % of the radius\n", row.name, i + 1, row.levels[i].ours,
                           row.levels[i].theirs);
        if (row.packedReuse && row.reuse[0].ours > row.packedReuse->ours)
            fmt::print("loses: {}, {}: {:.4f} against gltfpack's {:.4f}\n", row.name, kModels[0].first, row.reuse[0].ours,
                       row.packedReuse->ours);
        if (row.packedReuse && row.reuse.back().ours > row.packedReuse->theirs)
            fmt::print("loses: {}, {}: {:.4f} against gltfpack's {:.4f}\n", row.name, kModels.back().first, row.reuse.back().ours,
                       row.packedReuse->theirs);
        if (row.levels.size() > 1 && row.packedLevel * 1.05 < row.levels[1].ours)
            fmt::print("loses: {}, level 2: {:.3f} against gltfpack's {:.3f} % of the radius\n", row.name, row.levels[1].ours,
                       row.packedLevel);
        if (row.milliseconds.ours > 3 * row.milliseconds.theirs && row.milliseconds.ours > 50)
            fmt::print("loses: {}, time: {:.1f} against {:.1f} ms\n", row.name, row.milliseconds.ours, row.milliseconds.theirs);
        if (row.elapsed.ours > row.elapsed.theirs && row.triangles >= kLeastTimed)
            fmt::print("loses: {}, elapsed: {:.2f} against {:.2f} ms\n", row.name, row.elapsed.ours, row.elapsed.theirs);
    }
}

} // namespace

int main(int count, char** arguments) {
    bool filesOnly = false;
    bool levels = true;
    std::filesystem::path tools;
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < count; ++i) {
        if (std::string_view(arguments[i]) == "--files-only")
            filesOnly = true;
        else if (std::string_view(arguments[i]) == "--no-levels")
            levels = false;
        else if (std::string_view(arguments[i]) == "--gltfpack" && i + 1 < count)
            tools = arguments[++i];
        else
            files.emplace_back(arguments[i]);
    }
    fmt::print(
        "Ours, then {}. Runs of the vertex shader per vertex; warp: NVIDIA-like batches. ms: `best` for fifo:16 (of all threads), then "
        "its vertex cache order; elapsed: ours over theirs by the clock, on {} processors. gltfpack: fifo:16, warp. Levels: greatest "
        "distance in per cent of the radius.\n\n",
        testing_prep::peerName(), std::thread::hardware_concurrency());
    fmt::print("| mesh | triangles | fifo:16 | fifo:24 | fifo:32 | lru:16 | warp | ms | elapsed | gltfpack | level 1 | level 2 | level 3 | "
               "gltfpack's "
               "level 2 |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    std::vector<Row> rows;
    const auto take = [&](std::optional<Row> row) {
        if (!row) return;
        print(*row);
        rows.push_back(std::move(*row));
    };
    if (!filesOnly)
        for (const auto& [name, mesh] : generated())
            take(rowOf(name, mesh, tools, levels));
    for (const std::filesystem::path& file : files)
        take(rowOf(file, tools, levels));
    fmt::print("\n{} meshes\n", rows.size());
    printLosses(rows);
    return EXIT_SUCCESS;
}
