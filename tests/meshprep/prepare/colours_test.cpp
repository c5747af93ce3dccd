// Colours and properties of a scan's vertices, at the same places whatever is done to the mesh.
#include "host/mesh/vertex_values.h"
#include "host/support/file.h"
#include "tests/meshprep/prepare/meshes.h"

#include <fmt/format.h>

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_prep;

namespace {

using Colours = PrepFolder;

/// A square of side x side points, 1 mm apart, whose bytes say where they are.
std::string painted(int side) {
    std::string vertices, faces;
    for (int i = 0; i < side * side; ++i)
        vertices +=
            fmt::format("{} {} {} {} {} 77 {}\n", i % side, i / side, i % 3, i % side % 256, i / side % 256, (i % side + i / side) % 256);
    for (int i = 0; i < side * side - side; ++i)
        if (i % side < side - 1) faces += fmt::format("3 {0} {1} {2}\n3 {1} {3} {2}\n", i, i + 1, i + side, i + side + 1);
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nproperty uchar fur_length\nelement face {}\n"
        "property list uchar int vertex_indices\nend_header\n{}{}",
        side * side, 2 * (side - 1) * (side - 1), vertices, faces);
}

/// Values that do not belong to their vertex's place.
std::size_t misplaced(const VertexValues& values, const glm::dvec3& moved) {
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < values.positions.size(); ++v) {
        const glm::dvec3 place = glm::dvec3(values.positions[v]) - moved;
        const long x = std::lround(place.x), y = std::lround(place.y);
        const std::array<long, 4> expected = {x % 256, y % 256, 77, (x + y) % 256};
        for (std::size_t k = 0; k < expected.size(); ++k)
            wrong += std::lround(255 * values.values[k][v]) != expected[k];
    }
    return wrong;
}

const std::vector<std::string> kNames = {"red", "green", "blue", "fur_length"};

struct Case {
    const char* name;
    int side;
    void (*choose)(prep::PrepOptions&);
};

constexpr Case kCases[] = {
    {"pieces", 270, [](prep::PrepOptions& o) { o.chunk16 = true, o.levels = 1; }},
    {"levels by OpenMesh", 20, [](prep::PrepOptions& o) { o.levelMethod = prep::LevelMethod::OpenMesh; }},
    {"16-bit numbers", 20, [](prep::PrepOptions& o) { o.precision = prep::VertexPrecision::Unorm16; }},
    {"halves", 20, [](prep::PrepOptions& o) { o.precision = prep::VertexPrecision::Half; }},
    {"overdraw", 20, [](prep::PrepOptions& o) { o.overdraw = true; }},
    {"the file's order", 20, [](prep::PrepOptions& o) { o.order = std::nullopt; }},
    {"the file's place", 20, [](prep::PrepOptions& o) { o.centre = prep::CentreMode::None; }},
    {"the scan's texture coordinates made", 12, [](prep::PrepOptions& o) { o.unwrap = true, o.levels = 1; }},
};

} // namespace

TEST_F(Colours, stay_at_their_places_whatever_is_done_to_the_mesh) {
    for (const Case& one : kCases) {
        prep::PrepOptions options;
        options.read.unitMm = 1;
        one.choose(options);
        ASSERT_TRUE(writeFile(folder_ / "painted.ply", painted(one.side)));
        const auto result = prep::prepareMesh(folder_ / "painted.ply", options);
        if (!result && options.unwrap) continue; // built without xatlas
        ASSERT_TRUE(result) << one.name << format(result.error());
        ASSERT_TRUE(writeGlb(folder_ / "out.glb", result->mesh, result->glb));
        ASSERT_TRUE(writePly(folder_ / "out.ply", result->mesh));
        for (const auto& [file, unit] : {std::pair(folder_ / "out.glb", 1000.0), std::pair(folder_ / "out.ply", 1.0)}) {
            const auto after = readVertexValues(file, kNames, unit);
            ASSERT_TRUE(after) << one.name << format(after.error());
            EXPECT_GE(after->positions.size(), static_cast<std::size_t>(one.side * one.side)) << one.name;
            EXPECT_EQ(misplaced(*after, result->report.centring.moved), 0u) << one.name << ", " << file.extension();
        }
        EXPECT_EQ(std::ranges::count(result->report.warnings, 5331, &Diagnostic::code), 0) << one.name;
    }
}
