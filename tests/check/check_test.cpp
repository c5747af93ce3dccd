// The example of docs/your-engine.md that skins the effects.

#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "tests/check/broken.h"
#include "tests/check/describe.h"
#include "tests/check/effect_files.h"
#include "tests/check/hook_example.h"
#include "tests/spirv/missing.h"
#include "tools/check/check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

class Check : public testing::Test {
protected:
    Check() : folder_(fs::temp_directory_path() / ("tegument-check-" + std::to_string(::getpid()))) { fs::create_directories(folder_); }
    ~Check() override { fs::remove_all(folder_); }

    /// The dialect's prelude and `text` in one file.
    [[nodiscard]] fs::path effect(const std::string& name, const std::string& text) const {
        const auto prelude = readFile("hlsl/platform.fxh");
        EXPECT_TRUE(prelude) << "tests run from the repository's root";
        return file(name, (prelude ? *prelude : "") + "\n#line 1 \"" + name + "\"\n" + text);
    }
    [[nodiscard]] fs::path file(const std::string& name, const std::string& text) const {
        EXPECT_TRUE(writeFile(folder_ / name, text));
        return folder_ / name;
    }
    static FileReport checkOne(const fs::path& path, const std::vector<Target>& targets) {
        CheckReport report = checkEffects({path}, targets);
        EXPECT_EQ(report.files.size(), 1U);
        return report.files.at(0);
    }

private:
    fs::path folder_;
};

const std::string kPass = R"(
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION) { V o; o.position = float4(position, 1); o.uv = position.xy; return o; }
#ifdef FX_TECHNIQUES
technique T { pass P { VertexShader = compile TG_VS_MODEL VS(); PixelShader = compile TG_PS_MODEL PS(); TG_STATE_BUFFER; } }
#endif
)";

TEST(Targets, have_the_names_of_the_command_line) {
    EXPECT_EQ(targetsByName("all"), allTargets());
    for (const Target target : allTargets())
        EXPECT_EQ(targetsByName(targetName(target)), std::vector{target});
    EXPECT_TRUE(targetsByName("fx_3_0").empty());
}

class EveryEffect : public testing::TestWithParam<fs::path> {};

INSTANTIATE_TEST_SUITE_P(Effects, EveryEffect, testing::ValuesIn(effectFiles()), effectName);

TEST_P(EveryEffect, compiles_to_spirv_by_both_compilers_which_see_the_same_parameters_in_every_setting) {
    const CheckReport report = checkEffects({GetParam()}, spirvTargets(), {.allSettings = true});
    EXPECT_EQ(report.files.size(), 3U);
    for (const FileReport& file : report.files)
        for (const TargetCheck& target : file.targets)
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
}

TEST_P(EveryEffect, compiles_for_direct3d_12_in_every_setting) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    for (const FileReport& file : checkEffects({GetParam()}, {Target::Dxil}, {.allSettings = true}).files)
        EXPECT_EQ(file.targets.at(0).verdict, Verdict::Passed) << describe(file);
}

TEST_F(Check, a_good_effect_passes_and_its_entry_points_are_counted) {
    const FileReport good = checkOne(effect("good.fx", kPass + "float4 PS(V v) : SV_Target0 { return v.uv.xyxy; }"), spirvTargets());
    for (const TargetCheck& target : good.targets) {
        EXPECT_EQ(target.verdict, Verdict::Passed) << describe(good);
        EXPECT_EQ(target.entries, 2);
    }
}

TEST_F(Check, a_pixel_shader_that_reads_what_nobody_writes_fails) {
    const FileReport report =
        checkOne(effect("link.fx", kPass + "float4 PS(float2 uv : TEXCOORD5) : SV_Target0 { return uv.xyxy; }"), spirvTargets());
    for (const TargetCheck& target : report.targets) {
        EXPECT_EQ(target.verdict, Verdict::Failed);
        ASSERT_EQ(target.diagnostics.size(), 1U) << describe(report);
        EXPECT_EQ(target.diagnostics[0].code, 3004);
    }
}

TEST_F(Check, parameters_on_which_the_compilers_differ_fail) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const FileReport report = checkOne(
        effect("layout.fx", "float gA; float3 gB;" + kPass + "float4 PS(V v) : SV_Target0 { return gA + gB.xyzz; }"), spirvTargets());
    EXPECT_EQ(report.targets[0].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Failed);
    ASSERT_FALSE(report.targets[1].diagnostics.empty());
    EXPECT_EQ(report.targets[1].diagnostics[0].code, 3201);
}

TEST_F(Check, a_direct3d_9_file_goes_to_spirv_by_way_of_dxc_and_glslang_says_where_it_cannot) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const fs::path path = file("old.fx", "texture gMap;\nsampler2D gSkin = sampler_state { Texture = <gMap>; };\n"
                                         "float4 PS(float2 uv : TEXCOORD0) : COLOR0 { return tex2D(gSkin, uv); }\n"
                                         "technique T { pass P { PixelShader = compile ps_3_0 PS(); } }\n");
    const FileReport report = checkOne(path, spirvTargets());
    EXPECT_EQ(report.targets[0].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[0].entries, 1);
    EXPECT_EQ(report.targets[1].verdict, Verdict::NotApplicable);
    EXPECT_TRUE(report.targets[1].reason.starts_with("written for Direct3D 9: intrinsic at " + path.string() + "("))
        << report.targets[1].reason;
    EXPECT_TRUE(report.decided());
}

TEST_F(Check, arguments_of_a_pass_are_compiled_and_not_passed_over) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const FileReport report = checkOne(file("args.fx", "float4 VS(float4 p : POSITION) : SV_Position { return p; }\n"
                                                       "float4 PS(uniform float k) : SV_Target { return k; }\n"
                                                       "technique11 A { pass P { SetVertexShader(CompileShader(vs_4_0, VS()));"
                                                       " SetPixelShader(CompileShader(ps_4_0, PS(0.25))); } }\n"
                                                       "technique11 B { pass P { SetVertexShader(CompileShader(vs_4_0, VS()));"
                                                       " SetPixelShader(CompileShader(ps_4_0, PS(nowhere))); } }\n"),
                                       spirvTargets());
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed) << describe(report);
    EXPECT_EQ(report.targets[0].entries, 3) << "VS, and PS with each of its arguments";
    EXPECT_EQ(report.targets[1].verdict, Verdict::NotApplicable) << "glslang takes no arguments";
}

TEST_F(Check, a_file_that_the_front_end_refuses_fails_on_every_target) {
    const FileReport report = checkOne(effect("broken.fx", "technique { pass P { NoSuchState = 1; } }"), allTargets());
    EXPECT_FALSE(report.diagnostics.empty());
    for (const TargetCheck& target : report.targets)
        EXPECT_EQ(target.verdict, Verdict::Failed);
}

TEST_F(Check, a_missing_file_fails_on_every_target) {
    const FileReport report = checkOne("nowhere.fx", allTargets());
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_EQ(report.diagnostics[0].code, 5001);
    for (const TargetCheck& target : report.targets)
        EXPECT_EQ(target.verdict, Verdict::Failed);
}

TEST_F(Check, a_file_without_passes_has_nothing_to_check) {
    const FileReport report = checkOne(effect("empty.fx", "float4 gTint;\n"), spirvTargets());
    for (const TargetCheck& target : report.targets) {
        EXPECT_EQ(target.verdict, Verdict::NotApplicable);
        EXPECT_EQ(target.reason, "no pass names a shader");
    }
    EXPECT_FALSE(report.decided());
}

TEST_F(Check, a_missing_microsoft_compiler_is_not_checked_and_never_passed) {
    const char* before = std::getenv("TEGUMENT_D3DCOMPILER");
    const std::string kept = before == nullptr ? "" : before;
    ::setenv("TEGUMENT_D3DCOMPILER", "/nowhere/d3dcompiler_47.dll", 1);
    const CheckReport report = checkEffects({"effects/OriginalTexture.fx"}, {Target::Fx2, Target::Fx4, Target::Fx5});
    if (kept.empty())
        ::unsetenv("TEGUMENT_D3DCOMPILER");
    else
        ::setenv("TEGUMENT_D3DCOMPILER", kept.c_str(), 1);
    EXPECT_FALSE(report.failed());
    EXPECT_FALSE(report.complete());
    for (const TargetCheck& target : report.files.at(0).targets) {
        EXPECT_EQ(target.verdict, Verdict::NotChecked);
        EXPECT_FALSE(target.reason.empty());
    }
}

TEST(CheckReport, fails_with_one_target_and_is_incomplete_with_one_unchecked) {
    CheckReport report;
    report.files.push_back({.file = "a.fx", .targets = {{.target = Target::Fx2, .verdict = Verdict::Passed}}});
    EXPECT_FALSE(report.failed());
    report.files[0].targets.push_back({.target = Target::Sm5, .verdict = Verdict::NotApplicable});
    EXPECT_FALSE(report.failed());
    EXPECT_TRUE(report.complete());
    report.files[0].targets.push_back({.target = Target::Fx4, .verdict = Verdict::NotChecked});
    EXPECT_FALSE(report.failed());
    EXPECT_FALSE(report.complete());
    report.files[0].targets.push_back({.target = Target::Fx5, .verdict = Verdict::Failed});
    EXPECT_TRUE(report.failed());
}

/// Semantics that vertex shaders of this report read.
std::set<std::string> vertexInputs(const FileReport& file) {
    std::set<std::string> semantics;
    for (const EntryPoint& entry : file.entries)
        if (entry.stage == ShaderStage::Vertex && entry.glslang)
            for (const StageVariable& input : entry.glslang->reflection.inputs)
                semantics.insert(input.semantic);
    return semantics;
}

TEST(VertexHookExample, compiles_by_the_compilers_of_vulkan_with_its_streams) {
    const EffectsCopy copy;
    for (const char* effect : {"Main.fx", "FurRoots.fx", "Culling.fx", "peers/Separable.fx"}) {
        const FileReport file = checkEffects({copy.put(hookExample(), effect)}, spirvTargets()).files.at(0);
        for (const TargetCheck& target : file.targets) {
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
            EXPECT_NE(std::ranges::find(target.diagnostics, 4042, &Diagnostic::code), target.diagnostics.end()) << "this host has no bones";
        }
        for (const char* semantic : {"BLENDINDICES0", "BLENDWEIGHT0"})
            EXPECT_TRUE(vertexInputs(file).contains(semantic)) << effect << " without " << semantic;
    }
}

constexpr std::size_t kPromised = 20;

TEST(BrokenEffects, are_blamed_on_the_right_line_by_the_front_end_and_for_spirv) {
    const auto files = brokenEffects();
    ASSERT_GE(files.size(), kPromised);
    std::vector<Target> targets{Target::SpirvGlslang};
    if (compilerAvailable(Compiler::Dxc)) targets.insert(targets.end(), {Target::SpirvDxc, Target::Dxil});
    const CheckReport report = checkEffects(files, targets);
    for (const FileReport& file : report.files) {
        if (file.file.stem() == "layout" && targets.size() == 1) continue; // two compilers are compared there
        expectBlame(file);
    }
}

} // namespace
} // namespace tegument::test
