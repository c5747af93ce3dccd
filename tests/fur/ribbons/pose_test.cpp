// Roots on a body that bends: each stays on its triangle, and its strand's axes turn with it. References in double precision.
#include "host/mesh/pose.h"
#include "meshprep/fur/ribbons/pose.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <functional>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

constexpr double kRadius = 50;

/// Bent about the z axis as a bow of this radius, the longer the further up: lengths across stay, lengths along change by x / radius.
glm::dvec3 bent(const glm::dvec3& p) {
    constexpr double kBow = 3 * kRadius;
    const double angle = p.y / kBow;
    return {kBow - (kBow - p.x) * std::cos(angle), (kBow - p.x) * std::sin(angle), p.z};
}

/// Its derivative, by columns.
glm::dmat3 slopeAt(const glm::dvec3& p) {
    constexpr double kStep = 1e-4;
    glm::dmat3 slope;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 step(0);
        step[i] = kStep;
        slope[i] = (bent(p + step) - bent(p - step)) / (2 * kStep);
    }
    return slope;
}

Mesh moved(const Mesh& rest, const std::function<glm::dvec3(const glm::dvec3&)>& place,
           const std::function<glm::dmat3(const glm::dvec3&)>& slope) {
    Mesh mesh = rest;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(rest.positions[i]);
        mesh.positions[i] = glm::vec3(place(p));
        mesh.normals[i] = glm::vec3(glm::normalize(glm::transpose(glm::inverse(slope(p))) * glm::dvec3(rest.normals[i])));
    }
    computeBounds(mesh);
    return mesh;
}

/// A ball with its roots and their seats.
struct Seated {
    Built built = build(ball(kRadius, 96), {.count = 3000});
    RootSeats seats;

    Seated() {
        auto found = seatsOfRoots(built.mesh, built.texture.image);
        EXPECT_TRUE(found);
        if (found) seats = *std::move(found);
    }
    [[nodiscard]] const Mesh& mesh() const { return built.mesh; }
    [[nodiscard]] glm::dvec3 root(const RootSeat& seat) const {
        const float* texel = &built.texture.image.pixels[4 * static_cast<std::size_t>(seat.address)];
        return {texel[0], texel[1], texel[2]};
    }
    [[nodiscard]] std::array<glm::dvec3, 3> corners(const RootSeat& seat, const Mesh& mesh) const {
        std::array<glm::dvec3, 3> found;
        for (std::size_t i = 0; i < 3; ++i)
            found[i] = glm::dvec3(mesh.positions[mesh.indices[3 * std::size_t{seat.triangle} + i]]);
        return found;
    }
};

/// Weights of a point of a triangle, by its areas.
glm::dvec3 weightsOf(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    const auto area = [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(glm::cross(a - p, b - p), n) / glm::dot(n, n); };
    return {area(t[1], t[2]), area(t[2], t[0]), area(t[0], t[1])};
}

} // namespace

TEST(Pose, at_rest_moves_and_turns_nothing) {
    const Seated seated;
    EXPECT_EQ(seated.seats.lost, 0U);
    EXPECT_EQ(seated.seats.seats.size(), seated.built.set.roots.size());
    for (const RootSeat& seat : seated.seats.seats) {
        const RootPose pose = poseOfRoot(seat, seated.mesh(), seated.mesh());
        EXPECT_EQ(pose.moved, glm::dvec3(0));
        EXPECT_EQ(pose.turn, glm::dquat(1, 0, 0, 0));
    }
}

TEST(Pose, keeps_each_root_on_its_triangle) {
    const Seated seated;
    const Mesh posed = moved(seated.mesh(), bent, slopeAt);
    double most = 0;
    for (const RootSeat& seat : seated.seats.seats) {
        const glm::dvec3 root = seated.root(seat);
        const auto rest = seated.corners(seat, seated.mesh());
        const glm::dvec3 weights = weightsOf(root, rest);
        EXPECT_NEAR(glm::distance(weights.x * rest[0] + weights.y * rest[1] + weights.z * rest[2], root), 0, 1e-4) << "it grows there";
        ASSERT_GT(std::min({weights.x, weights.y, weights.z}), -1e-3);
        const auto now = seated.corners(seat, posed);
        const glm::dvec3 expected = weights.x * now[0] + weights.y * now[1] + weights.z * now[2];
        const glm::dvec3 found = root + poseOfRoot(seat, seated.mesh(), posed).moved;
        // Positions are floats of 50 mm: 4e-6, times the weights of needles at the poles.
        EXPECT_NEAR(glm::distance(found, expected), 0, 2e-4) << seat.triangle;
        most = std::max(most, glm::distance(found, root));
    }
    EXPECT_GT(most, 5) << "it bends";
}

TEST(Pose, turns_as_a_rigid_body_does) {
    const Seated seated;
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 2.2, glm::normalize(glm::dvec3(0.3, -1, 0.5))));
    const glm::dquat asked = glm::quat_cast(turn);
    const Mesh posed = moved(
        seated.mesh(), [&](const glm::dvec3& p) { return turn * p + glm::dvec3(7, 8, 9); }, [&](const glm::dvec3&) { return turn; });
    for (const RootSeat& seat : seated.seats.seats) {
        const glm::dquat found = poseOfRoot(seat, seated.mesh(), posed).turn;
        // Triangles of floats: 4e-6 of 1.6 mm, more of needles.
        EXPECT_GT(std::abs(glm::dot(found, asked)), 1 - 1e-6) << seat.triangle;
    }
}

TEST(Pose, turns_strands_with_the_skin_below_them) {
    const Seated seated;
    const Mesh posed = moved(seated.mesh(), bent, slopeAt);
    double worst = 1, sum = 0;
    for (const RootSeat& seat : seated.seats.seats) {
        const glm::dvec3 root = seated.root(seat);
        const glm::dvec3 normal = glm::normalize(root);
        const glm::dmat3 slope = slopeAt(root);
        const glm::dquat turn = poseOfRoot(seat, seated.mesh(), posed).turn;
        const glm::dvec3 up = glm::normalize(glm::transpose(glm::inverse(slope)) * normal);
        worst = std::min(worst, glm::dot(turn * normal, up));
        // z is an axis of the bow: what lies along it goes on lying so.
        const glm::dvec3 z = glm::dvec3(0, 0, 1) - normal * normal.z;
        if (glm::length(z) < 0.3) continue;
        const glm::dvec3 along = slope * z;
        sum = std::max(sum, std::acos(std::min(glm::dot(glm::normalize(turn * z), glm::normalize(along)), 1.0)));
    }
    EXPECT_GT(worst, std::cos(glm::radians(1.5))) << "normals between corners that stand two degrees apart";
    // The rotation nearest to a stretch of a third shares its shear between both directions.
    EXPECT_LT(glm::degrees(sum), 15);
}

TEST(Pose, is_read_from_its_texture_and_seats_from_theirs) {
    const Seated seated;
    const Mesh posed = moved(seated.mesh(), bent, slopeAt);
    const Image& roots = seated.built.texture.image;
    const Image poses = poseTexture(seated.seats, seated.mesh(), posed, roots);
    const Image seats = seatTexture(seated.seats, seated.mesh(), roots);
    ASSERT_EQ(poses.pixels.size(), roots.pixels.size());
    for (const RootSeat& seat : seated.seats.seats) {
        const float* pose = &poses.pixels[4 * static_cast<std::size_t>(seat.address)];
        const float* own = &seats.pixels[4 * static_cast<std::size_t>(seat.address)];
        glm::dvec3 place(0);
        for (int i = 0; i < 3; ++i)
            place += static_cast<double>(own[4 + i]) * glm::dvec3(posed.positions[static_cast<std::size_t>(own[i])]);
        EXPECT_NEAR(glm::distance(seated.root(seat) + glm::dvec3(pose[0], pose[1], pose[2]), place), 0, 2e-4)
            << "an engine finds the same from its vertices";
        EXPECT_NEAR(glm::length(glm::vec4(pose[4], pose[5], pose[6], pose[7])), 1, 1e-6);
    }
}

TEST(Pose, takes_ribbons_where_culling_sees_them_and_leaves_their_vertices) {
    Seated seated;
    Mesh mesh = seated.mesh();
    ASSERT_TRUE(addRibbons(mesh, seated.built.texture.image));
    const Mesh rest = mesh;
    const Mesh posed = moved(seated.mesh(), bent, slopeAt);
    ASSERT_TRUE(sameTriangles(mesh, posed));
    applyPose(mesh, posed, poseTexture(seated.seats, skinOf(rest, posed), posed, seated.built.texture.image));
    const auto pose = poseOf(mesh);
    ASSERT_TRUE(pose);
    EXPECT_EQ(mesh.bounds.radius, rest.bounds.radius) << "lengths of fur are those at rest";
    EXPECT_EQ(mesh.positions, rest.positions);
    EXPECT_GT(glm::distance(seenBounds(mesh).centre, mesh.bounds.centre), 1) << "light and camera see where it is";
    for (std::size_t i = 0; i < mesh.positions.size(); i += 17)
        EXPECT_NEAR(glm::distance(pose->position(i), bent(glm::dvec3(rest.positions[i]))), 0, 0.1) << "a chord below its arc";
    for (const MeshPart& part : mesh.parts)
        for (const MeshCluster& cluster : part.clusters)
            for (std::uint32_t k = 0; k < cluster.indexCount; ++k) {
                const std::uint32_t vertex = mesh.indices[part.firstIndex + cluster.firstIndex + k];
                ASSERT_LE(glm::distance(pose->position(vertex), glm::dvec3(cluster.centre)), static_cast<double>(cluster.radius) * 1.0001);
            }
}

TEST(Pose, of_other_triangles_is_none) {
    const Seated seated;
    Mesh other = seated.mesh();
    std::swap(other.indices[0], other.indices[1]);
    EXPECT_FALSE(sameTriangles(seated.mesh(), other));
    other = seated.mesh();
    other.indices.resize(other.indices.size() - 3);
    EXPECT_FALSE(sameTriangles(seated.mesh(), other)) << "triangles are missing that are no ribbons";
    EXPECT_TRUE(sameTriangles(seated.mesh(), seated.mesh()));
}
