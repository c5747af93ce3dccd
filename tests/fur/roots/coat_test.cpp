// Lean and density of the coat, as shaders read them at vertices, against what they are there.
#include "meshprep/fur/roots/root_texture.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include "meshprep/fur/roots/scatter.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

FurMap densityHalves(float left, float right) {
    Image image{.width = 2, .height = 1, .channels = 1, .pixels = {left, right}, .metadata = {}};
    return FurMap(DdsTexture{.images = {image}});
}

/// A cube map that is white towards +Y and black elsewhere.
FurMap whiteAbove() {
    DdsTexture texture{.faces = 6, .images = {}};
    for (int face = 0; face < 6; ++face)
        texture.images.push_back(
            {.width = 1, .height = 1, .channels = 3, .pixels = std::vector<float>(3, face == 2 ? 1.0F : 0.0F), .metadata = {}});
    return FurMap(std::move(texture));
}

} // namespace

TEST(Coat, leans_at_any_vertex_as_the_comb_does) {
    const Built built = build(ball(50), {.count = 20'000, .lean = 0.5, .comb = {0, -1, 0}});
    double worst = 0;
    for (std::size_t i = 0; i < built.mesh.positions.size(); ++i) {
        const glm::vec3 n = built.mesh.normals[i];
        const glm::vec3 exact = 0.5F * (glm::vec3(0, -1, 0) + n * n.y);
        const glm::vec4 found = built.coat(built.mesh.positions[i]);
        worst = std::max(worst, static_cast<double>(glm::distance(glm::vec3(found), exact)));
        EXPECT_NEAR(found.w, 1, 1e-3);
    }
    // The lean bends by 2 / R^2: between nodes 4 spacings apart, and in a mean over 7, that is a few (4 / 40)^2 of it.
    EXPECT_LT(worst, 0.02);
}

TEST(Coat, has_no_step_where_bricks_meet) {
    const Built built = build(ball(50), {.count = 5000, .lean = 0.5, .comb = {1, 2, 0}});
    const FurSurface surface(built.mesh);
    const float side = static_cast<float>(built.texture.brick * built.set.cell);
    const glm::vec3 origin(built.texture.image.at(0, 0, 0), built.texture.image.at(0, 0, 1), built.texture.image.at(0, 0, 2));
    std::size_t tried = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        glm::vec3 place = surface.toMesh(surface.point(rootNoise(i, 3)).position);
        const auto axis = static_cast<glm::length_t>(i % 3);
        place[axis] = origin[axis] + side * std::round((place[axis] - origin[axis]) / side); // onto the nearest wall
        glm::vec3 before = place;
        glm::vec3 after = place;
        before[axis] -= 1e-3F * side;
        after[axis] += 1e-3F * side;
        const glm::vec4 a = built.coat(before);
        const glm::vec4 b = built.coat(after);
        if (a.w == 0 || b.w == 0) continue; // beside the surface, where there is no brick
        ++tried;
        EXPECT_LT(glm::distance(a, b), 2e-3F * 0.5F * 4) << "as much as a slope makes that turns the whole lean round within a brick";
    }
    EXPECT_GT(tried, 1000u);
}

TEST(Coat, is_as_dense_as_the_map) {
    const Built built = build(plate(), {.count = 8000, .densityMap = densityHalves(1, 0.2F)});
    for (int i = 2; i < 98; ++i)
        for (int j = 2; j < 98; ++j) {
            const double u = 0.01 * i;
            const double ramp = u < 0.25 ? 0.6 + 1.6 * u : u < 0.75 ? 1.4 - 1.6 * u : 1.6 * u - 1; // bilinear, repeating
            // The ramp's corners at 1/4 and 3/4 are rounded off within 7.2 spacings, 8 mm, by less than half of what it rises in that.
            EXPECT_NEAR(built.coat(glm::vec3(i, j, 0)).w, ramp, 0.016 * 8 / 2) << u;
        }
}

TEST(Coat, ends_where_the_density_does_and_keeps_its_lean) {
    const Built built = build(ball(50), {.count = 20'000, .lean = 0.5, .comb = {1, 0, 0}, .densityMap = whiteAbove()});
    EXPECT_NEAR(built.coat({0, 50, 0}).w, 1, 1e-3);
    for (const glm::vec3& bald : {glm::vec3(0, -50, 0), glm::vec3(0, 0, 50), glm::vec3(0, 0, -50)}) {
        EXPECT_NEAR(built.coat(bald).w, 0, 1e-3);
        EXPECT_LT(glm::distance(glm::vec3(built.coat(bald)), glm::vec3(0.5F, 0, 0)), 0.02F) << "where nothing stands, too";
    }
}

TEST(Coat, is_bald_where_the_length_is_0) {
    const Built built = build(ball(50), {.count = 5000, .lengthMap = whiteAbove()});
    EXPECT_NEAR(built.coat({0, 50, 0}).w, 1, 1e-3);
    EXPECT_NEAR(built.coat({0, 0, 50}).w, 0, 1e-3);
}

TEST(Coat, without_maps_and_comb_stands_upright_and_dense) {
    const Built built = build(ball(50), {.count = 2000});
    for (const glm::vec3& place : built.mesh.positions)
        EXPECT_LT(glm::distance(built.coat(place), glm::vec4(0, 0, 0, 1)), 1e-6F);
}

TEST(Coat, is_nothing_far_away) {
    const Built built = build(ball(50), {.count = 1000});
    for (const glm::vec3& place : {glm::vec3(1000, 0, 0), glm::vec3(0, -1000, 0), glm::vec3(0, 0, 1e30F), glm::vec3(0)})
        EXPECT_EQ(built.coat(place), glm::vec4(0));
}

TEST(CoatField, is_exact_for_what_is_linear_on_the_surface) {
    std::vector<CoatSample> samples;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const glm::vec3 p(i, j, 0);
            samples.push_back({.position = p, .lean = {0.01F * p.x, 0.02F * p.y, 0}, .density = 0.02F * p.x});
        }
    const CoatField field(samples, 6);
    for (const glm::vec3& place : {glm::vec3(20.3F, 17.7F, 0), glm::vec3(20.3F, 17.7F, 3), glm::vec3(0.5F, 20, 1)}) {
        const glm::vec4 found = field.at(place);
        // but for the stiffness of slopes, a hundredth of them over the distance to the middle of the samples
        EXPECT_NEAR(found.x, 0.01F * place.x, 0.01);
        EXPECT_NEAR(found.y, 0.02F * place.y, 0.01);
        EXPECT_NEAR(found.w, 0.02F * place.x, 0.01);
    }
    EXPECT_EQ(field.at({20, 20, 6.5F}), glm::vec4(0)) << "nothing is near";
}

TEST(CoatField, of_one_sample_is_that_sample) {
    const std::vector<CoatSample> samples{{.position = {1, 2, 3}, .lean = {0.1F, 0.2F, 0.3F}, .density = 0.5F}};
    const CoatField field(samples, 2);
    EXPECT_LT(glm::distance(field.at({1, 2, 3.5F}), glm::vec4(0.1F, 0.2F, 0.3F, 0.5F)), 0.01F);
}
