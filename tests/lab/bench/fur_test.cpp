// Every technique of fur on one table: the same strands, the same views, errors to exact rays.

#include "lab/bench/fur.h"

#include "meshprep/assets/generators.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <unistd.h>

using namespace tegument;
using namespace tegument::bench;

namespace {

namespace fs = std::filesystem;

class FurBench : public test::WithDevice {
protected:
    FurBench() {
        options_ = {.effects = "effects",
                    .sceneFolder = fs::temp_directory_path() / ("tegument-fur-" + std::to_string(::getpid())),
                    .scenes = {"sphere-20"},
                    .width = 96,
                    .height = 96,
                    .mapSizes = {256},
                    .shadowSizes = {256},
                    .frames = {.warmUp = 0, .timed = 1},
                    .compiler = defaultCompiler(),
                    .pixels = 0,
                    .assets = assets::meshAssets([](const std::string&) {})};
    }
    ~FurBench() override {
        std::error_code code;
        fs::remove_all(options_.sceneFolder, code);
    }

    /// Rows by technique and scene.
    std::map<std::pair<std::string, std::string>, Row> rows(const std::vector<std::string>& techniques) {
        const auto catalogue = loadCatalogue("effects/fur_catalogue.json");
        EXPECT_TRUE(catalogue);
        std::vector<Contender> chosen;
        for (const std::string& technique : techniques) {
            const auto one = choose(*catalogue, {technique}, {"corrected"});
            EXPECT_TRUE(one) << technique;
            if (one) chosen.push_back(one->front());
        }
        const auto all = runFur(*device_, chosen, options_, {.say = [](const std::string&) {}, .flip = nullptr});
        if (!all) ADD_FAILURE() << format(all.error());
        std::map<std::pair<std::string, std::string>, Row> found;
        if (all)
            for (const Row& row : *all) {
                EXPECT_FALSE(row.failure) << (row.failure ? format(*row.failure) : "");
                found[{row.contender.technique, row.scene}] = row;
            }
        return found;
    }

    BenchOptions options_;
};

// On a ball of 20 mm in a coat as long as a twentieth of its radius; truth of 16 to 64 rays a pixel.
TEST_F(FurBench, ribbons_are_nearer_to_rays_than_layers_by_vertex_shaders_and_by_compute_shaders) {
    const auto found = rows({"CubePosition", "Roots", "Cellular", "Strands", "StrandsSoft", "StrandsCompute", "CoatSoft", "CoatCompute"});
    ASSERT_EQ(found.size(), 8 * furViews().size());
    for (const FurView& view : furViews()) {
        const std::string scene = "sphere-20" + view.name;
        const auto at = [&](const char* technique) { return found.at({technique, scene}); };
        EXPECT_LT(at("StrandsSoft").errors.relativeL2, 0.45)
            << scene << ": from afar the ball is of a few pixels, each of hundreds of strands";
        EXPECT_LT(at("Strands").errors.relativeL2, 0.45) << scene;
        EXPECT_NEAR(at("StrandsCompute").errors.relativeL2, at("StrandsSoft").errors.relativeL2, 2e-3) << scene;
        EXPECT_NEAR(at("CoatCompute").errors.relativeL2, at("CoatSoft").errors.relativeL2, 2e-3) << scene;
        EXPECT_GT(at("Strands").drawn.gross.median, 0) << scene;
        EXPECT_LT(at("StrandsSoft").errors.relativeL2, at("CoatSoft").errors.relativeL2) << scene << ": another coat";
    }
    EXPECT_LT(found.at({"StrandsSoft", "sphere-20"}).errors.relativeL2, found.at({"Roots", "sphere-20"}).errors.relativeL2);
}

} // namespace
