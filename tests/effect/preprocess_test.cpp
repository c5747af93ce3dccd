// Where the files of an effect may lie when no mark says how far its project reaches, and where one that is missing lies.

#include "host/effect/preprocess.h"
#include "host/effect/source.h"
#include "host/support/file.h"
#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace tegument::test {
namespace {

TEST(Preprocessor, object_macros_expand_to_their_bodies) {
    EXPECT_EQ(numbers(loaded("#define SIZE 64\nfloat g = SIZE * 2;"), "g"), std::vector<double>{128});
}

TEST(Preprocessor, arguments_are_expanded_before_substitution) {
    EXPECT_EQ(numbers(loaded("#define N 3\n#define TWICE(x) ((x) * 2)\nfloat g = TWICE(N);"), "g"), std::vector<double>{6});
}

TEST(Preprocessor, a_call_as_argument_of_the_same_macro_expands) {
    EXPECT_EQ(numbers(loaded("#define TWICE(x) (2 * x)\nfloat g = TWICE(TWICE(3));"), "g"), std::vector<double>{12});
}

TEST(Preprocessor, a_macro_is_not_expanded_inside_its_own_expansion) {
    const Effect effect = loaded("#define gA gA\n#define gB gC\n#define gC gB\nfloat gA; float gB;");
    EXPECT_NE(effect.findParameter("gA"), nullptr);
    EXPECT_NE(effect.findParameter("gB"), nullptr);
}

TEST(Preprocessor, pasted_arguments_are_not_expanded) {
    const Effect effect = loaded("#define Skin wrong\n#define MAP(s) Texture2D s##Map\nMAP(Skin);");
    EXPECT_NE(effect.findParameter("SkinMap"), nullptr);
}

TEST(Preprocessor, what_is_pasted_may_be_several_tokens) {
    EXPECT_EQ(numbers(loaded("#define MEMBER(a, b) a##.##b\nfloat3 c = { 1, 2, 3 };\nfloat g = MEMBER(float3(4, 5, 6), y);"), "g"),
              std::vector<double>{5});
    EXPECT_EQ(numbers(loaded("#define SHIFT(o) 1 o##o 3\nfloat g = SHIFT(<);"), "g"), std::vector<double>{8});
    EXPECT_EQ(numbers(loaded("#define CALL(f, a) f##(a, 3)\nfloat g = CALL(max, 2);"), "g"), std::vector<double>{3});
}

TEST(Preprocessor, pasted_strings_stand_side_by_side) {
    const std::string joined = "#define FILE \"skin.png\"\n#define JOIN(a, b) a##b\n";
    EXPECT_EQ(loaded(joined + "texture m < string ResourceName = JOIN(\"tex/\", FILE); >;")
                  .findParameter("m")
                  ->annotations.string("ResourceName"),
              "tex/skin.png");
    EXPECT_EQ(loaded(joined + "texture m < string ResourceName = JOIN(\"a\", \"b\") \"c\"; >;")
                  .findParameter("m")
                  ->annotations.string("ResourceName"),
              "abc");
    EXPECT_EQ(loaded(joined + "string s = JOIN(FILE, \".dds\");").findParameter("s")->name, "s");
}

TEST(Preprocessor, directives_stand_within_the_arguments_of_a_call) {
    const std::string pick = "#define PICK(a, b) ((a) * 10 + (b))\n";
    EXPECT_EQ(numbers(loaded(pick + "float g = PICK(\n#if 1\n 2\n#else\n 3\n#endif\n, 4);"), "g"), std::vector<double>{24});
    EXPECT_EQ(numbers(loaded(pick + "float g = PICK(1,\n#define TWO 2\n TWO\n#undef ONE\n);"), "g"), std::vector<double>{12});
    EXPECT_EQ(numbers(loaded(pick + "float g = PICK(PICK(0, 1),\n#ifdef NONE\n 5\n#elif 1\n (6)\n#endif\n);"), "g"),
              std::vector<double>{16});
    EXPECT_EQ(firstCode(load(pick + "float g = PICK(1,\n#if 1\n 2;\n#endif\n")), 1009) << "never closed";
}

TEST(Preprocessor, stringified_arguments_keep_their_text) {
    const Effect effect = loaded("#define NAMED(n) float n < string UIName = #n; >\nNAMED(gScale);");
    EXPECT_EQ(effect.findParameter("gScale")->annotations.string("UIName"), "gScale");
}

TEST(Preprocessor, a_function_macro_without_bracket_is_a_plain_name) {
    EXPECT_NE(loaded("#define F(x) x\nfloat F;").findParameter("F"), nullptr);
}

TEST(Preprocessor, calls_may_span_lines) {
    EXPECT_EQ(numbers(loaded("#define ADD(a, b) ((a) + (b))\nfloat g = ADD(1,\n  2);"), "g"), std::vector<double>{3});
}

TEST(Preprocessor, defines_continue_behind_a_backslash) {
    EXPECT_EQ(numbers(loaded("#define ADD(a, b) \\\r\n  ((a) + (b))\r\nfloat g = ADD(1, 2);"), "g"), std::vector<double>{3});
}

struct ConditionCase {
    const char* expression;
    bool holds;
};

class Condition : public testing::TestWithParam<ConditionCase> {};

TEST_P(Condition, is_evaluated_as_c_does) {
    const Effect effect = loaded(fmt::format("#define ONE 1\n#if {}\nfloat gYes;\n#endif", GetParam().expression));
    EXPECT_EQ(effect.findParameter("gYes") != nullptr, GetParam().holds) << GetParam().expression;
}

INSTANTIATE_TEST_SUITE_P(Expressions, Condition,
                         testing::Values(ConditionCase{"1 + 2 * 3 == 7", true}, ConditionCase{"(1 + 2) * 3 == 9", true},
                                         ConditionCase{"10 - 4 - 3 == 3", true}, ConditionCase{"defined ONE && !defined(TWO)", true},
                                         ConditionCase{"TWO", false}, ConditionCase{"ONE ? 0 : 1", false},
                                         ConditionCase{"1 << 4 >= 16", true}, ConditionCase{"-1 < 0", true},
                                         ConditionCase{"~0 == -1", true}, ConditionCase{"0x10 == 16", true},
                                         ConditionCase{"010 == 8", true}, ConditionCase{"0 && 1 / 0", false},
                                         ConditionCase{"1 || 1 % 0", true}, ConditionCase{"7 / 2 == 3 && 7 % 2 == 1", true},
                                         ConditionCase{"6 & 3 | 8 ^ 1", true}, ConditionCase{"1 | 2 & 0", true},
                                         ConditionCase{"-9223372036854775807 - 1 == 1 << 63", true}));

TEST(Preprocessor, division_by_zero_in_a_taken_branch_is_an_error) {
    EXPECT_EQ(firstCode(load("#if 1 / 0\n#endif")), 1006);
}

TEST(Preprocessor, only_the_first_true_branch_is_read) {
    const Effect effect = loaded("#if 0\nfloat gA;\n#elif 1\nfloat gB;\n#elif 1\nfloat gC;\n#else\nfloat gD;\n#endif");
    ASSERT_EQ(effect.parameters.size(), 1u);
    EXPECT_EQ(effect.parameters[0].name, "gB");
}

TEST(Preprocessor, skipped_text_may_hold_anything_but_an_open_comment) {
    EXPECT_TRUE(load("#if 0\n don't \"stop\n #nonsense\n #if garbage (\n #endif\n#endif\nfloat g;"));
}

TEST(Preprocessor, includes_are_found_beside_the_including_file) {
    const Files files{{"main.fx", "#include \"lib/a.fxh\""}, {"lib/a.fxh", "#include \"b.fxh\""}, {"lib/b.fxh", "float gDeep;"}};
    const Effect effect = loaded(load(files));
    EXPECT_NE(effect.findParameter("gDeep"), nullptr);
    EXPECT_EQ(effect.includes, (std::vector<std::filesystem::path>{"lib/a.fxh", "lib/b.fxh"}));
}

TEST(Preprocessor, includes_are_found_in_the_include_folders_next) {
    const Files files{{"main.fx", "#include <b.fxh>"}, {"lib/b.fxh", "float gDeep;"}};
    EXPECT_TRUE(load(files, {.includeFolders = {"lib"}}));
}

TEST(Preprocessor, guarded_includes_are_read_once) {
    const std::string guarded = "#ifndef A_FXH\n#define A_FXH\nfloat gOnce;\n#endif\n";
    EXPECT_EQ(loaded(load(Files{{"main.fx", "#include \"a.fxh\"\n#include \"a.fxh\""}, {"a.fxh", guarded}})).parameters.size(), 1u);
}

TEST(Preprocessor, pragma_once_reads_a_file_once) {
    const Files files{{"main.fx", "#include \"a.fxh\"\n#include \"a.fxh\""}, {"a.fxh", "#pragma once\nfloat gOnce;\n"}};
    EXPECT_EQ(loaded(load(files)).parameters.size(), 1u);
}

TEST(Preprocessor, an_error_in_an_include_names_the_include) {
    const Result<Effect> effect = load(Files{{"main.fx", "float gA;\n#include \"a.fxh\""}, {"a.fxh", "\n  float3 gB = {1, 2};"}});
    ASSERT_FALSE(effect);
    EXPECT_EQ(format(effect.error()), "a.fxh(2,15): error TG1105: 2 numbers for float3 that holds 3\n"
                                      "      float3 gB = {1, 2};\n"
                                      "                  ^");
}

TEST(Preprocessor, tokens_of_a_macro_stand_where_it_is_called) {
    const Result<Effect> effect = load("#define STATES ZEnabel = TRUE\ntechnique T { pass P {\n    STATES;\n} }");
    ASSERT_FALSE(effect);
    EXPECT_EQ(effect.error().diagnostics[0].at.line, 3);
    EXPECT_EQ(effect.error().diagnostics[0].at.column, 5);
}

TEST(Preprocessor, a_byte_order_mark_and_utf8_comments_do_no_harm) {
    const Effect effect = loaded("\xEF\xBB\xBF"
                                 "float gA; // gr\xC3\xB6\xC3\x9F"
                                 "e\r\nfloat gB;\r\n");
    EXPECT_EQ(effect.findParameter("gA")->at.column, 7);
    EXPECT_EQ(effect.findParameter("gB")->at.line, 2);
}

TEST(Preprocessor, defines_given_at_load_are_seen_by_both_views) {
    const Result<Effect> effect =
        load(Files{{"main.fx", "float gA = SIZE;\nstatic const float kA = SIZE;"}}, {.defines = {{"SIZE", "64"}}});
    EXPECT_EQ(numbers(loaded(effect), "gA"), std::vector<double>{64});
    EXPECT_NE(effect->code.find("kA = 64"), std::string::npos);
}

TEST(Preprocessor, a_nul_byte_is_an_error_with_a_position) {
    EXPECT_EQ(firstCode(load(std::string("float gA\0;", 10))), 1101);
}

TEST(Preprocessor, line_directives_do_not_move_positions) {
    EXPECT_EQ(loaded("#line 100 \"other.fx\"\nfloat gA;").findParameter("gA")->at.line, 2);
}

const char* const kQuality = "#define FX_SETTINGS QUALITY draft good best\n"
                             "#define FX_METADATA size SIDE quality QUALITY\n"
                             "#ifndef QUALITY\n#define QUALITY 1\n#endif\n"
                             "#define SIDE 64\n"
                             "float gQuality = QUALITY;\n";

TEST(EffectSettings, are_named_by_the_effect_with_the_one_that_it_has) {
    const Effect effect = loaded(kQuality);
    ASSERT_TRUE(effect.settings);
    EXPECT_EQ(effect.settings->define, "QUALITY");
    EXPECT_EQ(effect.settings->names, (std::vector<std::string>{"draft", "good", "best"}));
    EXPECT_EQ(effect.settings->current, "good");
    EXPECT_EQ(effect.metadata, (std::map<std::string, std::string>{{"quality", "1"}, {"size", "64"}}));
}

TEST(EffectSettings, are_chosen_by_name_in_both_views) {
    const Result<Effect> effect =
        load(Files{{"main.fx", kQuality + std::string("static const float kQuality = QUALITY;")}}, {.setting = "best"});
    EXPECT_EQ(loaded(effect).settings->current, "best");
    EXPECT_EQ(numbers(*effect, "gQuality"), std::vector<double>{2});
    EXPECT_NE(effect->code.find("kQuality = 2"), std::string::npos);
    EXPECT_EQ(effect->defines, (std::vector<std::pair<std::string, std::string>>{{"QUALITY", "2"}})) << "what other compilers need";
}

TEST(EffectSettings, follow_a_definition_of_their_switch) {
    EXPECT_EQ(loaded(load(Files{{"main.fx", kQuality}}, {.defines = {{"QUALITY", "0"}}})).settings->current, "draft");
    EXPECT_EQ(loaded(load(Files{{"main.fx", kQuality}}, {.defines = {{"QUALITY", "7"}}})).settings->current, "7") << "it has no name";
}

TEST(EffectSettings, that_are_unknown_are_an_error_of_the_command_line_with_those_there_are) {
    const Result<Effect> effect = load(Files{{"main.fx", kQuality}}, {.setting = "worst"});
    ASSERT_EQ(firstCode(effect), 4051);
    EXPECT_EQ(effect.error().blame, Blame::Usage);
    EXPECT_EQ(effect.error().diagnostics.front().hint, "draft, good, best");
    EXPECT_EQ(firstCode(load(Files{{"main.fx", "float gA;"}}, {.setting = "draft"})), 4051) << "no settings at all";
}

TEST(EffectSettings, are_absent_where_the_effect_names_none) {
    const Effect effect = loaded("float gA;");
    EXPECT_FALSE(effect.settings);
    EXPECT_TRUE(effect.metadata.empty());
}

std::string code(const std::string& text) {
    return loaded(text).code;
}

TEST(CodeView, effect_syntax_is_blanked_and_shader_text_is_kept) {
    EXPECT_EQ(code("float4 gTint : DIFFUSE < string UIName = \"Tint\"; > = { 1, 2, 3, 4 };\n"
                   "float4 P() : SV_Target0 { return gTint < 1 ? 0 : 1; }\n"
                   "technique T { pass P { PixelShader = compile ps_3_0 P(); } }\n"),
              "#line 1 \"main.fx\"\n"
              "float4 gTint                                                       ;\n"
              "float4 P() : SV_Target0 { return gTint < 1 ? 0 : 1; }\n");
}

TEST(CodeView, lines_and_columns_stay_where_they_were) {
    EXPECT_EQ(code("SamplerState gS\n{\n    AddressU = WRAP;\n};\n\n  float4 gA;"),
              "#line 1 \"main.fx\"\nSamplerState gS\n\n\n ;\n\n  float4 gA;\n");
}

TEST(CodeView, far_jumps_and_includes_get_a_line_directive) {
    const Effect effect = loaded(load(Files{{"main.fx", "float gA;\n#include \"a.fxh\"\nfloat gC;\n"}, {"a.fxh", "\nfloat gB;"}}));
    EXPECT_EQ(effect.code, "#line 1 \"main.fx\"\nfloat gA;\n#line 2 \"a.fxh\"\nfloat gB;\n#line 3 \"main.fx\"\nfloat gC;\n");
}

TEST(CodeView, is_preprocessed_with_fx_entry) {
    EXPECT_NE(code("#if FX_ENTRY\nfloat gEntry;\n#endif\n#ifdef FX_D3D11\nfloat gMeta;\n#endif").find("gEntry"), std::string::npos);
    EXPECT_EQ(code("#ifdef FX_D3D11\nfloat gMeta;\n#endif").find("gMeta"), std::string::npos);
}

TEST(CodeView, metadata_is_preprocessed_with_fx_d3d11) {
    const Effect effect = loaded("#ifdef FX_D3D11\nfloat gMeta;\n#endif\n#ifdef FX_ENTRY\nfloat gEntry;\n#endif");
    EXPECT_NE(effect.findParameter("gMeta"), nullptr);
    EXPECT_EQ(effect.findParameter("gEntry"), nullptr);
}

TEST(CodeView, strings_state_objects_and_the_global_script_vanish) {
    EXPECT_EQ(code("string gText = \"a\"; BlendState gB { BlendEnable[0] = TRUE; }; float Script : STANDARDSGLOBAL = 0.8;"), "\n");
}

TEST(CodeView, qualifiers_that_compilers_misread_are_blanked) {
    EXPECT_EQ(code("const float gA = 3; uniform float gB; static const float kC = 3;"),
              "#line 1 \"main.fx\"\n      float gA    ;         float gB; static const float kC = 3;\n");
}

TEST(CodeView, pragmas_reach_the_compilers) {
    EXPECT_NE(code("float gA;\n#pragma pack_matrix(row_major)\nfloat gB;").find("\n#pragma pack_matrix(row_major)\n"), std::string::npos);
}

TEST(CodeView, operators_of_macros_are_not_torn_apart) {
    EXPECT_NE(code("#define LESS(a, b) ((a) <= (b))\nbool f(float x) { return LESS(x, 1); }").find("<="), std::string::npos);
}

TEST(CodeView, neighbours_of_macros_are_not_glued_together) {
    const std::string text = code("#define MINUS -\nfloat f(float x) { return MINUS-x; }");
    EXPECT_EQ(text.find("--"), std::string::npos) << text;
}

TEST(Direct3D9Intrinsics, are_found_with_their_position) {
    const std::optional<Diagnostic> found = direct3D9Intrinsic(loaded(
        load(Files{{"main.fx", "\n#include \"a.fxh\"\n"}, {"a.fxh", "\n\nfloat4 f() { return tex2Dlod(s, float4(0, 0, 0, 0)); }"}})));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->at.file, "a.fxh");
    EXPECT_EQ(found->at.line, 3);
    EXPECT_EQ(found->at.column, 21);
}

TEST(Direct3D9Intrinsics, macros_that_spell_them_in_direct3d10_are_fine) {
    EXPECT_FALSE(direct3D9Intrinsic(loaded("#define tex2D(s, uv) s##Map.Sample(s, uv)\nTexture2D gSkinMap; SamplerState gSkin;\n"
                                           "float4 f(float2 uv) { return tex2D(gSkin, uv); }")));
}

namespace fs = std::filesystem;

class Unpacked : public testing::Test {
protected:
    void SetUp() override {
        root_ = fs::temp_directory_path() /
                fmt::format("tegument-unpacked-{}", ::testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(root_);
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    fs::path write(const std::string& name, const std::string& text) const {
        EXPECT_TRUE(writeFile(root_ / name, text));
        return root_ / name;
    }
    static std::string said(const fs::path& effect) {
        const auto read = loadEffect(effect, {.lenient = true});
        return read ? std::string() : format(read.error());
    }

    fs::path root_;
};

TEST_F(Unpacked, an_archive_reads_what_its_effects_name_in_folders_beside_and_above) {
    write("common.fxh", "float gCommon;");
    write("lib/deep/more.fxh", "#include \"../more2.fxh\"\n");
    write("lib/more2.fxh", "#include \"../common.fxh\"\n");
    EXPECT_EQ(said(write("pack/sub/above.fx", "#include \"../../common.fxh\"\n")), "");
    EXPECT_EQ(said(write("pack/sub/beside.fx", "#include <..\\..\\lib\\deep\\more.fxh>\n")), "") << "through what it includes";
    EXPECT_EQ(said(write("sub/one.fx", "  #  include \"../common.fxh\" // shared\n")), "");
}

TEST_F(Unpacked, an_archive_holds_no_file_that_is_named_absolutely_or_behind_a_link) {
    const fs::path secret = write("secret/s.fxh", "float gSecret;");
    EXPECT_NE(said(write("a/absolute.fx", "#include \"" + secret.string() + "\"\n")).find("TG1014"), std::string::npos);
    fs::create_directories(root_ / "a");
    fs::create_symlink(secret, root_ / "a/link.fxh");
    EXPECT_NE(said(write("a/linked.fx", "#include \"link.fxh\"\n")).find("TG1014"), std::string::npos);
    EXPECT_NE(said(write("a/far.fx", "#include \"../../../../../../../../../../etc/passwd\"\n")).find("TG1014"), std::string::npos)
        << "the common parent is the whole machine";
}

TEST_F(Unpacked, an_include_that_is_there_and_cannot_be_read_is_not_called_missing) {
    const fs::path effect = write("a.fx", "\n#include \"part.fxh\"\n");
    const fs::path part = write("part.fxh", "float gPart;");
    const auto with = [&](const Error& error) {
        Sources sources;
        const auto read = [&](const fs::path& path) { return path == part ? Result<std::string>(error) : readFile(path); };
        return preprocess(effect, {.read = read}, sources).error();
    };
    const Error memory = with(machineError(8001, "out of memory for part.fxh"));
    EXPECT_EQ(memory.blame, Blame::Machine);
    EXPECT_NE(format(memory).find("a.fx(2,10): error TG8001: out of memory for part.fxh"), std::string::npos) << format(memory);
    const Error rights = with(inputError(5001, {.file = part.string()}, "cannot be read: Permission denied"));
    EXPECT_EQ(rights.blame, Blame::Input);
    EXPECT_NE(format(rights).find(fmt::format("a.fx(2,10): error TG5001: include file '{}' cannot be read", part.string())),
              std::string::npos)
        << format(rights);
}

TEST_F(Unpacked, a_mark_ends_the_project_before_the_file) {
    write("shared.fxh", "float gShared;");
    write("repository/.git/HEAD", "ref");
    EXPECT_NE(said(write("repository/sub/a.fx", "#include \"../../shared.fxh\"\n")).find("TG1014"), std::string::npos);
}

TEST_F(Unpacked, the_working_directory_holds_what_is_named_absolutely) {
    const fs::path shared = write("lib/shared.fxh", "float gShared;");
    const fs::path effect = write("a/b.fx", "#include \"" + shared.string() + "\"\n");
    EXPECT_NE(said(effect).find("TG1014"), std::string::npos);
    const fs::path before = fs::current_path();
    fs::current_path(root_);
    const std::string here = said(effect);
    fs::current_path(root_ / "lib");
    const std::string elsewhere = said(effect);
    fs::current_path(before);
    EXPECT_EQ(here, "");
    EXPECT_NE(elsewhere.find("TG1014"), std::string::npos) << "the working directory does not hold the effect";
}

TEST_F(Unpacked, a_file_that_is_named_in_another_case_belongs_to_the_project) {
    write("Shader/EdgeLine.fxsub", "float gEdge;");
    const fs::path effect = write("Outline/Red/a.fx", "#include \"../../shader/edgeline.fxsub\"\n");
    const auto loaded = loadEffect(effect, {.lenient = true});
    EXPECT_TRUE(loaded) << format(loaded.error());
    write("ray.conf", "float gRay;");
    write("Light/disk.fxsub", "#include \"../../ray.conf\"\n"); // from where the effect lies
    const auto from = loadEffect(write("Light/Red/b.fx", "#include \"../disk.fxsub\"\n"), {.lenient = true});
    EXPECT_TRUE(from) << format(from.error());
}

TEST_F(Unpacked, a_missing_include_is_looked_for_and_its_folder_named) {
    write("shaders/lib/common.fxh", "float gCommon;");
    write("shaders/lib/inner/part.fxh", "float gPart;");
    const auto hint = [&](const fs::path& effect) {
        const std::string text = said(effect);
        EXPECT_NE(text.find("TG1001"), std::string::npos) << text;
        const std::size_t at = text.find("-I ");
        return at == std::string::npos ? std::string() : text.substr(at + 3, text.find(" finds it") - at - 3);
    };
    const std::string lib = (root_ / "shaders/lib").string();
    const fs::path plain = write("shaders/sm3/a.fx", "#include \"common.fxh\"\n");
    EXPECT_EQ(hint(plain), lib);
    EXPECT_TRUE(loadEffect(plain, {.includeFolders = {lib}})) << "the hint works";
    EXPECT_EQ(hint(write("shaders/sm3/b.fx", "#include <inner\\part.fxh>\n")), lib) << "of a name with a folder";
    EXPECT_EQ(hint(write("c.fx", "#include \"Common.FXH\"\n")), lib) << "in another case";
    EXPECT_EQ(hint(write("shaders/sm3/d.fx", "#include \"nowhere.fxh\"\n")), "");
    write("other/common.fxh", "float gOther;");
    EXPECT_EQ(hint(plain), lib) << "the nearest one";
}

TEST_F(Unpacked, the_header_of_reshade_is_said_to_come_with_its_effects) {
    const std::string text = said(write("a.fx", "#include \"ReShade.fxh\"\n"));
    EXPECT_NE(text.find("TG1001: cannot find include file 'ReShade.fxh'; it comes with crosire/reshade-shaders (GitHub): -I names its "
                        "folder Shaders"),
              std::string::npos)
        << text;
}

} // namespace
} // namespace tegument::test
