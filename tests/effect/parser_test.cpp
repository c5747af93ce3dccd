// Each file of expect_fail/ says in its first line what loading it (and, where that works, running its scripts) reports first.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace tegument::test {
namespace {

using Numbers = std::vector<double>;

struct TypeCase {
    const char* text;
    BaseType base;
    int rows;
    int columns;
    int elements;
};

class Types : public testing::TestWithParam<TypeCase> {};

TEST_P(Types, are_recognised) {
    const Effect effect = loaded(GetParam().text);
    ASSERT_EQ(effect.parameters.size(), 1u);
    const Type& type = effect.parameters[0].type;
    EXPECT_EQ(type.base, GetParam().base);
    EXPECT_EQ(type.rows, GetParam().rows);
    EXPECT_EQ(type.columns, GetParam().columns);
    EXPECT_EQ(type.elements, GetParam().elements);
}

INSTANTIATE_TEST_SUITE_P(
    All, Types,
    testing::Values(TypeCase{"float g;", BaseType::Float, 1, 1, 0}, TypeCase{"float4x3 g;", BaseType::Float, 4, 3, 0},
                    TypeCase{"int2 g[3];", BaseType::Int, 1, 2, 3}, TypeCase{"bool g;", BaseType::Bool, 1, 1, 0},
                    TypeCase{"uint4 g;", BaseType::Uint, 1, 4, 0}, TypeCase{"half3 g;", BaseType::Float, 1, 3, 0},
                    TypeCase{"vector g;", BaseType::Float, 1, 4, 0}, TypeCase{"vector<int, 2> g;", BaseType::Int, 1, 2, 0},
                    TypeCase{"matrix<float, 3, 2> g;", BaseType::Float, 3, 2, 0},
                    TypeCase{"row_major float4x4 g;", BaseType::Float, 4, 4, 0}, TypeCase{"float4 g[2][3];", BaseType::Float, 1, 4, 6},
                    TypeCase{"float4 g[2 * 3 + 1];", BaseType::Float, 1, 4, 7},
                    TypeCase{"uniform extern float g;", BaseType::Float, 1, 1, 0}, TypeCase{"shared float g;", BaseType::Float, 1, 1, 0},
                    TypeCase{"typedef float3 Colour; Colour g;", BaseType::Float, 1, 3, 0},
                    TypeCase{"string g;", BaseType::String, 1, 1, 0}, TypeCase{"texture g;", BaseType::Texture2D, 1, 1, 0},
                    TypeCase{"texture2D g;", BaseType::Texture2D, 1, 1, 0}, TypeCase{"Texture2D<float4> g;", BaseType::Texture2D, 1, 1, 0},
                    TypeCase{"TextureCube g;", BaseType::TextureCube, 1, 1, 0},
                    TypeCase{"texture g < string ResourceType = \"Cube\"; >;", BaseType::TextureCube, 1, 1, 0},
                    TypeCase{"texture g; samplerCUBE s = sampler_state { Texture = <g>; };", BaseType::TextureCube, 1, 1, 0}));

TEST(Declarations, what_belongs_to_the_shader_is_no_parameter) {
    const Effect effect =
        loaded("struct S { float a; }; static float gS = 1; static const float kK[2] = {1, 2}; groupshared float gG;\n"
               "namespace N { float gN; } template <typename T> T f(T x) { return x; } RWTexture2D<float4> gOut;\n"
               "float h(float x) { return x < 1 ? 2 : 3; } [numthreads(8, 8, 1)] void C(uint3 i : SV_DispatchThreadID) {}\n"
               "typedef float Real; using Alias = float; enum E { A, B }; float forward(float x);");
    EXPECT_TRUE(effect.parameters.empty()) << effect.parameters[0].name;
}

TEST(Declarations, members_of_a_constant_buffer_are_parameters) {
    const Effect effect =
        loaded("cbuffer Frame : register(b0) { float4 gA : COLOR < string UIName = \"A\"; > = 1; float gB : packoffset(c1); };");
    ASSERT_EQ(effect.parameters.size(), 2u);
    EXPECT_EQ(numbers(effect, "gA"), (Numbers{1, 1, 1, 1}));
    EXPECT_EQ(effect.parameters[0].semantic, "COLOR");
    EXPECT_EQ(effect.parameters[1].semantic, "");
}

TEST(Declarations, several_names_share_a_type) {
    const Effect effect = loaded("float gA = 1, gB[2], gC : TIME;");
    ASSERT_EQ(effect.parameters.size(), 3u);
    EXPECT_EQ(effect.parameters[1].type.elements, 2);
    EXPECT_EQ(effect.parameters[2].semantic, "TIME");
}

TEST(Values, nested_braces_are_read_in_order) {
    EXPECT_EQ(numbers(loaded("float2x2 g[2] = { { {1, 2}, {3, 4} }, { 5, 6, 7, 8 } };"), "g"), (Numbers{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Values, a_scalar_fills_a_vector) {
    EXPECT_EQ(numbers(loaded("float3 g = 2;"), "g"), (Numbers{2, 2, 2}));
}

TEST(Values, constructors_and_operators_are_componentwise) {
    EXPECT_EQ(numbers(loaded("float3 g = float3(float2(1, 2), -3) * 2 + 1;"), "g"), (Numbers{3, 5, -5}));
}

TEST(Values, integers_divide_as_integers) {
    EXPECT_EQ(numbers(loaded("float g = 1 / 2;"), "g"), Numbers{0});
    EXPECT_EQ(numbers(loaded("float g = 1.0 / 2;"), "g"), Numbers{0.5});
}

TEST(Values, static_constants_may_be_used) {
    EXPECT_EQ(numbers(loaded("static const float kSize = 8; static const float2 kTwo = 1 / kSize; float2 g = kTwo;"), "g"),
              (Numbers{0.125, 0.125}));
}

TEST(Values, numbers_are_converted_to_their_type) {
    EXPECT_EQ(numbers(loaded("int g = 2.7;"), "g"), Numbers{2});
    EXPECT_EQ(numbers(loaded("bool g = 5;"), "g"), Numbers{1});
    EXPECT_EQ(numbers(loaded("uint g = 0xffffffff;"), "g"), Numbers{4294967295.0});
}

TEST(Values, literal_suffixes_and_exponents_are_read) {
    EXPECT_EQ(numbers(loaded("float4 g = { 1.5f, .25h, 2e-3, 7u };"), "g"), (Numbers{1.5, 0.25, 0.002, 7}));
}

TEST(Values, adjacent_strings_concatenate) {
    EXPECT_EQ(loaded("float g < string UIName = \"skin \"\n  \"tone\"; >;").findParameter("g")->annotations.string("uiname"), "skin tone");
}

TEST(Annotations, are_typed) {
    const Effect effect = loaded("float g < float UIMin = -1; int UIMax = 2; float4 c = {0, 1, 2, 3}; bool UIVisible = true; >;");
    const Annotations& annotations = effect.findParameter("g")->annotations;
    EXPECT_EQ(annotations.numbers("UIMin"), Numbers{-1});
    EXPECT_EQ(annotations.find("UIMax")->type.base, BaseType::Int);
    EXPECT_EQ(annotations.numbers("c"), (Numbers{0, 1, 2, 3}));
    EXPECT_EQ(annotations.numbers("UIVisible"), Numbers{1});
}

TEST(Samplers, convention_binds_the_map_of_the_same_name) {
    EXPECT_EQ(loaded("Texture2D gSkinMap; SamplerState gSkin;").findSampler("gSkin")->texture, "gSkinMap");
}

TEST(Samplers, the_block_wins_over_the_convention) {
    EXPECT_EQ(loaded("Texture2D gSkinMap, gOther; SamplerState gSkin { Texture = gOther; };").findSampler("gSkin")->texture, "gOther");
}

TEST(Samplers, direct3d9_states_are_read) {
    const Effect effect =
        loaded("texture t; sampler2D s = sampler_state { Texture = <t>; MinFilter = Anisotropic; MagFilter = LINEAR; MipFilter = NONE;"
               " AddressU = Clamp; AddressV = BORDER; MipMapLodBias = -1.5; MaxAnisotropy = 8; BorderColor = 0x80ff0000; };");
    const SamplerState& state = effect.findSampler("s")->state;
    EXPECT_EQ(state.minFilter, Filter::Anisotropic);
    EXPECT_EQ(state.magFilter, Filter::Linear);
    EXPECT_FALSE(state.mipmapping);
    EXPECT_EQ(state.addressU, Address::Clamp);
    EXPECT_EQ(state.addressV, Address::Border);
    EXPECT_EQ(state.addressW, Address::Wrap);
    EXPECT_EQ(state.mipLodBias, -1.5f);
    EXPECT_EQ(state.maxAnisotropy, 8);
    EXPECT_EQ(state.borderColor, (std::array<float, 4>{1, 0, 0, 128 / 255.0f}));
}

TEST(Samplers, direct3d10_states_are_read) {
    const Effect effect = loaded(
        "SamplerComparisonState s { Filter = COMPARISON_MIN_MAG_LINEAR_MIP_POINT; ComparisonFunc = LESS_EQUAL; AddressU = MIRROR_ONCE;"
        " MinLOD = 1; MaxLOD = 4; BorderColor = float4(0, 1, 0, 1); };");
    const SamplerState& state = effect.findSampler("s")->state;
    EXPECT_EQ(state.minFilter, Filter::Linear);
    EXPECT_EQ(state.mipFilter, Filter::Point);
    EXPECT_TRUE(state.mipmapping);
    EXPECT_EQ(state.compare, CompareOp::LessEqual);
    EXPECT_EQ(state.addressU, Address::MirrorOnce);
    EXPECT_EQ(state.minLod, 1);
    EXPECT_EQ(state.maxLod, 4);
    EXPECT_EQ(state.borderColor, (std::array<float, 4>{0, 1, 0, 1}));
}

TEST(Samplers, defaults_are_those_of_their_direct3d_version) {
    const Effect effect = loaded("sampler2D gOld; SamplerState gNew;");
    EXPECT_EQ(effect.findSampler("gOld")->state.minFilter, Filter::Point);
    EXPECT_FALSE(effect.findSampler("gOld")->state.mipmapping);
    EXPECT_EQ(effect.findSampler("gOld")->state.addressU, Address::Wrap);
    EXPECT_EQ(effect.findSampler("gNew")->state.minFilter, Filter::Linear);
    EXPECT_TRUE(effect.findSampler("gNew")->state.mipmapping);
    EXPECT_EQ(effect.findSampler("gNew")->state.addressU, Address::Clamp);
}

TEST(Samplers, srgb_texture_becomes_the_colour_space_of_the_texture) {
    const Effect effect = loaded("texture t; sampler2D s = sampler_state { Texture = <t>; SRGBTexture = TRUE; };");
    EXPECT_EQ(effect.findParameter("t")->annotations.string("ColorSpace"), "sRGB");
}

TEST(Techniques, all_keywords_and_groups_are_read) {
    const Effect effect =
        loaded("technique A { } technique10 B { } technique11 C { } fxgroup G { technique11 D { } } Technique { Pass { } }");
    ASSERT_EQ(effect.techniques.size(), 5u);
    EXPECT_EQ(effect.techniques[0].kind, TechniqueKind::D3D9);
    EXPECT_EQ(effect.techniques[1].kind, TechniqueKind::D3D10);
    EXPECT_EQ(effect.techniques[2].kind, TechniqueKind::D3D11);
    EXPECT_EQ(effect.techniques[3].name, "D");
    EXPECT_EQ(effect.techniques[4].passes.size(), 1u);
}

TEST(Techniques, are_found_without_regard_to_case) {
    EXPECT_EQ(loaded("technique Main { }").findTechnique("MAIN")->name, "Main");
}

TEST(Shaders, both_spellings_name_entry_profile_and_arguments) {
    const Effect effect =
        loaded("void F(uniform int n, uniform float2 b) {} technique11 T { pass A { VertexShader = compile vs_3_0 F(2, float2(1, 0)); "
               "SetPixelShader(CompileShader(ps_5_0, F())); } }");
    const Pass& pass = effect.techniques[0].passes[0];
    EXPECT_EQ(pass.vertexShader->entry, "F");
    EXPECT_EQ(pass.vertexShader->profile, "vs_3_0");
    EXPECT_EQ(pass.vertexShader->arguments, (std::vector<std::string>{"2", "float2(1,0)"}));
    EXPECT_EQ(pass.pixelShader->profile, "ps_5_0");
    EXPECT_TRUE(pass.pixelShader->arguments.empty());
}

TEST(Shaders, null_is_no_shader) {
    EXPECT_FALSE(loaded("technique T { pass P { PixelShader = NULL; } }").techniques[0].passes[0].pixelShader);
}

TEST(Shaders, objects_stand_for_their_shaders) {
    const Effect effect = loaded("void F() {} VertexShader gV = compile vs_3_0 F(); technique T { pass P { VertexShader = (gV); } }");
    EXPECT_EQ(effect.techniques[0].passes[0].vertexShader->entry, "F");
}

TEST(Robustness, errors_are_collected) {
    const Result<Effect> effect = load("float3 gA = {1, 2};\nfloat3 gB = {1};\nfloat gC;\nfloat2 gC;");
    ASSERT_FALSE(effect);
    EXPECT_EQ(effect.error().diagnostics.size(), 3u);
}

TEST(Robustness, an_error_in_one_pass_does_not_hide_the_next) {
    const Result<Effect> effect = load("technique T { pass A { ZEnabel = 1; } pass B { ZFunk = 1; } }");
    ASSERT_FALSE(effect);
    EXPECT_EQ(effect.error().diagnostics.size(), 2u);
}

TEST(Robustness, a_version_that_is_no_number_is_an_error) {
    EXPECT_EQ(firstCode(load("float Script : STANDARDSGLOBAL = wrong;")), 1104);
}

TEST(Robustness, at_most_twenty_errors_are_reported) {
    std::string text;
    for (int i = 0; i < 100; ++i)
        text += "float2 g = {1};\n";
    EXPECT_EQ(load(text).error().diagnostics.size(), 20u);
}

TEST(Robustness, deep_nesting_is_an_error) {
    EXPECT_EQ(firstCode(load("float g = " + std::string(100000, '{') + ";")), 1106);
    EXPECT_EQ(firstCode(load("#if " + std::string(100000, '(') + "\n#endif")), 1006);
    std::string calls;
    for (int i = 0; i < 300; ++i)
        calls += "F(";
    calls += "1" + std::string(300, ')');
    EXPECT_EQ(firstCode(load("#define F(x) x\nfloat g = " + calls + ";")), 1011);
    EXPECT_EQ(firstCode(load("float f() " + std::string(100000, '{'))), 1102);
}

TEST(Robustness, an_empty_file_is_an_empty_effect) {
    EXPECT_TRUE(loaded("").parameters.empty());
    EXPECT_EQ(loaded("").defaultTechnique(), nullptr);
}

TEST(Formats, prefixes_case_and_known_misspellings_are_accepted) {
    EXPECT_EQ(canonicalFormat("D3DFMT_a16b16g16r16f"), "A16B16G16R16F");
    EXPECT_EQ(canonicalFormat("A16R16G16B16F"), "A16B16G16R16F");
    EXPECT_EQ(canonicalFormat("FMT_R32F"), "R32F");
    EXPECT_EQ(canonicalFormat("R33F"), std::nullopt);
}

namespace fs = std::filesystem;

const fs::path kFolder = "tests/effect/expect_fail";
constexpr std::string_view kPrefix = "// expect: ";

std::vector<fs::path> effects() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(kFolder))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string firstLine(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

std::string firstMessage(const fs::path& file) {
    const bool lenient = file.stem().string().ends_with("_lenient");
    const Result<Effect> effect = loadEffect(file, {.lenient = lenient});
    if (!effect) return format(effect.error().diagnostics[0]);
    if (!effect->warnings.empty()) return format(effect->warnings[0]);
    if (const std::optional<Diagnostic> intrinsic = direct3D9Intrinsic(*effect)) return format(*intrinsic);
    Log log;
    const Result<void> done = runScripts(*effect, "", log);
    return done ? "no message" : format(done.error().diagnostics[0]);
}

class ExpectFail : public testing::TestWithParam<fs::path> {};

TEST_P(ExpectFail, gives_the_message_of_its_first_line) {
    const std::string message = firstMessage(GetParam());
    const std::string line = message.substr(0, message.find('\n'));
    const std::string expected = firstLine(GetParam());
    ASSERT_TRUE(expected.starts_with(kPrefix));
    EXPECT_EQ(line, kFolder.string() + "/" + expected.substr(kPrefix.size()));
}

std::string testName(const testing::TestParamInfo<fs::path>& info) {
    return "tg" + info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Effects, ExpectFail, testing::ValuesIn(effects()), testName);

TEST(Diagnostics, every_documented_code_has_an_effect_that_shows_it) {
    std::ifstream page("docs/diagnostics.md");
    ASSERT_TRUE(page);
    std::set<std::string> shown;
    for (const fs::path& file : effects())
        shown.insert("TG" + file.filename().string().substr(0, 4));
    int documented = 0;
    bool ofEffectFiles = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## ")) ofEffectFiles = line == "## Effect files";
        if (!ofEffectFiles || !line.starts_with("| TG")) continue;
        ++documented;
        EXPECT_TRUE(shown.contains(line.substr(2, 6))) << line;
    }
    EXPECT_EQ(documented, static_cast<int>(shown.size()));
}

} // namespace
} // namespace tegument::test
