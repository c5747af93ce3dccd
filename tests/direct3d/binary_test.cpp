// Reflections of Microsoft's compiler as JSON: what it says, and what it says as it dies.

#include "tools/direct3d/effect_binary.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/microsoft_reflection.h"
#include "tools/direct3d/sm3.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tegument::test {
namespace {

std::string bytesOf(const std::vector<std::uint32_t>& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * 4};
}

/// One parameter with one annotation; two techniques, of one pass with three states and of two passes, the first with an annotation.
std::string fx2() {
    return bytesOf({0xfeff0901, 0,                               // tag, tables at byte 8
                    1,          2, 0, 5,                         // parameters, techniques, unknown, objects
                    4,          8, 0, 1, 4, 8,                   // parameter: type, value, flags, one annotation
                    4,          0, 1,                            // technique: name, no annotation, one pass
                    4,          0, 3,                            // pass: name, no annotation, three states
                    1,          0, 4, 8, 1, 0, 4, 8, 1, 0, 4, 8, //
                    4,          1, 2, 4, 8,                      // technique: name, an annotation, two passes
                    4,          1, 0, 4, 8,                      // pass with an annotation
                    4,          0, 0});
}

TEST(EffectBinary, fx_2_0_is_walked_to_its_techniques_and_passes) {
    const auto content = readEffectBinary(fx2());
    ASSERT_TRUE(content);
    EXPECT_EQ(content->techniques, 2);
    EXPECT_EQ(content->passes, 3);
}

TEST(EffectBinary, fx_2_0_cut_short_is_no_effect) {
    const std::string whole = fx2();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_FALSE(readEffectBinary(std::string_view(whole).substr(0, length))) << length;
}

TEST(EffectBinary, counts_beyond_the_file_are_no_effect) {
    EXPECT_FALSE(readEffectBinary(bytesOf({0xfeff0901, 0xffffffff, 1, 1})));
    EXPECT_FALSE(readEffectBinary(bytesOf({0xfeff0901, 0, 0xffffffff, 0xffffffff, 0, 0})));
}

/// One float2 parameter "gA" of semantic "S" with default 0.5, 2; one technique of one pass, whose only resource is `object`.
std::string fx2With(std::uint32_t tag) {
    return bytesOf({0xfeff0901, 60, // tag, tables at byte 68
                    0,          3,          1,          32,         40, 0,
                    2,          1, // byte 8: nothing at offset 0; offset 4: float, vector, name, semantic, elements, columns, rows
                    3,          0x00004167, 2,          0x00000053,        // offset 32: "gA", offset 40: "S"
                    0,          0x3f000000, 0x40000000,                    // offset 52: the value
                    1,          1,          0,          3,                 // parameters, techniques, unknown, objects
                    4,          52,         0,          0,                 // type, value, flags, annotations
                    0,          0,          1,          0,          0,  0, // technique and pass without a name
                    1,          1,                                         // values, resources
                    1,          3,          0x00636261,                    // a value of three bytes
                    0,          0,          0xffffffff, 0,          0,  8,
                    tag,        0x0000ffff});
}

TEST(EffectBinary, fx_2_0_holds_the_shaders_of_its_passes) {
    const std::string pixel = fx2With(0xffff0300);
    const auto shaders = fx2Shaders(pixel);
    ASSERT_EQ(shaders.size(), 1U);
    EXPECT_EQ(shaders[0].bytes.size(), 8U);
    EXPECT_TRUE(isPixelShader(shaders[0]));
    const std::string vertex = fx2With(0xfffe0300);
    ASSERT_EQ(fx2Shaders(vertex).size(), 1U);
    EXPECT_FALSE(isPixelShader(fx2Shaders(vertex)[0]));
}

TEST(EffectBinary, fx_2_0_holds_parameters_with_semantic_and_default) {
    const auto parameters = fx2Parameters(fx2With(0xffff0300));
    ASSERT_EQ(parameters.size(), 1U);
    EXPECT_EQ(parameters[0].name, "gA");
    EXPECT_EQ(parameters[0].semantic, "S");
    EXPECT_EQ(parameters[0].numbers, (std::vector<double>{0.5, 2}));
}

TEST(EffectBinary, an_effect_cut_short_holds_no_shader_that_reaches_beyond_it) {
    const std::string whole = fx2With(0xffff0300);
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_TRUE(fx2Shaders(std::string_view(whole).substr(0, length)).empty()) << length;
}

TEST(EffectBinary, fx_5_0_counts_techniques_and_shaders_in_its_header) {
    std::vector<std::uint32_t> words(24, 0);
    words[0] = 0xfeff2001;
    words[7] = 1;
    words[17] = 30;
    const auto content = readEffectBinary(bytesOf(words));
    ASSERT_TRUE(content);
    EXPECT_EQ(content->techniques, 1);
    EXPECT_EQ(content->shaders, 30);
}

TEST(EffectBinary, fx_4_0_lies_in_a_container) {
    std::vector<std::uint32_t> words{0x43425844, 0, 0,  0,          0, 0,
                                     0,          1, 36, 0x30315846, 80}; // "DXBC", ..., one chunk at byte 36, "FX10", its size
    std::vector<std::uint32_t> chunk(20, 0);
    chunk[0] = 0xfeff1001;
    chunk[7] = 2;
    chunk[17] = 4;
    words.insert(words.end(), chunk.begin(), chunk.end());
    const auto content = readEffectBinary(bytesOf(words));
    ASSERT_TRUE(content);
    EXPECT_EQ(content->techniques, 2);
    EXPECT_EQ(content->shaders, 4);
}

TEST(EffectBinary, a_shader_is_no_effect) {
    EXPECT_FALSE(readEffectBinary(bytesOf({0xffff0300, 1, 2, 3})));
    EXPECT_FALSE(readEffectBinary(""));
}

TEST(Sm3, a_pixel_shader_s_use_is_read_from_its_listing) {
    const auto usage = readSm3Listing("// Registers:\n//\n//   Name         Reg   Size\n//   ------------ ----- ----\n//   gWorld       c3 "
                                      "      4\n//   gTsm         s0       1\n//\n"
                                      "    ps_3_0\n    def c9, 1, 0, 0, 0\n    dcl_texcoord v0.xy\n    dcl_texcoord3 v1\n    dcl vPos.xy\n "
                                      "   dcl_2d s0\n    dcl_cube s4\n"
                                      "    mov oC0, c9\n// approximately 86 instruction slots used (2 texture, 84 arithmetic)\n");
    ASSERT_TRUE(usage);
    EXPECT_EQ(usage->instructionSlots, 86);
    EXPECT_EQ(usage->constants, 10) << "c9 is the highest";
    EXPECT_EQ(usage->samplers, 2);
    EXPECT_EQ(usage->interpolators, 2) << "vPos is no interpolator";
}

TEST(Sm3, a_matrix_takes_a_register_for_each_column) {
    const auto usage = readSm3Listing("//   gWorld       c3       4\n    vs_3_0\n");
    ASSERT_TRUE(usage);
    EXPECT_EQ(usage->constants, 7);
}

TEST(Sm3, a_vertex_shader_s_interpolators_are_its_outputs_without_the_position) {
    const auto usage = readSm3Listing(
        "    vs_3_0\n    dcl_position v0\n    dcl_texcoord v1\n    dcl_position o0\n    dcl_texcoord o1.xy\n    dcl_texcoord1 o2.xyz\n");
    ASSERT_TRUE(usage);
    EXPECT_EQ(usage->interpolators, 2);
}

TEST(Sm3, other_listings_are_not_read) {
    EXPECT_FALSE(readSm3Listing("ps_5_0\ndcl_globalFlags refactoringAllowed\n"));
    EXPECT_FALSE(readSm3Listing(""));
}

TEST(Sm3, what_the_compiler_said_as_it_died_is_no_use_of_registers) {
    const auto usage =
        readSm3Listing("//   gWorld       c2147483647       4\n//   gView       c3       2147483647\n//   gTsm         c-9       1\n"
                       "// approximately -86 instruction slots used\n"
                       "    ps_3_0\n    dcl_ v0\n    dcl__pp v1\n    dcl_texcoord v2.x{\n");
    ASSERT_TRUE(usage);
    EXPECT_EQ(usage->instructionSlots, 0);
    EXPECT_EQ(usage->constants, 3);
    EXPECT_EQ(usage->varyings, (std::map<std::string, int>{{"TEXCOORD0", 1}}));
}

TEST(MicrosoftMessages, an_error_names_the_unix_path_as_the_user_wrote_it) {
    const Messages messages = readMicrosoftMessages("Z:" + windowsPath(std::filesystem::absolute("effects/none.fx")).substr(2) +
                                                        "(3,10-22): error X1507: failed to open source file: 'm.fxh'\n",
                                                    "effects/none.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "effects/none.fx(3,10): error TG3101: X1507: failed to open source file: 'm.fxh'");
}

TEST(MicrosoftMessages, an_included_file_is_named_beside_the_source) {
    const Messages messages = readMicrosoftMessages("passes/none.fxh(1,21): error X3014: wrong\n", "effects/none.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(messages.errors[0].at.file, "effects/passes/none.fxh");
    EXPECT_EQ(messages.errors[0].at.line, 1);
    EXPECT_EQ(messages.errors[0].at.column, 21);
}

TEST(MicrosoftMessages, a_place_before_the_file_s_first_line_is_none) {
    const Messages messages = readMicrosoftMessages("x.fx(-639,-2): error X3000: syntax error\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(messages.errors[0].at.line, 0);
    EXPECT_EQ(messages.errors[0].at.column, 0);
}

TEST(MicrosoftMessages, the_warning_that_comes_with_every_effect_is_left_out) {
    const Messages messages = readMicrosoftMessages(
        "warning X4717: Effects deprecated for D3DCompiler_47\nx.fx(2,3): warning X3206: implicit truncation\n", "x.fx");
    EXPECT_TRUE(messages.errors.empty());
    ASSERT_EQ(messages.warnings.size(), 1U);
    EXPECT_EQ(messages.warnings[0].code, 3102);
    EXPECT_EQ(messages.warnings[0].text, "X3206: implicit truncation");
}

TEST(MicrosoftMessages, memory_that_compute_shaders_share_is_no_matter_for_the_others_of_their_file) {
    const Messages messages =
        readMicrosoftMessages("x.fx(66,20-28): warning X3579: vs_5_0 does not support groupshared, groupshared ignored\n", "x.fx");
    EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
}

TEST(MicrosoftMessages, an_error_without_place_is_one_of_the_file) {
    const Messages messages = readMicrosoftMessages("error X3501: 'NOPE': entrypoint not found\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_EQ(format(messages.errors[0]), "x.fx: error TG3101: X3501: 'NOPE': entrypoint not found");
}

TEST(MicrosoftMessages, a_technique11_in_fx_2_0_gets_a_hint) {
    const Messages messages = readMicrosoftMessages("ID3DXEffectCompiler: There was an error initializing the compiler\n", "x.fx");
    ASSERT_EQ(messages.errors.size(), 1U);
    EXPECT_NE(messages.errors[0].hint.find("technique11"), std::string::npos);
}

using nlohmann::json;

json plain() {
    return json::parse(R"({"buffers": [{"name": "$Globals", "size": 48, "kind": 0, "members": [
        {"name": "gTable", "offset": 0, "size": 36, "used": true, "class": 1, "type": 3, "rows": 1, "columns": 1, "elements": 3,
         "default": [1065353216, 0, 0, 0, 1073741824, 0, 0, 0, 1077936128]}]}],
        "resources": [], "inputs": [], "outputs": [], "threads": [0, 0, 0]})");
}

json& member(json& reflection) {
    return reflection["buffers"][0]["members"][0];
}

} // namespace

TEST(Sm5Reflections, of_a_constant_give_its_default_an_element_a_register) {
    const auto read = readSm5Reflection(plain());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->defaults.at("gTable"), (std::vector<double>{1, 2, 3}));
}

TEST(Sm5Reflections, with_numbers_that_are_none_are_not_read) {
    for (const char* key : {"offset", "size", "rows", "columns", "elements", "type", "class"})
        for (const json& value : {json(1e300), json(0.5), json(-1), json(std::uint64_t{1} << 40), json(true), json("1"), json(nullptr)}) {
            json wrong = plain();
            member(wrong)[key] = value;
            EXPECT_FALSE(readSm5Reflection(wrong)) << key << " " << value;
        }
    json word = plain();
    member(word)["default"][1] = 1e300;
    EXPECT_FALSE(readSm5Reflection(word));
    json large = plain();
    member(large)["elements"] = 16384;
    EXPECT_TRUE(readSm5Reflection(large)) << "what a buffer has room for";
    member(large)["rows"] = 2;
    EXPECT_FALSE(readSm5Reflection(large));
}

} // namespace tegument::test
