// Parts that references are put together from, each against a closed form of its own: places of a mesh, cameras, maps, lattices.
// Blurs in millimetres: what a map of any size must agree on.

#include "lab/reference/chart_map.h"
#include "lab/reference/fur_body.h"
#include "lab/reference/fur_exact.h"
#include "lab/reference/fur_patch.h"
#include "lab/reference/pinhole.h"
#include "lab/reference/skin.h"
#include "lab/reference/surface.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tegument::reference {
namespace {

class RandomPlaces {
public:
    glm::dvec3 inCube(double half) { return {number(half), number(half), number(half)}; }

private:
    double number(double half) { return std::uniform_real_distribution(-half, half)(random_); }
    std::mt19937 random_{11};
};

/// Distance to a triangle: to its plane where the foot lies within its three edges, else to the nearest edge.
double distanceTo(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    const glm::dvec3 foot = p - normal * glm::dot(p - t[0], normal);
    bool within = true;
    double least = 1e300;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = t[i], edge = t[(i + 1) % 3] - a;
        within = within && glm::dot(glm::cross(edge, foot - a), normal) >= 0;
        const double along = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
        least = std::min(least, glm::distance(p, a + along * edge));
    }
    return within ? glm::distance(p, foot) : least;
}

TEST(NearestSkin, is_the_nearest_place_of_all_triangles_off_their_middle_edges_and_corners) {
    RandomPlaces random;
    for (int trial = 0; trial < 40; ++trial) {
        Mesh mesh;
        for (std::uint32_t i = 0; i < 12; ++i) {
            mesh.positions.emplace_back(random.inCube(10));
            mesh.indices.push_back(i);
        }
        mesh.normals.assign(12, {0, 0, 1});
        const RayScene skin(mesh);
        for (int i = 0; i < 25; ++i) {
            const glm::dvec3 point = random.inCube(14);
            double least = 1e300;
            for (std::size_t t = 0; t < 4; ++t)
                least = std::min(least, distanceTo({glm::dvec3(mesh.positions[3 * t]), glm::dvec3(mesh.positions[3 * t + 1]),
                                                    glm::dvec3(mesh.positions[3 * t + 2])},
                                                   point));
            const auto found = nearestSkin(skin, point, 60);
            ASSERT_TRUE(found);
            EXPECT_NEAR(found->distance, least, 1e-9);
            EXPECT_NEAR(glm::distance(found->position, point), least, 1e-9) << "the place is where the distance says";
        }
    }
}

TEST(OnFurBody, is_the_nearest_place_of_a_tube_even_from_its_middle) {
    const FurBody torus{.ring = 30, .radius = 10};
    RandomPlaces random;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 point = i == 0 ? glm::dvec3(30, 0, 0) : i == 1 ? glm::dvec3(0) : random.inCube(50);
        const OnFurBody place = onFurBody(torus, point);
        EXPECT_NEAR(glm::length(place.normal), 1, 1e-12) << i;
        EXPECT_NEAR(std::hypot(std::hypot(place.skin.x, place.skin.z) - 30, place.skin.y), 10, 1e-12) << "on the tube";
        EXPECT_NEAR(place.distance, std::hypot(std::hypot(point.x, point.z) - 30, point.y) - 10, 1e-12);
        EXPECT_NEAR(glm::distance(place.skin, point), std::abs(place.distance), 1e-12);
    }
}

TEST(OutsideFacet, lies_on_the_ball_that_normals_mean_and_stays_where_they_bend_inwards) {
    const Mesh ball = sphereMesh(10, 2);
    Mesh hollow = ball;
    for (glm::vec3& normal : hollow.normals)
        normal = -normal;
    const Place middle{.triangle = 5, .weights = glm::dvec3(1.0 / 3)};
    const SurfacePoint flat = interpolate(ball, middle);
    const double low = glm::length(flat.position);
    ASSERT_LT(low, 9.9);
    // Over the middle of three corners on the ball: each plane stands 10 - low^2 / 10 over it along its normal, of which low / 10 is up.
    EXPECT_NEAR(glm::length(outsideFacet(ball, flat)) - low, low * (1 - low * low / 100), 0.01 * (10 - low))
        << "its sides are not quite equal";
    EXPECT_LT(glm::distance(outsideFacet(hollow, interpolate(hollow, middle)), flat.position), 1e-12);
}

TEST(Unwrapped, holds_places_whose_coordinates_are_the_texels_centres) {
    const Mesh mesh = plane(10, 3);
    const Unwrapped map = unwrap(mesh, 16);
    int found = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            if (const auto& place = map.at(x, y)) {
                ++found;
                EXPECT_NEAR(place->weights.x + place->weights.y + place->weights.z, 1, 1e-12);
                EXPECT_LT(glm::distance(interpolate(mesh, *place).uv, (glm::dvec2(x, y) + 0.5) / 16.0), 1e-7) << "coordinates are floats";
            }
    EXPECT_EQ(found, 256);
}

TEST(ReferenceTexture, is_itself_at_texels_centres_and_their_mean_half_way) {
    const Image image{.width = 3, .height = 2, .channels = 1, .pixels = {1, 2, 4, 8, 16, 32}};
    const Texture texture(image, false);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            EXPECT_NEAR(texture.at((glm::dvec2(x, y) + 0.5) / glm::dvec2(3, 2)).x, image.at(x, y, 0), 1e-12);
    EXPECT_NEAR(texture.at(glm::dvec2(1.0 / 3, 0.5)).x, (1 + 2 + 8 + 16) / 4.0, 1e-12);
    EXPECT_NEAR(texture.at(glm::dvec2(1, 1)).x, 32, 1e-12) << "clamped";
}

TEST(PinholeView, shows_what_lies_before_it_within_its_border) {
    const Pinhole view = pinhole({0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.4), 200, 100); // 8 x 4 mm at the origin, 25 pixels a mm
    for (const glm::dvec3& side : {glm::dvec3(4, 0, 0), glm::dvec3(-4, 0, 0), glm::dvec3(0, 2, 0), glm::dvec3(0, -2, 0)}) {
        const glm::dvec3 pixel = glm::normalize(side) / 25.0;
        EXPECT_TRUE(view.shows(side - 0.1 * pixel));
        EXPECT_FALSE(view.shows(side + 0.1 * pixel));
        EXPECT_TRUE(view.shows(side + 2.9 * pixel, 3));
        EXPECT_FALSE(view.shows(side + 3.1 * pixel, 3));
    }
    EXPECT_FALSE(view.shows({0, 0, 11})) << "behind the eye";
}

TEST(PinholeView, of_a_light_holds_the_ball_and_hardly_more) {
    for (const double distance : {1.2, 3.0, 50.0}) {
        const Pinhole view = lightPyramid({0, 0, distance * 10}, {0, 0, 0}, 10, 64);
        // A cone that touches the ball: its half angle has the sine radius / distance.
        const double touching = std::tan(std::asin(1 / distance));
        EXPECT_GE(view.tangentX, touching);
        EXPECT_LE(view.tangentX, touching * 1.01 + 0.01 * std::pow(touching, 3)) << "a thousandth more of the radius";
        EXPECT_EQ(view.tangentX, view.tangentY);
    }
}

/// A roof of 20 mm 20 mm above the ground, light 500 mm above it: its shadow ends 10 * 500 / 480 mm aside.
TEST(NearShadowEdge, is_what_lies_within_texels_of_it_on_the_side_that_faces_the_light) {
    const Mesh mesh = joined(plane(60, 4), plane(10, 2, 20));
    const Pinhole light = pinhole({0, 0, 500}, glm::dvec3(0), {0, 1, 0}, 2 * std::atan(0.128), 256, 256); // 0.5 mm a texel on the ground
    const SkinScene scene(mesh, light, glm::dvec3(1), {});
    const auto near = [&](double x, double up) {
        SurfacePoint point{.place = {0, glm::dvec3(1.0 / 3)}, .position = {x, 1, 0}, .normal = {0, 0, up}};
        return scene.nearShadowEdge(point, 2);
    };
    const double edge = 10 * 500.0 / 480;
    for (const double away : {0.0, 0.8, -0.8})
        EXPECT_TRUE(near(edge + away, 1)) << away;
    for (const double x : {0.0, edge - 1.5, edge + 1.5, 40.0})
        EXPECT_FALSE(near(x, 1)) << x;
    EXPECT_FALSE(near(edge, -1)) << "looks away: its own shadow";
}

TEST(FurLattices, are_the_same_at_any_size_and_their_tints_vary_as_asked) {
    const auto grow = [](double size) {
        Mesh mesh = sphereMesh(static_cast<float>(20 * size), 3);
        const RayScene skin(mesh);
        return latticeOn(skin, {.spacing = size, .shortest = 0.5, .variation = 0.4}, [](const glm::dvec3&) { return true; });
    };
    const auto strands = grow(1);
    EXPECT_NEAR(static_cast<double>(grow(0.25).size()), static_cast<double>(strands.size()), 0.001 * static_cast<double>(strands.size()));
    double mean = 0, least = 1e300, most = 0;
    for (const FurGrown& strand : strands) {
        mean += strand.tint / static_cast<double>(strands.size());
        least = std::min(least, strand.tint);
        most = std::max(most, strand.tint);
    }
    ASSERT_GT(strands.size(), 3000U);
    EXPECT_NEAR(mean, 1, 4 * 0.4 / std::sqrt(12.0 * 3000)) << "four standard errors";
    EXPECT_NEAR(least, 0.8, 0.01);
    EXPECT_NEAR(most, 1.2, 0.01);
}

using namespace tegument::reference;

constexpr float kHalf = 10; // mm
constexpr double kKernel = 0.5;

/// One lit texel in the middle of a plane of 20 mm.
ChartMap litTexel(int size) {
    ChartMap chart = chartMap(plane(kHalf, 4), size, [](const SurfacePoint&) { return glm::dvec4(0, 0, 0, kKernel); });
    chart.map.texels[chart.map.index(size / 2, size / 2)] = glm::dvec4(1, 1, 1, kKernel);
    return chart;
}

/// mm^2, mean of both axes.
double varianceOf(const ChartMap& chart, const Map& blurred) {
    double weight = 0;
    glm::dvec2 first(0);
    double second = 0;
    for (int y = 0; y < blurred.size; ++y)
        for (int x = 0; x < blurred.size; ++x) {
            const double light = blurred.texels[blurred.index(x, y)].x;
            const glm::dvec2 place = glm::dvec2(x, y) / chart.densityAt(blurred.size / 2, blurred.size / 2);
            weight += light;
            first += light * place;
            second += light * glm::dot(place, place);
        }
    const glm::dvec2 mean = first / weight;
    return (second / weight - glm::dot(mean, mean)) / 2;
}

} // namespace

TEST(ChartMap, density_is_texels_over_millimetres) {
    for (const int size : {32, 128}) {
        const ChartMap chart = litTexel(size);
        for (const glm::dvec2& density : chart.density) {
            EXPECT_NEAR(density.x, size / 20.0, size * 1e-6); // positions are 32-bit floats
            EXPECT_NEAR(density.y, size / 20.0, size * 1e-6);
        }
    }
}

TEST(ChartMap, a_gaussian_has_its_variance_on_the_surface_at_any_size) {
    for (const int size : {32, 64, 128}) {
        const ChartMap chart = litTexel(size);
        const double texel = 20.0 / size;
        // What the map shows is spread by the texel's square once more.
        EXPECT_NEAR(varianceOf(chart, spread(chart, 1.99)) + texel * texel / 12, 1.99, 1e-4) << size;
    }
}

TEST(ChartMap, discs_have_the_variance_of_their_thirteen_points) {
    const ChartMap chart = litTexel(256);
    glm::dvec2 mean(0);
    for (const auto& p : kPrintedDisc)
        mean += glm::dvec2(p[0], p[1]) / 12.0;
    double points = 0; // of the centred disc and the texel itself, mean of both axes
    for (const auto& p : kPrintedDisc)
        points += glm::dot(glm::dvec2(p[0], p[1]) - mean, glm::dvec2(p[0], p[1]) - mean) / 26;
    const double radius = 1.6 * kKernel;
    for (const int count : {1, 2, 3}) {
        const double variance = varianceOf(chart, spread(chart, Discs{.size = 1.6, .count = count}));
        // Taps fall on whole texels, up to half of one aside: 5 % of the radius.
        EXPECT_NEAR(variance, count * points * radius * radius, 0.05 * count * points * radius * radius) << count << " discs";
    }
}

TEST(ChartMap, printed_discs_are_sized_in_texels) {
    const Discs printed{.size = 3, .turn = 0, .count = 1, .asPrinted = true};
    const double small = varianceOf(litTexel(64), spread(litTexel(64), printed));
    const double large = varianceOf(litTexel(128), spread(litTexel(128), printed));
    EXPECT_NEAR(small, 4 * large, 1e-6 * small); // positions are 32-bit floats
}

TEST(ChartMap, discs_leave_alpha_and_constant_light_as_they_are) {
    const ChartMap chart = chartMap(plane(kHalf, 4), 48, [](const SurfacePoint&) { return glm::dvec4(0.25, 0.5, 1, kKernel); });
    for (const bool printed : {false, true})
        for (const glm::dvec4& texel : spread(chart, Discs{.asPrinted = printed}).texels)
            EXPECT_LT(glm::length(texel - glm::dvec4(0.25, 0.5, 1, kKernel)), 1e-12);
}

} // namespace tegument::reference
