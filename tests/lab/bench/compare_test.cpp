// Contenders on a scene, from effect to error.

#include "lab/bench/ablation.h"
#include "lab/bench/choice.h"
#include "lab/bench/report.h"
#include "lab/bench/truth.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <unistd.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

namespace fs = std::filesystem;

class Comparison : public test::WithDevice {
protected:
    Comparison() {
        options_ = {.effects = "effects",
                    .sceneFolder = fs::temp_directory_path() / ("tegument-compare-" + std::to_string(::getpid())),
                    .scenes = {"sphere-5"},
                    .width = 48,
                    .height = 48,
                    .mapSizes = {128},
                    .frames = {.warmUp = 0, .timed = 1},
                    .compiler = defaultCompiler(),
                    .pixels = 128};
    }
    ~Comparison() override {
        std::error_code code;
        fs::remove_all(options_.sceneFolder, code);
    }

    std::vector<Row> run(const std::vector<std::string>& techniques, const std::vector<std::string>& settings) {
        const auto catalogue = loadCatalogue("effects/catalogue.json");
        const auto chosen = choose(*catalogue, techniques, settings);
        if (!chosen) {
            ADD_FAILURE() << format(chosen.error());
            return {};
        }
        auto rows = runBench(*device_, *chosen, options_, {.say = [](const std::string&) {}, .flip = nullptr});
        if (!rows) {
            ADD_FAILURE() << format(rows.error());
            return {};
        }
        return *rows;
    }

    BenchOptions options_;
};

double errorOf(const std::vector<Row>& rows, const std::string& technique, const std::string& setting) {
    for (const Row& row : rows)
        if (row.contender.technique == technique && row.contender.setting == setting) return row.errors.relativeL2;
    ADD_FAILURE() << technique << " " << setting << " was not drawn";
    return 0;
}

} // namespace

TEST_F(Comparison, draws_the_whole_catalogue_with_finite_errors) {
    for (const Row& row : run({}, {})) {
        ASSERT_FALSE(row.failure) << row.contender.name() << " " << row.contender.setting << ": " << format(*row.failure);
        EXPECT_TRUE(std::isfinite(row.errors.relativeL2)) << row.contender.name();
        EXPECT_LT(row.errors.relativeL2, 0.5) << row.contender.name() << ": not the same scene";
        EXPECT_GT(row.drawn.targetBytes, 48U * 48U * 4U) << row.contender.name() << ": at least the picture";
        EXPECT_GE(row.drawn.bytes, row.drawn.targetBytes) << row.contender.name();
    }
}

/// A third of the red light travels further than a millimetre, on a sphere of five.
TEST_F(Comparison, light_that_does_not_spread_is_further_off_than_light_that_does) {
    const auto rows = run({"Lambert", "DEonLuebke"}, {"corrected"});
    ASSERT_EQ(rows.size(), 2);
    EXPECT_GT(errorOf(rows, "Lambert", "corrected"), 3 * errorOf(rows, "DEonLuebke", "corrected"));
}

TEST_F(Comparison, what_is_printed_is_further_off_than_what_is_corrected) {
    const auto rows = run({"DEonLuebke"}, {});
    EXPECT_GT(errorOf(rows, "DEonLuebke", "seed"), errorOf(rows, "DEonLuebke", "corrected"));
    EXPECT_GT(errorOf(rows, "DEonLuebke", "deon2007"), errorOf(rows, "DEonLuebke", "corrected"));
}

TEST_F(Comparison, lambert_keeps_its_own_definition) {
    const auto rows = run({"Lambert"}, {});
    ASSERT_EQ(rows.size(), 1);
    ASSERT_TRUE(rows[0].own);
    EXPECT_LT(rows[0].own->relativeL2, 0.01) << "what shadow map and albedo table leave";
}

TEST_F(Comparison, means_of_samples_keep_the_definition_too) {
    for (const int grid : {1, 4}) {
        options_.grid = grid;
        const auto rows = run({"Lambert"}, {"corrected"});
        ASSERT_EQ(rows.size(), 1);
        ASSERT_FALSE(rows[0].failure) << format(*rows[0].failure);
        EXPECT_EQ(rows[0].samples, grid * grid);
        ASSERT_TRUE(rows[0].own);
        EXPECT_LT(rows[0].own->relativeL2, 0.01) << "a picture that lies half a pixel aside would be .03 off";
    }
}

TEST_F(Comparison, samples_lie_evenly_in_their_pixels) {
    const auto scene = loadScene("sphere-5", {.effects = "effects", .folder = options_.sceneFolder, .width = 48, .height = 48});
    ASSERT_TRUE(scene) << format(scene.error());
    const TruthScene truth = truthScene(*scene, 48, 48);
    const Sample sample = samplePixels(*scene, truth, 16, 3);
    ASSERT_EQ(sample.parts.size(), 9 * sample.points.size()) << "all eight neighbours of each show the ball";
    ASSERT_EQ(sample.partOf.size(), sample.parts.size());
    for (std::size_t i = 0; i < sample.points.size(); ++i) {
        const reference::ShadedPoint& middle = sample.parts[9 * i + 4];
        EXPECT_EQ(sample.partOf[9 * i + 4], i);
        EXPECT_EQ(middle.x, 3 * sample.points[i].x + 1);
        EXPECT_EQ(middle.y, 3 * sample.points[i].y + 1);
        EXPECT_LT(glm::length(middle.point.position - sample.points[i].point.position), 1e-9) << "the fifth of nine is the centre";
    }
}

TEST_F(Comparison, a_second_run_confirms_the_pick) {
    const auto rows = run({"Lambert", "Gosselin", "DEonLuebke"}, {"corrected"});
    const double limit = 0.02;
    const auto chosen = pick(rows, {.error = limit, .milliseconds = {}});
    ASSERT_TRUE(chosen);
    const Contender& contender = rows[*chosen].contender;
    const auto again = run({contender.name()}, {contender.setting});
    ASSERT_EQ(again.size(), 1);
    EXPECT_LE(again[0].errors.relativeL2, limit);
    EXPECT_DOUBLE_EQ(again[0].errors.relativeL2, rows[*chosen].errors.relativeL2) << "who else is drawn must not matter";
}

TEST_F(Comparison, what_cannot_be_drawn_does_not_stop_the_others) {
    const auto catalogue = loadCatalogue("effects/catalogue.json");
    auto chosen = *choose(*catalogue, {"Lambert"}, {});
    chosen.push_back(chosen.front());
    chosen.front().technique = "Lambart";
    const auto rows = runBench(*device_, chosen, options_, {.say = [](const std::string&) {}, .flip = nullptr});
    ASSERT_TRUE(rows) << format(rows.error());
    EXPECT_TRUE((*rows)[0].failure);
    EXPECT_FALSE((*rows)[1].failure);
}

TEST_F(Comparison, a_camera_that_sees_no_skin_is_an_error) {
    options_.scenes = {"sphere-5+0.01px"};
    const auto catalogue = loadCatalogue("effects/catalogue.json");
    const auto rows = runBench(*device_, *catalogue, options_, {.say = [](const std::string&) {}, .flip = nullptr});
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().diagnostics.front().code, 8075);
}

TEST_F(Comparison, culling_leaves_the_picture_within_what_it_costs) {
    options_.mapSizes = {64};
    const auto rows = measureAblation(*device_, options_, {.say = [](const std::string&) {}, .flip = nullptr});
    ASSERT_TRUE(rows) << format(rows.error());
    ASSERT_EQ((*rows)[0].what, "none");
    double first = 0;
    for (std::size_t i = 0; i < rows->size(); ++i) {
        const AblationRow& row = (*rows)[i];
        EXPECT_GT(row.milliseconds, 0) << row.what;
        if (i == 0 || row.group != (*rows)[i - 1].group) first = row.milliseconds;
        EXPECT_NEAR(row.milliseconds, first + row.change, 1e-9) << row.what << ": a change is to the line that its group begins with";
        if (row.group != (*rows)[0].group) continue;
        EXPECT_NEAR(*row.relativeL2, *(*rows)[0].relativeL2, 0.02) << row.what;
    }
}
