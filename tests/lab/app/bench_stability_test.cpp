// tegument bench --stability as a user runs it.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace tegument::test {

namespace {

namespace fs = std::filesystem;

/// An effect that divides by zero in every pixel, beside a catalogue that names nothing.
std::string faultyEffects() {
    const fs::path folder = scratch() / "faulty"; // with a copy of ours: an effect reads no file outside of its project
    fs::create_directories(folder / "effects");
    fs::copy("hlsl", folder / "hlsl", fs::copy_options::recursive);
    fs::copy("effects/passes", folder / "effects/passes", fs::copy_options::recursive);
    const std::string effect = write("faulty/Faulty.fx", R"(#include "hlsl/platform.fxh"
#include "hlsl/workspace.fxh"
#include "effects/passes/quad.fxh"
float4 gZero = { 0.0, 0.0, 0.0, 0.0 };
float4 FaultyPS(QuadVarying input) : SV_Target0 { return (input.uv.x + 1.0) / gZero; }
#ifdef FX_TECHNIQUES
technique Faulty < string Script = "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Faulty;"; >
{
    TG_QUAD_PASS(Faulty, QuadVS, FaultyPS, TG_STATE_BUFFER)
}
#endif
)");
    const std::string catalogue = write("faulty/catalogue.json", "[]");
    EXPECT_EQ(fs::path(effect).parent_path(), fs::path(catalogue).parent_path());
    return catalogue;
}

} // namespace

TEST(BenchStability, refuses_a_part_that_does_not_exist) {
    const Ran ran = tegument({"bench", "--stability", "--part", "shadows"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("TG8080"), std::string::npos) << ran.err;
    EXPECT_EQ(tegument({"bench", "--part", "shadow"}).code, 2) << "without --stability";
}

TEST(BenchStability, refuses_a_module_that_no_part_knows) {
    const Ran ran = tegument({"bench", "--stability", "--part", "shadow", "--module", "Nothing"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("TG8081"), std::string::npos) << ran.err;
}

TEST(BenchStability, prints_its_figures_as_json_and_nothing_else) {
    const Ran ran = tegument({"bench", "--stability", "--part", "roughness", "--module", "Beckmann", "--json", "-"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto report = ran.json();
    ASSERT_TRUE(report.is_object()) << ran.out;
    EXPECT_TRUE(report["pass"]);
    ASSERT_EQ(report["rows"].size(), 2);
    EXPECT_EQ(report["rows"][0]["module"], "Beckmann");
    EXPECT_EQ(report["rows"][0]["not_finite"], 0);
}

TEST(BenchStability, ends_with_1_where_an_effect_gives_what_is_no_number) {
    const Ran ran = tegument({"bench", "--stability", "--part", "finite", "--map-size", "16", "--catalogue", faultyEffects()});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("FAIL"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("picture (0, 0) is inf"), std::string::npos) << ran.out;
}

} // namespace tegument::test
