// Shaders of other hosts' effects are compiled by DXC in a process of its own.

#include "host/spirv/compile.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

namespace tegument {
namespace {

ShaderRequest foreignPixel(std::string_view code) {
    return {
        .code = code, .file = "main.fx", .entry = "PS", .stage = Stage::Pixel, .defines = {}, .includeFolders = {}, .language2018 = true};
}

TEST(ForeignCode, that_dxc_does_not_survive_is_an_error_with_its_place) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const auto crashed = compileShader(
        foreignPixel("float a;\n#line 12 \"lamps.fxh\"\nfloat4 PS() : SV_Target { VertexShader v[2] = 1; return 1; }\n"), Compiler::Dxc);
    ASSERT_FALSE(crashed);
    const Diagnostic& first = crashed.error().diagnostics.front();
    EXPECT_EQ(first.code, 3008) << format(crashed.error());
    EXPECT_EQ(first.at.file, "lamps.fxh");
    EXPECT_EQ(first.at.line, 12);
    EXPECT_NE(first.text.find("while it compiled PS"), std::string::npos) << first.text;
}

TEST(ForeignCode, compiles_after_a_crash_and_says_what_is_wrong_as_ever) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const auto crashed = compileShader(foreignPixel("float4 PS() : SV_Target { VertexShader v[2] = 1; return 2; }\n"), Compiler::Dxc);
    EXPECT_FALSE(crashed);
    const auto good = compileShader(foreignPixel("float4 tint;\nfloat4 PS() : SV_Target { return tint; }\n"), Compiler::Dxc);
    ASSERT_TRUE(good) << format(good.error());
    ASSERT_TRUE(good->reflection.globals);
    EXPECT_EQ(good->reflection.globals->members.front().name, "tint");
    const auto wrong = compileShader(foreignPixel("\n\nfloat4 PS() : SV_Target { return nowhere; }\n"), Compiler::Dxc);
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().diagnostics.front().code, 3001);
    EXPECT_EQ(wrong.error().diagnostics.front().at.line, 3);
}

} // namespace
} // namespace tegument
