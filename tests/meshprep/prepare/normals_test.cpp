// One normal per place: right on shapes whose normal is known, whatever the size and however flat faces are cut.
#include "meshprep/prepare/vertex_normals.h"
#include "tests/meshprep/prepare/meshes.h"

#include <cmath>
#include <numbers>
#include <random>

using namespace tegument;
using namespace tegument::prep;
using namespace tegument::testing_prep;

namespace {

/// A cube's corner at the origin, in some rotation, each of its three faces cut at random into one to four triangles that meet there.
struct Corner {
    Mesh mesh;
    glm::dvec3 normal{0};
};

Corner randomCorner(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const auto direction = [&] { return glm::normalize(glm::dvec3(any(random), any(random), any(random))); };
    const glm::dvec3 x = direction();
    const glm::dvec3 y = glm::normalize(glm::cross(x, direction()));
    const std::array<glm::dvec3, 3> axes = {x, y, glm::cross(x, y)};
    Corner corner;
    corner.normal = -glm::normalize(axes[0] + axes[1] + axes[2]); // the cube lies along the axes, the corner looks away from it
    const glm::dvec3 offset(10 * any(random), 10 * any(random), 10 * any(random));
    std::vector<glm::vec3> positions = {glm::vec3(offset)};
    std::vector<std::uint32_t> indices;
    for (std::size_t face = 0; face < 3; ++face) {
        std::vector<double> cuts = {0, 1};
        for (auto extra = random() % 4; extra > 0; --extra)
            cuts.push_back(static_cast<double>(1 + random() % 998) / 1000);
        std::ranges::sort(cuts);
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const double t : cuts) // from one edge of the face to the other, along its diagonal; seen from outside counter-clockwise
            positions.emplace_back(offset + 2.0 * (t * axes[face] + (1 - t) * axes[(face + 1) % 3]));
        for (std::uint32_t i = 0; i + 1 < cuts.size(); ++i)
            indices.insert(indices.end(), {0, first + i, first + i + 1});
    }
    corner.mesh = meshOf(std::move(positions), std::move(indices));
    return corner;
}

struct Errors {
    double mean = 0;
    double most = 0;
};

Errors errorsOf(NormalMode mode) {
    constexpr int kTrials = 2000;
    std::mt19937 random(1);
    Errors errors;
    for (int i = 0; i < kTrials; ++i) {
        const Corner corner = randomCorner(random);
        Surface surface = surfaceOf(corner.mesh);
        makeNormals(surface, {.mode = mode});
        const double error = degreesBetween(surface.mesh.normals[0], corner.normal);
        errors.mean += error / kTrials;
        errors.most = std::max(errors.most, error);
    }
    return errors;
}

constexpr std::array kModes = {NormalMode::Sum, NormalMode::Seed, NormalMode::UniqueTolerance, NormalMode::Angle, NormalMode::Keep};

Mesh tetraOfSize(float size) {
    return meshOf({{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
}

} // namespace

TEST(CornerNormals, weighted_by_angle_are_right_however_the_faces_are_cut) {
    const Errors errors = errorsOf(NormalMode::Angle);
    // float positions around 10 with edges of 1 to 2: each direction is good to 1e-6 radians, thin triangles to some hundred times that
    EXPECT_LT(errors.mean, 0.02);
    EXPECT_LT(errors.most, 0.2);
}

TEST(CornerNormals, unique_with_a_tolerance_are_right_however_the_faces_are_cut) {
    const Errors errors = errorsOf(NormalMode::UniqueTolerance);
    EXPECT_LT(errors.mean, 0.02);
    EXPECT_LT(errors.most, 0.3); // a face whose triangles differ by more than the tolerance counts twice
}

TEST(CornerNormals, unique_bit_for_bit_are_no_better_than_the_sum_of_all) {
    const Errors sum = errorsOf(NormalMode::Sum);
    const Errors seed = errorsOf(NormalMode::Seed);
    EXPECT_GT(sum.mean, 10) << "degrees: faces of more triangles pull";
    EXPECT_NEAR(seed.mean, sum.mean, 0.15 * sum.mean) << "rounding makes nearly every normal unique";
}

TEST(CornerNormals, unique_bit_for_bit_are_right_where_the_file_stores_equal_normals) {
    Mesh mesh = makeShape(Shape::Cube);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
        const glm::vec3 face =
            glm::normalize(glm::cross(mesh.positions[i + 1] - mesh.positions[i], mesh.positions[i + 2] - mesh.positions[i]));
        mesh.normals.insert(mesh.normals.end(), 3, face);
    }
    Surface surface = surfaceOf(std::move(mesh));
    makeNormals(surface, {.mode = NormalMode::Seed});
    for (std::size_t i = 0; i < surface.mesh.positions.size(); ++i)
        EXPECT_LT(degreesBetween(surface.mesh.normals[i], surface.mesh.positions[i]), 1e-4);
}

TEST(VertexNormals, are_unit_in_every_mode_for_meshes_of_any_size) {
    for (const float size : {1e-40f, 1e-20f, 1.0f, 1e20f, 1e38f})
        for (const NormalMode mode : kModes) {
            Surface surface = surfaceOf(tetraOfSize(size));
            makeNormals(surface, {.mode = mode});
            for (const glm::vec3& normal : surface.mesh.normals)
                EXPECT_NEAR(glm::length(glm::dvec3(normal)), 1, 1e-6) << size << " mode " << static_cast<int>(mode);
            EXPECT_LT(degreesBetween(surface.mesh.normals[0], glm::dvec3(-1)), 1e-3) << size << " mode " << static_cast<int>(mode);
        }
}

TEST(VertexNormals, agree_at_one_place_across_a_seam_of_texture_coordinates) {
    Mesh mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 0, 1}}, {0, 1, 2, 3, 4, 5});
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {0.5f, 0.5f}, {1, 1}, {0, 0.5f}};
    Surface surface = surfaceOf(std::move(mesh));
    makeNormals(surface, {});
    EXPECT_EQ(surface.mesh.normals[0], surface.mesh.normals[3]);
    EXPECT_EQ(surface.mesh.normals[2], surface.mesh.normals[4]);
}

TEST(VertexNormals, of_a_fan_of_valence_100000_take_linear_time_in_every_mode) {
    constexpr std::uint32_t kValence = 100000;
    std::vector<glm::vec3> positions = {{0, 0, 1}};
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < kValence; ++i) {
        const double angle = 2 * std::numbers::pi * i / kValence;
        positions.emplace_back(std::cos(angle), std::sin(angle), 0.3 * std::sin(7 * angle));
        indices.insert(indices.end(), {0, 1 + i, 1 + (i + 1) % kValence});
    }
    for (const NormalMode mode : kModes) {
        Surface surface = surfaceOf(meshOf(positions, indices));
        makeNormals(surface, {.mode = mode}); // a quadratic search would take minutes, and the test's time runs out
        EXPECT_GT(surface.mesh.normals[0].z, 0.5f);
    }
}

TEST(VertexNormals, of_a_fold_in_a_surface_are_shared_with_the_surface) {
    // A square of two triangles, and on one of its edges a fold: a triangle and its flip.
    Surface surface = surfaceOf(meshOf({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0, 1}}, {0, 1, 2, 0, 2, 3, 0, 1, 4, 1, 0, 4}));
    const NormalChanges changes = makeNormals(surface, {});
    EXPECT_EQ(changes.split, 0u);
    EXPECT_LT(degreesBetween(surface.mesh.normals[0], {0, 0, 1}), 1e-3) << "the fold's two sides cancel, the surface is left";
}
