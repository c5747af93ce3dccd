// The annotation Part: which triangles of a mesh a pass draws.

#include "host/run/parts.h"
#include "meshprep/assets/generators.h"
#include "tests/run/fixture.h"

#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace tegument::test {
namespace {

class Parts : public Run {
protected:
    /// The square's upper left half, and its lower right one, twice.
    static Mesh halves(const char* upper, const char* lower) {
        Mesh mesh = square();
        mesh.indices.insert(mesh.indices.end(), {mesh.indices[3], mesh.indices[4], mesh.indices[5]});
        mesh.parts = {{.name = upper, .firstIndex = 0, .indexCount = 3},
                      {.name = lower, .firstIndex = 3, .indexCount = 3},
                      {.name = lower, .firstIndex = 6, .indexCount = 3}};
        return mesh;
    }
    Result<RunResult> draw(const std::string& technique, const Mesh& mesh) {
        return run("parts.fx",
                   {.technique = technique, .width = 16, .height = 16, .compiler = defaultCompiler(), .assets = assets::meshAssets()},
                   &mesh, closeUp());
    }
    /// What the picture shows of both halves.
    std::pair<float, float> shown(const std::string& technique, const Mesh& mesh) {
        const auto result = draw(technique, mesh);
        EXPECT_TRUE(succeeded(result));
        if (!result) return {};
        return {result->image.at(1, 1, 0), result->image.at(14, 14, 0)};
    }
};

TEST_F(Parts, a_pass_draws_the_part_that_it_names) {
    const Mesh mesh = halves("skin", "strands");
    EXPECT_EQ(shown("Whole", mesh), std::pair(1.0F, 1.0F));
    EXPECT_EQ(shown("Skin", mesh), std::pair(1.0F, 0.0F));
    EXPECT_EQ(shown("Strands", mesh), std::pair(0.0F, 2.0F));
    EXPECT_EQ(shown("Both", mesh), std::pair(1.0F, 2.0F));
}

TEST_F(Parts, skin_is_what_no_pass_of_the_effect_names) {
    EXPECT_EQ(shown("Skin", halves("a bunny", "strands")), std::pair(1.0F, 0.0F))
        << "a technique without a pass of strands knows them, too";
    EXPECT_EQ(shown("Skin", halves("a bunny", "its eyes")), std::pair(1.0F, 1.0F));
    EXPECT_EQ(shown("Skin", halves("skin", "its eyes")), std::pair(1.0F, 0.0F)) << "a part of that name is meant where there is one";
}

TEST_F(Parts, one_that_the_mesh_lacks_is_an_error_that_names_those_it_has) {
    const auto result = draw("Strands", halves("a bunny", "its eyes"));
    ASSERT_EQ(code(result), 4060);
    for (const char* text : {"pass Strands", "'strands'", "a bunny, its eyes", "tegument fur strands"})
        EXPECT_NE(format(result.error()).find(text), std::string::npos) << text << " in " << format(result.error());
    EXPECT_EQ(code(draw("Skin", halves("strands", "strands"))), 4060) << "no skin is left";
}

TEST_F(Parts, that_touch_are_one_range) {
    const auto effect = loadEffect(kFixtures / "parts.fx");
    ASSERT_TRUE(succeeded(effect));
    const Technique* both = effect->findTechnique("Both");
    ASSERT_NE(both, nullptr);
    const auto ranges = [&](const Mesh& mesh) {
        const auto found = run::partOf(*effect, both->passes[1], mesh);
        EXPECT_TRUE(succeeded(found));
        return found ? *found : std::vector<ListedRange>{};
    };
    Mesh mesh = halves("a", "strands");
    EXPECT_EQ(ranges(mesh), (std::vector<ListedRange>{{.first = 3, .count = 6}}));
    mesh.parts[0].name = mesh.parts[2].name = "strands";
    mesh.parts[1].name = "a";
    EXPECT_EQ(ranges(mesh), (std::vector<ListedRange>{{.first = 0, .count = 3}, {.first = 6, .count = 3}}));
    const auto result = draw("Strands", mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(1, 1, 0), 2.0F) << "several ranges are one pass";
    EXPECT_EQ(result->image.at(14, 14, 0), 2.0F);
    EXPECT_EQ(result->passes.size(), 1U);
}

/// A cluster of random vertices, and whether one of them shows: in the picture within the reach, and not looking away by more than strands
/// reach over the horizon.
struct Random {
    std::mt19937 random{11};
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
    glm::dvec3 inBall() {
        while (true)
            if (const glm::dvec3 v(number(-1, 1), number(-1, 1), number(-1, 1)); glm::dot(v, v) < 1) return v;
    }
};

TEST(PartClusters, beyond_any_side_of_the_picture_are_left_out_as_soon_as_they_do_not_reach_into_it) {
    constexpr double kAngle = 0.5, kAspect = 1.5, kFar = 300, kReach = 2;
    const glm::dmat4 toClip =
        glm::perspective(kAngle, kAspect, 1.0, 1000.0) * glm::lookAt(glm::dvec3(0, 0, kFar), glm::dvec3(0), glm::dvec3(0, 1, 0));
    run::PartView view = run::partView(toClip, {0, 0, kFar}, kReach);
    view.hidden = -2;
    for (const glm::dvec3 side : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
        // The picture's edge is a plane through the eye: what lies a reach beyond it is further out by the reach over its cosine.
        const double slope = std::tan(kAngle / 2) * (side.x != 0 ? kAspect : 1), edge = kFar * slope,
                     beyond = kReach * std::hypot(1, slope);
        EXPECT_TRUE(run::canBeSeen((edge + 0.99 * beyond) * side, {0, 0, 1}, view)) << side.x << ' ' << side.y;
        EXPECT_FALSE(run::canBeSeen((edge + 1.01 * beyond) * side, {0, 0, 1}, view)) << side.x << ' ' << side.y;
    }
}

TEST(PartClusters, that_show_anything_are_never_left_out) {
    const glm::dmat4 toClip =
        glm::perspective(0.5, 1.5, 1.0, 1000.0) * glm::lookAt(glm::dvec3(0, 0, 300), glm::dvec3(0), glm::dvec3(0, 1, 0));
    Random random;
    int hidden = 0, shown = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        Mesh mesh;
        const glm::dvec3 place = 150.0 * random.inBall(), way = glm::normalize(random.inBall());
        const double size = random.number(1, 20), bend = random.number(0, 1);
        run::PartView view = run::partView(toClip, {0, 0, 300}, random.number(0, 10));
        view.hidden = random.number(-0.9, -0.6);
        bool shows = false;
        for (std::uint32_t i = 0; i < 30; ++i) {
            const glm::dvec3 vertex = place + size * random.inBall(), normal = glm::normalize(way + bend * random.inBall());
            mesh.positions.emplace_back(vertex);
            mesh.normals.emplace_back(normal);
            mesh.indices.push_back(i);
            const glm::dvec3 tip = vertex + view.reach * glm::normalize(random.inBall());
            const glm::dvec4 clip = toClip * glm::dvec4(tip, 1);
            const bool inside = clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
            shows = shows || (inside && glm::dot(normal, glm::normalize(view.eye - vertex)) > view.hidden);
        }
        MeshPart part{.name = "strands", .firstIndex = 0, .indexCount = 30, .clusters = {{.firstIndex = 0, .indexCount = 30}}};
        computeClusters(mesh, part);
        const bool seen = run::canBeSeen(part.clusters.front(), view);
        if (shows) {
            ASSERT_TRUE(seen) << trial;
        }
        hidden += !seen;
        shown += shows;
    }
    EXPECT_GT(shown, 800);
    EXPECT_GT(hidden, 800) << "leaving nothing out would pass as well";
}

TEST_F(Parts, of_which_nothing_can_be_seen_draw_nothing) {
    Mesh mesh = halves("skin", "strands");
    for (MeshPart& part : mesh.parts)
        part.clusters = {{.firstIndex = 0, .indexCount = 3}};
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
    computeBounds(mesh);
    EXPECT_EQ(shown("Seen", mesh), std::pair(0.0F, 2.0F)) << "the square faces +z, where the camera stands";
    mesh.normals.assign(4, {0, 0, -1});
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
    EXPECT_EQ(shown("Seen", mesh), std::pair(0.0F, 0.0F)) << "looking away";
}

} // namespace
} // namespace tegument::test
