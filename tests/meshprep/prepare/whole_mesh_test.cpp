// A mesh of several parts simplified as one: its triangles are found again in the parts that they came from.
#include "meshprep/prepare/whole_mesh.h"
#include "tests/meshprep/prepare/meshes.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::prep;
using namespace tegument::testing_prep;

namespace {

struct Halves {
    Mesh mesh;
    float middle = 0; // x
    float step = 0;   // from vertex to vertex
};

/// A terrain whose triangles left of the middle are one part, and the others another one; they have the vertices between in common.
Halves halves() {
    constexpr int kSquares = 24;
    Mesh mesh = makeShape(Shape::Terrain, kSquares);
    const auto [low, high] = std::ranges::minmax(mesh.positions, {}, &glm::vec3::x);
    const float middle = (low.x + high.x) / 2;
    std::vector<std::uint32_t> sides[2];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        float x = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            x += mesh.positions[mesh.indices[k]].x / 3;
        auto& side = sides[x < middle ? 0 : 1];
        side.insert(side.end(), &mesh.indices[i], &mesh.indices[i] + 3);
    }
    mesh.indices.clear();
    mesh.parts.clear();
    for (const auto& side : sides) {
        mesh.parts.push_back({.name = mesh.parts.empty() ? "left" : "right",
                              .firstIndex = static_cast<std::uint32_t>(mesh.indices.size()),
                              .indexCount = static_cast<std::uint32_t>(side.size())});
        mesh.indices.insert(mesh.indices.end(), side.begin(), side.end());
    }
    return {.mesh = std::move(mesh), .middle = middle, .step = (high.x - low.x) / kSquares};
}

} // namespace

TEST(WholeMeshes, simplified_as_one_have_their_parts_again) {
    const Halves terrain = halves();
    const Mesh& mesh = terrain.mesh;
    const WholeMesh whole(mesh);
    ASSERT_TRUE(whole.mayBeOne(mesh.indices.size() / 6));
    const MeshLevel level = whole.level(whole.simplifiedAsOne(mesh.indices.size() / 6, {}));
    ASSERT_EQ(level.parts.size(), 2u);
    std::size_t across = 0; // triangles all of whose corners are beyond the middle by a tenth of a square
    for (const MeshPart& part : level.parts) {
        EXPECT_GT(part.indexCount, level.indices.size() / 3) << part.name;
        for (std::uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; i += 3) {
            const auto beyond = [&](std::uint32_t k) {
                const float x = mesh.positions[level.indices[i + k]].x - terrain.middle;
                return (part.name == "left" ? x : -x) > 0.1f * terrain.step;
            };
            across += beyond(0) && beyond(1) && beyond(2);
        }
    }
    EXPECT_EQ(across, 0u);
}

TEST(WholeMeshes, that_lose_nothing_have_all_triangles_where_they_were) {
    const Mesh mesh = halves().mesh;
    const WholeMesh whole(mesh);
    const MeshLevel level = whole.level(whole.simplifiedAsOne(mesh.indices.size() / 3, {}));
    ASSERT_EQ(level.parts.size(), 2u);
    for (std::size_t part = 0; part < 2; ++part)
        EXPECT_EQ(level.parts[part].indexCount, mesh.parts[part].indexCount) << mesh.parts[part].name;
}
