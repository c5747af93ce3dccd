// Where a coat is combed to on a mesh that nobody has painted.
#include "meshprep/fur/ribbons/coat_flow.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

/// Roots of a mesh, brought to it.
struct Rooted {
    Built built;
    RootedMesh rooted;

    explicit Rooted(Mesh mesh, std::size_t count = 6000) : built(build(std::move(mesh), {.count = count})), rooted{built.mesh, {}, 0} {
        auto read = readRooted(built.mesh, built.texture.image);
        EXPECT_TRUE(read) << format(read.error());
        if (!read) return;
        rooted.roots = std::move(read->roots);
        rooted.spacing = read->spacing;
    }
};

Mesh stretched(Mesh mesh, const glm::vec3& by) {
    for (glm::vec3& p : mesh.positions)
        p *= by;
    for (glm::vec3& n : mesh.normals)
        n = glm::normalize(n / by);
    computeBounds(mesh);
    return mesh;
}

double degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return glm::degrees(std::acos(std::clamp(static_cast<double>(glm::dot(glm::normalize(a), glm::normalize(b))), -1.0, 1.0)));
}

} // namespace

TEST(Flow, lies_in_the_skin_and_is_never_longer_than_1) {
    const Rooted on(stretched(ball(50), {2, 1, 0.7F}));
    const CoatFlow flow = flowOfCoat(on.rooted, {});
    ASSERT_EQ(flow.direction.size(), on.rooted.roots.size());
    for (std::size_t i = 0; i < flow.direction.size(); ++i) {
        EXPECT_LT(std::abs(glm::dot(flow.direction[i], on.rooted.roots[i].normal)), 1e-4F);
        EXPECT_LT(glm::length(flow.direction[i]), 1.001F);
        EXPECT_GE(flow.shortness[i], 0);
        EXPECT_LE(flow.shortness[i], 1);
    }
}

TEST(Flow, follows_the_comb_where_the_skin_lies_along_it) {
    const Rooted on(ball(50));
    const CoatFlow flow = flowOfCoat(on.rooted, {.comb = glm::dvec3(2, 0, 0)});
    for (std::size_t i = 0; i < flow.direction.size(); ++i) {
        const glm::vec3& n = on.rooted.roots[i].normal;
        if (std::abs(n.x) > 0.7F) continue;
        const glm::vec3 along = glm::vec3(1, 0, 0) - n * n.x;
        EXPECT_LT(degreesBetween(flow.direction[i], along), 12) << "where neighbours of a pole do not decide";
    }
}

// The comb alone is a source on each bump that looks against it. Directions that follow their neighbours, too, go past it: round a knob on
// the side of a ball, whose near face looks against the comb.
TEST(Flow, has_no_source_on_a_knob) {
    const glm::vec3 side = glm::normalize(glm::vec3(0, 1, -0.6F)); // of the knob, seen from the ball's centre
    Mesh mesh = ball(50, 128);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float far = glm::distance(mesh.positions[i], 50.0F * side) / 8;
        mesh.positions[i] += 26.0F * std::exp(-far * far) * mesh.normals[i];
    }
    mesh.normals.clear();
    computeNormals(mesh);
    computeBounds(mesh);
    const Rooted on(std::move(mesh), 20000);
    const glm::vec3 comb(0, 0, 1);
    const glm::vec3 past = glm::normalize(comb - side * glm::dot(comb, side)); // the way over the ball, there
    const CoatFlow flow = flowOfCoat(on.rooted, {.comb = glm::dvec3(comb)});
    int against = 0, alone = 0;
    for (std::size_t i = 0; i < flow.direction.size(); ++i) {
        const RootedPlace& root = on.rooted.roots[i];
        const glm::vec3 place = root.position * on.built.mesh.bounds.radius + on.built.mesh.bounds.centre;
        if (glm::distance(glm::normalize(place), side) > 0.3F) continue;
        alone += glm::dot(comb - root.normal * glm::dot(comb, root.normal), past) < 0;
        against += glm::dot(flow.direction[i], past) < 0;
    }
    EXPECT_GT(alone, 20) << "the comb by itself runs back somewhere on the knob: otherwise this tests nothing";
    EXPECT_EQ(against, 0);
}

TEST(Flow, is_short_where_a_coat_must_part) {
    const Rooted on(ball(50));
    const CoatFlow flow = flowOfCoat(on.rooted, {.comb = glm::dvec3(1, 0, 0)});
    for (std::size_t i = 0; i < flow.direction.size(); ++i) {
        if (on.rooted.roots[i].normal.x < -0.995F) {
            EXPECT_LT(glm::length(flow.direction[i]), 0.3F) << "at the source strands stand up";
        }
    }
}

TEST(Flow, keeps_what_it_is_told) {
    const Rooted on(ball(50), 500);
    std::vector<glm::vec3> told;
    for (const RootedPlace& root : on.rooted.roots)
        told.push_back(0.5F * glm::normalize(glm::cross(root.normal, glm::vec3(0.1F, 1, 0.2F))));
    const CoatFlow flow = flowOfCoat(on.rooted, {.told = told});
    EXPECT_EQ(flow.direction, told);
}

TEST(Flow, runs_from_the_higher_end_to_the_lower_and_down) {
    Mesh mesh = stretched(ball(50), {3, 1, 1});
    for (glm::vec3& p : mesh.positions)
        p.y -= 0.2F * p.x; // the head is at -x
    const glm::dvec3 comb = combOfShape(mesh.positions, {0, -1, 0});
    EXPECT_NEAR(glm::length(comb), 1, 1e-9);
    EXPECT_GT(comb.x, 0.8);
    EXPECT_LT(comb.y, -0.3);
    EXPECT_NEAR(comb.z, 0, 0.02);
}

/// A long body with a ball as its head, high at its front, which is -x.
Mesh animal() {
    Mesh mesh = stretched(ball(50), {2.4F, 1, 1});
    Mesh head = ball(30);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t i = 0; i < head.positions.size(); ++i) {
        mesh.positions.push_back(head.positions[i] + glm::vec3(-120, 60, 0));
        mesh.normals.push_back(head.normals[i]);
    }
    for (const std::uint32_t index : head.indices)
        mesh.indices.push_back(first + index);
    mesh.tangents.clear();
    mesh.uvs.clear();
    mesh.parts = {{.name = "animal", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

TEST(Flow, begins_at_the_nose_and_not_on_the_forehead) {
    const Rooted on(animal());
    const CoatFlow flow = flowOfCoat(on.rooted, {});
    ASSERT_GT(flow.comb.x, 0.5);
    ASSERT_LT(flow.comb.y, -0.3);
    glm::vec3 face(0), flank(0);
    for (std::size_t i = 0; i < flow.direction.size(); ++i) {
        const RootedPlace& root = on.rooted.roots[i];
        const bool head = root.position.y > 0.35F && root.position.x < -0.5F;
        if (head && glm::dot(root.normal, glm::normalize(glm::vec3(-1, 0.5F, 0))) > 0.9F) face += flow.direction[i]; // the forehead
        if (!head && std::abs(root.normal.z) > 0.9F && root.position.x > 0) flank += flow.direction[i];
    }
    EXPECT_GT(face.y, 0) << "up over the forehead";
    EXPECT_GT(face.x, 0);
    EXPECT_LT(flank.y, 0) << "and down the flanks";
    EXPECT_GT(flank.x, 0);

    const CoatFlow asked = flowOfCoat(on.rooted, {.comb = flow.comb});
    glm::vec3 combed(0);
    for (std::size_t i = 0; i < asked.direction.size(); ++i)
        if (on.rooted.roots[i].position.y > 0.35F && glm::dot(on.rooted.roots[i].normal, glm::normalize(glm::vec3(-1, 0.5F, 0))) > 0.9F)
            combed += asked.direction[i];
    EXPECT_LT(combed.y, face.y) << "who asks for a comb gets it everywhere";
}

TEST(Flow, of_what_is_round_seen_from_above_is_down) {
    const Mesh mesh = stretched(ball(50), {1, 2, 1});
    const glm::dvec3 comb = combOfShape(mesh.positions, {0, -1, 0});
    EXPECT_LT(comb.y, -0.99);
}

TEST(Flow, knows_down_from_the_caller) {
    Mesh mesh = stretched(ball(50), {1, 3, 1});
    for (glm::vec3& p : mesh.positions)
        p.z += 0.2F * p.y; // z is up, and the head at +y
    const glm::dvec3 comb = combOfShape(mesh.positions, {0, 0, -2});
    EXPECT_LT(comb.y, -0.8);
    EXPECT_LT(comb.z, -0.3);
}

// The body is a ball, the ear a flat one on it: a tenth as thick.
TEST(Flow, makes_fur_short_where_the_body_is_thin) {
    const Rooted body(ball(50));
    for (const float shortness : flowOfCoat(body.rooted, {}).shortness)
        EXPECT_LT(shortness, 0.05F) << "as thick as it is long";
    const Rooted ear(stretched(ball(50), {1, 1, 0.05F}));
    const CoatFlow flow = flowOfCoat(ear.rooted, {});
    const auto above = std::ranges::count_if(flow.shortness, [](float s) { return s > 0.8F; });
    EXPECT_GT(static_cast<double>(above), 0.9 * static_cast<double>(flow.shortness.size()));
    for (const float shortness : flowOfCoat(ear.rooted, {.thickness = false}).shortness)
        EXPECT_EQ(shortness, 0);
}
