// Textures that other effects draw: what is drawn when, from what, and what is said when it cannot be.

#include "host/run/pixels.h"
#include "host/run/session.h"
#include "tests/run/fixture.h"

#include <algorithm>
#include <filesystem>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

RunOptions pixels(const std::string& technique) {
    return {.technique = technique, .width = 8, .height = 4, .compiler = defaultCompiler()};
}

class Products : public Run {
protected:
    /// What `consumer.fx` draws, and the effects that had to be drawn for it.
    struct Drawn {
        Image image;
        Names produced;
    };

    void load(const LoadOptions& options = {}) {
        auto effect = loadEffect(kFixtures / "consumer.fx", options);
        ASSERT_TRUE(succeeded(effect));
        effect_ = std::make_unique<Effect>(std::move(*effect));
        session_ = std::make_unique<EffectSession>(*device_, *effect_, SessionScene{});
    }

    Result<Drawn> draw(const RunOptions& options, const Workspace& workspace = {}) {
        if (!session_) return inputError(0, {}, "load() has failed");
        const auto frame = session_->draw(workspace, options);
        if (!frame) return frame.error();
        Drawn drawn;
        for (const std::string& file : frame->produced)
            drawn.produced.push_back(fs::path(file).filename().string());
        auto image = run::readBack(*device_, *session_->target(""));
        if (!image) return image.error();
        drawn.image = std::move(*image);
        return drawn;
    }

    Result<RunResult> once(const std::string& technique, const Workspace& workspace = {}, const LoadOptions& load = {}) {
        return run("consumer.fx", pixels(technique), nullptr, workspace, load);
    }

    std::unique_ptr<Effect> effect_;
    std::unique_ptr<EffectSession> session_;
};

Workspace with(const std::string& parameter, double value) {
    Workspace workspace;
    workspace.parameters[parameter] = {value};
    return workspace;
}

Workspace seenFrom(float z) {
    Workspace workspace;
    workspace.cameraRelative = false;
    workspace.camera.position = {0, 0, z};
    workspace.camera.nearPlane = 1;
    workspace.camera.farPlane = 100;
    return workspace;
}

TEST_F(Products, parameters_that_make_a_difference_are_those_of_shaders_scripts_and_of_what_is_drawn_for_them) {
    const auto readBy = [&](const std::string& file, const std::string& technique) {
        const auto effect = loadEffect(kFixtures / file);
        EXPECT_TRUE(succeeded(effect));
        EffectSession session(*device_, *effect, SessionScene{});
        const auto frame = session.draw({}, pixels(technique));
        EXPECT_TRUE(succeeded(frame));
        return frame ? frame->parameters : Names{};
    };
    const Names product = readBy("consumer.fx", "Product");
    EXPECT_EQ(std::ranges::count(product, "gScale"), 1) << "of the shader";
    EXPECT_EQ(std::ranges::count(product, "gViewProjection"), 0) << "of another technique";
    const Names cleared = readBy("scripts.fx", "ClearOnly");
    EXPECT_EQ(std::ranges::count(cleared, "gClearValue"), 1) << "a clear value";
    EXPECT_EQ(std::ranges::count(cleared, "gCount"), 0);
    EXPECT_EQ(std::ranges::count(readBy("scripts.fx", "Loop"), "gCount"), 1) << "a loop's count";
}

TEST_F(Products, another_effect_draws_a_texture) {
    const auto result = once("Product");
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(pixelIs(result->image, 0, 0, {0.5F / 8, 0.5F / 4, 2, 0.5F})); // exact in halves
    EXPECT_TRUE(pixelIs(result->image, 7, 3, {7.5F / 8, 3.5F / 4, 2, 0.5F}));
}

TEST_F(Products, the_producing_effect_gets_the_same_definitions) {
    const auto result = once("Product", {}, {.defines = {{"GREEN", "0.25"}}});
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(0, 0, 3), 0.25F);
}

TEST_F(Products, the_producing_effect_gets_the_workspace_s_values) {
    const auto result = once("Product", with("gGain", 4));
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(0, 0, 2), 4.0F);
}

TEST_F(Products, are_drawn_once_for_all_frames_that_read_the_same) {
    load();
    const auto first = draw(pixels("Product"));
    const auto second = draw(pixels("Product"));
    ASSERT_TRUE(succeeded(first) && succeeded(second));
    EXPECT_EQ(first->produced, Names{"product.fx"});
    EXPECT_EQ(second->produced, Names{});
    EXPECT_EQ(second->image.pixels, first->image.pixels);
    EXPECT_EQ(second->image.at(0, 0, 2), 2.0F);
}

TEST_F(Products, frames_that_are_timed_draw_them_before_the_first_only_and_do_not_count_them) {
    load();
    RunOptions options = pixels("Product");
    options.warmUpFrames = 1;
    options.frames = 3;
    const auto frame = session_->draw({}, options);
    ASSERT_TRUE(succeeded(frame));
    EXPECT_EQ(frame->produced.size(), 1U);
    ASSERT_EQ(frame->passes.size(), 1U);
    EXPECT_EQ(frame->passes.front().name, "Product");
}

TEST_F(Products, are_drawn_anew_when_a_number_that_they_read_changes) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Product"))));
    const auto changed = draw(pixels("Product"), with("gGain", 4));
    ASSERT_TRUE(succeeded(changed));
    EXPECT_EQ(changed->produced, Names{"product.fx"});
    EXPECT_EQ(changed->image.at(0, 0, 2), 4.0F);
    const auto back = draw(pixels("Product"));
    ASSERT_TRUE(succeeded(back));
    EXPECT_EQ(back->produced, Names{"product.fx"});
    EXPECT_EQ(back->image.at(0, 0, 2), 2.0F);
}

TEST_F(Products, stay_when_a_number_changes_that_only_the_effect_reads) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Product"))));
    const auto changed = draw(pixels("Product"), with("gScale", 0.5));
    ASSERT_TRUE(succeeded(changed));
    EXPECT_EQ(changed->produced, Names{});
    EXPECT_EQ(changed->image.at(0, 0, 2), 1.0F);
}

TEST_F(Products, stay_when_the_picture_has_another_size) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Product"))));
    RunOptions larger = pixels("Product");
    larger.width = 16;
    const auto changed = draw(larger);
    ASSERT_TRUE(succeeded(changed));
    EXPECT_EQ(changed->produced, Names{});
}

TEST_F(Products, a_clear_value_is_read_too) {
    load();
    const auto first = draw(pixels("Cleared"));
    ASSERT_TRUE(succeeded(first));
    EXPECT_EQ(first->produced, Names{"cleared.fx"});
    EXPECT_TRUE(pixelIs(first->image, 0, 0, {0.25F, 0.5F, 0.75F, 1}, 0.51F / 255)) << "half a step of 8 bits, and rounding";
    Workspace workspace;
    workspace.parameters["gPaint"] = {1, 0, 1, 0};
    const auto second = draw(pixels("Cleared"), workspace);
    ASSERT_TRUE(succeeded(second));
    EXPECT_EQ(second->produced, Names{"cleared.fx"});
    EXPECT_TRUE(pixelIs(second->image, 0, 0, {1, 0, 1, 0}));
}

TEST_F(Products, a_producer_of_a_producer_is_drawn_before_it) {
    load();
    const auto first = draw(pixels("Chain"));
    ASSERT_TRUE(succeeded(first));
    EXPECT_EQ(first->produced, (Names{"product.fx", "chain.fx"}));
    EXPECT_TRUE(pixelIs(first->image, 0, 0, {1 + 0.5F / 8, 1 + 0.5F / 4, 3, 1.5F}));
    const auto offset = draw(pixels("Chain"), with("gOffset", 2));
    ASSERT_TRUE(succeeded(offset));
    EXPECT_EQ(offset->produced, Names{"chain.fx"}) << "what the first one reads has not changed";
    EXPECT_EQ(offset->image.at(0, 0, 2), 4.0F);
}

TEST_F(Products, what_is_drawn_from_another_product_follows_it) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Chain"))));
    const auto gained = draw(pixels("Chain"), with("gGain", 8));
    ASSERT_TRUE(succeeded(gained));
    EXPECT_EQ(gained->produced, (Names{"product.fx", "chain.fx"}));
    EXPECT_EQ(gained->image.at(0, 0, 2), 9.0F);
}

TEST_F(Products, two_textures_of_one_effect_are_drawn_together) {
    load();
    const auto both = draw(pixels("Both"), seenFrom(5));
    ASSERT_TRUE(succeeded(both));
    EXPECT_EQ(both->produced, (Names{"product.fx", "chain.fx"}));
    EXPECT_EQ(both->image.at(0, 0, 2), 3.0F + 5.0F);
}

TEST_F(Products, another_texture_of_a_drawn_effect_is_drawn_when_it_is_asked_for) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Chain"), seenFrom(5))));
    const auto eye = draw(pixels("Eye"), seenFrom(5));
    ASSERT_TRUE(succeeded(eye));
    EXPECT_EQ(eye->produced, Names{"chain.fx"});
    EXPECT_EQ(eye->image.at(0, 0, 2), 5.0F);
}

TEST_F(Products, that_read_the_camera_follow_it) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Eye"), seenFrom(5))));
    const auto moved = draw(pixels("Eye"), seenFrom(7));
    ASSERT_TRUE(succeeded(moved));
    EXPECT_EQ(moved->produced, Names{"chain.fx"});
    EXPECT_EQ(moved->image.at(0, 0, 2), 7.0F);
    const auto still = draw(pixels("Eye"), seenFrom(7));
    ASSERT_TRUE(succeeded(still));
    EXPECT_EQ(still->produced, Names{});
}

TEST_F(Products, that_ask_for_mip_levels_have_them) {
    load();
    const auto eye = draw(pixels("Eye"), seenFrom(5)); // level 2 of 4 x 4: one texel, the mean of u
    ASSERT_TRUE(succeeded(eye));
    EXPECT_EQ(eye->image.at(0, 0, 3), 0.5F);
    EXPECT_EQ(eye->image.at(7, 0, 3), 0.5F);
}

TEST_F(Products, that_are_not_sampled_any_more_leave_the_device) {
    load();
    ASSERT_TRUE(succeeded(draw(pixels("Product"))));
    const std::uint64_t one = device_->allocatedBytes();
    ASSERT_TRUE(succeeded(draw(pixels("Chain"))));
    EXPECT_GT(device_->allocatedBytes(), one);
    ASSERT_TRUE(succeeded(draw(pixels("Product"))));
    EXPECT_EQ(device_->allocatedBytes(), one);
}

TEST_F(Products, of_objects_that_differ_in_their_own_parameters_are_several) {
    const auto effect = loadEffect(kFixtures / "consumer.fx");
    ASSERT_TRUE(succeeded(effect));
    const Mesh mesh = square();
    Workspace scene = seenFrom(200);
    scene.camera.farPlane = 400;
    const auto tinted = [&](float x, double tint) {
        const Placement placement{.position = {x, 0, 0}, .rotation = {0, 30, 0}};
        return RunObject{.mesh = &mesh, .workspace = workspaceOf(scene, {{}, placement, {}, {{"gTint", {tint}}}}), .placement = placement};
    };
    const std::vector<RunObject> alike = {tinted(-25, 0.5), tinted(25, 0.5)};
    const std::vector<RunObject> different = {tinted(-25, 0.5), tinted(25, 0.75)};
    RunOptions options = pixels("Placed");
    options.width = options.height = 64;
    EffectSession shared(*device_, *effect, {.mesh = nullptr, .objects = alike});
    const auto once = shared.draw(scene, options);
    ASSERT_TRUE(succeeded(once));
    EXPECT_EQ(once->produced.size(), 1U) << "each in its own space, both are the same";
    EffectSession apart(*device_, *effect, {.mesh = nullptr, .objects = different});
    const auto twice = apart.draw(scene, options);
    ASSERT_TRUE(succeeded(twice));
    EXPECT_EQ(twice->produced.size(), 2U);
    const auto image = run::readBack(*device_, *apart.target(""));
    ASSERT_TRUE(succeeded(image));
    std::set<float> tints;
    for (std::size_t i = 3; i < image->pixels.size(); i += 4)
        tints.insert(image->pixels[i]);
    EXPECT_EQ(tints, (std::set<float>{0, 0.5F, 0.75F}));
    const auto again = apart.draw(scene, options);
    ASSERT_TRUE(succeeded(again));
    EXPECT_EQ(again->produced, Names{});
}

TEST_F(Products, after_a_frame_that_failed_are_drawn_by_the_next) {
    load();
    RunOptions unknown = pixels("Product");
    unknown.dump = {"gNoSuchMap"};
    EXPECT_EQ(code(draw(unknown)), 4029);
    const auto drawn = draw(pixels("Product"));
    ASSERT_TRUE(succeeded(drawn));
    EXPECT_EQ(drawn->produced, Names{"product.fx"});
    EXPECT_EQ(drawn->image.at(0, 0, 2), 2.0F);
}

TEST_F(Products, a_producer_without_that_target_is_an_error_that_says_who_asked) {
    const auto result = once("NoTarget");
    ASSERT_EQ(code(result), 4036);
    EXPECT_EQ(result.error().diagnostics.front().hint, "did you mean 'gProductMap'?");
    EXPECT_EQ(result.error().diagnostics.back().code, 4037);
    EXPECT_NE(format(result.error()).find("gNoTargetMap is drawn by tests/run/fixtures/product.fx"), std::string::npos)
        << format(result.error());
}

TEST_F(Products, an_error_deep_in_a_chain_names_every_effect_on_the_way) {
    const auto result = once("Broken");
    ASSERT_EQ(code(result), 4036);
    const std::string message = format(result.error());
    const std::size_t inner = message.find("gMissingMap is drawn by tests/run/fixtures/product.fx");
    const std::size_t outer = message.find("gBrokenMap is drawn by tests/run/fixtures/broken_chain.fx");
    EXPECT_NE(inner, std::string::npos) << message;
    EXPECT_NE(outer, std::string::npos) << message;
    EXPECT_LT(inner, outer) << message;
}

TEST_F(Products, a_producer_that_cannot_be_read_is_an_error_that_names_it) {
    const auto result = once("Lost");
    ASSERT_FALSE(result);
    EXPECT_NE(format(result.error()).find("gLostMap is drawn by tests/run/fixtures/lost.fx"), std::string::npos) << format(result.error());
}

TEST_F(Products, producers_in_a_circle_are_an_error) {
    EXPECT_EQ(code(once("Circle")), 4035);
}

} // namespace
} // namespace tegument::test
