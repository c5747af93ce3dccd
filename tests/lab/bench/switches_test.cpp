// The switches that take one optimisation out of the skin passes (docs/settings.md): each does that, and nothing else.

#include "host/run/run.h"
#include "lab/verify/verify.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace tegument;

namespace {

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
        const auto effect = loadEffect("effects/Main.fx", {.defines = defines, .includeFolders = {}});
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
