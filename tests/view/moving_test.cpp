// How small a picture gets while something moves, what stays under the cursor, and what a session takes over from the one before an edit.

#include "host/run/pixels.h"
#include "host/run/session.h"
#include "tests/run/fixture.h"
#include "tools/view/sharpness.h"
#include "tools/view/state.h"

#include <gtest/gtest.h>

namespace tegument::view {

namespace {

/// A machine that takes so long for what does not depend on the size, and for all pixels.
struct Machine {
    double rest = 0;
    double pixels = 0;
    [[nodiscard]] double milliseconds(double share) const { return rest + pixels * share * share; }

    /// After a few pictures.
    [[nodiscard]] double settled() const {
        QuickPicture last;
        for (int i = 0; i < 8; ++i) {
            const double share = quickShare(milliseconds(1), last);
            if (share == 1) return 1;
            last = {.share = share, .milliseconds = milliseconds(share)};
        }
        return last.share;
    }
};

} // namespace

TEST(WhileItMoves, a_picture_that_is_quick_enough_is_whole) {
    EXPECT_EQ(quickShare(0, {}), 1) << "none was drawn yet";
    EXPECT_EQ((Machine{.rest = 20, .pixels = 45}.settled()), 1);
}

TEST(WhileItMoves, the_picture_is_as_small_as_answers_in_time) {
    for (const double rest : {0.0, 20.0, 50.0})
        for (const double pixels : {100.0, 400.0, 1000.0}) {
            const Machine machine{.rest = rest, .pixels = pixels};
            EXPECT_LE(machine.milliseconds(machine.settled()), 70) << rest << " and " << pixels; // the 70 ms that sharpness.h promises
            EXPECT_GT(machine.milliseconds(1.6 * machine.settled()), 50) << "not smaller than need be";
        }
}

TEST(WhileItMoves, the_picture_is_no_smaller_than_helps) {
    const Machine machine{.rest = 800, .pixels = 400};
    EXPECT_GE(machine.settled(), 0.5);
}

TEST(WhileItMoves, one_slow_picture_that_compiled_does_not_blur_the_rest) {
    const Machine machine{.rest = 5, .pixels = 30};
    QuickPicture last{.share = 0.125, .milliseconds = machine.milliseconds(0.125)};
    for (int i = 0; i < 8 && last.share < 1; ++i) {
        const double share = quickShare(5000, last);
        last = {.share = share, .milliseconds = machine.milliseconds(share)};
    }
    EXPECT_EQ(last.share, 1);
}

TEST(WhileItMoves, quick_pictures_that_are_cheaper_than_their_share_do_not_bring_the_whole_one) {
    MovingCosts costs;
    costs.note({.pixels = 390, .others = 0}, 0, 1, Moving::Rest, false);
    EXPECT_TRUE(costs.slow(Moving::Camera));
    const auto quick = [](double share) { return 5 + 100 * share * share; }; // of one sample, and fewer triangles
    for (int i = 0; i < 12; ++i) {
        const double share = costs.share(Moving::Camera);
        EXPECT_LE(quick(share), 70) << "step " << i << ", " << share;
        costs.note({.pixels = quick(share), .others = 0}, quick(share), share, Moving::Camera, true);
    }
    EXPECT_GE(costs.share(Moving::Camera), 0.75) << "as large as it may be";
    EXPECT_TRUE(costs.slow(Moving::Camera)) << "which the whole one still is";
}

TEST(WhileItMoves, maps_that_the_camera_leaves_alone_do_not_make_its_picture_smaller) {
    MovingCosts costs;
    EXPECT_EQ(costs.share(Moving::Camera), 1) << "nothing is known";
    costs.note({.pixels = 40, .others = 1000}, 0, 1, Moving::Rest, false); // the first picture
    EXPECT_EQ(costs.share(Moving::Camera), 1);
    EXPECT_LT(costs.share(Moving::Rest), 1);
    costs.note({.pixels = 40, .others = 300}, 345, 1, Moving::Camera, false); // of a technique whose maps follow the camera
    EXPECT_LT(costs.share(Moving::Camera), 1);
}

TEST(WhileItMoves, a_picture_that_drew_nothing_says_nothing) {
    MovingCosts costs;
    costs.note({.pixels = 400, .others = 0}, 0, 1, Moving::Rest, false);
    const double share = costs.share(Moving::Camera);
    EXPECT_LT(share, 1);
    costs.note({.pixels = 0, .others = 0}, 0, 1, std::nullopt, false); // all was kept
    EXPECT_EQ(costs.share(Moving::Camera), share);
}

TEST(WhileItMoves, a_pass_is_cut_until_no_band_is_long_and_joined_again_once_it_is_quick) {
    PieceTimes pieces;
    const auto take = [&](double triangles, double pixels) { // milliseconds, the triangles' in each band
        for (int i = 0; i < 12; ++i) {
            const auto found = pieces.bands().find("Final");
            const double bands = found == pieces.bands().end() ? 1 : found->second;
            pieces.note("Final", bands * triangles + pixels);
        }
        return pieces.bands().at("Final");
    };
    EXPECT_EQ(take(5, 40), 1U);
    const double bands = take(30, 420);
    EXPECT_LE(30 + 420 / bands, 60) << "what sharpness.cpp calls long";
    EXPECT_LE(bands, 16);
    EXPECT_EQ(take(100, 400), 16U) << "where no number of bands would do, there is an end";
    EXPECT_LE(take(1, 10), 2U);
}

TEST(WhileItMoves, the_line_that_says_so_is_no_wider_than_what_stands_there_at_rest) {
    const Sharpness draft{.share = 0.25, .drafting = true, .coarse = true, .single = true};
    const std::string usual = "Main.fx  technique DEonLuebke  setting corrected";
    EXPECT_LE(draftText(draft, 1920, 1080).size(), usual.size()) << "its panel would cover, and darken, more of the picture";
}

TEST(Zoom, keeps_what_is_under_the_cursor_and_ends_at_32) {
    ViewState state;
    const ViewState start = state;
    state.cursor = {0.8, 0.3};
    const glm::dvec2 place = placeSeenAt(state, state.cursor);
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(apply(state, Command::Closer, start), Request::Levels);
        EXPECT_NEAR(glm::length(placeSeenAt(state, state.cursor) - place), 0, 1e-9) << i;
    }
    EXPECT_EQ(state.zoom, 32);
    EXPECT_EQ(apply(state, Command::Closer, start), Request::None);
    EXPECT_EQ(apply(state, Command::Whole, start), Request::Levels);
    EXPECT_NEAR(glm::length(placeSeenAt(state, {0.1, 0.2}) - glm::dvec2(0.1, 0.2)), 0, 1e-12); // rounding
}

TEST(MipLevels, go_round_and_begin_anew_with_another_target) {
    ViewState state;
    state.targets = {"gA", "gB"};
    state.levels = 3;
    const ViewState start = state;
    for (const int expected : {1, 2, 0, 1}) {
        EXPECT_EQ(apply(state, Command::NextLevel, start), Request::Levels);
        EXPECT_EQ(state.level, expected);
    }
    EXPECT_EQ(showTarget(state, "gB"), Request::Draw);
    EXPECT_EQ(state.level, 0);
}

class AfterAnEdit : public test::Run {};

TEST_F(AfterAnEdit, some_rows_of_a_target_are_spread_over_its_height) {
    auto texture = device_->createTexture({.name = "t", .format = gpu::Format::R32F, .width = 3, .height = 100});
    ASSERT_TRUE(texture);
    std::vector<float> values;
    for (int i = 0; i < 300; ++i)
        values.push_back(static_cast<float>(i / 3));
    ASSERT_TRUE(device_->upload(*texture, std::as_bytes(std::span(values))));
    const auto some = run::readBackRows(*device_, *texture, 10);
    ASSERT_TRUE(some);
    ASSERT_EQ(some->height, 10);
    for (int y = 0; y < 10; ++y)
        EXPECT_EQ(some->at(2, y, 0), static_cast<float>(10 * y + 5));
    const auto all = run::readBackRows(*device_, *texture, 1000);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->pixels, values);
}

TEST_F(AfterAnEdit, a_session_takes_over_what_the_device_holds_and_draws_the_same) {
    const Mesh mesh = test::square();
    const auto effect = loadEffect("tests/run/fixtures/textures.fx", {});
    ASSERT_TRUE(effect) << format(effect.error());
    const RunOptions options{.technique = "Color",
                             .width = 16,
                             .height = 16,
                             .compiler = defaultCompiler(),
                             .textures = {{"gColorMap", "docs/images/growth.png"}}};
    const auto drawn = [&](EffectSession& session) {
        const auto frame = session.draw({}, options);
        EXPECT_TRUE(frame) << (frame ? "" : format(frame.error()));
        auto image = run::readBack(*device_, *session.target(""));
        return image ? image->pixels : std::vector<float>();
    };
    auto first = std::make_unique<EffectSession>(*device_, *effect, SessionScene{.mesh = &mesh});
    const std::vector<float> picture = drawn(*first);
    const auto one = device_->allocatedBytes();
    EffectSession alone(*device_, *effect, SessionScene{.mesh = &mesh});
    EXPECT_EQ(drawn(alone), picture);
    const auto two = device_->allocatedBytes();
    EffectSession next(*device_, *effect, SessionScene{.mesh = &mesh}, first.get());
    EXPECT_EQ(drawn(next), picture);
    EXPECT_LT(device_->allocatedBytes() - two, (two - one) / 2) << "it has no texture of its own";
    first.reset();
    EXPECT_EQ(drawn(next), picture) << "what it took over lives on";
}

} // namespace tegument::view
