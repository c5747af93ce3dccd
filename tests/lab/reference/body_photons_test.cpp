// Photons in bodies against published slabs, closed forms, the same tissue between planes, and themselves cut off half-way.

#include "host/support/file.h"
#include "lab/reference/body_photons.h"
#include "lab/reference/tissue.h"
#include "tests/lab/reference/meshes.h"
#include "tests/lab/reference/own_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

using namespace tegument;
using namespace tegument::reference;

namespace {

constexpr double kBottomless = std::numeric_limits<double>::infinity();

struct PlateLight {
    double above = 0;
    double below = 0;
    double lost = 0;
};

/// A beam on a plate from above, straight down.
PlateLight beamOnPlate(const Flesh& flesh, double thickness, int photons) {
    std::mt19937_64 random(5);
    const Uniform uniform = [&] { return std::generate_canonical<double, 53>(random); };
    const PlateBody body(thickness);
    const Entering inside = entering({0, 0, 1}, {0, 0, -1}, flesh.index);
    PlateLight light;
    for (int i = 0; i < photons; ++i)
        light.lost +=
            followInBody(body, flesh, {0, 0, 1e-6}, inside.direction, (1 - inside.mirrored) / photons, uniform,
                         [&](const LeavingPhoton& photon) { (photon.triangle == 0 ? light.above : light.below) += photon.energy; });
    return light;
}

/// The same layer throughout, g everywhere.
Flesh even(double scattering, double absorption, double g, double index) {
    const LayerOptics layer{scattering * (1 - g), absorption};
    return {layer, layer, 0.1, index, g, kBottomless};
}

/// A cuboid from -half to half in x and y and from 0 to `height`, faces outwards; its upper and lower face in cells.
Mesh cuboid(double half, double height, std::uint32_t cells) {
    Mesh mesh = joined(plane(static_cast<float>(half), cells, static_cast<float>(height)), plane(static_cast<float>(half), cells, 0));
    const std::size_t one = 3UL * 2 * cells * cells;
    for (std::size_t i = one; i < 2 * one; i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    const std::uint32_t side = cells + 1;
    const std::uint32_t lower = side * side;
    const auto wall = [&](std::uint32_t from, std::uint32_t to) { // outside on the right of the way, seen from above
        for (const std::uint32_t corner : {from + lower, to + lower, to, from + lower, to, from})
            mesh.indices.push_back(corner);
    };
    for (std::uint32_t i = 0; i < cells; ++i) {
        wall(i, i + 1);
        wall(cells + side * i, cells + side * (i + 1));
        wall(side * cells + cells - i, side * cells + cells - i - 1);
        wall(side * (cells - i), side * (cells - i - 1));
    }
    return mesh;
}

double area(const Mesh& mesh, std::uint32_t t) {
    const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.indices[3UL * t + c]]); };
    return 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

class BodyPhotonsCache : public OwnCache {};

const Flesh kTwoLayers{{9.0, 0.6}, {3.4, 0.02}};

} // namespace

/// Wang, Jacques and Zheng 1995, "MCML", tables 1 and 2: van de Hulst's slab (albedo .9, optical thickness 2, g .75, index matched), and
/// Giovanelli's half-space (albedo .9, isotropic, index 1.5), of which what the surface mirrors is a part.
TEST(BodyPhotons, leave_slabs_as_published_tables_say) {
    const PlateLight slab = beamOnPlate(even(9, 1, 0.75, 1), 0.2, 400'000);
    EXPECT_NEAR(slab.above, .09739, .01 * .09739);
    EXPECT_NEAR(slab.below, .66096, .01 * .66096);
    const PlateLight half = beamOnPlate(even(9, 1, 0, 1.5), kBottomless, 200'000);
    EXPECT_NEAR(half.above + .04, .2600, .01 * .2600);
}

TEST(BodyPhotons, that_nothing_absorbs_all_leave) {
    const PlateLight slab = beamOnPlate(even(9, 0, 0.75, 1.4), 0.2, 20'000);
    EXPECT_NEAR(slab.above + slab.below, 1 - std::pow(.4 / 2.4, 2), 1e-4) << "roulette alone is left to chance";
}

/// Two layers between planes are what tissue.h follows, by other code.
TEST(BodyPhotons, in_two_layers_are_those_between_planes) {
    const Flesh flesh{{4, 0.3}, {1.5, 0.05}, 0.2, 1.4, 0, kBottomless};
    const PlateLight found = beamOnPlate(flesh, kBottomless, 100'000);
    const Photons known =
        followPhotons({{0.3, 4, 0.2, 1.4}, {0.05, 1.5, kBottomless, 1.4}}, {.photons = 100'000, .launch = Launch::Normal});
    EXPECT_NEAR(found.above, known.reflected, 6 * known.reflectedError);
    EXPECT_LT(found.lost, 1e-6);
}

/// Light through the middle of a broad plate of triangles goes as through one between planes.
TEST(BodyPhotons, in_a_mesh_pass_as_between_planes) {
    constexpr double kHeight = 1.5;
    const Mesh mesh = cuboid(10, kHeight, 8);
    const RayScene surface(mesh);
    const BodyLight light = photonsInBody(surface, kTwoLayers, {0, 0, 1}, {.photons = 40'000, .cached = false});
    double through = 0;
    double noise = 0;
    double below = 0;
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const glm::dvec3 centre = interpolate(mesh, {t, glm::dvec3(1.0 / 3)}).position;
        if (centre.z > 1e-3 || std::max(std::abs(centre.x), std::abs(centre.y)) > 5) continue;
        through += light.leaving(t);
        noise += light.variance[t];
        below += area(mesh, t);
    }
    const PlateLight plate = beamOnPlate(kTwoLayers, kHeight, 50'000);
    EXPECT_GT(below, 60) << "mm^2";
    EXPECT_NEAR(through / below, plate.below, 4 * std::sqrt(noise) / below + 0.02 * plate.below);
    EXPECT_LT(light.lost, 1e-4);
}

TEST(BodyPhotons, know_their_noise) {
    const Mesh mesh = sphereMesh(2.5, 3);
    const RayScene surface(mesh);
    const BodyLight light = photonsInBody(surface, kTwoLayers, {0, 0, 1}, {.photons = 8'000, .cached = false});
    double squares = 0;
    double expected = 0;
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        squares += std::pow(light.left[0][t] - light.left[1][t], 2) / 4;
        expected += light.variance[t];
    }
    EXPECT_NEAR(std::sqrt(squares / expected), 1, 0.2) << "half the difference of two halves has the variance of their mean";
}

TEST_F(BodyPhotonsCache, that_were_cut_off_go_on_and_are_the_same) {
    const Mesh mesh = sphereMesh(2.5, 2);
    const RayScene surface(mesh);
    const BodyPhotonOptions options{.photons = 6'400, .seed = 7};
    const BodyLight whole = photonsInBody(surface, kTwoLayers, {0, 0, 1}, options);
    std::vector<std::filesystem::path> blocks;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder()))
        if (file.is_regular_file()) blocks.push_back(file.path());
    ASSERT_EQ(blocks.size(), BodyLight::kBlocks);
    std::filesystem::remove(blocks[3]);
    std::filesystem::resize_file(blocks[5], 40);
    ASSERT_TRUE(writeFile(blocks[7], std::string(std::filesystem::file_size(blocks[7]), 'x')));
    const BodyLight again = photonsInBody(surface, kTwoLayers, {0, 0, 1}, options);
    EXPECT_EQ(whole.left, again.left);
    EXPECT_EQ(whole.entered, again.entered);
}
