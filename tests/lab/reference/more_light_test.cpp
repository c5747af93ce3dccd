// Lamps and surroundings of the reference against closed forms.
// The reflection of the references against published values and against plainer integrals.

#include "lab/reference/more_light.h"
#include "lab/reference/pinhole.h"
#include "lab/reference/radial.h"
#include "lab/reference/skin.h"
#include "lab/reference/specular.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tegument::reference {
namespace {

const Visible kAll = [](const glm::dvec3&, double) { return true; };
const glm::dvec3 kUp(0, 1, 0);

Image evenPanorama(float radiance) {
    return {.width = 128, .height = 64, .channels = 3, .pixels = std::vector<float>(std::size_t{128} * 64 * 3, radiance)};
}

double irradianceOf(const std::vector<Beam>& beams, const glm::dvec3& normal) {
    double sum = 0;
    for (const Beam& beam : beams)
        sum += beam.light.x * glm::dot(beam.towards, normal);
    return sum;
}

TEST(MoreLight, of_an_even_sky_is_its_radiance_whatever_way_a_surface_faces) {
    MoreLight more;
    more.diffuseSky = skyPieces(evenPanorama(0.7F), 12);
    for (const glm::dvec3& normal : {kUp, glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, -2, 3))})
        // 288 pieces: those that the horizon cuts count whole or not at all, 0.6 % at most here.
        EXPECT_NEAR(irradianceOf(beamsAt(more, more.diffuseSky, glm::dvec3(0), normal, kAll), normal), 0.7, 0.7 * 0.006);
}

TEST(MoreLight, of_an_even_sky_is_in_pieces_of_the_same_solid_angle) {
    const std::vector<SkyPiece> pieces = skyPieces(evenPanorama(1), 4);
    ASSERT_EQ(pieces.size(), 32U);
    for (const SkyPiece& piece : pieces) // 4 pi / 32 / pi; a row of texels that is cut counts whole: 64 rows, 16 in a piece
        EXPECT_NEAR(piece.light.x, 0.125, 0.02);
}

/// Light from one texel comes from its centre, in its colour: radiance times its solid angle / pi.
TEST(MoreLight, of_one_bright_texel_of_the_sky_comes_from_there_in_its_colour) {
    constexpr int kWidth = 128, kHeight = 64;
    for (const auto& [x, y] : {std::pair(5, 3), std::pair(64, 40), std::pair(100, 63)})
        for (int channel = 0; channel < 3; ++channel) {
            Image panorama = evenPanorama(0);
            panorama.at(x, y, channel) = 2;
            const std::vector<SkyPiece> pieces = skyPieces(panorama, 6);
            ASSERT_EQ(pieces.size(), 1U);
            const double down = std::numbers::pi * (y + 0.5) / kHeight;
            const double right = 2 * std::numbers::pi * ((x + 0.5) / kWidth - 0.5); // of -z, the middle column
            const glm::dvec3 towards(std::sin(right) * std::sin(down), std::cos(down), -std::cos(right) * std::sin(down));
            EXPECT_LT(glm::distance(pieces[0].direction, towards), 1e-12);
            const double angle = 2 * std::numbers::pi / kWidth * std::numbers::pi / kHeight * std::sin(down);
            for (int other = 0; other < 3; ++other)
                EXPECT_NEAR(pieces[0].light[other], other == channel ? 2 * angle / std::numbers::pi : 0, 1e-3 * angle);
        }
}

TEST(MoreLight, of_a_sphere_is_the_same_from_wherever_it_comes) {
    MoreLight more;
    more.lampSide = 8;
    for (const glm::dvec3 from : {glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 1), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0),
                                  glm::dvec3(0, 0, -1), glm::dvec3(1, 2, 3)}) {
        const glm::dvec3 towards = glm::normalize(from);
        more.lamps = {{.place = glm::dvec4(towards, 0), .colour = {1, 1, 1, 0}, .axis = glm::dvec4(-towards, 0.3)}};
        EXPECT_NEAR(irradianceOf(beamsAt(more, {}, glm::dvec3(0), towards, kAll), towards), 1, 1e-6) << from.x << from.y << from.z;
    }
}

TEST(MoreLight, of_lamps_is_four_numbers_of_each_in_their_order) {
    const auto parameters = lampParameters({{.colour = {1, 2, 3, 4}}, {.colour = {5, 6, 7, 8}}});
    EXPECT_EQ(parameters.size(), 4U);
    EXPECT_EQ(parameters.at("gLampColor"), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(parameters.at("gLampPlace").size(), 8U);
}

TEST(MoreLight, of_a_sphere_has_as_many_directions_as_are_asked_for) {
    MoreLight more;
    more.lamps = {{.place = {0, 100, 0, 1}, .colour = {1, 1, 1, 0}, .axis = {0, -1, 0, 30}}};
    for (const int side : {1, 2, 3}) {
        more.lampSide = side;
        EXPECT_EQ(beamsAt(more, {}, glm::dvec3(0), kUp, kAll).size(), static_cast<std::size_t>(side * side));
    }
}

TEST(MoreLight, of_points_and_spots_is_that_of_the_inverse_square_within_their_cone) {
    MoreLight more;
    more.lamps = {{.place = {0, 300, 0, 1}, .colour = {2, 1, 0.5, 150}, .axis = {0, -1, 0, 0}, .spot = {0.9, 0.8, 1, 1}}};
    const auto below = beamsAt(more, {}, glm::dvec3(0), kUp, kAll);
    ASSERT_EQ(below.size(), 1U);
    EXPECT_NEAR(below[0].light.x, 2 * 0.25, 1e-12);
    // cos = 0.85: half way between the cosines, where a smooth step is a half. The lamp is 300 / 0.85 away.
    const double aside = 300 * std::sqrt(1 - 0.85 * 0.85) / 0.85;
    EXPECT_NEAR(beamsAt(more, {}, glm::dvec3(aside, 0, 0), kUp, kAll)[0].light.x, 2 * 0.25 * 0.85 * 0.85 / 2, 1e-9);
    EXPECT_TRUE(beamsAt(more, {}, glm::dvec3(300, 0, 0), kUp, kAll).empty());
}

TEST(MoreLight, of_a_sphere_lights_a_surface_that_faces_it_as_a_point_does_and_half_hidden_half_as_much) {
    MoreLight more;
    more.lampSide = 32;
    for (const glm::dvec4 place : {glm::dvec4(0, 100, 0, 1), glm::dvec4(0, 1, 0, 0)}) {
        more.lamps = {{.place = place, .colour = {1, 1, 1, 0}, .axis = {0, -1, 0, place.w > 0.5 ? 60.0 : 0.6}}};
        const auto whole = beamsAt(more, {}, glm::dvec3(0), kUp, kAll);
        EXPECT_NEAR(irradianceOf(whole, kUp), 1, 1e-6); // a sphere's light falls on what faces it as if it came from its centre
        for (const Beam& beam : whole)
            EXPECT_GE(beam.towards.y, std::sqrt(1 - 0.36) - 1e-12) << "outside of the sphere";
        const auto half = beamsAt(more, {}, glm::dvec3(0), kUp, [](const glm::dvec3& d, double) { return d.x > 0; });
        EXPECT_NEAR(irradianceOf(half, kUp), 0.5, 0.02); // nodes on the edge
    }
}

TEST(MoreLight, enters_skin_by_its_own_cosine_and_is_hidden_by_the_mesh) {
    const Mesh open = plane(50, 4);
    const Pinhole view = pinhole(glm::dvec3(0, 0, 500), glm::dvec3(0), kUp, 0.4, 16, 16);
    MoreLight more;
    more.diffuseSky = skyPieces(evenPanorama(1), 24);
    SkinSettings settings;
    const SkinScene scene(open, view, glm::dvec3(0), settings, more);
    const SurfacePoint middle = interpolate(open, {0, {0.3, 0.3, 0.4}});
    double crossing = 0; // 2 integral of cos (1 - rho_s albedo(cos))
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps;
        crossing += 2 * cosine *
                    (1 - settings.attenuation * directionalAlbedo(cosine, settings.roughness, settings.fresnel0) / std::numbers::pi) /
                    kSteps;
    }
    const double expected = std::pow(0.8, settings.mix) * crossing;
    EXPECT_NEAR(scene.enteringMore(middle).x, expected, expected * 0.004); // 1,152 pieces
    EXPECT_NEAR(scene.plainMore(middle).x, 0.8, 0.8 * 0.004) << "plain material gives its colour of an even sky of radiance 1";
    // A roof of the same size close above: nothing but what comes in at its sides.
    const Mesh roofed = joined(plane(50, 4), plane(50, 4, 4));
    const SkinScene dark(roofed, view, glm::dvec3(0), settings, more);
    const SurfacePoint below = interpolate(roofed, {12, {0.3, 0.3, 0.4}});
    EXPECT_LT(dark.enteringMore(below).x, 0.05 * expected);
}

using namespace tegument::reference;

constexpr double kF0 = 0.028; // the paper's, of the tables below

/// The integral over light directions, as it is defined: no half vectors, no change of variables.
double albedoOverLight(double cosine, double m, std::size_t polar, int around) {
    const glm::dvec3 toEye{std::sqrt(1 - cosine * cosine), 0, cosine};
    double sum = 0;
    for (const Node& theta : gaussLegendre(polar, 0, 0.5 * std::numbers::pi))
        for (int i = 0; i < around; ++i) {
            const double phi = std::numbers::pi * (i + 0.5) / around;
            const glm::dvec3 toLight{std::sin(theta.x) * std::cos(phi), std::sin(theta.x) * std::sin(phi), std::cos(theta.x)};
            sum += theta.weight * std::sin(theta.x) * toLight.z * kelemenBrdf({0, 0, 1}, toLight, toEye, {.m = m, .f0 = kF0});
        }
    return sum * 2 * std::numbers::pi / around;
}

constexpr double kTableCosines[] = {0.05, 0.2, 0.5, 0.8, 1.0};

} // namespace

TEST(Quadrature, integrates_polynomials_up_to_twice_its_nodes_exactly) {
    for (std::size_t count : {1U, 2U, 5U, 16U, 48U}) {
        double sum = 0;
        const auto degree = static_cast<double>(2 * count - 2);
        for (const Node& node : gaussLegendre(count))
            sum += node.weight * std::pow(node.x, degree);
        EXPECT_NEAR(sum, 2 / (degree + 1), 1e-14) << count << " nodes"; // rounding of a sum of at most 48 terms
    }
}

TEST(BeckmannReference, integrates_with_the_cosine_to_pi) {
    for (double m : {0.05, 0.1, 0.3, 1.0}) {
        double sum = 0;
        for (int panel = 0; panel < 64; ++panel) // narrow lobes need narrow panels
            for (const Node& theta : gaussLegendre(16, panel * std::numbers::pi / 128, (panel + 1) * std::numbers::pi / 128))
                sum += theta.weight * beckmannPH(std::cos(theta.x), m) * std::cos(theta.x) * std::sin(theta.x);
        EXPECT_NEAR(2 * sum, 1, 1e-10) << "m = " << m;
    }
}

/// An independent table of four digits, made with 720 azimuths; its first entry is 1.5385, see the test below.
TEST(DirectionalAlbedoReference, has_the_tabulated_values) {
    constexpr double kRoughness[] = {0.1, 0.2, 0.3, 0.5};
    constexpr double kTable[4][5] = {{1.5393, .8558, .1860, .0883, .0871},
                                     {1.2263, .6107, .1725, .0864, .0844},
                                     {1.0138, .4771, .1478, .0822, .0801},
                                     {.7511, .3363, .1113, .0686, .0665}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column)
            EXPECT_NEAR(directionalAlbedo(kTableCosines[column], kRoughness[row], kF0), kTable[row][column], 0.50001e-4)
                << "m = " << kRoughness[row] << ", cosine = " << kTableCosines[column];
}

TEST(DirectionalAlbedoReference, agrees_with_the_integral_over_light_directions) {
    for (double m : {0.1, 0.3, 1.0})
        for (double cosine : kTableCosines) // at cosine 0.05 the plain rule needs this many azimuths to come within the tolerance
            EXPECT_NEAR(directionalAlbedo(cosine, m, kF0), albedoOverLight(cosine, m, 300, 1000), 2e-5)
                << "m = " << m << ", cosine = " << cosine;
}

/// At m = 0.1 and cosine 0.05 the lobe is 0.4 degrees wide around the plane of incidence for grazing directions: steps of 0.5 degrees miss
/// it.
TEST(DirectionalAlbedoReference, at_grazing_angles_720_azimuths_are_too_few) {
    EXPECT_NEAR(albedoOverLight(0.05, 0.1, 1500, 360), 1.5385, 0.50001e-4);
    EXPECT_NEAR(albedoOverLight(0.05, 0.1, 800, 1500), 1.5393, 0.50001e-4);
}

TEST(DirectionalAlbedoReference, the_printed_rule_has_the_tabulated_values) {
    constexpr double kNarrow[] = {.2352, .6709, .1814, .0861, .0859};
    constexpr double kTypical[] = {.9070, .4648, .1441, .0802, .0790};
    for (int column = 0; column < 5; ++column) {
        EXPECT_NEAR(directionalAlbedoPrinted(kTableCosines[column], 0.1, kF0, 80), kNarrow[column], 0.50001e-4) << kTableCosines[column];
        EXPECT_NEAR(directionalAlbedoPrinted(kTableCosines[column], 0.3, kF0, 80), kTypical[column], 0.50001e-4) << kTableCosines[column];
    }
}

TEST(KelemenReference, is_reciprocal) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, -0.5, 0.4));
    const glm::dvec3 b = glm::normalize(glm::dvec3(-0.7, 0.1, 0.2));
    constexpr Lobe lobe{.m = 0.3, .f0 = 0.04, .rhoS = 0.7};
    const double there = kelemenBrdf({0, 0, 1}, a, b, lobe);
    EXPECT_NEAR(there, kelemenBrdf({0, 0, 1}, b, a, lobe), 1e-12 * there); // rounding: tan^2 / m^2 is 11 here
}

} // namespace tegument::reference
