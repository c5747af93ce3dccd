// The example of docs/your-engine.md that skins the effects, by Microsoft's compiler.

#include "host/support/file.h"
#include "tests/check/broken.h"
#include "tests/check/describe.h"
#include "tests/check/hook_example.h"
#include "tools/check/check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

const std::vector<Target> kDirect3D = {Target::Fx2, Target::Fx4, Target::Fx5};

class CheckMicrosoft : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
        folder_ = fs::temp_directory_path() / ("tegument-check-d3d-" + std::to_string(::getpid()));
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }

    /// The dialect's prelude and `text` in one file, checked for Direct3D.
    [[nodiscard]] FileReport check(const std::string& text) const {
        const auto prelude = readFile("hlsl/platform.fxh");
        return checkPlain((prelude ? *prelude : "") + "\n" + text);
    }
    [[nodiscard]] FileReport checkPlain(const std::string& text) const { return checkPlain(text, folder_ / "effect.fx"); }
    [[nodiscard]] static FileReport checkPlain(const std::string& text, const fs::path& file) {
        EXPECT_TRUE(writeFile(file, text));
        return checkEffects({file}, kDirect3D).files.at(0);
    }

    fs::path folder_;
};

const std::string kQuad = R"(
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
)";
const std::string kTechnique = R"(
#ifdef FX_TECHNIQUES
technique T { pass P { VertexShader = compile TG_VS_MODEL VS(); PixelShader = compile TG_PS_MODEL PS(); TG_STATE_BUFFER; } }
#endif
)";

TEST_F(CheckMicrosoft, a_shader_of_more_than_512_instructions_breaks_shader_model_3_only) {
    const std::string body = "float4 c = v.uv.xyxy; [unroll] for (int i = 0; i < 550; i++) c = c * c + gX; return c;";
    const FileReport report = check("float4 gX;" + kQuad + "float4 PS(V v) : SV_Target0 { " + body + " }" + kTechnique);
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed) << describe(report);
    EXPECT_TRUE(std::ranges::any_of(report.targets[0].diagnostics, [](const Diagnostic& d) {
        return d.code == 3203 && d.text.find("instruction slots") != std::string::npos;
    })) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[2].verdict, Verdict::Passed) << describe(report);
}

TEST_F(CheckMicrosoft, bit_operations_break_shader_model_3_only) {
    const FileReport report = check("int gBits; float3 gFill;" + kQuad +
                                    "float4 PS(V v) : SV_Target0 { return (gBits & 3) * v.uv.xyxy + gFill.xyzz; }" + kTechnique);
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[2].verdict, Verdict::Passed) << describe(report);
}

TEST_F(CheckMicrosoft, a_technique_that_one_target_does_not_see_is_missed) {
    const FileReport report = check(kQuad + "float4 PS(V v) : SV_Target0 { return v.uv.xyxy; }" + kTechnique +
                                    "#ifdef FX_D3D11\ntechnique Only11 { pass P { VertexShader = compile TG_VS_MODEL VS(); PixelShader = "
                                    "compile TG_PS_MODEL PS(); TG_STATE_BUFFER; } }\n#endif\n");
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Failed);
    EXPECT_EQ(report.targets[2].verdict, Verdict::Passed) << describe(report);
    ASSERT_FALSE(report.targets[1].diagnostics.empty());
    EXPECT_EQ(report.targets[1].diagnostics[0].code, 3202);
    EXPECT_EQ(report.targets[1].diagnostics[0].text, "fx_4_0 holds 1 techniques, the file has 2");
}

TEST_F(CheckMicrosoft, a_plain_direct3d_9_file_is_checked_as_such_only) {
    const FileReport report = checkPlain("texture gMap;\nsampler2D gSkin = sampler_state { Texture = <gMap>; };\n"
                                         "float4 PS(float2 uv : TEXCOORD0) : COLOR0 { return tex2D(gSkin, uv); }\n"
                                         "technique T { pass P { PixelShader = compile ps_3_0 PS(); } }\n");
    EXPECT_EQ(report.targets[0].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::NotApplicable);
    EXPECT_EQ(report.targets[1].reason, "the file has no technique for fx_4_0");
    EXPECT_EQ(report.targets[2].verdict, Verdict::NotApplicable);
    ASSERT_EQ(report.sm3.size(), 1U);
    EXPECT_EQ(report.sm3[0].usage.samplers, 1);
}

TEST_F(CheckMicrosoft, files_and_folders_have_names_in_any_letters) {
    const fs::path folder = folder_ / "k\u00f6pfe \u982d";
    ASSERT_TRUE(writeFile(folder / "t\u00f6ne.fxh", "float4 PS() : COLOR0 { return 1; }\n"));
    const FileReport report = checkPlain("#include \"t\u00f6ne.fxh\"\ntechnique T { pass P { PixelShader = compile ps_3_0 PS(); } }\n",
                                         folder / "Gr\u00f6\u00dfe.fx");
    EXPECT_EQ(report.targets[0].verdict, Verdict::Passed) << describe(report);
}

/// FurRoots' vertex shaders are the longest and take the most registers.
TEST(VertexHookExample, compiles_for_direct3d_9_10_and_11_within_the_limits_of_shader_model_3) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const EffectsCopy copy;
    for (const char* effect : {"Main.fx", "FurRoots.fx", "Culling.fx", "peers/Separable.fx"}) {
        const FileReport file =
            checkEffects({copy.put(hookExample(), effect)}, {Target::Fx2, Target::Fx4, Target::Fx5, Target::Sm5}).files.at(0);
        for (const TargetCheck& target : file.targets)
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
        // 60 bones of 3 registers are in use.
        EXPECT_TRUE(std::ranges::any_of(file.sm3, [](const PassUsage& pass) { return pass.usage.constants > 180; })) << describe(file);
    }
}

TEST(BrokenEffects, are_blamed_on_the_right_line_for_every_target_of_microsoft_s_compiler) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const CheckReport report = checkEffects(brokenEffects(), allTargets());
    for (const FileReport& file : report.files)
        expectBlame(file);
}

} // namespace
} // namespace tegument::test
