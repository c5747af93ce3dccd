// What is written for Direct3D 12. DXC's validator is the judge: it refuses a shader whose root signature does not bind all that the shader
// reads.

#include "host/spirv/dxil.h"
#include "host/spirv/glsl.h"
#include "host/support/file.h"
#include "tests/check/effect_files.h"
#include "tests/spirv/missing.h"
#include "tests/support/variable.h"
#include "tools/emit/cross.h"
#include "tools/emit/emit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Name, relative to the folder, and bytes of every file.
std::map<std::string, std::string> filesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files[entry.path().lexically_relative(folder).string()] = *readFile(entry.path());
    return files;
}

class Emit : public testing::Test {
protected:
    Emit() : folder_(fs::temp_directory_path() / ("tegument-emit-" + std::to_string(::getpid()))) {}
    ~Emit() override { fs::remove_all(folder_); }

    [[nodiscard]] const fs::path& folder() const { return folder_; }
    [[nodiscard]] fs::path emit(const CheckReport& report, const EmitOptions& more = {}) const {
        EmitOptions options = more;
        options.folder = folder_;
        const auto written = emitEffect(report.files.at(0), options);
        EXPECT_TRUE(written) << (written ? "" : format(written.error()));
        return written ? *written : fs::path();
    }
    [[nodiscard]] json manifestOf(const fs::path& written) const {
        const auto text = readFile(written / "manifest.json");
        return json::parse(text ? *text : "", nullptr, false);
    }

private:
    fs::path folder_;
};

TEST(EmitKinds, have_the_names_of_the_command_line) {
    EXPECT_EQ(targetsByName("all", true).size(), kTargets.size());
    for (const TargetRow& row : kTargets)
        EXPECT_EQ(targetsByName(row.name, true), std::vector{row.target});
    EXPECT_TRUE(targetsByName("hlsl", true).empty());
}

TEST(Translation, of_every_shader_of_both_compilers_in_every_setting_is_glsl_and_msl) {
    const CheckReport report = checkEffects(effectFiles(), spirvTargets(), {.allSettings = true});
    int shaders = 0;
    for (const FileReport& file : report.files)
        for (const EntryPoint& entry : file.entries)
            for (const auto* shader : {&entry.dxc, &entry.glslang}) {
                if (!*shader) continue;
                ++shaders;
                for (const Target language : {Target::Glsl, Target::GlslEs, Target::Msl}) {
                    if (entry.stage == ShaderStage::Compute && language != Target::Msl) continue; // GLSL 330 has none
                    const auto text = crossCompile(**shader, language, {});
                    if (language != Target::Msl && belongsToCompute(file.effect, entry.name)) continue; // nor what is drawn beside
                    ASSERT_TRUE(text) << format(text.error());
                    if (language == Target::Msl) continue;
                    EXPECT_EQ(checkGlsl((*shader)->stage, text->text), "") << file.file << " " << entry.name;
                }
            }
    EXPECT_GT(shaders, 100);
}

TEST_F(Emit, writes_what_the_manifest_lists_and_nothing_else) {
    const fs::path written = emit(checkEffects({"effects/Stretch.fx"}, spirvTargets()));
    const json manifest = manifestOf(written);
    auto files = filesIn(written);
    ASSERT_EQ(files.erase("manifest.json"), 1U);
    EXPECT_EQ(files.size(), manifest["files"].size());
    for (const json& file : manifest["files"]) {
        const std::string name = file["name"].get<std::string>();
        ASSERT_TRUE(files.contains(name)) << name;
        EXPECT_EQ(file["hash"].get<std::string>(), contentHash(files[name]));
        EXPECT_EQ(file["bytes"].get<std::size_t>(), files[name].size());
    }
    EXPECT_TRUE(files.contains("glsl/StretchPS.frag"));
    EXPECT_TRUE(files.contains("msl/StretchVS.vs.metal"));
}

TEST_F(Emit, a_second_run_gives_the_same_bytes) {
    const CheckReport report = checkEffects({"effects/Stretch.fx"}, spirvTargets());
    const auto first = filesIn(emit(report));
    EXPECT_EQ(filesIn(emit(checkEffects({"effects/Stretch.fx"}, spirvTargets()))), first);
}

TEST_F(Emit, the_manifest_holds_parameters_with_semantics_defaults_and_annotations) {
    const json manifest = manifestOf(emit(checkEffects({"effects/TSM.fx"}, spirvTargets())));
    const auto named = [&](const std::string& name) {
        for (const json& parameter : manifest["parameters"])
            if (parameter["name"] == name) return parameter;
        return json();
    };
    EXPECT_EQ(named("gWorld")["semantic"], "WORLD");
    EXPECT_EQ(named("gWorld")["type"], "float4x4");
    EXPECT_TRUE(named("gWorld")["default"].is_null());
    EXPECT_EQ(named("gClearFar")["default"], 1.0);
    EXPECT_EQ(named("gLightPosition")["annotations"]["Object"], "PointLight0");
}

TEST_F(Emit, the_manifest_joins_passes_with_states_shaders_and_files) {
    const fs::path written = emit(checkEffects({"effects/TSM.fx"}, spirvTargets()));
    const json manifest = manifestOf(written);
    const json& pass = manifest["techniques"][0]["passes"][0];
    EXPECT_EQ(pass["states"]["depth_compare"], "LESS_EQUAL");
    EXPECT_EQ(pass["states"]["cull"], "NONE");
    const auto shader = std::ranges::find_if(manifest["shaders"], [&](const json& s) { return s["name"] == pass["vertex_shader"]; });
    ASSERT_NE(shader, manifest["shaders"].end());
    EXPECT_EQ((*shader)["stage"], "vertex");
    EXPECT_TRUE(fs::exists(written / (*shader)["glsl"]["file"].get<std::string>()));
    EXPECT_EQ((*shader)["spirv-glslang"]["constants"][0]["members"][0]["offset"], 0);
}

TEST_F(Emit, compute_shaders_say_what_they_write_and_how_many_threads_a_group_has) {
    const json manifest = manifestOf(emit(checkEffects({"tests/run/fixtures/compute.fx"}, spirvTargets())));
    const json& storages = manifest["storages"];
    const auto targetOf = [&](const std::string& name) {
        const auto found = std::ranges::find_if(storages, [&](const json& one) { return one["name"] == name; });
        return found != storages.end() && found->contains("target") ? (*found)["target"].get<std::string>() : "none";
    };
    EXPECT_EQ(targetOf("gFirstStore"), "gFirstMap");
    EXPECT_EQ(targetOf("gOther"), "gWideMap");
    EXPECT_EQ(targetOf("gNowhere"), "none");
    for (const json& shader : manifest["shaders"]) {
        if (shader["name"] != "ReverseCS") continue;
        EXPECT_EQ(shader["stage"], "compute");
        EXPECT_EQ(shader["threads"], (json{16, 1, 1}));
        EXPECT_TRUE(shader.contains("msl"));
        EXPECT_FALSE(shader.contains("glsl")) << "GLSL 330 has no compute shaders";
    }
    EXPECT_EQ(manifest["techniques"][1]["passes"][1]["compute_shader"], "ReverseCS");
}

TEST_F(Emit, what_could_not_be_checked_is_missing_with_its_reason) {
    const json manifest = manifestOf(emit(checkEffects({"effects/TSM.fx"}, {Target::SpirvGlslang})));
    const auto sm5 = std::ranges::find_if(manifest["missing"], [](const json& one) { return one["kind"] == "sm5"; });
    ASSERT_NE(sm5, manifest["missing"].end());
    EXPECT_EQ((*sm5)["reason"], "sm5 was not asked for");
}

TEST_F(Emit, a_manifest_says_what_is_missing_without_this_machine_s_folders) {
    const fs::path empty = folder() / "cache"; // which holds no compiler
    const Variable cache("TEGUMENT_CACHE", empty.string());
    const Variable compiler("TEGUMENT_D3DCOMPILER", "");
    const json missing = manifestOf(emit(checkEffects({"effects/TSM.fx"}, allTargets())))["missing"];
    EXPECT_FALSE(missing.empty());
    for (const json& one : missing)
        EXPECT_EQ(one["reason"].get<std::string>().find(empty.string()), std::string::npos) << one;
}

TEST_F(Emit, only_the_chosen_kinds_are_written) {
    const CheckReport report = checkEffects({"effects/TSM.fx"}, spirvTargets());
    for (const auto& [name, bytes] : filesIn(emit(report, {.folder = {}, .kinds = {Target::SpirvGlslang}})))
        EXPECT_TRUE(name == "manifest.json" || name.starts_with("spirv-glslang/")) << name;
}

TEST_F(Emit, an_effect_that_fails_is_not_written) {
    const CheckReport report = checkEffects({"tests/check/broken/undeclared.fx"}, {Target::SpirvGlslang});
    const auto written = emitEffect(report.files.at(0), {.folder = folder()});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().diagnostics[0].code, 3301);
    EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Emit, an_effect_whose_glsl_is_not_valid_is_not_written) {
    const fs::path source = folder() / "buffer.fx"; // GLSL 330 has no storage buffers
    const auto prelude = readFile("hlsl/platform.fxh");
    ASSERT_TRUE(prelude && writeFile(source, *prelude + R"(
StructuredBuffer<float4> gTable;
float4 VS(float3 position : POSITION) : SV_Position { return float4(position, 1); }
float4 PS(float4 position : SV_Position) : SV_Target0 { return gTable[int(position.x)]; }
#ifdef FX_TECHNIQUES
technique T { pass P { VertexShader = compile TG_VS_MODEL VS(); PixelShader = compile TG_PS_MODEL PS(); TG_STATE_BUFFER; } }
#endif
)"));
    const auto written = emitEffect(checkEffects({source}, spirvTargets()).files.at(0), {.folder = folder() / "out"});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().diagnostics[0].code, 3303);
    EXPECT_FALSE(fs::exists(folder() / "out"));
}

TEST_F(Emit, a_folder_that_holds_something_else_is_left_alone) {
    ASSERT_TRUE(writeFile(folder() / "TSM/notes.txt", "mine"));
    const auto written = emitEffect(checkEffects({"effects/TSM.fx"}, {Target::SpirvGlslang}).files.at(0), {.folder = folder()});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().diagnostics[0].code, 3304);
    EXPECT_EQ(filesIn(folder()), (std::map<std::string, std::string>{{"TSM/notes.txt", "mine"}}));
}

TEST_F(Emit, what_was_written_before_is_replaced_whole) {
    const CheckReport report = checkEffects({"effects/TSM.fx"}, spirvTargets());
    const fs::path written = emit(report);
    ASSERT_TRUE(writeFile(written / "glsl/Old.frag", "of a run before"));
    EXPECT_EQ(emit(report), written);
    EXPECT_FALSE(fs::exists(written / "glsl/Old.frag"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()), 1) << "nothing temporary is left";
}

/// A pixel shader that reads two of four components.
Shader narrowPixel() {
    constexpr std::string_view kCode = "float4 PS(float2 uv : TEXCOORD0) : SV_Target0 { return float4(uv, 0, 1); }\n";
    auto shader = compileShader({.code = kCode, .file = "narrow.fx", .entry = "PS", .stage = ShaderStage::Pixel}, Compiler::Glslang);
    EXPECT_TRUE(shader);
    return shader ? *shader : Shader{};
}

/// What a pixel shader that reads two components declares where the vertex shader writes so many.
void expectDeclared(Target language, std::uint32_t components, const std::string& declaration) {
    const Shader pixel = narrowPixel();
    const auto text = crossCompile(pixel, language, {{0, {.semantic = "TEXCOORD0", .location = 0, .components = components}}});
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_NE(text->text.find(declaration), std::string::npos) << text->text;
    if (language == Target::Msl) return;
    EXPECT_EQ(checkGlsl(ShaderStage::Pixel, text->text), "") << text->text;
}

TEST(WholeInputs, make_a_pixel_shader_declare_what_the_vertex_shader_writes) {
    expectDeclared(Target::Glsl, 4, "in vec4 varying_TEXCOORD0;");
    expectDeclared(Target::GlslEs, 4, "in vec4 varying_TEXCOORD0;");
    expectDeclared(Target::Msl, 4, "float4 varying_TEXCOORD0 [[user(locn0)]];");
}

TEST(WholeInputs, leave_a_shader_alone_that_reads_everything) {
    expectDeclared(Target::Glsl, 2, "in vec2 varying_TEXCOORD0;");
    expectDeclared(Target::Msl, 2, "float2 varying_TEXCOORD0 [[user(locn0)]];");
}

TEST(Translation, of_words_that_are_no_module_is_an_error) {
    const Shader broken{.stage = ShaderStage::Pixel, .file = "broken.fx", .entry = "PS", .spirv = {1, 2, 3}};
    for (const Target language : {Target::Glsl, Target::GlslEs, Target::Msl}) {
        const auto text = crossCompile(broken, language, {});
        ASSERT_FALSE(text);
        EXPECT_EQ(text.error().diagnostics[0].code, 3302);
    }
}

TEST(Glsl, two_stages_that_do_not_meet_make_no_program) {
    const std::string vertex = "#version 330\nout vec2 uv;\nvoid main() { uv = vec2(0.0); gl_Position = vec4(0.0); }\n";
    const std::string pixel = "#version 330\nin vec3 uv;\nlayout(location = 0) out vec4 color;\nvoid main() { color = uv.xyzz; }\n";
    EXPECT_EQ(checkGlsl(ShaderStage::Vertex, vertex), "");
    EXPECT_EQ(checkGlsl(ShaderStage::Pixel, pixel), "");
    EXPECT_NE(checkGlslProgram(vertex, pixel), "");
}

class DxilEmit : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
        const CheckReport checked = checkEffects({"effects/Pyramid.fx"}, {Target::Dxil});
        report_ = checked.files.at(0);
        const auto written = emitEffect(report_, {.folder = folder_, .kinds = {Target::Dxil}});
        ASSERT_TRUE(written) << format(written.error());
        written_ = *written;
        manifest_ = json::parse(*readFile(written_ / "manifest.json"));
    }
    ~DxilEmit() override { fs::remove_all(folder_); }

    [[nodiscard]] const json& shader(const std::string& name) const {
        return *std::ranges::find_if(manifest_["shaders"], [&](const json& one) { return one["name"] == name; });
    }
    /// The entry point again, with this root signature in front of it.
    [[nodiscard]] bool serves(const std::string& name, ShaderStage stage, const std::string& signature) const {
        const std::string entry = shader(name)["entry"];
        const std::regex definition(fmt::format("\\b((?:void|float4|[A-Z]\\w*)\\s+{}\\s*\\()", entry));
        const std::string code = std::regex_replace(report_.effect.code, definition, fmt::format("[RootSignature(\"{}\")] $1", signature));
        EXPECT_TRUE(code != report_.effect.code) << entry << " is not found";
        const auto made = compileDxil({.code = code, .file = "effects/Pyramid.fx", .entry = entry, .stage = stage});
        if (!made) error_ = format(made.error());
        return static_cast<bool>(made);
    }

    FileReport report_;
    fs::path written_;
    json manifest_;
    mutable std::string error_;

private:
    fs::path folder_ = fs::temp_directory_path() / fmt::format("tegument-dxil-emit-{}", ::getpid());
};

constexpr std::pair<const char*, ShaderStage> kStages[] = {
    {"vertex_shader", ShaderStage::Vertex}, {"pixel_shader", ShaderStage::Pixel}, {"compute_shader", ShaderStage::Compute}};

TEST_F(DxilEmit, the_root_signature_of_every_pass_binds_what_its_shaders_read) {
    int held = 0;
    for (const json& technique : manifest_["techniques"])
        for (const json& pass : technique["passes"])
            for (const auto& [key, stage] : kStages) {
                if (!pass.contains(key)) continue;
                EXPECT_TRUE(serves(pass[key], stage, pass["root_signature"])) << technique["name"] << pass["name"] << key << error_;
                ++held;
            }
    EXPECT_GT(held, 20);
}

TEST_F(DxilEmit, a_root_signature_with_a_texture_less_is_refused) {
    const json& pass = manifest_["techniques"][0]["passes"].back();
    const std::string whole = pass["root_signature"];
    const std::regex textures("SRV\\(t0, numDescriptors=(\\d+)\\)");
    std::smatch count;
    ASSERT_TRUE(std::regex_search(whole, count, textures)) << whole;
    const std::string less = std::regex_replace(whole, textures, fmt::format("SRV(t0, numDescriptors={})", std::stoi(count[1].str()) - 1));
    EXPECT_FALSE(serves(pass["pixel_shader"], ShaderStage::Pixel, less));
}

/// Shader model 5 for Direct3D 11 and 12, model 6 for 12: two compilers, one signature.
TEST_F(DxilEmit, the_same_root_signature_serves_shader_model_5) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const CheckReport checked = checkEffects({"effects/Pyramid.fx"}, {Target::Sm5});
    const auto written = emitEffect(checked.files.at(0), {.folder = written_.parent_path() / "sm5", .kinds = {Target::Sm5}});
    ASSERT_TRUE(written) << format(written.error());
    const json other = json::parse(*readFile(*written / "manifest.json"));
    for (std::size_t t = 0; t < manifest_["techniques"].size(); ++t)
        for (std::size_t p = 0; p < manifest_["techniques"][t]["passes"].size(); ++p)
            EXPECT_EQ(manifest_["techniques"][t]["passes"][p].at("root_signature").get<std::string>(),
                      other["techniques"][t]["passes"][p].at("root_signature").get<std::string>());
    const auto& shaders = other["shaders"];
    const auto entry = std::ranges::find_if(shaders, [](const json& one) { return one["name"] == "EntryCS"; });
    ASSERT_NE(entry, shaders.end());
    EXPECT_EQ((*entry)["threads"], json({8, 8, 1})); // numthreads in effects/passes/pyramid_compute.fxh
}

TEST_F(DxilEmit, the_manifest_says_where_every_constant_and_texture_lies) {
    const json& pass = manifest_["techniques"][0]["passes"].back();
    const json& dxil = shader(pass["pixel_shader"])["dxil"];
    const auto bytes = readFile(written_ / dxil["file"].get<std::string>());
    ASSERT_TRUE(bytes);
    EXPECT_TRUE(bytes->starts_with("DXBC"));
    ASSERT_EQ(dxil["constants"].size(), 1U);
    EXPECT_EQ(dxil["constants"][0]["register"], 0);
    EXPECT_FALSE(dxil["constants"][0]["members"].empty());
    std::set<std::pair<bool, int>> places; // samplers count for themselves
    for (const json& resource : dxil["resources"])
        EXPECT_TRUE(places.emplace(resource["kind"] == "Sampler", resource["register"]).second) << resource;
    EXPECT_GT(places.size(), 4U);
    EXPECT_TRUE(std::ranges::any_of(dxil["outputs"], [](const json& one) { return one["semantic"] == "SV_TARGET0"; }));
}

} // namespace
} // namespace tegument::test
