// What the eye sees of a mesh by the surface integral: shadows, plain material, slabs; points chosen; results kept on disk.

#include "host/support/file.h"
#include "lab/reference/bssrdf.h"
#include "tests/lab/reference/meshes.h"
#include "tests/lab/reference/near.h"
#include "tests/lab/reference/own_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

using namespace tegument;
using namespace tegument::reference;

namespace {

constexpr double kFar = 1e5; // mm: the light is as good as directional

const glm::dvec3 kFallback(0.8, 0.6, 0.5); // colour where the mesh has no map

Pinhole lightAt(const glm::dvec3& eye) {
    return lightPyramid(eye, {0, 0, 0}, 45, 256);
}

ShadedPoint at(const Mesh& mesh, const RayScene& rays, double x, double y) {
    const auto hit = rays.nearest({x, y, 500}, {0, 0, -1});
    return {0, 0, interpolate(mesh, hit->place)};
}

/// An image of one texel.
EmbeddedTexture constantMap(const std::string& role, const glm::vec4& value) {
    return {role, {.width = 1, .height = 1, .channels = 4, .pixels = {value.r, value.g, value.b, value.a}, .metadata = {}}};
}

BssrdfOptions uncached() {
    BssrdfOptions options;
    options.cached = false;
    return options;
}

class BssrdfCache : public OwnCache {
protected:
    /// Radiance in the middle of a plane, and whether it had to be computed.
    std::pair<glm::dvec3, bool> compute(double fineness) {
        const SkinScene skin(mesh_, lightAt({0, 0, kFar}), glm::dvec3(1), skinSettings("corrected"));
        BssrdfOptions options;
        options.quadrature.fineness = fineness;
        bool computed = false;
        options.progress = [&](std::size_t, std::size_t) { computed = true; };
        const std::vector<ShadedPoint> points = {at(mesh_, skin.rays(), 0, 0)};
        return {radiance(skin, points, {0, 0, 500}, options).front().diffuse, computed};
    }

    [[nodiscard]] std::vector<std::filesystem::path> files() const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder() / "reference"))
            found.push_back(entry.path());
        return found;
    }

    Mesh mesh_ = plane(20, 8);

private:
};

} // namespace

TEST(Bssrdf, a_plane_lit_and_seen_from_above_keeps_its_colour_but_for_what_the_surface_reflects) {
    const Mesh mesh = plane(30, 20);
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), {1.5, 1.5, 1.5}, skinSettings("corrected"));
    const std::vector<ShadedPoint> points = {at(mesh, skin.rays(), 0.2, 0.1)};
    const Radiance seen = radiance(skin, points, {0.2, 0.1, 500}, uncached()).front();
    const double through = skin.diffuseShare(1);
    expectNear(seen.diffuse, 1.5 * kFallback * through * through, 1e-5); // light at 100 m: cosines of 1 - 1e-7
}

TEST(Bssrdf, a_shadow_s_edge_is_the_half_plane_of_the_closed_form) {
    // A screen 100 mm above covers x < 0, far enough from light to leave a sharp edge.
    Mesh screen = plane(30, 2, 100);
    for (glm::vec3& p : screen.positions)
        p.x -= 30;
    const Mesh mesh = joined(plane(30, 40), screen);
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), glm::dvec3(1), skinSettings("corrected"));
    const RayScene ground(mesh);
    for (const double x : {0.05, 0.4, 2.0}) {
        const std::vector<ShadedPoint> points = {at(mesh, ground, x, 0.1)};
        const Radiance seen = radiance(skin, points, {x, 0.1, 500}, uncached()).front();
        const double through = skin.diffuseShare(1);
        expectNear(seen.diffuse, kFallback * through * through * halfPlane(skinProfile(), x), 1e-3); // as the integral at an edge
    }
}

TEST(Bssrdf, light_passes_through_a_slab_as_the_closed_form_says) {
    Mesh back = plane(30, 20, -3);
    for (std::size_t i = 0; i < back.indices.size(); i += 3)
        std::swap(back.indices[i], back.indices[i + 1]);
    for (glm::vec3& normal : back.normals)
        normal.z = -1;
    const Mesh mesh = joined(plane(30, 20), back);
    const SkinScene skin(mesh, lightAt({0, 0, -kFar}), glm::dvec3(1), skinSettings("corrected"));
    const std::vector<ShadedPoint> points = {at(mesh, skin.rays(), 0.2, 0.1)};
    const Radiance seen = radiance(skin, points, {0.2, 0.1, 500}, uncached()).front();
    const double through = skin.diffuseShare(1);
    expectNear(seen.diffuse, kFallback * through * through * slab(skinProfile(), 3), 1e-5);
    EXPECT_EQ(seen.specular, glm::dvec3(0));
}

TEST(Bssrdf, plain_material_is_lit_without_diffusion) {
    Mesh mesh = plane(30, 20);
    mesh.textures = {constantMap("color", {1, 1, 1, 0})};
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), glm::dvec3(0.6), skinSettings("corrected"));
    const std::vector<ShadedPoint> points = {at(mesh, skin.rays(), 0.2, 0.1)};
    expectNear(radiance(skin, points, {0, 0, 500}, uncached()).front().diffuse, glm::dvec3(0.6), 1e-5);
}

TEST(Bssrdf, plain_material_gives_no_light_to_skin_beside_it) {
    Mesh mesh = plane(30, 20);
    EmbeddedTexture halves = constantMap("color", {1, 1, 1, 1});
    halves.image.width = 2; // alpha falls from 1 to 0 from left to right, 1/2 in the middle
    halves.image.pixels = {1, 1, 1, 1, 1, 1, 1, 0};
    mesh.textures = {halves};
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), glm::dvec3(1), skinSettings("corrected"));
    const std::vector<ShadedPoint> points = {at(mesh, skin.rays(), -1, 0)};
    const double alpha = skin.colour(points[0].point).w;
    const double through = skin.diffuseShare(1);
    const glm::dvec3 skinHere = through * through * halfPlane(skinProfile(), 1);
    expectNear(radiance(skin, points, {-1, 0, 500}, uncached()).front().diffuse, glm::mix(glm::dvec3(1), skinHere, alpha), 1e-3);
}

TEST(Bssrdf, is_the_same_on_every_run) {
    const Mesh mesh = sphereMesh(20, 4);
    const SkinScene skin(mesh, lightAt({200, 300, 400}), glm::dvec3(1), skinSettings("corrected"));
    const auto points = visiblePoints(skin, pinhole({0, 0, 200}, {0, 0, 0}, {0, 1, 0}, 0.3, 64, 64), 20);
    const auto first = radiance(skin, points, {0, 0, 200}, uncached());
    const auto second = radiance(skin, points, {0, 0, 200}, uncached());
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(first[i].diffuse, second[i].diffuse);
}

TEST(VisiblePoints, are_spread_evenly_over_what_is_seen) {
    const Mesh mesh = plane(30, 4);
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), glm::dvec3(1), skinSettings("corrected"));
    const Pinhole camera = pinhole({0, 0, 100}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.3), 64, 64); // the plane fills the picture
    const auto points = visiblePoints(skin, camera, 256);
    ASSERT_EQ(points.size(), 256U);
    std::set<std::pair<int, int>> blocks; // of 4 x 4 pixels: one point in each
    for (const ShadedPoint& p : points)
        blocks.insert({p.x / 4, p.y / 4});
    EXPECT_EQ(blocks.size(), 256U);
}

TEST(VisiblePoints, lie_where_their_pixels_look) {
    const Mesh mesh = sphereMesh(20, 4);
    const SkinScene skin(mesh, lightAt({200, 300, 400}), glm::dvec3(1), skinSettings("corrected"));
    const Pinhole camera = pinhole({0, 0, 200}, {0, 0, 0}, {0, 1, 0}, 0.3, 64, 48);
    for (const ShadedPoint& p : visiblePoints(skin, camera, 50)) {
        const glm::dvec2 pixel = camera.project(p.point.position) * glm::dvec2(64, 48);
        EXPECT_NEAR(pixel.x, p.x + 0.5, 1e-9);
        EXPECT_NEAR(pixel.y, p.y + 0.5, 1e-9);
    }
}

TEST(VisiblePoints, are_every_covered_pixel_when_no_count_is_given) {
    const Mesh mesh = plane(30, 4);
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), glm::dvec3(1), skinSettings("corrected"));
    const Pinhole camera = pinhole({0, 0, 100}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.6), 64, 64); // the plane fills a quarter
    EXPECT_EQ(visiblePoints(skin, camera, 0).size(), 32U * 32U);
    EXPECT_EQ(visiblePoints(skin, camera, 100000).size(), 32U * 32U);
}

TEST(VisiblePoints, of_a_camera_that_looks_away_are_none_and_need_no_light) {
    const Mesh mesh = plane(30, 4);
    const SkinScene skin(mesh, lightAt({0, 0, kFar}), glm::dvec3(1), skinSettings("corrected"));
    const auto points = visiblePoints(skin, pinhole({0, 0, 100}, {0, 0, 200}, {0, 1, 0}, 0.3, 8, 8), 16);
    EXPECT_TRUE(points.empty());
    EXPECT_TRUE(radiance(skin, points, {0, 0, 100}, uncached()).empty());
}

TEST_F(BssrdfCache, keeps_a_result_bit_for_bit) {
    const auto [first, computed] = compute(0.5);
    const auto [second, again] = compute(0.5);
    EXPECT_TRUE(computed);
    EXPECT_FALSE(again);
    EXPECT_EQ(first, second);
}

TEST_F(BssrdfCache, does_not_take_one_quadrature_s_result_for_another_s) {
    EXPECT_TRUE(compute(0.5).second);
    EXPECT_TRUE(compute(0.6).second);
}

TEST_F(BssrdfCache, does_not_take_one_mesh_s_result_for_another_s) {
    EXPECT_TRUE(compute(0.5).second);
    mesh_.positions[40].z += 0.001F;
    EXPECT_TRUE(compute(0.5).second);
}

TEST_F(BssrdfCache, computes_again_what_was_cut_short_or_changed) {
    const glm::dvec3 truth = compute(0.5).first;
    const auto path = files().at(0);
    std::string bytes = *readFile(path);
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    for (const std::string& damaged : {bytes, bytes.substr(0, bytes.size() - 1), std::string()}) {
        ASSERT_TRUE(writeFile(path, damaged));
        const auto [value, computed] = compute(0.5);
        EXPECT_TRUE(computed) << damaged.size() << " bytes";
        EXPECT_EQ(value, truth);
    }
}

TEST(Burley, half_plane_is_the_integral_of_what_lies_within_each_radius) {
    const glm::dvec3 d(.451, .104, .070);
    // Light on x > a: the share of a ring of radius r that it covers is acos(a / r) / pi.
    for (const double a : {0.05, 0.3, 1.0}) {
        glm::dvec3 sum(0);
        constexpr int kRings = 400000;
        for (int i = 0; i < kRings; ++i) {
            const double near = a + 20 * std::pow(i / static_cast<double>(kRings), 3);
            const double far = a + 20 * std::pow((i + 1) / static_cast<double>(kRings), 3);
            sum += (burleyWithin(d, far) - burleyWithin(d, near)) * (std::acos(2 * a / (near + far)) / M_PI);
        }
        expectNear(burleyHalfPlane(d, -a), sum, 1e-6);
    }
}
