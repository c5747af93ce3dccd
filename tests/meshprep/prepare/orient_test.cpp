// What --orient makes of meshes that face the wrong way.
#include "host/mesh/facing.h"
#include "meshprep/prepare/topology.h"
#include "tests/meshprep/prepare/meshes.h"

#include <random>

using namespace tegument;
using namespace tegument::prep;
using namespace tegument::testing_prep;

namespace {

Mesh torusMesh() {
    return makeShape(Shape::Torus);
}

void turn(Mesh& mesh, std::size_t triangle) {
    std::swap(mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]);
}

using Orient = PrepFolder;

} // namespace

TEST_F(Orient, a_mesh_inside_out_is_turned_over) {
    Mesh mesh = torusMesh();
    const double outward = outwardFacing(mesh);
    ASSERT_GT(outward, 0);
    for (std::size_t i = 0; i < mesh.indices.size() / 3; ++i)
        turn(mesh, i);
    EXPECT_EQ(prepare(mesh).report.warnings.back().code, 5332) << "without the option it is told";
    const Prepared turned = prepare(mesh, {.orient = true});
    EXPECT_NEAR(outwardFacing(turned.mesh), outward, 1e-4) << "floats";
    EXPECT_EQ(changedBy(turned.report, "orient"), mesh.indices.size() / 3);
    EXPECT_TRUE(turned.report.warnings.empty());
}

TEST_F(Orient, triangles_that_face_at_random_face_outwards_afterwards) {
    for (const unsigned seed : {1u, 2u, 3u, 4u}) { // half of them: the majority is inside as often as outside
        Mesh mesh = torusMesh();
        std::mt19937 random(seed);
        for (std::size_t i = 0; i < mesh.indices.size() / 3; ++i)
            if (random() % 2 == 0) turn(mesh, i);
        const Prepared turned = prepare(mesh, {.orient = true});
        EXPECT_EQ(turned.report.topology.opposedEdges, 0u);
        EXPECT_GT(outwardFacing(turned.mesh), 0) << seed;
    }
}

TEST_F(Orient, of_a_surface_written_for_both_sides_one_stays) {
    Mesh mesh = torusMesh();
    const std::size_t once = mesh.indices.size();
    for (std::size_t i = 0; i < once; i += 3)
        for (const std::size_t corner : {0u, 2u, 1u})
            mesh.indices.push_back(mesh.indices[i + corner]);
    mesh.parts.front().indexCount = static_cast<std::uint32_t>(mesh.indices.size());
    EXPECT_EQ(prepare(mesh).report.warnings.back().code, 5334);
    const Prepared turned = prepare(mesh, {.orient = true});
    EXPECT_EQ(turned.report.triangles, mesh.indices.size() / 3) << "as read";
    EXPECT_EQ(turned.report.output.faces, once / 3);
    EXPECT_GT(outwardFacing(turned.mesh), 0);
}

TEST_F(Orient, a_mesh_that_faces_outwards_stays_as_it_is) {
    const Prepared turned = prepare(torusMesh(), {.orient = true});
    EXPECT_EQ(changedBy(turned.report, "orient"), 0u);
}
