// What frames fetch and move: held against passes whose counts can be told by head.
// The switches that take one optimisation out of the skin passes (docs/settings.md): each does that, and nothing else.

#include "host/run/run.h"
#include "lab/bench/traffic.h"
#include "lab/verify/verify.h"
#include "tests/gpu/with_device.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace tegument;
using namespace tegument::bench;

namespace {

constexpr std::uint64_t kTexels = 32 * 16; // of gWideMap
constexpr std::uint64_t kHalves = 8;       // bytes
constexpr std::uint64_t kFloats = 16;
constexpr std::uint64_t kSmall = 4 * 4;
constexpr int kPixelsAcross = 64;

class FrameTraffic : public test::WithDevice, public testing::WithParamInterface<Compiler> {
protected:
    void SetUp() override {
        test::WithDevice::SetUp();
        if (const std::string missing = test::compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    std::vector<Traffic> count(const std::string& technique, double turns = 5) {
        const Scene scene{.name = "none", .workspace = {}, .mesh = {}};
        const Contest contest{.scene = scene, .width = kPixelsAcross, .height = kPixelsAcross, .mapSize = 64, .compiler = GetParam()};
        const Contender contender{.technique = technique,
                                  .setting = "corrected",
                                  .effect = "tests/lab/bench/fixtures/counts.fx",
                                  .parameters = {{"gTurns", {turns}}}};
        const auto traffic = trafficOf(*device_, contest, contender);
        EXPECT_TRUE(traffic) << format(traffic.error());
        return traffic ? *traffic : std::vector<Traffic>{};
    }

    static Traffic passOf(const std::vector<Traffic>& all, const std::string& name) {
        const auto found = std::ranges::find(all, name, &Traffic::pass);
        EXPECT_NE(found, all.end()) << name;
        return found == all.end() ? Traffic{} : *found;
    }
};

constexpr int kSize = 64;

using Defines = std::vector<std::pair<std::string, std::string>>;

const Defines kNoCause = {{"TEGUMENT_CULL_FRUSTUM", "0"}, {"TEGUMENT_CULL_BACK_FACES", "0"}, {"TEGUMENT_CULL_BLACK", "0"}};

Defines only(const std::string& cause) {
    Defines defines = kNoCause;
    std::ranges::find(defines, cause, &Defines::value_type::first)->second = "1";
    return defines;
}

/// The built-in body, half of it right of the view; `black`: with a colour map that is black left of its middle.
struct BodyScene {
    Mesh mesh = verificationMesh();
    Workspace workspace = worldWorkspace();

    explicit BodyScene(bool black = false) {
        workspace.camera.position = {-25, 0, 170};
        workspace.camera.target = {-25, 0, 0};
        workspace.camera.horizontalFov = 14;
        workspace.light.position = {-330, 280, 420};
        if (!black) return;
        Image& map = std::ranges::find(mesh.textures, std::string("color"), &EmbeddedTexture::role)->image;
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width / 2; ++x)
                for (int c = 0; c < 3; ++c)
                    map.at(x, y, c) = 0;
    }
};

class Switches : public test::WithDevice {
protected:
    RunResult draw(const BodyScene& stage, const std::string& technique, int setting, Defines defines, bool prepass = false) {
        defines.emplace_back("TEGUMENT_SETTING", std::to_string(setting));
        defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(kSize));
        const auto effect = loadEffect("effects/Main.fx", {.defines = defines});
        EXPECT_TRUE(effect) << format(effect.error());
        RunOptions options{.technique = technique, .width = kSize, .height = kSize, .compiler = defaultCompiler(), .dump = {"all"}};
        options.parameters["gUsePrePass"] = {prepass ? 1.0 : 0.0};
        const auto run = runEffect(*device_, *effect, &stage.mesh, stage.workspace, options);
        EXPECT_TRUE(run) << format(run.error());
        return run ? *run : RunResult{};
    }

    /// Texels that the prepasses spare the later passes, over the whole map.
    std::ptrdiff_t culled(const BodyScene& stage, const Defines& defines) {
        const RunResult run = draw(stage, "DEonLuebke", 0, defines, true);
        return std::ranges::count_if(run.dumped.at("gUnwrapDepthMap").pixels, [](float depth) { return depth > 0; });
    }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(By, FrameTraffic, testing::Values(Compiler::Dxc, Compiler::Glslang), test::compilerTestName);

TEST_P(FrameTraffic, a_pass_is_called_for_each_pixel_of_its_target_and_writes_all_of_it) {
    const Traffic fill = passOf(count("Counts"), "Fill");
    EXPECT_EQ(fill.calls, kSmall);
    EXPECT_EQ(fill.fetches, 0U);
    EXPECT_EQ(fill.read, 0U);
    EXPECT_EQ(fill.written, kSmall * kFloats);
}

TEST_P(FrameTraffic, look_ups_in_a_loop_count_as_often_as_it_turns) {
    EXPECT_EQ(passOf(count("Counts", 5), "Loop").fetches, 7 * kTexels);
    EXPECT_EQ(passOf(count("Counts", 11), "Loop").fetches, 13 * kTexels);
}

TEST_P(FrameTraffic, no_more_is_read_of_a_texture_than_it_holds) {
    const Traffic loop = passOf(count("Counts"), "Loop");
    EXPECT_EQ(loop.read, kSmall * kFloats);
    EXPECT_EQ(loop.written, kTexels * kHalves);
}

TEST_P(FrameTraffic, a_branch_that_is_not_taken_costs_no_look_up) {
    const Traffic branch = passOf(count("Counts"), "Branch");
    constexpr std::uint64_t kPixels = kPixelsAcross * kPixelsAcross;
    EXPECT_EQ(branch.calls, kPixels);
    EXPECT_EQ(branch.fetches, 2 * kPixels / 4);
    EXPECT_EQ(branch.read, kTexels * kHalves + kSmall * kFloats) << "both maps whole: each is looked up more often than it has texels";
}

TEST_P(FrameTraffic, compute_shaders_count_what_they_read_and_store) {
    const Traffic other = passOf(count("CountsCompute"), "EveryOther");
    EXPECT_EQ(other.calls, kTexels);
    EXPECT_EQ(other.fetches, kTexels);
    EXPECT_EQ(other.read, kTexels * kHalves);
    EXPECT_EQ(other.written, kTexels / 2 * kHalves);
}

TEST_P(FrameTraffic, passes_come_in_the_order_of_the_frame) {
    std::vector<std::string> names;
    for (const Traffic& pass : count("CountsCompute"))
        names.push_back(pass.pass);
    EXPECT_EQ(names, (std::vector<std::string>{"Fill", "Loop", "EveryOther", "Branch"}));
}

TEST_F(Switches, a_shadow_map_of_its_own_draws_the_same_picture_bit_by_bit) {
    const BodyScene stage;
    for (const char* technique : {"DEonLuebke", "Lambert"})
        for (const int setting : {0, 2}) {
            const RunResult shared = draw(stage, technique, setting, {});
            const RunResult own = draw(stage, technique, setting, {{"TEGUMENT_SHADOW_FROM_TSM", "0"}});
            EXPECT_EQ(own.image.pixels, shared.image.pixels) << technique << ", setting " << setting;
            EXPECT_EQ(own.passes.size(), shared.passes.size() + 1) << technique << ", setting " << setting;
        }
}

TEST_F(Switches, without_any_cause_the_prepasses_spare_nothing) {
    EXPECT_EQ(culled(BodyScene(true), kNoCause), 0);
}

TEST_F(Switches, each_cause_culls_by_itself) {
    const BodyScene stage(true);
    for (const char* cause : {"TEGUMENT_CULL_FRUSTUM", "TEGUMENT_CULL_BACK_FACES", "TEGUMENT_CULL_BLACK"})
        EXPECT_GT(culled(stage, only(cause)), 0) << cause;
}

TEST_F(Switches, black_texels_are_culled_for_no_other_cause_than_black) {
    const Defines black = only("TEGUMENT_CULL_BLACK");
    EXPECT_EQ(culled(BodyScene(false), black), 0) << "the body's own map has none";
}

TEST_F(Switches, all_causes_together_cull_at_least_what_each_does) {
    const BodyScene stage(true);
    const std::ptrdiff_t all = culled(stage, {});
    for (const char* cause : {"TEGUMENT_CULL_FRUSTUM", "TEGUMENT_CULL_BACK_FACES", "TEGUMENT_CULL_BLACK"})
        EXPECT_GE(all, culled(stage, only(cause))) << cause;
}
