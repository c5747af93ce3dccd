// Annotations of passes that draw strands.

#include "meshprep/assets/strand_passes.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tegument::assets {
namespace {

/// The first pass of the default technique, with one annotation changed.
class StrandPassesOf : public testing::Test {
protected:
    void SetUp() override {
        auto loaded = loadEffect("effects/FurCoat.fx", {});
        ASSERT_TRUE(loaded) << format(loaded.error());
        effect_ = *std::move(loaded);
        for (Technique& technique : effect_.techniques)
            for (Pass& pass : technique.passes)
                if (!pass_ && pass.annotations.find("Reach") != nullptr && pass.annotations.string("Part") == kStrandsPart) pass_ = &pass;
        ASSERT_NE(pass_, nullptr);
        mesh_.name = "mesh";
        mesh_.positions.assign(3, glm::vec3(0));
        mesh_.indices = {0, 1, 2};
    }

    [[nodiscard]] PassRequest request() const {
        return {.effect = effect_,
                .pass = *pass_,
                .mesh = mesh_,
                .value = [](const Parameter&) -> Result<std::vector<double>> { return std::vector<double>{1}; },
                .rows = [](const std::string&) { return std::optional<std::uint32_t>(); }};
    }

    [[nodiscard]] int codeOf() {
        StrandPasses passes;
        const auto list = passes.list(request());
        return list ? 0 : list.error().diagnostics.front().code;
    }

    Effect effect_;
    Pass* pass_ = nullptr;
    Mesh mesh_;
};

TEST_F(StrandPassesOf, that_a_mesh_does_not_have_are_refused_with_the_command_that_grows_them) {
    EXPECT_EQ(codeOf(), 4060);
}

TEST_F(StrandPassesOf, an_annotation_that_names_no_number_is_told) {
    mesh_.parts.push_back({.name = kStrandsPart, .firstIndex = 0, .indexCount = 3, .expanded = true});
    EXPECT_EQ(codeOf(), 0);
    auto& annotations = pass_->annotations.list;
    const auto reach = std::ranges::find(annotations, std::string("Reach"), &Annotation::name);
    ASSERT_NE(reach, annotations.end());
    reach->value = std::string("gNoSuchNumber");
    EXPECT_EQ(codeOf(), 4081);
}

TEST_F(StrandPassesOf, equal_requests_get_the_same_list_while_it_is_held) {
    mesh_.parts.push_back({.name = kStrandsPart, .firstIndex = 0, .indexCount = 3, .expanded = true});
    mesh_.uvs.assign(3, glm::vec2(0, 4096));
    mesh_.normals.assign(3, glm::vec3(0, 0, -1)); // away from the eye
    StrandPasses passes;
    PassRequest asked = request();
    asked.eye = glm::dvec3(0, 0, 10);
    asked.horizontalFov = 0.5;
    asked.viewportWidth = 64;
    const auto first = passes.list(asked);
    const auto second = passes.list(asked);
    ASSERT_TRUE(first && second);
    ASSERT_TRUE(*first);
    EXPECT_EQ(*first, *second);
    EXPECT_TRUE((*first)->ranges.empty()) << "the only strand looks away";
    asked.eye = glm::dvec3(0, 0, -10);
    const auto other = passes.list(asked);
    ASSERT_TRUE(other);
    EXPECT_NE(*other, *first);
}

TEST(PartHorizon, is_where_a_strand_ends_that_grows_on_the_far_side_of_a_ball) {
    for (const double length : {0.28, 0.5, 2.0}) {
        const double cosine = horizonOf(length), sine = std::sqrt(1 - cosine * cosine);
        EXPECT_NEAR((1 + 1.5 * length) * sine, 1, 1e-12) << "a strand half as long again ends at the ball's outline, seen from afar";
    }
    EXPECT_EQ(horizonOf(0.05), horizonOf(0.28)) << "ears and toes bend more";
}

} // namespace
} // namespace tegument::assets
