// Flicker: figures of paths whose errors are known, and what moves along a path.

#include "lab/bench/motion.h"
#include "meshprep/assets/generators.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

namespace fs = std::filesystem;
using Frame = std::vector<glm::dvec3>;

/// One pixel of light 1 in each frame, drawn with these errors in red.
MotionRow withErrors(const std::vector<double>& errors) {
    std::vector<Frame> truth;
    std::vector<Frame> drawn;
    for (const double error : errors) {
        truth.push_back({glm::dvec3(1, 0, 0)});
        drawn.push_back({glm::dvec3(1 + error, 0, 0)});
    }
    return motionRow(drawn, truth);
}

const Motion& named(const std::string& name) {
    return *std::ranges::find(motions(), name, &Motion::name);
}

class Motions : public test::WithDevice {
protected:
    Motions() {
        options_ = {.effects = "effects",
                    .sceneFolder = fs::temp_directory_path() / ("tegument-motion-" + std::to_string(::getpid())),
                    .scenes = {"sphere-5"},
                    .width = 48,
                    .height = 48,
                    .mapSizes = {128},
                    .shadowSizes = {256},
                    .compiler = defaultCompiler(),
                    .pixels = 64,
                    .assets = assets::meshAssets([](const std::string&) {})};
    }
    ~Motions() override {
        std::error_code code;
        fs::remove_all(options_.sceneFolder, code);
    }

    BenchOptions options_;
};

} // namespace

TEST(Flicker, an_error_that_stays_does_not_flicker) {
    const MotionRow row = withErrors({0.1, 0.1, 0.1, 0.1});
    EXPECT_NEAR(row.error, 0.1, 1e-12);
    EXPECT_NEAR(row.flicker, 0, 1e-12);
    EXPECT_NEAR(row.light, 0, 1e-12);
}

TEST(Flicker, an_error_that_changes_its_sign_flickers_twice_its_size) {
    const MotionRow row = withErrors({0.1, -0.1, 0.1, -0.1});
    EXPECT_NEAR(row.error, 0.1, 1e-12);
    EXPECT_NEAR(row.flicker, 0.2, 1e-12);
    EXPECT_NEAR(row.largest, 0.2, 1e-12);
}

TEST(Flicker, one_pop_is_the_largest_step) {
    const MotionRow row = withErrors({0, 0, 0, 0, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3});
    EXPECT_NEAR(row.largest, 0.3, 1e-12);
    EXPECT_NEAR(row.flicker, 0.1, 1e-12) << "root of one square in nine steps";
}

TEST(Flicker, what_the_light_changes_by_is_no_flicker) {
    const std::vector<Frame> truth = {{glm::dvec3(1)}, {glm::dvec3(1.2)}};
    const MotionRow row = motionRow(truth, truth);
    EXPECT_EQ(row.flicker, 0);
    EXPECT_NEAR(row.light, 0.2 / std::sqrt((1 + 1.44) / 2), 1e-12);
}

TEST_F(Motions, a_zoom_comes_nearer_and_a_turn_keeps_its_distance) {
    const auto scene = loadScene("sphere-5", {.effects = "effects", .folder = options_.sceneFolder, .width = 48, .height = 48});
    ASSERT_TRUE(scene) << format(scene.error());
    const auto distance = [&](const Workspace& stood) { return glm::length(stood.camera.position - stood.camera.target); };
    const Workspace first = named("zoom").stand(*scene, 0);
    EXPECT_NEAR(distance(named("zoom").stand(*scene, 3)), distance(first) * std::pow(0.99, 3), 1e-3 * distance(first));
    const Workspace turned = named("turn").stand(*scene, 3);
    EXPECT_NEAR(distance(turned), distance(first), 1e-4 * distance(first));
    const auto angle = [](const Workspace& stood) { return std::atan2(stood.camera.position.x, stood.camera.position.z); };
    EXPECT_NEAR(std::abs(angle(turned) - angle(first)), glm::radians(1.5), 1e-3);
    EXPECT_EQ(named("light").stand(*scene, 3).camera.position, first.camera.position);
}

TEST_F(Motions, the_linked_pyramid_flickers_less_than_light_that_does_not_diffuse) {
    const auto catalogue = loadCatalogue("effects/catalogue.json");
    ASSERT_TRUE(catalogue);
    const auto chosen = choose(*catalogue, {"Lambert", "PyramidLinked"}, {"corrected"});
    ASSERT_TRUE(chosen);
    std::vector<Contender> two = {(*chosen)[0], (*chosen)[1]};
    const auto rows = measureMotion(*device_, two, options_, {.say = [](const std::string&) {}, .flip = nullptr});
    ASSERT_TRUE(rows) << format(rows.error());
    ASSERT_EQ(rows->size(), 2 * motions().size());
    for (std::size_t i = 0; i < rows->size(); i += 2) {
        const MotionRow& plain = (*rows)[i];
        const MotionRow& linked = (*rows)[i + 1];
        EXPECT_GT(plain.light, 0) << plain.motion;
        EXPECT_LT(linked.error, plain.error) << plain.motion;
        EXPECT_LT(linked.flicker, 5e-3) << plain.motion;
        if (plain.motion == "turn") continue; // a ball that turns stays as it is: what is left is its maps' grid
        EXPECT_LT(linked.flicker, plain.flicker) << plain.motion;
        EXPECT_LT(linked.flicker, plain.light) << plain.motion;
    }
}
