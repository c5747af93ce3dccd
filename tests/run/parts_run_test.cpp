// The annotation Part: which triangles of a mesh a pass draws.

#include "host/run/parts.h"
#include "tests/run/fixture.h"

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
        return run("parts.fx", {.technique = technique, .width = 16, .height = 16, .compiler = defaultCompiler()}, &mesh);
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
        return found ? *found : std::vector<run::IndexRange>{};
    };
    Mesh mesh = halves("a", "strands");
    EXPECT_EQ(ranges(mesh), (std::vector<run::IndexRange>{{.first = 3, .count = 6}}));
    mesh.parts[0].name = mesh.parts[2].name = "strands";
    mesh.parts[1].name = "a";
    EXPECT_EQ(ranges(mesh), (std::vector<run::IndexRange>{{.first = 0, .count = 3}, {.first = 6, .count = 3}}));
    const auto result = draw("Strands", mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(1, 1, 0), 2.0F) << "several ranges are one pass";
    EXPECT_EQ(result->image.at(14, 14, 0), 2.0F);
    EXPECT_EQ(result->passes.size(), 1U);
}

} // namespace
} // namespace tegument::test
