// A fibre's light: it keeps energy, its samples are drawn as its density says, and coats of it are lit as they must be.

#include "lab/reference/fibre_paths.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace tegument::reference {

namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 way(double inclination, double azimuth) {
    return {std::sin(inclination), std::cos(inclination) * std::cos(azimuth), std::cos(inclination) * std::sin(azimuth)};
}

/// Over all directions, by the midpoint rule over the sine and the azimuth.
template <class Function>
glm::dvec3 overSphere(const Function& f) {
    constexpr int kSines = 400, kAzimuths = 400;
    glm::dvec3 sum(0);
    for (int i = 0; i < kSines; ++i)
        for (int j = 0; j < kAzimuths; ++j) {
            const double sine = -1 + 2 * (i + 0.5) / kSines;
            const double azimuth = 2 * kPi * (j + 0.5) / kAzimuths;
            const double cosine = std::sqrt(1 - sine * sine);
            sum += glm::dvec3(f(glm::dvec3(sine, cosine * std::cos(azimuth), cosine * std::sin(azimuth))));
        }
    return sum * (4 * kPi / (kSines * kAzimuths));
}

struct Seen {
    double inclination, azimuth, offset;
};
const std::vector<Seen> kSeen = {{0, 0, 0}, {0.3, 1, 0.5}, {-0.6, 2, -0.8}, {1.0, -1, 0.95}};

/// Strands on a ball of 10 mm, leaning, of `count` roots below its surface.
FibreScene ball(std::size_t count, const Mesh& skin) {
    FibreScene scene;
    scene.skin = &skin;
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 up = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const glm::dvec3 lean = 0.3 * glm::dvec3(normal(random), normal(random), normal(random));
        FibreAxis axis;
        for (int k = 0; k <= 3; ++k) {
            const double along = k / 3.0;
            axis.emplace_back(glm::vec3(9.8 * up + 2 * along * (up + along * lean)), static_cast<float>(0.08 * (1 - 0.8 * along)));
        }
        scene.strands.push_back(axis);
    }
    return scene;
}

Pinhole eye(int size) {
    return pinhole({0, 0, 200}, {0, 0, 0}, {0, 1, 0}, 0.14, size, size);
}

} // namespace

TEST(Fibre, sends_out_what_comes_in_unless_it_absorbs) {
    for (const Seen& seen : kSeen) {
        const glm::dvec3 toEye = way(seen.inclination, seen.azimuth);
        const FibreScattering white({}, glm::dvec3(0), toEye, seen.offset);
        const glm::dvec3 sum = overSphere([&](const glm::dvec3& v) { return white.evaluate(v); });
        EXPECT_NEAR(sum.x, 1, 2e-3) << seen.inclination << ", " << seen.offset;
        const FibreScattering dark({}, {0.1, 0.5, 2}, toEye, seen.offset);
        const glm::dvec3 left = overSphere([&](const glm::dvec3& v) { return dark.evaluate(v); });
        EXPECT_LT(left.x, 1);
        EXPECT_LT(left.y, left.x);
        EXPECT_LT(left.z, left.y);
    }
}

TEST(Fibre, draws_its_samples_as_its_density_says) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform;
    for (const Seen& seen : kSeen) {
        const FibreScattering fibre({}, {0.05, 0.2, 1}, way(seen.inclination, seen.azimuth), seen.offset);
        EXPECT_NEAR(overSphere([&](const glm::dvec3& v) { return glm::dvec3(fibre.density(v)); }).x, 1, 2e-3);
        // Means of products by samples, and by an even sum over the sphere.
        constexpr int kDraws = 200000;
        glm::dvec3 mean(0), towards(0);
        for (int i = 0; i < kDraws; ++i) {
            const auto sampled = fibre.sample({uniform(random), uniform(random), uniform(random), uniform(random)});
            EXPECT_NEAR(glm::length(sampled.toLight), 1, 1e-6);
            mean += sampled.weight / static_cast<double>(kDraws);
            towards += sampled.weight.y * sampled.toLight / static_cast<double>(kDraws);
        }
        const glm::dvec3 whole = overSphere([&](const glm::dvec3& v) { return fibre.evaluate(v); });
        const glm::dvec3 aside = overSphere([&](const glm::dvec3& v) { return fibre.evaluate(v).y * v; });
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], whole[c], 5e-3) << seen.inclination << ", channel " << c;
            EXPECT_NEAR(towards[c], aside[c], 5e-3) << seen.inclination << ", axis " << c;
        }
    }
}

TEST(Fibre, of_the_published_inversion_absorbs_less_the_brighter_its_colour_is) {
    const glm::dvec3 absorption = fibreAbsorption({0.1, 0.5, 0.9}, 0.3);
    // Chiang et al. 2016, equation 9: (ln C / 5.888)^2 at a roughness of 0.3.
    EXPECT_NEAR(absorption.x, std::pow(std::log(0.1) / 5.888, 2), 1e-4);
    EXPECT_NEAR(absorption.y, std::pow(std::log(0.5) / 5.888, 2), 1e-4);
    EXPECT_NEAR(absorption.z, std::pow(std::log(0.9) / 5.888, 2), 1e-5);
}

TEST(FibrePaths, show_a_single_strand_as_its_scattering_says) {
    // A cylinder across the view: the mean over its width is the mean over offsets.
    FibreScene scene;
    scene.strands = {{glm::vec4(-50, 0, 0, 1), glm::vec4(50, 0, 0, 1)}};
    scene.colour = glm::dvec3(0.2, 0.5, 0.8);
    for (const double phase : {0.0, 0.7, 1.6, 2.6}) {
        const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.3, std::sin(phase), std::cos(phase)));
        scene.lights = {{.kind = FibreLight::Kind::Parallel, .place = toLight}};
        const FibrePaths paths(scene);
        constexpr int kOffsets = 400;
        glm::dvec3 drawn(0), expected(0);
        for (int i = 0; i < kOffsets; ++i) {
            const double y = -1 + 2 * (i + 0.5) / kOffsets;
            drawn += paths.radiance({0.1, y, 30}, {0, 0, -1}, static_cast<std::uint64_t>(i)) / static_cast<double>(kOffsets);
            // The frame's x along the strand, y and z of the world. The normal at y is asin(y) from the eye towards y.
            const FibreScattering fibre(scene.fibre, fibreAbsorption(scene.colour, 0.3), {0, 0, 1}, y);
            expected += kPi * fibre.evaluate(toLight) / static_cast<double>(kOffsets);
        }
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(drawn[c] / expected[c], 1, 0.01) << "phase " << phase << ", channel " << c;
    }
}

TEST(FibrePaths, see_nothing_of_a_white_coat_in_an_even_environment) {
    const Mesh skin = sphereMesh(10, 4);
    FibreScene scene = ball(6000, skin);
    scene.colour = glm::dvec3(1); // absorbs a trillionth
    scene.skinColour = glm::dvec3(1);
    scene.environment = [](const glm::dvec3&) { return glm::dvec3(1); };
    const FibrePaths paths(scene);
    FibreSums sums;
    paths.trace(eye(24), 8, sums);
    const Image picture = sums.picture();
    double mean = 0;
    for (const float value : picture.pixels)
        mean += static_cast<double>(value) / static_cast<double>(picture.pixels.size());
    EXPECT_NEAR(mean, 1, 5e-3);
    double covered = 0;
    for (const double each : sums.covered)
        covered += each;
    EXPECT_GT(covered, 1000) << "there is a coat to see";
}

TEST(FibrePaths, lead_no_light_through_the_skin) {
    // Strands pierce it: what enters one of them above may not come out below.
    const Mesh skin = sphereMesh(10, 4);
    FibreScene scene = ball(6000, skin);
    scene.colour = glm::dvec3(0.99);
    scene.skinColour = glm::dvec3(1);
    scene.lights = {{.kind = FibreLight::Kind::Parallel, .place = {0, 0, -1}}};
    const FibrePaths paths(scene);
    double night = 0;
    for (std::uint64_t path = 0; path < 4000; ++path)
        night += paths.radiance({1e-3 * static_cast<double>(path % 2000), 0.5, 200}, {0, 0, -1}, path).y / 4000;
    EXPECT_LT(night, 1e-3) << "the day has 1; with an inside as bright as the outside 0.06";
}

TEST(FibrePaths, go_on_after_an_interruption_as_if_there_had_been_none) {
    const Mesh skin = sphereMesh(10, 3);
    FibreScene scene = ball(1000, skin);
    scene.lights = {{.kind = FibreLight::Kind::Parallel, .place = glm::normalize(glm::dvec3(1, 1, 1))}};
    const FibrePaths paths(scene);
    FibreSums whole;
    paths.trace(eye(16), 6, whole);
    FibreSums part;
    paths.trace(eye(16), 2, part);
    FibreSums again = sumsOf(numbersOf(part));
    EXPECT_EQ(again.samples, 2U);
    paths.trace(eye(16), 6, again);
    ASSERT_EQ(again.sum.size(), whole.sum.size());
    for (std::size_t i = 0; i < whole.sum.size(); ++i)
        EXPECT_EQ(again.sum[i], whole.sum[i]);
    EXPECT_GT(whole.noise(8), 0);
}

TEST(FibrePaths, are_lit_alike_by_parallel_light_and_by_points_and_spheres_far_away) {
    const Mesh skin = sphereMesh(10, 4);
    FibreScene scene = ball(3000, skin);
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.5, 0.4, 0.8));
    const auto mean = [&](const FibreLight& light) {
        scene.lights = {light};
        const FibrePaths paths(scene);
        FibreSums sums;
        paths.trace(eye(24), 160, sums); // of noise a hundredth is left
        double sum = 0;
        for (const glm::dvec3& each : sums.sum)
            sum += each.y;
        return sum;
    };
    const double parallel = mean({.kind = FibreLight::Kind::Parallel, .place = toLight});
    EXPECT_GT(parallel, 0);
    EXPECT_NEAR(mean({.kind = FibreLight::Kind::Point, .place = 1200.0 * toLight}) / parallel, 1, 0.02);
    EXPECT_NEAR(mean({.kind = FibreLight::Kind::Sphere, .place = 1200.0 * toLight, .radius = 12}) / parallel, 1, 0.03);
}

} // namespace tegument::reference
