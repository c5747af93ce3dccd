#include "host/run/plan.h"
#include "tests/run/fixture.h"

#include <algorithm>

namespace tegument::run {
namespace {

const std::array<float, 4> kGrey = {0.5F, 0.5F, 0.5F, 0};

/// A plan of draws written by hand, on targets of two sizes.
class Completing : public testing::Test {
protected:
    Completing() {
        pass_.name = "P";
        pass_.state.depthTest = false;
        uses_[&pass_] = {.writtenColors = 1};
    }

    DrawStep& draw(std::vector<std::optional<std::string>> colors, std::optional<std::string> depth = std::nullopt) {
        plan_.steps.emplace_back(DrawStep{.pass = &pass_, .colors = std::move(colors), .depth = std::move(depth)});
        return std::get<DrawStep>(plan_.steps.back());
    }

    Result<void> complete() { return completePlan(plan_, uses_, shapes_, kGrey, warnings_); }

    template <class T>
    std::vector<T> steps() const {
        std::vector<T> found;
        for (const Step& step : plan_.steps)
            if (const auto* match = std::get_if<T>(&step)) found.push_back(*match);
        return found;
    }

    Pass pass_;
    Plan plan_;
    std::map<const Pass*, PassUse> uses_;
    std::map<std::string, TargetShape> shapes_ = {{kPicture, {64, 64, 1, false}}, {kPictureDepth, {64, 64, 1, true}},
                                                  {"gSmall", {32, 32, 1, false}}, {"gChain", {32, 32, 0, false}},
                                                  {"gDepth", {32, 32, 1, true}},  {"gOther", {32, 32, 1, false}}};
    std::vector<Diagnostic> warnings_;
};

TEST_F(Completing, a_depth_target_is_dropped_when_the_pass_tests_nothing) {
    draw({"gSmall"}, kPictureDepth);
    draw({"gSmall"}, "gDepth");
    ASSERT_TRUE(test::succeeded(complete()));
    for (const DrawStep& step : steps<DrawStep>())
        EXPECT_FALSE(step.depth);
}

TEST_F(Completing, a_depth_target_of_another_size_is_an_error_when_the_pass_tests_depth) {
    pass_.state.depthTest = true;
    draw({"gSmall"}, kPictureDepth);
    EXPECT_EQ(test::code(complete()), 4025);
}

TEST_F(Completing, a_colour_target_that_is_masked_out_does_not_decide_the_size) {
    pass_.state.depthTest = true;
    pass_.state.targets[0].writeMask = 0;
    draw({kPicture}, "gDepth");
    ASSERT_TRUE(test::succeeded(complete()));
    EXPECT_TRUE(steps<DrawStep>().front().colors.empty());
    EXPECT_EQ(steps<DrawStep>().front().depth, "gDepth");
}

TEST_F(Completing, two_written_targets_of_different_sizes_are_an_error) {
    uses_[&pass_].writtenColors = 3;
    draw({kPicture, "gSmall"});
    EXPECT_EQ(test::code(complete()), 4025);
}

TEST_F(Completing, the_caller_s_depth_of_several_samples_beside_a_target_of_one_is_an_error_that_names_both) {
    shapes_[kPictureDepth].samples = 4;
    shapes_["gFull"] = {64, 64, 1, false};
    pass_.state.depthTest = true;
    draw({"gFull"}, kPictureDepth);
    const auto completed = complete();
    ASSERT_EQ(test::code(completed), 4039);
    EXPECT_EQ(completed.error().diagnostics.front().text,
              "pass P has targets of different samples a pixel: gFull has 1, <picture depth> has 4");
}

TEST_F(Completing, the_caller_s_depth_of_several_samples_is_dropped_when_the_pass_tests_nothing) {
    shapes_[kPictureDepth].samples = 4;
    shapes_["gFull"] = {64, 64, 1, false};
    draw({"gFull"}, kPictureDepth);
    ASSERT_TRUE(test::succeeded(complete()));
    EXPECT_FALSE(steps<DrawStep>().front().depth);
}

TEST_F(Completing, sampling_a_bound_target_is_an_error_that_names_pass_and_texture) {
    uses_[&pass_].sampled = {"gSmall"};
    draw({"gSmall"});
    const auto completed = complete();
    ASSERT_EQ(test::code(completed), 4024);
    EXPECT_EQ(completed.error().diagnostics.front().text, "pass P samples gSmall while drawing into it");
}

TEST_F(Completing, one_target_in_two_places_is_an_error) {
    draw({"gSmall", "gSmall"});
    AddedTargets added;
    EXPECT_EQ(test::code(completePlan(plan_, uses_, shapes_, kGrey, warnings_, &added)), 4024) << "for other hosts, too";
}

TEST_F(Completing, for_other_hosts_a_sampled_target_that_is_bound_is_copied_first) {
    uses_[&pass_].sampled = {"gSmall", "gOther"};
    draw({"gSmall"});
    draw({"gSmall"});
    AddedTargets added;
    ASSERT_TRUE(test::succeeded(completePlan(plan_, uses_, shapes_, kGrey, warnings_, &added)));
    ASSERT_EQ(steps<CopyStep>().size(), 2U) << "before each of the draws";
    const CopyStep copy = steps<CopyStep>().front();
    EXPECT_EQ(copy.from, "gSmall");
    EXPECT_EQ(added.copies, (std::map<std::string, std::string>{{copy.to, "gSmall"}}));
    for (const DrawStep& step : steps<DrawStep>())
        EXPECT_EQ(step.copies, (std::map<std::string, std::string>{{"gSmall", copy.to}})) << "gOther is no target of the pass";
    EXPECT_EQ(std::ranges::count(warnings_, 4024, &Diagnostic::code), 1) << "said once";
    const auto at = [&](auto is) { return std::ranges::find_if(plan_.steps, is) - plan_.steps.begin(); };
    EXPECT_LT(at([](const Step& step) { return std::holds_alternative<CopyStep>(step); }),
              at([](const Step& step) { return std::holds_alternative<DrawStep>(step); }));
}

TEST_F(Completing, for_other_hosts_depth_may_be_larger_and_the_caller_s_gives_way_to_one_that_fits) {
    pass_.state.depthTest = true;
    shapes_["gWide"] = {128, 32, 1, false};
    draw({"gOther"}, kPictureDepth);
    draw({"gWide"}, kPictureDepth);
    AddedTargets added;
    ASSERT_TRUE(test::succeeded(completePlan(plan_, uses_, shapes_, kGrey, warnings_, &added)));
    EXPECT_EQ(steps<DrawStep>()[0].depth, kPictureDepth) << "64 x 64 for 32 x 32";
    ASSERT_EQ(added.depths.size(), 1U);
    EXPECT_EQ(*added.depths.begin(), (std::pair<const std::string, std::string>{*steps<DrawStep>()[1].depth, "gWide"}));
}

TEST_F(Completing, for_other_hosts_too_their_own_depth_may_not_be_smaller) {
    pass_.state.depthTest = true;
    draw({kPicture}, "gDepth");
    AddedTargets added;
    EXPECT_EQ(test::code(completePlan(plan_, uses_, shapes_, kGrey, warnings_, &added)), 4025);
}

TEST_F(Completing, sampling_a_bound_depth_target_is_an_error) {
    pass_.state.depthTest = true;
    uses_[&pass_].sampled = {"gDepth"};
    draw({"gSmall"}, "gDepth");
    EXPECT_EQ(test::code(complete()), 4024);
}

TEST_F(Completing, a_target_sampled_before_it_is_drawn_warns_and_is_cleared) {
    uses_[&pass_].sampled = {"gSmall"};
    draw({kPicture});
    ASSERT_TRUE(test::succeeded(complete()));
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_.front().code, 4026);
    EXPECT_EQ(std::get<ClearStep>(plan_.steps.front()).target, "gSmall");
}

TEST_F(Completing, a_target_that_keeps_what_an_earlier_frame_left_is_sampled_as_it_is) {
    uses_[&pass_].sampled = {"gSmall"};
    shapes_.at("gSmall").keeps = true;
    draw({kPicture});
    ASSERT_TRUE(test::succeeded(complete()));
    EXPECT_TRUE(warnings_.empty());
    for (const ClearStep& clear : steps<ClearStep>())
        EXPECT_NE(clear.target, "gSmall");
}

TEST_F(Completing, the_picture_starts_as_the_background) {
    draw({kPicture});
    ASSERT_TRUE(test::succeeded(complete()));
    const auto clears = steps<ClearStep>();
    ASSERT_EQ(clears.size(), 1U);
    EXPECT_EQ(clears.front().color, kGrey);
}

TEST_F(Completing, a_target_that_the_script_clears_is_not_cleared_twice) {
    plan_.steps.emplace_back(ClearStep{.target = "gSmall"});
    draw({"gSmall"});
    ASSERT_TRUE(test::succeeded(complete()));
    EXPECT_EQ(steps<ClearStep>().size(), 1U);
}

TEST_F(Completing, a_mip_chain_is_made_once_between_drawing_and_sampling) {
    draw({"gChain"});
    Pass reader;
    reader.name = "Reader";
    reader.state.depthTest = false;
    uses_[&reader] = {.sampled = {"gChain"}, .writtenColors = 1};
    draw({"gSmall"}).pass = &reader;
    draw({"gOther"}).pass = &reader;
    ASSERT_TRUE(test::succeeded(complete()));
    EXPECT_EQ(steps<MipStep>().size(), 1U);
}

TEST_F(Completing, a_gap_between_colour_targets_is_an_error) {
    uses_[&pass_].writtenColors = 4;
    draw({"gSmall", std::nullopt, "gOther"});
    EXPECT_EQ(test::code(complete()), 4028);
}

TEST_F(Completing, drawing_with_nothing_bound_is_an_error) {
    draw({});
    EXPECT_EQ(test::code(complete()), 4027);
}

/// All that the annotation promises, and that the host sees for itself.
TEST_F(Completing, a_target_that_a_full_screen_pass_overwrites_is_not_cleared_before) {
    pass_.annotations.list.push_back({.name = "CoversTarget", .value = std::vector<double>{1}});
    draw({"gSmall"}).kind = DrawKind::Buffer;
    ASSERT_TRUE(test::succeeded(complete()));
    EXPECT_TRUE(steps<ClearStep>().empty());
}

TEST_F(Completing, a_target_is_cleared_before_a_pass_that_may_leave_pixels_out) {
    const auto clearsOf = [&](auto change) {
        pass_ = {};
        pass_.name = "P";
        pass_.state.depthTest = false;
        pass_.annotations.list.push_back({.name = "CoversTarget", .value = std::vector<double>{1}});
        uses_[&pass_] = {.writtenColors = 1};
        plan_ = {};
        DrawStep& step = draw({"gSmall"});
        step.kind = DrawKind::Buffer;
        change(step);
        EXPECT_TRUE(test::succeeded(complete()));
        return steps<ClearStep>().size();
    };
    EXPECT_EQ(clearsOf([](DrawStep&) {}), 0U);
    EXPECT_EQ(clearsOf([&](DrawStep&) { pass_.annotations.list.clear(); }), 1U);
    EXPECT_EQ(clearsOf([](DrawStep& step) { step.kind = DrawKind::Geometry; }), 1U);
    EXPECT_EQ(clearsOf([&](DrawStep&) { uses_[&pass_].discards = true; }), 1U);
    EXPECT_EQ(clearsOf([&](DrawStep&) { pass_.state.targets[0].enable = true; }), 1U) << "blends";
    EXPECT_EQ(clearsOf([&](DrawStep&) { pass_.state.targets[0].writeMask = 7; }), 1U) << "keeps alpha";
}

} // namespace
} // namespace tegument::run
