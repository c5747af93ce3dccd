// Shaders of other hosts' effects are compiled by DXC in a process of its own.

#include "host/spirv/compile.h"
#include "host/spirv/messages.h"
#include "host/spirv/reflect.h"
#include "host/support/file.h"
#include "tests/spirv/missing.h"
#include "tests/spirv/support.h"

#include <gtest/gtest.h>
#include <spirv_cross/spirv_cross.hpp>

#include <set>
#include <thread>

namespace tegument::test {
namespace {

constexpr std::string_view kTextured = R"(
float4 gTint; float4 gUnusedTint;
Texture2D gSkinMap; SamplerState gSkin; Texture2D gOtherMap; SamplerState gOther;
struct Varying { float4 position : SV_Position; float2 uv : TEXCOORD0; float3 normal : NORMAL; };
Varying VS(float3 position : POSITION, float2 uv : TEXCOORD0, float4 tangent : TANGENT, float3 normal : NORMAL)
{ Varying o; o.position = float4(position, 1) * gTint; o.uv = uv; o.normal = normal; return o; }
static const bool kOff = false;
float4 PS(Varying v) : SV_Target0
{ float4 c = gSkinMap.Sample(gSkin, v.uv) * gTint; if (kOff) c += gOtherMap.Sample(gOther, v.uv) * gUnusedTint; return c; }
)";

std::vector<std::pair<std::uint32_t, std::uint32_t>> places(const Shader& shader) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    if (shader.reflection.globals) found.emplace_back(shader.reflection.globals->set, shader.reflection.globals->binding);
    for (const Resource& r : shader.reflection.resources)
        found.emplace_back(r.set, r.binding);
    return found;
}

using Compile = EachCompiler;
INSTANTIATE_TEST_SUITE_P(By, Compile, testing::Values(Compiler::Dxc, Compiler::Glslang), compilerTestName);

TEST_P(Compile, the_entry_point_keeps_its_name_in_the_spirv) {
    const Shader shader = compile(kTextured, "PS", ShaderStage::Pixel);
    const auto entries = spirv_cross::Compiler(shader.spirv).get_entry_points_and_stages();
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].name, "PS");
}

TEST_P(Compile, no_extension_is_left_that_a_vulkan_device_need_not_have) {
    const Shader shader = compile(kTextured, "VS", ShaderStage::Vertex);
    const spirv_cross::Compiler reader(shader.spirv);
    for (const std::string& extension : reader.get_declared_extensions())
        ADD_FAILURE() << extension;
}

TEST_P(Compile, stages_of_a_pipeline_use_different_descriptor_sets) {
    for (const auto& [set, binding] : places(compile(kTextured, "VS", ShaderStage::Vertex)))
        EXPECT_EQ(set, 0U) << binding;
    for (const auto& [set, binding] : places(compile(kTextured, "PS", ShaderStage::Pixel)))
        EXPECT_EQ(set, 1U) << binding;
}

TEST_P(Compile, bindings_within_a_stage_are_unique) {
    const auto all = places(compile(kTextured, "PS", ShaderStage::Pixel));
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
}

TEST_P(Compile, the_bindings_in_the_spirv_are_those_of_the_reflection) {
    const Shader shader = compile(kTextured, "PS", ShaderStage::Pixel);
    const spirv_cross::Compiler module(shader.spirv);
    const spirv_cross::ShaderResources all = module.get_shader_resources();
    std::size_t seen = 0;
    for (const auto* variables : {&all.separate_images, &all.separate_samplers})
        for (const auto& variable : *variables) {
            const Resource* r = resource(shader, module.get_name(variable.id));
            if (r == nullptr) continue;
            ++seen;
            EXPECT_EQ(module.get_decoration(variable.id, spv::DecorationDescriptorSet), r->set) << r->name;
            EXPECT_EQ(module.get_decoration(variable.id, spv::DecorationBinding), r->binding) << r->name;
        }
    EXPECT_EQ(seen, 2U);
}

TEST_P(Compile, code_that_cannot_run_uses_nothing) {
    const Shader shader = compile(kTextured, "PS", ShaderStage::Pixel);
    ASSERT_NE(member(shader, "gTint"), nullptr);
    EXPECT_TRUE(member(shader, "gTint")->used);
    EXPECT_FALSE(member(shader, "gUnusedTint")->used);
    ASSERT_NE(resource(shader, "gSkinMap"), nullptr);
    EXPECT_TRUE(resource(shader, "gSkinMap")->used);
    EXPECT_TRUE(resource(shader, "gOtherMap") == nullptr || !resource(shader, "gOtherMap")->used);
}

TEST_P(Compile, stage_variables_carry_their_semantics_and_system_values_are_left_out) {
    const Shader vertex = compile(kTextured, "VS", ShaderStage::Vertex);
    EXPECT_EQ(locations(vertex.reflection.inputs),
              (std::map<std::string, std::uint32_t>{{"POSITION0", 0}, {"TEXCOORD0", 1}, {"NORMAL0", 3}}));
    EXPECT_EQ(locations(vertex.reflection.outputs), (std::map<std::string, std::uint32_t>{{"TEXCOORD0", 0}, {"NORMAL0", 1}}));
    const Shader pixel = compile(kTextured, "PS", ShaderStage::Pixel);
    EXPECT_EQ(locations(pixel.reflection.inputs), (std::map<std::string, std::uint32_t>{{"TEXCOORD0", 0}}));
    EXPECT_EQ(locations(pixel.reflection.outputs), (std::map<std::string, std::uint32_t>{{"SV_TARGET0", 0}}));
}

TEST_P(Compile, every_target_of_a_pixel_shader_is_an_output) {
    const Shader shader = compile("struct O { float4 a : SV_Target0; float2 b : SV_Target2; float d : SV_Depth; };"
                                  "O PS() { O o; o.a = 1; o.b = 2; o.d = 0.5; return o; }",
                                  "PS", ShaderStage::Pixel);
    EXPECT_EQ(locations(shader.reflection.outputs), (std::map<std::string, std::uint32_t>{{"SV_TARGET0", 0}, {"SV_TARGET2", 2}}));
}

TEST_P(Compile, arrays_and_matrices_count_their_elements_as_semantics) {
    const Shader shader = compile(
        "struct V { float4 p : SV_Position; float3x3 frame : TEXCOORD2; float2 uv[3] : TEXCOORD7; };"
        "V VS(float3 p : POSITION) { V o; o.p = float4(p, 1); o.frame = (float3x3)p.x; o.uv[0] = 0; o.uv[1] = 1; o.uv[2] = 2; return o; }"
        "float4 PS(V v) : SV_Target { return float4(v.frame[1], v.uv[1].x); }",
        "VS", ShaderStage::Vertex);
    EXPECT_EQ(locations(shader.reflection.outputs),
              (std::map<std::string, std::uint32_t>{
                  {"TEXCOORD2", 0}, {"TEXCOORD3", 1}, {"TEXCOORD4", 2}, {"TEXCOORD7", 3}, {"TEXCOORD8", 4}, {"TEXCOORD9", 5}}));
}

TEST_P(Compile, kinds_of_resources_are_told_apart) {
    const Shader shader = compile(
        "Texture2D gPlain; TextureCube gCube; Texture3D gVolume; SamplerState gSampler; Texture2D gShadow; SamplerComparisonState gCompare;"
        "float4 PS(float3 uv : TEXCOORD0) : SV_Target { return gPlain.Sample(gSampler, uv.xy) + gCube.Sample(gSampler, uv) + "
        "gVolume.Sample(gSampler, uv) + gShadow.SampleCmpLevelZero(gCompare, uv.xy, 0.5); }",
        "PS", ShaderStage::Pixel);
    const std::map<std::string, ResourceKind> expected{{"gPlain", ResourceKind::Texture2D},  {"gCube", ResourceKind::TextureCube},
                                                       {"gVolume", ResourceKind::Texture3D}, {"gSampler", ResourceKind::Sampler},
                                                       {"gShadow", ResourceKind::Texture2D}, {"gCompare", ResourceKind::CompareSampler}};
    for (const auto& [name, kind] : expected) {
        ASSERT_NE(resource(shader, name), nullptr) << name;
        EXPECT_EQ(resource(shader, name)->kind, kind) << name;
    }
    EXPECT_EQ(shader.reflection.resources.size(), expected.size());
    const Resource& compared = *resource(shader, "gShadow");
    EXPECT_EQ(spirv::comparedPictures(shader.spirv), (std::set<std::pair<std::uint32_t, std::uint32_t>>{{compared.set, compared.binding}}));
}

TEST_P(Compile, compute_shaders_have_their_group_size_and_buffers) {
    const Shader shader =
        compile("StructuredBuffer<float4> gIn; RWStructuredBuffer<float4> gOut; RWTexture2D<float4> gImage;"
                "[numthreads(8, 4, 2)] void CS(uint3 id : SV_DispatchThreadID) { gOut[id.x] = gIn[id.x] * 2; gImage[id.xy] = 1; }",
                "CS", ShaderStage::Compute);
    EXPECT_EQ(shader.reflection.localSize[0], 8U);
    EXPECT_EQ(shader.reflection.localSize[1], 4U);
    EXPECT_EQ(shader.reflection.localSize[2], 2U);
    for (const char* name : {"gIn", "gOut"}) {
        ASSERT_NE(resource(shader, name), nullptr) << name;
        EXPECT_EQ(resource(shader, name)->kind, ResourceKind::StorageBuffer);
        EXPECT_EQ(resource(shader, name)->set, 0U);
    }
    ASSERT_NE(resource(shader, "gImage"), nullptr);
    EXPECT_EQ(resource(shader, "gImage")->kind, ResourceKind::StorageImage);
}

TEST_P(Compile, a_default_value_is_no_warning) {
    const Shader shader = compile("float4 gTint = { 1, 2, 3, 4 }; float4 PS() : SV_Target { return gTint; }", "PS", ShaderStage::Pixel);
    for (const Diagnostic& warning : shader.warnings)
        ADD_FAILURE() << format(warning);
}

TEST_P(Compile, errors_name_the_file_and_line_of_the_line_directive) {
    const auto shader =
        tryCompile("#line 40 \"effects/My Skin.fx\"\nfloat4 PS() : SV_Target\n{\n    return undeclared;\n}\n", "PS", ShaderStage::Pixel);
    ASSERT_FALSE(shader);
    EXPECT_EQ(shader.error().blame, Blame::Input);
    const Diagnostic& first = shader.error().diagnostics.front();
    EXPECT_EQ(first.code, 3001);
    EXPECT_EQ(first.at.file, "effects/My Skin.fx");
    EXPECT_EQ(first.at.line, 42);
    EXPECT_EQ(first.at.column, 12) << "the caret stands under `undeclared`";
    EXPECT_EQ(first.sourceLine, "    return undeclared;");
    EXPECT_NE(first.text.find("undeclared"), std::string::npos) << first.text;
}

TEST_P(Compile, errors_without_line_directive_name_the_request_s_file) {
    const auto shader = tryCompile("float4 PS() : SV_Target { return undeclared; }", "PS", ShaderStage::Pixel);
    ASSERT_FALSE(shader);
    EXPECT_EQ(shader.error().diagnostics.front().at.file, "test.fx");
    EXPECT_EQ(shader.error().diagnostics.front().at.line, 1);
}

TEST_P(Compile, at_most_twenty_errors_are_shown_and_the_rest_is_counted) {
    std::string code;
    for (int i = 0; i < 40; ++i)
        code += "float f" + std::to_string(i) + "() { return undeclared" + std::to_string(i) + "; }\n";
    const auto shader = tryCompile(code + "float4 PS() : SV_Target { return 0; }", "PS", ShaderStage::Pixel);
    ASSERT_FALSE(shader);
    EXPECT_LE(shader.error().diagnostics.size(), 21U);
}

TEST_P(Compile, a_missing_entry_point_is_one_error_that_names_it) {
    const auto shader = tryCompile("float4 PS() : SV_Target { return 0; }", "Nowhere", ShaderStage::Pixel);
    ASSERT_FALSE(shader);
    ASSERT_EQ(shader.error().diagnostics.size(), 1U);
    EXPECT_NE(shader.error().diagnostics[0].text.find("Nowhere"), std::string::npos);
}

TEST_P(Compile, garbage_is_an_error) {
    for (const std::string_view code :
         {std::string_view("\0\xff\xfe{{{{", 7), std::string_view("}"), std::string_view("#include \"nowhere.fxh\"\n"), std::string_view()})
        EXPECT_FALSE(tryCompile(code, "PS", ShaderStage::Pixel)) << code;
}

TEST_P(Compile, a_struct_among_the_parameters_is_refused_with_its_name) {
    const auto shader =
        tryCompile("struct Light { float4 colour; float4 place; }; Light gLamp; float4 PS() : SV_Target { return gLamp.colour; }", "PS",
                   ShaderStage::Pixel);
    ASSERT_FALSE(shader);
    EXPECT_EQ(shader.error().diagnostics.front().code, 3006);
    EXPECT_NE(shader.error().diagnostics.front().text.find("gLamp"), std::string::npos);
}

TEST_P(Compile, defines_of_the_request_reach_the_code) {
    const auto shader = compileShader(
        {.code = "float4 PS() : SV_Target { return VALUE + FX_ENTRY; }", .file = "test.fx", .entry = "PS", .defines = {{"VALUE", "3.0"}}},
        GetParam());
    EXPECT_TRUE(shader) << format(shader.error());
}

TEST_P(Compile, includes_are_found_beside_the_including_file_and_in_the_folders) {
    ASSERT_TRUE(writeFile(folder() / "lib/inner/a.fxh", "#include \"b.fxh\"\n"));
    ASSERT_TRUE(writeFile(folder() / "lib/inner/b.fxh", "static const float kValue = 2;\n"));
    const auto shader = compileShader({.code = "#include \"inner/a.fxh\"\nfloat4 PS() : SV_Target { return kValue; }",
                                       .file = "test.fx",
                                       .entry = "PS",
                                       .includeFolders = {folder() / "lib"}},
                                      GetParam());
    EXPECT_TRUE(shader) << format(shader.error());
}

TEST_P(Compile, errors_in_includes_name_the_included_file) {
    const std::string included = (folder() / "broken.fxh").string();
    ASSERT_TRUE(writeFile(included, "\nfloat broken() { return undeclared; }\n"));
    const auto shader = compileShader({.code = "#include \"broken.fxh\"\nfloat4 PS() : SV_Target { return broken(); }",
                                       .file = "test.fx",
                                       .entry = "PS",
                                       .includeFolders = {folder()}},
                                      GetParam());
    ASSERT_FALSE(shader);
    EXPECT_EQ(shader.error().diagnostics.front().at.file, included);
    EXPECT_EQ(shader.error().diagnostics.front().at.line, 2);
}

TEST_P(Compile, many_threads_may_compile_at_once) {
    std::vector<std::string> failures(8);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < failures.size(); ++i)
            threads.emplace_back([&, i] {
                const std::string code = "float4 PS(float2 uv : TEXCOORD0) : SV_Target { return uv.x * " + std::to_string(i) + "; }";
                for (int k = 0; k < 4; ++k) {
                    const auto shader = tryCompile(code + std::string(static_cast<std::size_t>(k), ' '), "PS",
                                                   ShaderStage::Pixel); // a space: not from the cache
                    if (!shader) failures[i] = format(shader.error());
                }
            });
    }
    for (const std::string& failure : failures)
        EXPECT_EQ(failure, "");
}

TEST(Compilers, glslang_is_always_there_and_dxc_comes_first_when_it_is) {
    EXPECT_TRUE(compilerAvailable(Compiler::Glslang));
    EXPECT_EQ(defaultCompiler(), compilerAvailable(Compiler::Dxc) ? Compiler::Dxc : Compiler::Glslang);
    EXPECT_TRUE(compilerName(Compiler::Glslang).starts_with("glslang 1"));
}

ShaderRequest foreignPixel(std::string_view code) {
    return {.code = code, .file = "main.fx", .entry = "PS", .stage = ShaderStage::Pixel, .language2018 = true};
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

constexpr std::string_view kCode = "#line 1 \"a b/skin.fx\"\nfirst\nsecond line\n#line 7 \"other.fxh\"\nseventh here\n";

TEST(SourceLine, follows_line_directives) {
    EXPECT_EQ(sourceLine(kCode, "a b/skin.fx", 2), "second line");
    EXPECT_EQ(sourceLine(kCode, "other.fxh", 7), "seventh here");
    EXPECT_EQ(sourceLine(kCode, "other.fxh", 2), "");
    EXPECT_EQ(sourceLine(kCode, "nowhere.fx", 1), "");
}

TEST(DxcMessages, an_error_has_file_line_column_and_the_source_line) {
    const Messages messages =
        readDxcMessages("a b/skin.fx:2:8: error: use of undeclared identifier 'line'\nsecond line\n       ^\n", kCode, "skin.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]),
              "a b/skin.fx(2,8): error TG3001: use of undeclared identifier 'line'\n    second line\n           ^");
    EXPECT_TRUE(messages.warnings.empty());
}

TEST(DxcMessages, the_warning_that_default_values_are_ignored_is_left_out) {
    const Messages messages = readDxcMessages("s.fx:3:7: warning: variable 'gWorld' will be placed in $Globals so initializer ignored\n"
                                              "s.fx:4:9: warning: implicit truncation of vector type\n",
                                              kCode, "s.fx");
    ASSERT_EQ(messages.warnings.size(), 1U);
    EXPECT_EQ(messages.warnings[0].text, "implicit truncation of vector type");
    EXPECT_EQ(messages.warnings[0].code, 3007);
}

TEST(DxcMessages, an_error_without_place_is_one_of_the_file) {
    const Messages messages = readDxcMessages("fatal error: failed to optimize SPIR-V: something\n", kCode, "skin.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "skin.fx: error TG3001: failed to optimize SPIR-V: something");
}

TEST(GlslangMessages, the_token_gives_the_column) {
    const Messages messages = readGlslangMessages(
        "ERROR: a b/skin.fx:2: 'line' : unknown variable \nERROR: 1 compilation errors.  No code generated.\n", kCode, "skin.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "a b/skin.fx(2,8): error TG3001: unknown variable 'line'\n    second line\n           ^");
}

TEST(GlslangMessages, a_token_that_is_part_of_a_word_is_not_meant) {
    const Messages messages = readGlslangMessages("ERROR: x.fx:1: 'n' : bad\n", "#line 1 \"x.fx\"\n  min(n)\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(messages.errors[0].at.column, 7);
}

TEST(Shortened, repeated_messages_are_shown_once) {
    const Diagnostic one{.code = 3001, .at = {.file = "x.fx", .line = 1, .column = 2}, .text = "same"};
    EXPECT_EQ(shortened({one, one, one}).size(), 1U);
}

TEST(Shortened, the_rest_is_counted) {
    std::vector<Diagnostic> many;
    for (int i = 1; i <= 50; ++i)
        many.push_back({.code = 3001, .at = {.file = "x.fx", .line = i, .column = 1}, .text = "bad"});
    const auto shown = shortened(many);
    ASSERT_EQ(shown.size(), kShownMessages + 1);
    EXPECT_EQ(shown.back().text, "and 30 more");
    EXPECT_EQ(shown.back().severity, Severity::Note);
}

} // namespace
} // namespace tegument::test
