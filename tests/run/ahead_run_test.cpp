// What another thread makes for a session, and a first frame that is made in pieces.

#include "host/image/image.h"
#include "host/run/ahead.h"
#include "host/run/pieces.h"
#include "host/run/pixels.h"
#include "host/run/session.h"
#include "host/support/file.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <random>
#include <set>

namespace tegument::test {
namespace {

class MadeAhead : public Run {
protected:
    void SetUp() override {
        Run::SetUp();
        auto effect = loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
        ASSERT_TRUE(succeeded(effect));
        effect_ = std::make_unique<Effect>(std::move(*effect));
        mesh_ = sphere();
        options_ = {
            .technique = "DEonLuebke", .width = 48, .height = 40, .samples = 4, .compiler = defaultCompiler(), .keepUnchanged = true};
        options_.compiling = [this](std::size_t, std::size_t) { ++compiled_; };
    }

    [[nodiscard]] SessionScene scene() const { return {.mesh = &mesh_}; }

    std::vector<float> pixels(EffectSession& session, const std::string& target = {}) {
        const auto image = run::readBack(*device_, *session.target(target));
        EXPECT_TRUE(image);
        return image ? image->pixels : std::vector<float>();
    }

    std::vector<float> expected() {
        EffectSession alone(*device_, *effect_, scene());
        EXPECT_TRUE(succeeded(alone.draw(closeUp(), options_)));
        return pixels(alone);
    }

    std::unique_ptr<Effect> effect_;
    Mesh mesh_;
    RunOptions options_;
    int compiled_ = 0;
};

TEST_F(MadeAhead, a_session_compiles_and_reads_nothing_that_another_thread_has) {
    const std::vector<float> picture = expected();
    EXPECT_GT(compiled_, 10) << "the effect's passes, and those of the effect that draws its Stretch map";
    auto ahead = std::async(std::launch::async, [&] { return run::prepareAhead(*effect_, scene(), closeUp(), options_, {}); }).get();
    ASSERT_TRUE(succeeded(ahead));
    EXPECT_EQ(ahead->programs.size(), 13U) << "passes of the technique";
    EXPECT_FALSE(ahead->textures.empty());
    EXPECT_FALSE(ahead->producers.empty());
    compiled_ = 0;
    EffectSession session(*device_, *effect_, scene());
    session.take(std::move(*ahead));
    const auto frame = session.draw(closeUp(), options_);
    ASSERT_TRUE(succeeded(frame));
    EXPECT_EQ(compiled_, 0);
    EXPECT_EQ(pixels(session), picture);
    EXPECT_EQ(frame->produced.size(), 2U) << "what other effects draw for it is drawn, as always";
}

TEST_F(MadeAhead, what_a_session_knows_is_not_made_again) {
    EffectSession before(*device_, *effect_, scene());
    ASSERT_TRUE(succeeded(before.draw(closeUp(), options_)));
    compiled_ = 0;
    const auto ahead = run::prepareAhead(*effect_, scene(), closeUp(), options_, before.known());
    ASSERT_TRUE(succeeded(ahead));
    EXPECT_TRUE(ahead->textures.empty());
    EffectSession next(*device_, *effect_, scene(), &before);
    const auto bytes = device_->allocatedBytes();
    const auto frame = next.draw(closeUp(), options_);
    ASSERT_TRUE(succeeded(frame));
    EXPECT_TRUE(std::ranges::all_of(frame->passes, &SessionPass::kept)) << "a kept side costs nothing while nothing moves";
    EXPECT_TRUE(frame->produced.empty());
    EXPECT_EQ(device_->allocatedBytes(), bytes);
    EXPECT_EQ(pixels(next), pixels(before));
}

TEST_F(MadeAhead, errors_come_from_the_thread_as_they_would_from_the_session) {
    RunOptions wrong = options_;
    wrong.technique = "NoSuchTechnique";
    EffectSession session(*device_, *effect_, scene());
    const auto ahead = run::prepareAhead(*effect_, scene(), closeUp(), wrong, {});
    ASSERT_FALSE(ahead);
    EXPECT_FALSE(run::isGivenUp(ahead.error()));
    EXPECT_EQ(code(ahead), code(session.draw(closeUp(), wrong)));
}

TEST_F(MadeAhead, a_thread_that_is_given_up_ends_behind_a_shader) {
    const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2); // a shader for each
    RunOptions options = options_;
    int shaders = 0;
    options.compiling = [&](std::size_t, std::size_t) { ++shaders; };
    options.pieces.goOn = [&] { return shaders < 2; };
    const auto ahead = run::prepareAhead(*effect_, scene(), closeUp(), options, {});
    ASSERT_FALSE(ahead);
    EXPECT_TRUE(run::isGivenUp(ahead.error()));
    EXPECT_EQ(shaders, 2);
}

TEST_F(MadeAhead, shaders_that_passes_share_are_compiled_once) {
    std::vector<const Pass*> passes;
    std::set<std::string> entries;
    for (const Technique& technique : effect_->techniques)
        for (const Pass& pass : technique.passes) {
            passes.push_back(&pass);
            for (const auto& shader : {pass.vertexShader, pass.pixelShader, pass.computeShader})
                if (shader) entries.insert(shader->entry);
        }
    const std::vector<run::StageKey> keys = run::stagesOf(passes);
    std::set<std::string> compiled;
    for (const run::StageKey& key : keys)
        EXPECT_TRUE(compiled.insert(std::string(key.entry)).second) << key.entry << ": no entry of this effect has two stages";
    EXPECT_EQ(compiled, entries);
    EXPECT_LT(keys.size(), 2 * passes.size());
}

TEST_F(MadeAhead, a_first_frame_that_is_given_up_again_and_again_gets_done_and_is_right) {
    const std::vector<float> picture = expected();
    auto ahead = run::prepareAhead(*effect_, scene(), closeUp(), options_, {});
    ASSERT_TRUE(succeeded(ahead));
    EffectSession session(*device_, *effect_, scene());
    session.take(std::move(*ahead));
    options_.pieces.goOn = [] { return false; };
    constexpr int kMost = 300;
    int tries = 0;
    for (bool prepared = false; !prepared && tries < kMost; ++tries) {
        const auto frame = session.draw(closeUp(), options_);
        ASSERT_TRUE(succeeded(frame));
        ASSERT_TRUE(frame->givenUp);
        prepared = !frame->passes.empty();
    }
    EXPECT_GT(tries, 20) << "targets, textures and pipelines are pieces of their own";
    EXPECT_LT(tries, kMost);
    for (int i = 0; i < 3; ++i) { // two products, then the first pass
        const auto frame = session.draw(closeUp(), options_);
        ASSERT_TRUE(succeeded(frame));
        EXPECT_TRUE(frame->givenUp);
        EXPECT_EQ(frame->produced.size(), i == 0 ? 1U : 0U) << "one was drawn before, and is not again";
    }
    bool drawn = false;
    for (tries = 0; !drawn && tries < kMost; ++tries) {
        const auto frame = session.draw(closeUp(), options_);
        ASSERT_TRUE(succeeded(frame));
        drawn = !frame->givenUp;
    }
    EXPECT_LE(tries, 14) << "13 passes and the resolve: none is drawn twice, though targets are drawn into early and late";
    EXPECT_EQ(pixels(session), picture);
}

TEST_F(MadeAhead, the_session_before_moves_while_the_next_one_is_made_in_pieces) {
    EffectSession before(*device_, *effect_, scene());
    ASSERT_TRUE(succeeded(before.draw(closeUp(), options_)));
    RunOptions lambert = options_;
    lambert.technique = "Lambert";
    EffectSession next(*device_, *effect_, scene(), &before);
    RunOptions pieces = lambert;
    pieces.pieces.goOn = [] { return false; };
    Workspace workspace = closeUp();
    for (int i = 0; i < 60; ++i) {
        const auto piece = next.draw(closeUp(), pieces);
        ASSERT_TRUE(succeeded(piece));
        if (!piece->givenUp) break;
        workspace.camera.position = {0.1F * static_cast<float>(i), 0, 5};
        workspace.light.position = {1, 0.2F * static_cast<float>(i), 5};
        if (i % 4 == 0) {
            ASSERT_TRUE(succeeded(before.draw(workspace, options_)));
        }
    }
    ASSERT_TRUE(succeeded(next.draw(closeUp(), lambert)));
    ASSERT_TRUE(succeeded(before.draw(workspace, options_)));
    EffectSession one(*device_, *effect_, scene());
    EffectSession other(*device_, *effect_, scene());
    ASSERT_TRUE(succeeded(one.draw(closeUp(), lambert)));
    ASSERT_TRUE(succeeded(other.draw(workspace, options_)));
    EXPECT_EQ(pixels(next), pixels(one));
    EXPECT_EQ(pixels(before), pixels(other));
    EXPECT_EQ(pixels(before, "gIrradianceMap"), pixels(other, "gIrradianceMap"));
}

class MadeOfAMesh : public Run {
protected:
    void SetUp() override {
        Run::SetUp();
        folder_ = std::filesystem::temp_directory_path() / ("tegument-made-" + std::to_string(std::random_device{}()));
        std::filesystem::create_directories(folder_);
        auto effect = loadEffect(kFixtures / "made.fx", {});
        ASSERT_TRUE(succeeded(effect));
        effect_ = std::make_unique<Effect>(std::move(*effect));
        options_ = row(4, "Made");
        options_.keepUnchanged = true;
        options_.assets.make = [this](const std::string&, const Mesh&) -> Result<std::filesystem::path> {
            ++asked_;
            if (!std::filesystem::exists(folder_ / "map.png")) {
                const Image image{.width = 1, .height = 1, .channels = 3, .pixels = {0.5F, 0.5F, 0.5F}};
                if (auto written = writePng(folder_ / "map.png", image, PngEncoding::Raw); !written) return written.error();
            }
            return folder_ / "map.png";
        };
        options_.assets.check = [this](const std::string&, const std::filesystem::path&, const Mesh&) -> Result<void> {
            ++checked_;
            return {};
        };
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
    std::unique_ptr<Effect> effect_;
    Mesh mesh_ = square();
    RunOptions options_;
    int asked_ = 0;
    int checked_ = 0;
};

TEST_F(MadeOfAMesh, is_asked_for_once_by_all_frames_of_sessions_that_follow_each_other_and_anew_where_it_is_gone) {
    EffectSession session(*device_, *effect_, {.mesh = &mesh_});
    for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(succeeded(session.draw({}, options_)));
    EXPECT_EQ(asked_, 1) << "who makes it looks at all of the mesh first";
    EffectSession next(*device_, *effect_, {.mesh = &mesh_}, &session);
    ASSERT_TRUE(succeeded(next.draw({}, options_)));
    EXPECT_EQ(asked_, 1);
    next.bakeAgain("gMadeMap");
    ASSERT_TRUE(succeeded(next.draw({}, options_)));
    EXPECT_EQ(asked_, 2);
    EffectSession other(*device_, *effect_, {.mesh = &mesh_});
    ASSERT_TRUE(succeeded(other.draw({}, options_)));
    EXPECT_EQ(asked_, 3);
}

TEST_F(MadeOfAMesh, says_how_long_it_took_to_whoever_finds_it_later) {
    EffectSession first(*device_, *effect_, {.mesh = &mesh_});
    const auto made = first.draw({}, options_);
    ASSERT_TRUE(succeeded(made));
    const auto bake = made->textures.front().bake;
    ASSERT_TRUE(bake);
    EXPECT_FALSE(bake->fromCache);
    EXPECT_EQ(bake->once, 0);
    const std::string noted = *readFile(folder_ / "map.png.ms");
    EffectSession second(*device_, *effect_, {.mesh = &mesh_});
    ASSERT_TRUE(succeeded(second.draw({}, options_)));
    EXPECT_EQ(*readFile(folder_ / "map.png.ms"), noted) << "who finds it at once has not made it";
    std::filesystem::last_write_time(folder_ / "map.png", std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    const auto found = [&] {
        EffectSession later(*device_, *effect_, {.mesh = &mesh_});
        const auto frame = later.draw({}, options_);
        EXPECT_TRUE(succeeded(frame));
        EXPECT_TRUE(frame->textures.front().bake->fromCache);
        return frame->textures.front().bake->once;
    };
    EXPECT_NEAR(found(), bake->milliseconds, 0.051) << "it is written with one digit";
    for (const char* damaged : {"", "soon", "-3", "nan", "inf"}) {
        std::ofstream(folder_ / "map.png.ms") << damaged;
        EXPECT_EQ(found(), 0) << damaged;
    }
}

TEST_F(MadeOfAMesh, is_held_against_the_mesh_once_where_it_is_given) {
    ASSERT_TRUE(succeeded(options_.assets.make("", mesh_)));
    options_.textures["gMadeMap"] = (folder_ / "map.png").string();
    EffectSession session(*device_, *effect_, {.mesh = &mesh_});
    for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(succeeded(session.draw({}, options_)));
    EXPECT_EQ(checked_, 1);
}

class OfFewerTexels : public Run {};

/// As the viewer draws while the light moves: maps of a quarter of the texels along each side, one sample a pixel, a small picture.
TEST_F(OfFewerTexels, a_picture_with_half_of_a_body_in_shadow_is_as_bright_as_the_whole_one) {
    const Mesh mesh = sphere();
    const auto mean = [&](const char* side, int pixels, int samples, const glm::vec3& light) {
        const auto effect = loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", side}}});
        EXPECT_TRUE(succeeded(effect));
        EffectSession session(*device_, *effect, {.mesh = &mesh});
        Workspace workspace = closeUp();
        workspace.light.position = light;
        const RunOptions options{
            .technique = "DEonLuebke", .width = pixels, .height = pixels, .samples = samples, .compiler = defaultCompiler()};
        EXPECT_TRUE(succeeded(session.draw(workspace, options)));
        const auto image = run::readBack(*device_, *session.target(""));
        EXPECT_TRUE(image);
        double sum = 0;
        for (std::size_t i = 0; i < image->pixels.size(); ++i)
            sum += i % 4 == 3 ? 0 : static_cast<double>(image->pixels[i]);
        return sum / (pixels * pixels);
    };
    for (const glm::vec3& light : {glm::vec3(-600, 100, 0), glm::vec3(100, 500, -400)}) {
        const double whole = mean("512", 256, 4, light);
        EXPECT_GT(whole, 0);
        EXPECT_NEAR(mean("128", 96, 1, light) / whole, 1, 0.03) << "nobody sees a few percent while something moves";
    }
}

} // namespace
} // namespace tegument::test
