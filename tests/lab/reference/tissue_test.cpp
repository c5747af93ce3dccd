// Photons in tissue against closed forms, the theory of isotropic scattering, and published simulations.
// Photons in bodies against published slabs, closed forms, the same tissue between planes, and themselves cut off half-way.

#include "host/support/file.h"
#include "lab/reference/body_photons.h"
#include "lab/reference/radial.h"
#include "lab/reference/tissue.h"
#include "tests/lab/reference/meshes.h"
#include "tests/lab/reference/own_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

using namespace tegument::reference;
using namespace tegument;

namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kSigmas = 4; // of the simulation's own standard error: one run in 16,000 strays further
constexpr std::size_t kPhotons = 100'000;

Photons follow(const Tissue& tissue, Launch launch, std::size_t photons = kPhotons) {
    return followPhotons(tissue, {.photons = photons, .launch = launch});
}

/// Chandrasekhar's H for isotropic scattering of this single-scattering albedo, at the nodes, by iterating
///   1 / H(m) = sqrt(1 - a) + a / 2 integral of m' H(m') / (m + m') dm' over [0, 1].
double chandrasekhar(double albedo, double cosine) {
    const std::vector<Node> nodes = gaussLegendre(64, 0, 1);
    std::vector<double> h(nodes.size(), 1.0);
    const auto at = [&](double m) {
        double sum = 0;
        for (std::size_t j = 0; j < nodes.size(); ++j)
            sum += nodes[j].weight * nodes[j].x * h[j] / (m + nodes[j].x);
        return 1 / (std::sqrt(1 - albedo) + albedo / 2 * sum);
    };
    for (int i = 0; i < 400; ++i) {
        std::vector<double> next;
        for (const Node& node : nodes)
            next.push_back(at(node.x));
        h = next;
    }
    return at(cosine);
}

void expectPublished(const Photons& photons, double value, double published, const char* what) {
    constexpr double kRounding = 1e-3; // published with three digits, and simulated themselves
    EXPECT_NEAR(value, published, kSigmas * std::hypot(photons.reflectedError, photons.transmittedError) + kRounding) << what;
}

double back(const Photons& photons) {
    return photons.mirrored + photons.reflected + photons.transmitted;
}

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

TEST(Photons, through_a_plate_that_only_absorbs_go_as_fresnel_and_beer_say) {
    const double absorption = 0.7, thickness = 1.5, index = 1.4;
    const double mirrored = std::pow((index - 1) / (index + 1), 2);
    const double passed = std::exp(-absorption * thickness);
    const double inside = (1 - mirrored) * passed / (1 - std::pow(mirrored * passed, 2)); // reflections between the two faces added up
    const Photons found = follow({{absorption, 0, thickness, index}}, Launch::Normal);
    EXPECT_NEAR(found.mirrored, mirrored, 1e-12);
    EXPECT_NEAR(found.transmitted, inside * (1 - mirrored), kSigmas * found.transmittedError);
    EXPECT_NEAR(found.reflected, inside * mirrored * passed * (1 - mirrored), kSigmas * found.reflectedError);
}

TEST(Photons, that_nothing_absorbs_all_come_out) {
    const Photons found = follow({{0, 3, 0.5, 1.4}, {0, 1, 0.8, 1.34}, {0, 5, 0.2, 1.5}}, Launch::Normal);
    EXPECT_NEAR(back(found), 1, 1e-3) << "Russian roulette keeps the mean, not the sum";
}

TEST(Photons, from_an_endless_medium_of_matched_index_come_back_as_chandrasekhar_says) {
    for (const double albedo : {0.5, 0.9}) {
        const Photons beam = follow({{1 - albedo, albedo, kEndless, 1}}, Launch::Normal);
        EXPECT_NEAR(beam.reflected, 1 - std::sqrt(1 - albedo) * chandrasekhar(albedo, 1), kSigmas * beam.reflectedError) << albedo;
        double cosines = 0; // H averaged over the cosine law
        for (const Node& node : gaussLegendre(16, 0, 1))
            cosines += 2 * node.weight * node.x * chandrasekhar(albedo, node.x);
        const Photons diffuse = follow({{1 - albedo, albedo, kEndless, 1}}, Launch::Diffuse);
        EXPECT_NEAR(diffuse.reflected, 1 - std::sqrt(1 - albedo) * cosines, kSigmas * diffuse.reflectedError) << albedo;
    }
}

TEST(Photons, do_not_notice_an_interface_between_equal_layers) {
    const Photons one = follow({{0.1, 2, 1.0, 1.4}}, Launch::Diffuse);
    const Photons two = follow({{0.1, 2, 0.3, 1.4}, {0.1, 2, 0.7, 1.4}}, Launch::Diffuse);
    EXPECT_NEAR(one.reflected, two.reflected, kSigmas * std::hypot(one.reflectedError, two.reflectedError));
    EXPECT_NEAR(one.transmitted, two.transmitted, kSigmas * std::hypot(one.transmittedError, two.transmittedError));
}

/// A thin sheet of air over clear glass: light that the cosine law spreads goes down through the glass by Snell's angle, is mirrored at its
/// underside, and leaves after k turns 2 k tan(angle) glasses aside.
TEST(Photons, are_bent_at_an_interface_as_snell_says) {
    constexpr double kGlass = 1.5, kThick = 2;
    double energy = 0, moment = 0;
    for (const Node& node : gaussLegendre(400, 0, 1)) { // sine^2 above: even by the cosine law
        const double sine = std::sqrt(node.x), cosine = std::sqrt(1 - node.x), below = sine / kGlass, bent = std::sqrt(1 - below * below);
        const double s = (cosine - kGlass * bent) / (cosine + kGlass * bent), p = (kGlass * cosine - bent) / (kGlass * cosine + bent);
        const double mirrored = (s * s + p * p) / 2;
        double light = node.weight * (1 - mirrored) * mirrored;
        for (int turns = 1; turns < 40; ++turns, light *= mirrored * mirrored) {
            energy += light * (1 - mirrored);
            moment += light * (1 - mirrored) * 2 * turns * kThick * below / bent;
        }
    }
    const Photons found = follow({{0, 0, 1e-7, 1}, {0, 0, kThick, kGlass}}, Launch::Diffuse, 400'000);
    double seen = 0, reach = 0;
    for (std::size_t ring = 0; ring < RingHistogram::kRings; ++ring) {
        const double radius = (RingHistogram::edge(ring) + RingHistogram::edge(ring + 1)) / 2;
        if (radius < 1e-2) continue; // mirrored by the glass itself
        seen += found.rings.energy(ring);
        reach += found.rings.energy(ring) * radius;
    }
    EXPECT_NEAR(seen, energy, 0.02 * energy); // 400,000 photons, of which the interface mirrors some 9 %
    EXPECT_NEAR(reach / seen, moment / energy, 0.01 * moment / energy) << "rings are 2 % wide";
}

TEST(Photons, of_a_thousandth_of_the_absorption_and_scattering_spread_a_thousand_times_as_far) {
    const Photons near = follow({{0.2, 1.5, kEndless, 1.4}}, Launch::Diffuse);
    const Photons far = follow({{0.0002, 0.0015, kEndless, 1.4}}, Launch::Diffuse);
    EXPECT_NEAR(near.reflected, far.reflected, 1e-12) << "the same random numbers";
    EXPECT_NEAR(1000 * near.rings.radiusOf(0.1), far.rings.radiusOf(0.1), 20) << "rings are 2 % wide";
}

TEST(Photons, are_the_same_again_and_others_for_another_seed) {
    const Tissue tissue = layeredSkin(2);
    const Photons first = followPhotons(tissue, {.photons = 2000, .seed = 7});
    EXPECT_EQ(first.reflected, followPhotons(tissue, {.photons = 2000, .seed = 7}).reflected);
    EXPECT_NE(first.reflected, followPhotons(tissue, {.photons = 2000, .seed = 8}).reflected);
}

/// Values of an independent simulation, confirmed by Mitsuba 3 (docs/design/skin-error.md).
TEST(Photons, come_back_from_jensen_s_skin_as_published) {
    constexpr double kScattering[] = {.74, .88, 1.01};
    constexpr double kAbsorption[] = {.032, .17, .48};
    constexpr double kPublished[] = {.4168, .2090, .1240};
    for (int c = 0; c < 3; ++c) {
        const Photons found = follow({{kAbsorption[c], kScattering[c], kEndless, 1.4}}, Launch::Normal);
        expectPublished(found, back(found), kPublished[c], "skin1");
    }
}

TEST(Photons, leave_the_epidermis_as_published) {
    constexpr double kPublished[] = {.8385, .8339, .6811};
    for (int c = 0; c < 3; ++c) {
        const Photons found = follow({layeredSkin(c).front()}, Launch::Normal);
        expectPublished(found, back(found), kPublished[c], "both sides");
    }
}

TEST(Photons, leave_three_layered_skin_as_published) {
    constexpr double kAlbedo[] = {.502, .431, .331};
    constexpr double kRadii[3][3] = {{.45, 3.3, 12.8}, {.255, .65, 1.93}, {.18, .42, .79}};
    constexpr double kShares[] = {.5, .8, .95};
    for (int c = 0; c < 3; ++c) {
        const Photons found = follow(layeredSkin(c), Launch::Diffuse);
        expectPublished(found, found.reflected, kAlbedo[c], "albedo");
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(found.rings.radiusOf(kShares[i]), kRadii[c][i], 0.03 * kRadii[c][i]) << "two digits, and 100,000 photons";
    }
}

TEST(Photons, pass_through_an_ear_as_published) {
    constexpr double kThrough[4][3] = {{.195, .130, .0068}, {.173, .084, .0003}, {.139, .037, 0}, {.112, .017, 0}};
    constexpr double kBloody[] = {0.6, 1.6, 3.6, 5.6}; // mm: 0.9 less than the whole
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) {
            const Photons found = follow(skinSlab(c, kBloody[i]), Launch::Diffuse, 20'000);
            expectPublished(found, found.transmitted, kThrough[i][c], "slab");
        }
}

TEST(RingHistogram, finds_the_radius_that_holds_a_share) {
    RingHistogram rings;
    rings.add(0.0004, 1); // the innermost disc
    rings.add(0.5, 2);
    rings.add(30, 1);
    EXPECT_NEAR(rings.radiusOf(0.125), 0.0005, 1e-12) << "half of the disc's energy";
    EXPECT_NEAR(rings.radiusOf(0.5), 0.5, 0.02);
    EXPECT_NEAR(rings.within(1), 3, 1e-12);
    EXPECT_NEAR(rings.within(rings.radiusOf(0.6)), 2.4, 1e-12);
}

TEST(RingHistogram, keeps_what_is_further_than_its_last_ring) {
    RingHistogram rings;
    rings.add(1e6, 1);
    EXPECT_EQ(rings.total(), 1);
    EXPECT_EQ(rings.within(1), 0);
}

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
