// RunOptions::keepUnchanged: the same bits in every target as a session has that draws all of it, and what is drawn is no more than must
// be.

#include "host/run/pieces.h"
#include "host/run/pixels.h"
#include "host/run/session.h"
#include "tests/run/fixture.h"
#include "tests/run/sphere.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>

namespace tegument::test {
namespace {

using HeldNames = std::vector<std::string>;

class Held : public Run {
protected:
    void load(const std::filesystem::path& file, const LoadOptions& options = {}) {
        auto effect = loadEffect(file, options);
        ASSERT_TRUE(succeeded(effect));
        effect_ = std::make_unique<Effect>(std::move(*effect));
        mesh_ = sphere();
        session_ = std::make_unique<EffectSession>(*device_, *effect_, SessionScene{.mesh = &mesh_});
    }

    /// The passes that were drawn.
    HeldNames drawn(const Workspace& workspace, RunOptions options, std::size_t passes = kAllPasses) {
        options.keepUnchanged = true;
        const auto frame = session_->draw(workspace, options, passes);
        EXPECT_TRUE(succeeded(frame));
        HeldNames names;
        if (!frame) return names;
        for (std::size_t i = 0; i < std::min(passes, frame->passes.size()); ++i)
            if (!frame->passes[i].kept) names.push_back(frame->passes[i].name);
        return names;
    }

    /// Every target of the session beside those of one that has drawn nothing before.
    testing::AssertionResult isAsDrawnAnew(const Workspace& workspace, const RunOptions& options, std::size_t passes = kAllPasses) {
        EffectSession anew(*device_, *effect_, SessionScene{.mesh = &mesh_});
        const auto frame = anew.draw(workspace, options, passes);
        if (!frame) return testing::AssertionFailure() << format(frame.error());
        HeldNames names = frame->targets;
        names.emplace_back();
        if (passes != kAllPasses) names = frame->passes[passes - 1].targets; // others hold what they held
        for (const std::string& name : names) {
            const auto expected = run::readBack(*device_, *anew.target(name));
            const auto actual = run::readBack(*device_, *session_->target(name));
            if (!expected || !actual) return testing::AssertionFailure() << "no target '" << name << "'";
            if (expected->pixels.size() != actual->pixels.size() ||
                std::memcmp(expected->pixels.data(), actual->pixels.data(), expected->pixels.size() * sizeof(float)) != 0)
                return testing::AssertionFailure() << "target '" << name << "' differs";
        }
        return testing::AssertionSuccess();
    }

    std::unique_ptr<Effect> effect_;
    std::unique_ptr<EffectSession> session_;
    Mesh mesh_;
};

RunOptions chain(std::map<std::string, std::vector<double>> values) {
    return {.technique = "Chain", .width = 4, .height = 4, .compiler = defaultCompiler(), .parameters = std::move(values)};
}

TEST_F(Held, nothing_is_drawn_where_nothing_has_changed) {
    load(kFixtures / "held.fx");
    EXPECT_EQ(drawn({}, chain({})).size(), 4U);
    EXPECT_EQ(drawn({}, chain({})), HeldNames{});
    EXPECT_TRUE(isAsDrawnAnew({}, chain({})));
}

TEST_F(Held, a_picture_of_several_samples_is_kept_with_its_mean) {
    load(kFixtures / "mesh.fx");
    RunOptions options{.technique = "Front", .width = 16, .height = 16, .samples = 4, .compiler = defaultCompiler()};
    EXPECT_EQ(drawn(closeUp(), options).size(), 1U);
    EXPECT_EQ(drawn(closeUp(), options), HeldNames{});
    EXPECT_TRUE(isAsDrawnAnew(closeUp(), options));
    Workspace aside = closeUp();
    aside.camera.position = {1, 0, 5};
    EXPECT_EQ(drawn(aside, options).size(), 1U);
    EXPECT_TRUE(isAsDrawnAnew(aside, options));
}

TEST_F(Held, what_only_the_last_pass_reads_draws_that_one) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    EXPECT_EQ(drawn({}, chain({{"gShown", {3}}})), HeldNames{"Shown"});
    EXPECT_TRUE(isAsDrawnAnew({}, chain({{"gShown", {3}}})));
}

TEST_F(Held, a_target_that_is_sampled_half_way_is_drawn_from_its_first_pass_on) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    EXPECT_EQ(drawn({}, chain({{"gThird", {3}}})), (HeldNames{"First", "Third", "Shown"})) << "the right map stays";
    EXPECT_TRUE(isAsDrawnAnew({}, chain({{"gThird", {3}}})));
    EXPECT_EQ(drawn({}, chain({{"gSecond", {2}}, {"gThird", {3}}})), (HeldNames{"First", "Second", "Third", "Shown"}));
    EXPECT_TRUE(isAsDrawnAnew({}, chain({{"gSecond", {2}}, {"gThird", {3}}})));
}

TEST_F(Held, what_a_pass_needs_half_way_is_drawn_again_though_its_end_is_there) {
    load(kFixtures / "held.fx");
    RunOptions options = chain({});
    options.technique = "HalfWay";
    (void)drawn({}, options);
    options.parameters = {{"gSecond", {2}}};
    EXPECT_EQ(drawn({}, options), (HeldNames{"First", "Second", "Other", "Shown"}));
    EXPECT_TRUE(isAsDrawnAnew({}, options));
    options.parameters["gShown"] = {2};
    EXPECT_EQ(drawn({}, options), HeldNames{"Shown"});
}

TEST_F(Held, parts_of_a_frame_draw_what_the_part_before_has_not) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    EXPECT_EQ(drawn({}, chain({}), 1), HeldNames{"First"}) << "the left map is to be as after the first pass";
    EXPECT_TRUE(isAsDrawnAnew({}, chain({}), 1));
    EXPECT_EQ(drawn({}, chain({}), 2), HeldNames{"Second"});
    EXPECT_TRUE(isAsDrawnAnew({}, chain({}), 2));
    EXPECT_EQ(drawn({}, chain({})), (HeldNames{"Third", "Shown"})) << "the part is where the whole begins";
    EXPECT_TRUE(isAsDrawnAnew({}, chain({})));
}

TEST_F(Held, a_frame_that_draws_all_is_no_ground_to_keep_anything) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    ASSERT_TRUE(session_->draw({}, chain({{"gFirst", {5}}})));
    EXPECT_EQ(drawn({}, chain({})).size(), 4U);
    EXPECT_TRUE(isAsDrawnAnew({}, chain({})));
}

TEST_F(Held, an_edit_draws_the_passes_that_it_changes) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    auto edited = std::make_unique<Effect>(*loadEffect(kFixtures / "held.fx", {.defines = {{"HELD_SHOWN", "3.0"}}}));
    auto before = std::move(session_);
    session_ = std::make_unique<EffectSession>(*device_, *edited, SessionScene{.mesh = &mesh_}, before.get());
    EXPECT_EQ(drawn({}, chain({})), HeldNames{"Shown"});
    before.reset();
    effect_.swap(edited);
    EXPECT_TRUE(isAsDrawnAnew({}, chain({})));
    EXPECT_EQ(drawn({}, chain({})), HeldNames{});
    session_.reset();
}

TEST_F(Held, an_edit_that_cannot_be_drawn_leaves_the_session_before_as_it_was) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    {
        EffectSession next(*device_, *effect_, SessionScene{.mesh = &mesh_}, session_.get());
        RunOptions wrong = chain({});
        wrong.dump = {"gNoMap"};
        EXPECT_EQ(code(next.draw({}, wrong)), 4029);
    }
    EXPECT_EQ(drawn({}, chain({})), HeldNames{});
    EXPECT_TRUE(isAsDrawnAnew({}, chain({})));
}

TEST_F(Held, sessions_side_by_side_share_targets_until_either_draws_into_them) {
    load(kFixtures / "held.fx");
    (void)drawn({}, chain({}));
    auto other = std::make_unique<EffectSession>(*device_, *effect_, SessionScene{.mesh = &mesh_}, session_.get());
    const auto bytes = device_->allocatedBytes();
    session_.swap(other);
    EXPECT_EQ(drawn({}, chain({})), HeldNames{}) << "all is there";
    EXPECT_EQ(device_->allocatedBytes(), bytes) << "and is no copy";
    for (int i = 0; i < 3; ++i) { // each in turn, with values of its own
        const RunOptions here = chain({{"gThird", {2.0 + i}}});
        const RunOptions there = chain({{"gSecond", {7.0 + i}}});
        EXPECT_EQ(drawn({}, here), (HeldNames{"First", "Third", "Shown"}));
        EXPECT_TRUE(isAsDrawnAnew({}, here)) << i;
        session_.swap(other);
        EXPECT_EQ(drawn({}, i == 0 ? chain({}) : chain({{"gSecond", {6.0 + i}}})), HeldNames{}) << "what the other drew was its own";
        EXPECT_FALSE(drawn({}, there).empty());
        EXPECT_TRUE(isAsDrawnAnew({}, there)) << i;
        session_.swap(other);
        EXPECT_EQ(drawn({}, here), HeldNames{});
        EXPECT_TRUE(isAsDrawnAnew({}, here)) << i;
    }
    ASSERT_TRUE(session_->draw({}, chain({}))) << "without keeping anything";
    session_.swap(other);
    EXPECT_TRUE(isAsDrawnAnew({}, chain({{"gSecond", {9}}})));
    other.reset();
    EXPECT_EQ(drawn({}, chain({{"gSecond", {9}}})), HeldNames{});
}

/// A change that a viewer makes, at random.
struct HeldChange {
    Workspace workspace = closeUp();
    RunOptions options{.width = 48, .height = 48, .compiler = defaultCompiler()};
    std::size_t passes = kAllPasses;

    void step(std::mt19937& random, const HeldNames& techniques) {
        const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
        const auto place = [&] { return 0.5F * static_cast<float>(pick(9) - 4); };
        passes = kAllPasses;
        switch (pick(7)) {
        case 0: break;
        case 1: workspace.camera.position = {place(), place(), 5}; break;
        case 2: workspace.light.position = {place(), place(), 5}; break;
        case 3: options.technique = techniques[static_cast<std::size_t>(pick(static_cast<int>(techniques.size())))]; break;
        case 4: options.width = options.height = 32 + 8 * pick(3); break;
        case 5: passes = static_cast<std::size_t>(1 + pick(3)); break;
        default: options.samples = 1 + 3 * pick(2); break;
        }
    }
};

void walk(const std::function<void(const HeldChange&, int)>& check, const HeldNames& techniques, unsigned seed) {
    std::mt19937 random(seed);
    HeldChange change;
    change.options.technique = techniques.front();
    for (int i = 0; i < 24; ++i) {
        check(change, i);
        change.step(random, techniques);
    }
}

/// Two sessions of one effect, or of two: whatever either draws, in pieces that are given up, too, both are right.
TEST_F(Held, sessions_that_share_have_the_same_bits_through_changes_of_all_kinds) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    std::mt19937 random(5);
    HeldChange one;
    one.options.technique = "DEonLuebke";
    HeldChange two = one;
    (void)drawn(one.workspace, one.options);
    auto other = std::make_unique<EffectSession>(*device_, *effect_, SessionScene{.mesh = &mesh_}, session_.get());
    for (int i = 0; i < 16; ++i) {
        std::swap(one, two);
        session_.swap(other);
        if (i % 5 == 4) other = std::make_unique<EffectSession>(*device_, *effect_, SessionScene{.mesh = &mesh_}, session_.get());
        one.step(random, {"DEonLuebke", "Lambert", "Gosselin"});
        RunOptions pieces = one.options;
        pieces.keepUnchanged = true;
        pieces.pieces.goOn = [left = std::make_shared<int>(1 + static_cast<int>(random() % 9))] { return --*left > 0; };
        ASSERT_TRUE(succeeded(session_->draw(one.workspace, pieces, one.passes)));
        (void)drawn(one.workspace, one.options, one.passes);
        EXPECT_TRUE(isAsDrawnAnew(one.workspace, one.options, one.passes)) << "step " << i;
    }
}

TEST_F(Held, main_has_the_same_bits_through_changes_of_all_kinds) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    std::size_t kept = 0;
    const auto check = [&](const HeldChange& change, int i) {
        const HeldNames names = drawn(change.workspace, change.options, change.passes);
        kept += names.empty() ? 1 : 0;
        EXPECT_TRUE(isAsDrawnAnew(change.workspace, change.options, change.passes)) << "step " << i;
    };
    walk(check, {"DEonLuebke", "Lambert", "Gosselin"}, 7);
    EXPECT_GT(kept, 0U);
}

TEST_F(Held, the_camera_alone_leaves_the_skin_s_maps_as_they_are) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    Workspace workspace = closeUp();
    const RunOptions options{.technique = "DEonLuebke", .width = 48, .height = 48, .compiler = defaultCompiler()};
    EXPECT_EQ(drawn(workspace, options).size(), 13U);
    workspace.camera.position = {1, 0.5F, 5};
    EXPECT_EQ(drawn(workspace, options), HeldNames{"Final"});
    EXPECT_TRUE(isAsDrawnAnew(workspace, options));
    workspace.light.position = {1, 1, 5};
    EXPECT_EQ(drawn(workspace, options).size(), 13U);
    EXPECT_TRUE(isAsDrawnAnew(workspace, options));
}

/// Pieces that stop after so many of them; all passes are cut.
RunOptions inPieces(RunOptions options, int most, const SessionFrame& whole) {
    options.pieces.goOn = [left = std::make_shared<int>(most)] { return --*left > 0; };
    for (const SessionPass& pass : whole.passes)
        options.pieces.bands[pass.name] = 3;
    return options;
}

TEST_F(Held, a_frame_in_pieces_has_the_same_bits) {
    constexpr int kAll = 1000;
    for (const int samples : {1, 4}) {
        load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "256"}}});
        Workspace workspace = closeUp();
        RunOptions options{.technique = "DEonLuebke",
                           .width = 200,
                           .height = 200,
                           .samples = samples,
                           .compiler = defaultCompiler(),
                           .keepUnchanged = true};
        const auto whole = session_->draw(workspace, options);
        ASSERT_TRUE(succeeded(whole));
        workspace.light.position = {1, 1, 5};
        const auto pieces = session_->draw(workspace, inPieces(options, kAll, *whole));
        ASSERT_TRUE(succeeded(pieces));
        EXPECT_FALSE(pieces->givenUp);
        EXPECT_TRUE(isAsDrawnAnew(workspace, options)) << samples << " samples";
    }
}

TEST_F(Held, what_was_given_up_anywhere_is_drawn_right_the_next_time) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "128"}}});
    const RunOptions options{.technique = "DEonLuebke", .width = 72, .height = 72, .compiler = defaultCompiler(), .keepUnchanged = true};
    Workspace workspace = closeUp();
    const auto whole = session_->draw(workspace, options);
    ASSERT_TRUE(succeeded(whole));
    std::mt19937 random(11);
    std::size_t givenUp = 0;
    for (int most = 1; most < 30; most += 2) {
        Workspace other = workspace; // either is drawn next: what was left, or what was there before
        other.light.position = {0.1F * static_cast<float>(most), 1, 5};
        const auto pieces = session_->draw(other, inPieces(options, most, *whole));
        ASSERT_TRUE(succeeded(pieces));
        givenUp += pieces->givenUp ? 1 : 0;
        if (random() % 2 == 0) workspace = other;
        ASSERT_TRUE(succeeded(session_->draw(workspace, options)));
        EXPECT_TRUE(isAsDrawnAnew(workspace, options)) << "after " << most << " pieces";
    }
    EXPECT_GT(givenUp, 8U);
}

TEST_F(Held, what_was_given_up_keeps_what_it_did_not_touch_and_what_it_finished) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    const RunOptions options{.technique = "DEonLuebke", .width = 136, .height = 136, .compiler = defaultCompiler(), .keepUnchanged = true};
    Workspace workspace = closeUp();
    const auto whole = session_->draw(workspace, options);
    ASSERT_TRUE(succeeded(whole));
    workspace.camera.position = {1, 0.5F, 5};
    const auto pieces = session_->draw(workspace, inPieces(options, 1, *whole));
    ASSERT_TRUE(succeeded(pieces));
    ASSERT_TRUE(pieces->givenUp) << "a band of Final";
    EXPECT_EQ(drawn(workspace, options), HeldNames{"Final"}) << "the maps are there";
    workspace.light.position = {1, 1, 5};
    ASSERT_TRUE(succeeded(session_->draw(workspace, inPieces(options, 3, *whole))));
    const HeldNames names = drawn(workspace, options);
    EXPECT_TRUE(std::ranges::find(names, "TSM") == names.end()) << "the first pass was finished";
    EXPECT_EQ(names.size(), 10U) << "and the next two, though Irradiance's target is drawn into later, too";
    EXPECT_TRUE(isAsDrawnAnew(workspace, options));
}

/// Every other ring of the sphere.
std::vector<std::uint32_t> halfOf(const Mesh& mesh) {
    return {mesh.indices.begin(), mesh.indices.begin() + static_cast<std::ptrdiff_t>(mesh.indices.size() / 6 * 3)};
}

TEST_F(Held, fewer_triangles_change_the_picture_alone_or_everything_as_asked) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    const RunOptions options{.technique = "DEonLuebke", .width = 48, .height = 48, .compiler = defaultCompiler()};
    const Workspace workspace = closeUp();
    (void)drawn(workspace, options);
    RunOptions coarse = options;
    coarse.coarser.triangles = std::make_shared<FewerTriangles>(FewerTriangles{{&mesh_, halfOf(mesh_)}});
    EXPECT_EQ(drawn(workspace, coarse), HeldNames{"Final"});
    EXPECT_TRUE(isAsDrawnAnew(workspace, coarse));
    EXPECT_FALSE(isAsDrawnAnew(workspace, options)) << "half of the ball is missing";
    EXPECT_EQ(drawn(workspace, options), HeldNames{"Final"}) << "the maps were left";
    EXPECT_TRUE(isAsDrawnAnew(workspace, options));
    coarse.coarser.everywhere = true;
    EXPECT_EQ(drawn(workspace, coarse).size(), 13U);
    EXPECT_TRUE(isAsDrawnAnew(workspace, coarse));
    EXPECT_EQ(drawn(workspace, options).size(), 13U);
    EXPECT_TRUE(isAsDrawnAnew(workspace, options));
}

TEST_F(Held, a_texture_that_another_effect_draws_is_baked_again_alone) {
    load("effects/Main.fx", {.defines = {{"TEGUMENT_MAP_SIZE", "64"}}});
    const RunOptions options{.technique = "DEonLuebke", .width = 48, .height = 48, .compiler = defaultCompiler(), .keepUnchanged = true};
    const auto first = session_->draw(closeUp(), options);
    ASSERT_TRUE(succeeded(first));
    const auto baked = std::ranges::find_if(first->textures, [](const SessionTexture& texture) { return texture.bake.has_value(); });
    ASSERT_NE(baked, first->textures.end());
    EXPECT_GT(baked->bake->milliseconds, 0);
    EXPECT_FALSE(baked->bake->fromCache);
    const auto values = [&] {
        gpu::Texture* texture = session_->target(baked->name);
        const auto image = texture ? run::readBack(*device_, *texture) : Result<Image>(Image{});
        return image ? image->pixels : std::vector<float>();
    };
    const std::vector<float> before = values();
    ASSERT_FALSE(before.empty());
    ASSERT_TRUE(succeeded(session_->draw(closeUp(), options))) << "a frame between that bakes nothing: what was baked is remembered longer";
    session_->bakeAgain(baked->name);
    EXPECT_EQ(session_->target(baked->name), nullptr);
    const auto again = session_->draw(closeUp(), options);
    ASSERT_TRUE(succeeded(again));
    EXPECT_TRUE(std::ranges::all_of(again->passes, &SessionPass::kept)) << "it is the same";
    EXPECT_EQ(values(), before);
    session_->bakeAgain("gNoMap");
    EXPECT_TRUE(isAsDrawnAnew(closeUp(), options));
}

TEST(Pieces, bands_are_whole_tiles_and_cover_every_row_once) {
    for (const std::uint32_t height : {1U, 63U, 64U, 65U, 135U, 1024U, 1080U})
        for (const std::uint32_t bands : {1U, 2U, 3U, 16U, 100U}) {
            std::uint32_t next = 0;
            const auto rows = run::bandsOf(height, bands);
            for (const gpu::RowRange& range : rows) {
                EXPECT_EQ(range.first, next);
                EXPECT_EQ(range.first % 64, 0U);
                next += range.count;
            }
            EXPECT_EQ(next, height);
            EXPECT_LE(rows.size(), bands);
        }
    EXPECT_EQ(run::bandsOf(1080, 8).size(), 6U) << "17 tiles: three each";
}

} // namespace
} // namespace tegument::test
