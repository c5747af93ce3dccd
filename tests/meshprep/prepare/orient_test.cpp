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

namespace {

void addBall(Mesh& mesh, const glm::vec3& centre, float radius, bool inwards) {
    const Mesh ball = makeShape(Shape::Sphere, 4);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    Mesh copy = ball;
    computeBounds(copy);
    for (const glm::vec3& p : ball.positions)
        mesh.positions.push_back(centre + (p - copy.bounds.centre) * (radius / copy.bounds.radius));
    for (std::size_t i = 0; i < ball.indices.size(); i += 3)
        for (const std::size_t corner : {0U, inwards ? 2U : 1U, inwards ? 1U : 2U})
            mesh.indices.push_back(first + ball.indices[i + corner]);
    mesh.parts = {{.name = "all", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
}

/// Signed volumes of so many shells of equally many triangles, in order.
std::vector<double> volumes(const Mesh& mesh, std::size_t shells) {
    std::vector<double> sums(shells, 0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        sums[i * shells / mesh.indices.size()] += glm::dot(p(0), glm::cross(p(1), p(2))) / 6;
    }
    return sums;
}

} // namespace

TEST_F(Orient, each_shell_of_many_faces_out_and_hollows_face_in) {
    std::mt19937 random(3);
    Mesh mesh;
    constexpr std::size_t kPlaces = 25;
    for (std::size_t i = 0; i < kPlaces; ++i) { // a ball, a hollow in it, a ball in that
        const glm::vec3 centre(100 * (i % 5), 100 * (i / 5), 0);
        for (const float radius : {30.0F, 20.0F, 10.0F})
            addBall(mesh, centre, radius, random() % 2 == 0);
    }
    PrepOptions options{.orient = true, .centre = CentreMode::None, .order = std::nullopt, .levels = 1};
    const Prepared turned = prepare(mesh, options);
    const std::vector<double> found = volumes(turned.mesh, 3 * kPlaces);
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_GT(found[i] * (i % 3 == 1 ? -1 : 1), 0) << "shell " << i;
    EXPECT_EQ(changedBy(prepare(turned.mesh, options).report, "orient"), 0U) << "what is right stays";
}

TEST_F(Orient, one_shell_inside_out_among_others_is_told) {
    for (const std::size_t wrong : {0U, 1U, 2U}) {
        Mesh mesh;
        for (std::size_t i = 0; i < 3; ++i)
            addBall(mesh, glm::vec3(100 * i, 0, 0), i == 0 ? 40.0F : 20.0F, i == wrong);
        const Prepared told = prepare(mesh);
        ASSERT_FALSE(told.report.warnings.empty()) << wrong;
        EXPECT_EQ(told.report.warnings.back().code, 5332) << wrong;
        EXPECT_TRUE(prepare(mesh, {.orient = true}).report.warnings.empty()) << wrong;
    }
}
