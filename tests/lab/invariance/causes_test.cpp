// Why some pictures differ more than others (docs/design/invariance.md): the cause is taken out of a copy of the shaders, and the
// difference goes with it.

#include "host/support/file.h"
#include "lab/invariance/invariance.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <unistd.h>

using namespace tegument;

namespace {

namespace fs = std::filesystem;

/// A line of a shader, and what stands in its place.
struct Change {
    const char* file;
    std::string from;
    std::string to;
};

const Change kFirstLevel{"hlsl/platform.fxh", "#define TG_TEX2D(s, uv) s##Map.Sample(s, uv)",
                         "#define TG_TEX2D(s, uv) s##Map.SampleLevel(s, uv, 0.0)"};
/// A hundredth of a millimetre, or 1e-5 of z/w, to both sides of which a float is sure.
const Change kSoftShadow{"hlsl/shadow/map.fxh", "return depth <= texel + kTgFarBeyond * tgShadowBeyond(coordinate) ? 1.0 : 0.0;",
                         "return saturate((texel + kTgFarBeyond * tgShadowBeyond(coordinate) - depth) / "
                         "(kTgDepthInMillimetres ? 0.01 : 1e-5) + 0.5);"};
const Change kLengthsOfVectors{"hlsl/printed/preintegrated.fxh", "length(abs(nx) + abs(ny)) / max(length(abs(px) + abs(py)), 1e-6)",
                               "(length(nx) + length(ny)) / max(length(px) + length(py), 1e-6)"};

const Change kUpOfTheWorld{"effects/passes/lamps.fxh", "gLampBodyRadius, up, tgWorldNormal(float3(1.0, 0.0, 0.0)));",
                           "gLampBodyRadius, float3(0.0, 1.0, 0.0), float3(1.0, 0.0, 0.0));"};

class Causes : public testing::Test {
protected:
    /// Not at the process's end: with a second device's, Khronos' validation layer 1.4.309 has forgotten the first by then.
    static void TearDownTestSuite() { made_.reset(); }

    void SetUp() override {
        if (!made_) made_.emplace(gpu::Device::create());
        if (!*made_) GTEST_SKIP() << format((*made_).error());
        device_ = &**made_;
        folder_ = fs::temp_directory_path() / fmt::format("tegument-causes-{}", getpid());
        fs::create_directories(folder_);
    }

    void TearDown() override {
        std::error_code code;
        fs::remove_all(folder_, code);
    }

    /// A folder with effects and modules in which this is changed.
    [[nodiscard]] fs::path changed(const Change& change) const {
        for (const char* part : {"effects", "hlsl"})
            fs::copy(part, folder_ / part, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        auto text = readFile(folder_ / change.file);
        EXPECT_TRUE(text) << format(text.error());
        const std::size_t at = text ? text->find(change.from) : std::string::npos;
        EXPECT_NE(at, std::string::npos) << change.file << " no longer has: " << change.from;
        if (at == std::string::npos) return folder_;
        const auto written = writeFile(folder_ / change.file, text->replace(at, change.from.size(), change.to));
        EXPECT_TRUE(written) << format(written.error());
        return folder_;
    }

    /// One technique in one case, by the shaders of this folder.
    [[nodiscard]] InvarianceCell cell(const fs::path& root, const char* effect, const char* technique, const char* name,
                                      InvarianceOptions options = {}) {
        options.compiler = defaultCompiler();
        options.techniques = {technique};
        options.cases = {name};
        const auto cells = measureInvariance(*device_, root / "effects" / effect, options);
        EXPECT_TRUE(cells) << format(cells.error());
        if (!cells || cells->size() != 1) {
            ADD_FAILURE() << technique << " has no case '" << name << "'";
            return {};
        }
        EXPECT_FALSE(cells->front().error) << format(*cells->front().error);
        return cells->front();
    }

    static inline std::optional<Result<gpu::Device>> made_;
    gpu::Device* device_ = nullptr;
    fs::path folder_;
};

std::string tableOf(const InvarianceCell& cell) {
    return invarianceMarkdown({cell});
}

constexpr const char* kMirror = "scene in a mirror";

} // namespace

TEST_F(Causes, in_a_mirror_outlines_get_other_levels_of_the_maps) {
    // A level is chosen from the differences along one row and one column of 2 x 2 pixels: in a mirror the column is the other one.
    const fs::path flat = changed(kFirstLevel);
    for (const auto& [effect, technique] : {std::pair("OriginalTexture.fx", "OriginalTexture"), std::pair("Main.fx", "Lambert"),
                                            std::pair("peers/Preintegrated.fx", "Preintegrated")}) {
        const InvarianceCell usual = cell(".", effect, technique, kMirror);
        const InvarianceCell without = cell(flat, effect, technique, kMirror);
        EXPECT_TRUE(usual.pass()) << tableOf(usual);
        EXPECT_LT(without.relativeL2, 5e-5) << "what other columns have at most; " << tableOf(without);
        EXPECT_LT(without.relativeL2, 0.3 * usual.relativeL2) << tableOf(usual) << tableOf(without);
        EXPECT_EQ(without.beyond, 0) << tableOf(without);
    }
}

TEST_F(Causes, in_a_mirror_kernels_over_pixels_reach_as_far_to_the_left_as_to_the_right) {
    // Of large pixels, in which depth changes by much. A step that leans to one side, by that change times a pixel, gives 1.0e-4 to 1.3e-4.
    const fs::path flat = changed(kFirstLevel);
    for (const char* technique : {"Separable7", "Separable11", "Separable17", "Separable25"}) {
        const InvarianceCell without = cell(flat, "peers/Separable.fx", technique, kMirror, {.pictureSize = 48});
        EXPECT_LT(without.relativeL2, 5e-5) << "one pixel, by a step of a half; " << tableOf(without);
    }
}

TEST_F(Causes, the_printed_shadow_is_one_comparison_which_single_pixels_just_fail) {
    const fs::path soft = changed(kSoftShadow);
    for (const auto& [setting, name] :
         {std::pair("seed", "scene moved"), std::pair("deon2007", "world and mesh in metres, lit from behind")}) {
        const InvarianceCell usual = cell(".", "ShadowMap.fx", "Shadow", name, {.setting = setting});
        const InvarianceCell without = cell(soft, "ShadowMap.fx", "Shadow", name, {.setting = setting});
        EXPECT_LT(usual.beyond, 1e-4) << "three pixels; " << tableOf(usual);
        EXPECT_LT(without.relativeL2, 1e-3) << tableOf(without);
    }
}

TEST_F(Causes, the_printed_curvature_adds_changes_along_the_axes_of_the_world) {
    const fs::path turning = changed(kLengthsOfVectors);
    const InvarianceCell usual = cell(".", "peers/Preintegrated.fx", "Preintegrated", "scene turned, 1", {.setting = "deon2007"});
    const InvarianceCell without = cell(turning, "peers/Preintegrated.fx", "Preintegrated", "scene turned, 1", {.setting = "deon2007"});
    EXPECT_GT(usual.beyond, 5e-3) << "the printed form no longer depends on the axes; " << tableOf(usual);
    EXPECT_TRUE(without.pass()) << tableOf(without);
}

TEST_F(Causes, fur_of_the_seed_in_two_draws_shows_the_layers_that_other_lighting_makes_fainter) {
    const Mesh mesh = invarianceMesh();
    const auto coat = [&](const char* parameter, double value) {
        Workspace workspace = invarianceWorkspace();
        if (parameter) workspace.parameters[parameter] = {value};
        return cell(".", "Fur.fx", "CubeNormal", "each draw in two", {.setting = "seed", .mesh = &mesh, .workspace = &workspace});
    };
    const InvarianceCell usual = coat(nullptr, 0);
    EXPECT_GT(usual.relativeL2, usual.limit) << tableOf(usual);
    EXPECT_TRUE(coat("gFurKajiyaKay", 1).pass()) << "as deon2007 and corrected light it";
    EXPECT_LT(coat("gFurLayers", 1).relativeL2, 1e-3) << "nothing to be blended over but skin";
}

TEST_F(Causes, maps_of_lamps_turn_with_the_axes_of_the_mesh) {
    const fs::path world = changed(kUpOfTheWorld);
    for (const char* name : {"several lights: mesh with z up", "several lights: mesh with odd axes"}) {
        const InvarianceCell usual = cell(".", "Irradiance.fx", "Irradiance", name);
        const InvarianceCell without = cell(world, "Irradiance.fx", "Irradiance", name);
        EXPECT_TRUE(usual.pass()) << tableOf(usual);
        EXPECT_LT(without.beyond, 1e-3) << "within the usual limits; " << tableOf(without);
        EXPECT_LT(without.relativeL2, 0.5 * usual.relativeL2) << tableOf(usual) << tableOf(without);
    }
}
