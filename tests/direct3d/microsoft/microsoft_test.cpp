#include "tools/direct3d/microsoft.h"

#include "host/support/file.h"
#include "tests/support/variable.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEffect = R"(
#ifdef FX_D3D11
#define technique technique11
#define TG_PS_MODEL ps_5_0
#elif defined(FX_D3D10)
#define technique technique10
#define TG_PS_MODEL ps_4_0
#else
#define TG_PS_MODEL ps_3_0
#endif
float4 gTint;
float4 PS(float2 uv : TEXCOORD0) : SV_Target0 { return gTint * uv.x; }
technique First { pass P { PixelShader = compile TG_PS_MODEL PS(); } }
technique Second { pass P { PixelShader = compile TG_PS_MODEL PS(); } pass Q { PixelShader = compile TG_PS_MODEL PS(); } }
)";

class Microsoft : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
        folder_ = fs::temp_directory_path() / ("tegument microsoft " + std::to_string(::getpid())); // spaces on purpose
        fs::create_directories(folder_);
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }

    [[nodiscard]] fs::path file(const std::string& name, std::string_view text) const {
        EXPECT_TRUE(writeFile(folder_ / name, text));
        return folder_ / name;
    }
    /// As many results as jobs, or a failed test.
    static std::vector<MicrosoftResult> run(const std::vector<MicrosoftJob>& jobs) {
        auto results = compileWithMicrosoft(jobs);
        if (!results) {
            ADD_FAILURE() << format(results.error());
            return std::vector<MicrosoftResult>(jobs.size());
        }
        EXPECT_EQ(results->size(), jobs.size());
        results->resize(jobs.size());
        return *results;
    }

private:
    fs::path folder_;
};

TEST_F(Microsoft, one_file_compiles_for_direct3d_9_10_and_11_and_its_techniques_are_counted) {
    const fs::path source = file("two techniques.fx", kEffect);
    const auto results = run({{.profile = "fx_2_0", .source = source},
                              {.profile = "fx_4_0", .source = source, .defines = {{"FX_D3D10", "1"}}},
                              {.profile = "fx_5_0", .source = source, .defines = {{"FX_D3D11", "1"}}}});
    for (const MicrosoftResult& result : results) {
        EXPECT_TRUE(result.ok);
        EXPECT_TRUE(result.diagnostics.empty());
        EXPECT_EQ(result.techniqueCount, 2);
        EXPECT_GT(result.binary.size(), 100U);
    }
    EXPECT_EQ(results[0].passCount, 3);
    EXPECT_EQ(results[1].shaderCount, 3);
    EXPECT_EQ(results[2].shaderCount, 3);
}

TEST_F(Microsoft, techniques_that_fx_4_0_drops_without_a_word_are_missing_in_the_count) {
    const auto results =
        run({{.profile = "fx_4_0", .source = file("d3d9 techniques.fx", kEffect), .defines = {{"TG_PS_MODEL", "ps_3_0"}}}});
    EXPECT_TRUE(results[0].ok);
    EXPECT_EQ(results[0].techniqueCount, 0);
}

TEST_F(Microsoft, an_entry_point_tells_what_it_takes_of_shader_model_3) {
    const auto results = run({{.profile = "ps_3_0", .entry = "PS", .source = file("entry.fx", kEffect)}});
    ASSERT_TRUE(results[0].ok);
    ASSERT_TRUE(results[0].sm3);
    EXPECT_EQ(results[0].sm3->instructionSlots, 1);
    EXPECT_EQ(results[0].sm3->constants, 1);
    EXPECT_EQ(results[0].sm3->samplers, 0);
    EXPECT_EQ(results[0].sm3->interpolators, 1);
    EXPECT_EQ(results[0].techniqueCount, -1);
}

TEST_F(Microsoft, errors_name_file_line_and_column_with_microsoft_s_number_and_the_line_itself) {
    const fs::path source = file("bad one.fx", "float4 PS() : SV_Target0\n{\n    return undeclared;\n}\n");
    const auto results = run({{.profile = "ps_5_0", .entry = "PS", .source = source}});
    EXPECT_FALSE(results[0].ok);
    ASSERT_FALSE(results[0].diagnostics.empty());
    EXPECT_EQ(format(results[0].diagnostics[0]), source.string() + "(3,12): error TG3101: X3004: undeclared identifier 'undeclared'\n    " +
                                                     "    return undeclared;\n               ^");
}

TEST_F(Microsoft, errors_in_includes_name_the_included_file) {
    const fs::path included = file("inner/part.fxh", "float4 part() { return undeclared; }\n");
    const auto results = run({{.profile = "ps_5_0",
                               .entry = "PS",
                               .source = file("outer.fx", "#include \"inner/part.fxh\"\nfloat4 PS() : SV_Target0 { return part(); }\n")}});
    ASSERT_FALSE(results[0].diagnostics.empty());
    EXPECT_EQ(results[0].diagnostics[0].at.file, included.string());
    EXPECT_EQ(results[0].diagnostics[0].at.line, 1);
}

TEST_F(Microsoft, a_bad_job_does_not_stop_the_jobs_behind_it) {
    const fs::path good = file("good.fx", kEffect);
    const auto results = run({{.profile = "fx_2_0", .source = "nowhere.fx"},
                              {.profile = "no_profile", .entry = "PS", .source = good},
                              {.profile = "ps_3_0", .entry = "PS", .source = "with\ttab.fx"},
                              {.profile = "fx_2_0", .source = good}});
    for (const std::size_t bad : {0, 1, 2}) {
        EXPECT_FALSE(results[bad].ok) << bad;
        EXPECT_FALSE(results[bad].diagnostics.empty()) << bad;
    }
    EXPECT_EQ(results[0].diagnostics.at(0).text, "the file cannot be opened");
    EXPECT_EQ(results[2].diagnostics.at(0).code, 3105);
    EXPECT_TRUE(results[3].ok);
}

TEST_F(Microsoft, the_binary_is_kept_where_it_is_wanted) {
    const fs::path output = file("kept.fxo", "");
    const auto results = run({{.profile = "fx_2_0", .source = file("keep.fx", kEffect), .output = output}});
    ASSERT_TRUE(results[0].ok);
    EXPECT_EQ(fs::file_size(output), results[0].binary.size());
}

TEST_F(Microsoft, include_folders_are_searched_and_errors_name_the_file_that_was_found) {
    const fs::path good = file("shared/good.fxh", "float4 good() { return 1; }\n");
    const fs::path bad = file("shared/bad.fxh", "float4 bad() { return undeclared; }\n");
    const auto job = [&](const std::string& name) {
        return MicrosoftJob{.profile = "ps_5_0",
                            .entry = "PS",
                            .source =
                                file(name + ".fx", "#include \"" + name + ".fxh\"\nfloat4 PS() : SV_Target0 { return " + name + "(); }\n"),
                            .includeFolders = {good.parent_path()}};
    };
    const auto results = run({job("good"), job("bad")});
    EXPECT_TRUE(results[0].ok);
    ASSERT_FALSE(results[1].diagnostics.empty());
    EXPECT_EQ(results[1].diagnostics[0].at.file, bad.string());
    EXPECT_EQ(results[1].diagnostics[0].at.line, 1);
}

TEST_F(Microsoft, a_job_that_takes_too_long_fails_alone) {
    const std::string loops = "float4 gX[64];\nfloat4 PS(float4 c : TEXCOORD0) : SV_Target0 {\n[unroll] for (int i = 0; i < 1000; i++) {\n"
                              "if (c.x > i) c = c.yzwx * gX[i % 64] + sin(c.w); else c -= gX[(i * 7) % 64] * cos(c.y); }\nreturn c; }\n";
    const std::vector<MicrosoftJob> jobs{{.profile = "ps_5_0", .entry = "PS", .source = file("long.fx", loops)},
                                         {.profile = "fx_2_0", .source = file("short.fx", kEffect)}};
    constexpr double kSeconds = 2; // the short one takes 0.1 s, the long one 12 s
    const auto results = compileWithMicrosoft(jobs, kSeconds);
    ASSERT_TRUE(results) << format(results.error());
    ASSERT_EQ(results->size(), 2U);
    EXPECT_FALSE((*results)[0].ok);
    EXPECT_EQ((*results)[0].diagnostics.at(0).code, 3103);
    EXPECT_TRUE((*results)[1].ok);
}

TEST_F(Microsoft, a_shader_of_model_5_is_reflected_with_registers_offsets_and_defaults) {
    const fs::path source = file("reflected.fx", "float4 gTint = {1, 2, 3, 4};\nfloat gScale = 0.5;\nint3 gCount = {7, 8, 9};\n"
                                                 "Texture2D gSkinMap; SamplerState gSkin;\n"
                                                 "float4 PS(float4 p : SV_Position, float2 uv : TEXCOORD3) : SV_Target0\n"
                                                 "{ return gSkinMap.Sample(gSkin, uv) * gTint * gScale + gCount.z; }\n");
    const auto results = run({{.profile = "ps_5_0", .entry = "PS", .source = source}});
    ASSERT_TRUE(results[0].sm5);
    const Sm5Reflection& sm5 = *results[0].sm5;
    ASSERT_TRUE(sm5.reflection.globals);
    ASSERT_EQ(sm5.reflection.globals->members.size(), 3U);
    EXPECT_EQ(sm5.reflection.globals->members[1].offset, 16U);
    EXPECT_EQ(sm5.reflection.globals->members[2].offset, 20U);
    EXPECT_EQ(sm5.defaults.at("gTint"), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(sm5.defaults.at("gScale"), (std::vector<double>{0.5}));
    EXPECT_EQ(sm5.defaults.at("gCount"), (std::vector<double>{7, 8, 9}));
    ASSERT_EQ(sm5.reflection.inputs.size(), 1U);
    EXPECT_EQ(sm5.reflection.inputs[0].semantic, "TEXCOORD3");
    EXPECT_EQ(sm5.reflection.inputs[0].location, 1U) << "behind the position";
    EXPECT_EQ(sm5.reflection.resources.size(), 2U);
}

TEST_F(Microsoft, names_outside_ascii_are_handed_over) {
    const auto results = run({{.profile = "fx_2_0", .source = file("häut 皮.fx", kEffect)}});
    EXPECT_TRUE(results[0].ok);
}

TEST(MicrosoftMissing, names_the_library_that_is_not_there) {
    if (const std::string other = microsoftCompilerMissing(); !other.empty() && other.find("d3dcompiler_47.dll") == std::string::npos)
        GTEST_SKIP() << other;
    const Variable compiler("TEGUMENT_D3DCOMPILER", "/nowhere/d3dcompiler_47.dll");
    EXPECT_NE(microsoftCompilerMissing().find("/nowhere/d3dcompiler_47.dll"), std::string::npos);
    EXPECT_FALSE(compileWithMicrosoft({}));
}

} // namespace
} // namespace tegument::test
