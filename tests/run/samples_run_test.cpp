// Several samples a pixel: the caller's targets have them, the picture is their mean, the effect's own targets stay as they are.

#include "host/run/session.h"
#include "tests/run/fixture.h"

#include <algorithm>
#include <cstring>

namespace tegument::test {
namespace {

class Sampled : public Run {
protected:
    Result<RunResult> draw(int samples, int size = 16, const std::string& technique = "Front") {
        const Mesh mesh = slanted();
        return run("mesh.fx", options(samples, size, technique), &mesh, closeUp());
    }

    static RunOptions options(int samples, int size, const std::string& technique = "Front") {
        return {.technique = technique, .width = size, .height = size, .samples = samples, .compiler = defaultCompiler()};
    }

    /// The square turned by some degrees: no edge runs along rows, columns or diagonals.
    static Mesh slanted() {
        Mesh mesh = square();
        for (glm::vec3& position : mesh.positions)
            position = {0.98F * position.x - 0.2F * position.y, 0.2F * position.x + 0.98F * position.y, 0};
        computeBounds(mesh);
        return mesh;
    }

    /// Share of each pixel that the mesh covers, from one sample in each of 32 x 32 parts of it.
    std::vector<double> coverage(int size) {
        constexpr int kParts = 32;
        const auto fine = draw(1, size * kParts);
        EXPECT_TRUE(succeeded(fine));
        std::vector<double> shares(static_cast<std::size_t>(size * size), 0.0);
        if (!fine) return shares;
        for (int y = 0; y < size * kParts; ++y)
            for (int x = 0; x < size * kParts; ++x)
                shares[static_cast<std::size_t>(y / kParts * size + x / kParts)] +=
                    static_cast<double>(fine->image.at(x, y, 3)) / (kParts * kParts);
        return shares;
    }
};

TEST_F(Sampled, pictures_of_halves_hold_halves_with_any_number_of_samples) {
    const Mesh mesh = slanted();
    for (const int samples : {1, 4}) {
        RunOptions asked = options(samples, 16);
        asked.halfPicture = true;
        Workspace workspace = closeUp();
        workspace.background = {0.1F, 0.1F, 0.1F};
        const auto result = run("mesh.fx", asked, &mesh, workspace);
        ASSERT_TRUE(succeeded(result));
        // The half next to 0.1, from above or from below: devices may round or cut off.
        EXPECT_NEAR(result->image.at(0, 0, 0), 0.1F, 6.2e-5F) << samples;
        EXPECT_NE(result->image.at(0, 0, 0), 0.1F) << samples;
    }
}

bool offered(const Result<RunResult>& result) {
    return code(result) != 6016;
}

TEST_F(Sampled, edges_of_a_mesh_cover_their_area_within_one_sample) {
    constexpr int kSize = 16;
    const std::vector<double> exact = coverage(kSize);
    for (const int samples : {2, 4, 8}) {
        const auto result = draw(samples, kSize);
        if (!offered(result)) continue; // 4 is offered everywhere
        ASSERT_TRUE(succeeded(result)) << samples;
        // One sample, and half a part for the edge of what the fine picture itself can tell.
        const double allowed = 1.0 / samples + 1.0 / 64;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                EXPECT_NEAR(result->image.at(x, y, 3), exact[static_cast<std::size_t>(y * kSize + x)], allowed)
                    << samples << " samples, pixel " << x << ", " << y;
    }
}

TEST_F(Sampled, four_samples_smooth_an_edge_that_one_leaves_hard) {
    const auto partly = [this](int samples) {
        const auto result = draw(samples);
        EXPECT_TRUE(succeeded(result));
        if (!result) return std::ptrdiff_t{-1};
        std::vector<float> alpha;
        for (int i = 0; i < 256; ++i)
            alpha.push_back(result->image.at(i % 16, i / 16, 3));
        return std::ranges::count_if(alpha, [](float share) { return share > 0 && share < 1; });
    };
    EXPECT_EQ(partly(1), 0);
    EXPECT_GT(partly(4), 8); // the edges cross more rows than that
}

TEST_F(Sampled, one_sample_is_what_is_drawn_when_nothing_is_said) {
    const Mesh mesh = slanted();
    const RunOptions silent{.technique = "Front", .width = 16, .height = 16, .compiler = defaultCompiler()};
    const auto usual = run("mesh.fx", silent, &mesh, closeUp());
    const auto one = draw(1);
    ASSERT_TRUE(succeeded(usual));
    ASSERT_TRUE(succeeded(one));
    EXPECT_EQ(one->image.pixels, usual->image.pixels);
    EXPECT_EQ(one->bytes, usual->bytes);
    EXPECT_EQ(one->passes.size(), usual->passes.size());
    EXPECT_EQ(one->image.metadata, usual->image.metadata);
}

TEST_F(Sampled, the_picture_says_how_many_samples_it_has) {
    const auto result = draw(4);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.metadata.at("samples"), "4");
}

TEST_F(Sampled, the_resolve_is_timed_and_its_targets_are_counted) {
    const auto one = draw(1);
    const auto four = draw(4);
    ASSERT_TRUE(succeeded(one));
    ASSERT_TRUE(succeeded(four));
    EXPECT_EQ(four->passes.size(), one->passes.size() + 1);
    EXPECT_EQ(four->passes.back().name, "resolve");
    // Colour of 16 bytes and, in this pass, a depth of at least 4, four times; and the colour that it becomes.
    EXPECT_EQ(four->bytes, 4 * one->bytes + 16 * 16 * 16);
}

TEST_F(Sampled, other_numbers_than_1_2_4_and_8_are_refused) {
    for (const int samples : {0, -4, 3, 16}) {
        const auto result = draw(samples);
        ASSERT_EQ(code(result), 4007) << samples;
        EXPECT_NE(format(result.error()).find(std::to_string(samples)), std::string::npos);
    }
}

TEST_F(Sampled, frames_cut_short_are_resolved_too) {
    const Mesh mesh = slanted();
    const auto effect = loadEffect(kFixtures / "mesh.fx");
    ASSERT_TRUE(succeeded(effect));
    EffectSession session(*device_, *effect, {.mesh = &mesh});
    ASSERT_TRUE(succeeded(session.draw(closeUp(), options(4, 16))));
    Workspace lit = closeUp();
    lit.background = {0.25F, 0.5F, 0.75F};
    ASSERT_TRUE(succeeded(session.draw(lit, options(4, 16), 0))); // no pass: the background alone
    const auto bytes = device_->readback(*session.target(""));
    ASSERT_TRUE(succeeded(bytes));
    std::vector<float> floats(bytes->size() / sizeof(float));
    std::memcpy(floats.data(), bytes->data(), bytes->size());
    for (std::size_t i = 0; i < floats.size(); i += 4)
        EXPECT_EQ((std::array{floats[i], floats[i + 1], floats[i + 2]}), (std::array{0.25F, 0.5F, 0.75F})) << i / 4;
}

TEST_F(Sampled, a_session_changes_its_number_of_samples) {
    const Mesh mesh = slanted();
    const auto effect = loadEffect(kFixtures / "mesh.fx");
    ASSERT_TRUE(succeeded(effect));
    EffectSession session(*device_, *effect, {.mesh = &mesh});
    std::vector<std::vector<std::byte>> pictures;
    for (const int samples : {1, 4, 1}) {
        ASSERT_TRUE(succeeded(session.draw(closeUp(), options(samples, 16)))) << samples;
        auto bytes = device_->readback(*session.target(""));
        ASSERT_TRUE(succeeded(bytes)) << samples;
        pictures.push_back(std::move(*bytes));
    }
    EXPECT_NE(pictures[0], pictures[1]);
    EXPECT_EQ(pictures[0], pictures[2]);
}

TEST_F(Sampled, targets_of_the_effect_stay_as_they_are) {
    const auto dumped = [this](int samples) {
        RunOptions options{.width = 24, .height = 24, .samples = samples, .compiler = defaultCompiler(), .dump = {"all"}};
        const auto effect = loadEffect("effects/ShadowMap.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
        EXPECT_TRUE(succeeded(effect));
        const Mesh mesh = slanted();
        return runEffect(*device_, *effect, &mesh, closeUp(), options);
    };
    const auto one = dumped(1);
    const auto four = dumped(4);
    ASSERT_TRUE(succeeded(one));
    ASSERT_TRUE(succeeded(four));
    ASSERT_FALSE(one->dumped.empty());
    for (const auto& [name, image] : one->dumped)
        EXPECT_EQ(four->dumped.at(name).pixels, image.pixels) << name;
}

} // namespace
} // namespace tegument::test
