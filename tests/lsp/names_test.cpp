// What is found in a file, and what stands at a place, from tokens alone.

#include "tools/lsp/documents.h"
#include "tools/lsp/names.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::lsp {

namespace {

constexpr const char* kEffect = R"(#include "more.fxh"
#define SCALE 2
float4x4 gWorld : WORLD < string UIName = "World"; >;
Texture2D<float4> gMap;
struct Vertex { float3 position : POSITION; };
float4 lit(float3 normal, float power) : COLOR {
    float3 half_ = normal * SCALE;
    return float4(half_, power);
}
float4 other() : COLOR { float3 half_ = 0; return 0; }
technique T < string Script = "Pass=P;"; > {
    pass P < string Script = "Draw=Geometry;"; > { ZEnable = TRUE; PixelShader = compile ps_3_0 lit(); }
}
)";

const Declaration* find(const FileNames& names, const std::string& name) {
    const auto found = std::ranges::find(names.declarations, name, &Declaration::name);
    return found == names.declarations.end() ? nullptr : &*found;
}

/// The place of the cursor, which `|` marks.
Place at(std::string text) {
    const std::size_t bar = text.find('|');
    text.erase(bar, 1);
    const auto line = static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(bar), '\n')) + 1;
    const std::size_t start = bar == 0 ? std::string::npos : text.rfind('\n', bar - 1);
    return placeAt(text, line, static_cast<int>(start == std::string::npos ? bar : bar - start - 1) + 1);
}

} // namespace

TEST(LspNames, every_kind_of_declaration_is_found_where_it_stands) {
    const FileNames names = namesOf("a.fx", kEffect);
    struct Expected {
        const char* name;
        const char* kind;
        const char* type;
        int line;
        int column;
    };
    for (const Expected& expected : {Expected{"SCALE", "macro", "", 2, 9},
                                     {"gWorld", "global", "float4x4", 3, 10},
                                     {"gMap", "global", "Texture2D", 4, 19},
                                     {"Vertex", "struct", "", 5, 8},
                                     {"lit", "function", "float4", 6, 8},
                                     {"normal", "local", "float3", 6, 19},
                                     {"half_", "local", "float3", 7, 12},
                                     {"T", "technique", "", 11, 11},
                                     {"P", "pass", "", 12, 10}}) {
        const Declaration* found = find(names, expected.name);
        ASSERT_NE(found, nullptr) << expected.name;
        EXPECT_EQ(found->kind, expected.kind) << expected.name;
        EXPECT_EQ(found->type, expected.type) << expected.name;
        EXPECT_EQ(found->at.line, expected.line) << expected.name;
        EXPECT_EQ(found->at.column, expected.column) << expected.name;
    }
    EXPECT_EQ(names.includes, (std::vector<std::pair<int, std::string>>{{1, "more.fxh"}}));
    EXPECT_EQ(find(names, "float4"), nullptr) << "a constructor's call declares nothing";
}

TEST(LspNames, a_local_is_seen_in_its_own_function) {
    const FileNames names = namesOf("a.fx", kEffect);
    std::vector<std::pair<int, int>> seen;
    for (const Declaration& one : names.declarations)
        if (one.name == "half_") seen.emplace_back(one.from, one.to);
    EXPECT_EQ(seen, (std::vector<std::pair<int, int>>{{7, 9}, {10, 10}}));
}

TEST(LspNames, what_would_be_typed_is_known_from_what_stands_before) {
    EXPECT_EQ(at("technique T { pass P { |").context, Context::PassState);
    EXPECT_EQ(at("technique T { pass P < string S = \"a;b\"; > { ZEnable = TRUE; ZF|").context, Context::PassState);
    EXPECT_EQ(at("technique T { pass P { ZFunc = |").context, Context::Value);
    EXPECT_EQ(at("technique T { pass P { ZFunc = LE|").state, "ZFunc");
    EXPECT_EQ(at("sampler s = sampler_state { AddressU = |").context, Context::Value);
    EXPECT_TRUE(at("sampler s = sampler_state { AddressU = |").sampler);
    EXPECT_EQ(at("sampler s = sampler_state { Add|").context, Context::SamplerState);
    EXPECT_EQ(at("SamplerState s;\nfloat f() { |").context, Context::Other);
    EXPECT_EQ(at("float4x4 m : |").context, Context::Semantic);
    EXPECT_TRUE(at("float4x4 m : WOR|").global);
    EXPECT_FALSE(at("float4 f(float3 p : |").global);
    EXPECT_FALSE(at("float4 f() : |").global);
    EXPECT_FALSE(at("struct V { float3 p :|").global);
    EXPECT_EQ(at("float f() { return a ? b : |").context, Context::Other);
    EXPECT_EQ(at("|").context, Context::Other);
}

TEST(LspNames, what_is_half_written_is_read_to_its_end) {
    const std::string text = kEffect;
    for (std::size_t length = 0; length <= text.size(); ++length) {
        const std::string part = text.substr(0, length);
        for (const Declaration& one : namesOf("a.fx", part).declarations)
            EXPECT_EQ(lineOf(part, one.at.line).substr(static_cast<std::size_t>(one.at.column) - 1, one.name.size()), one.name) << length;
        (void)placeAt(part, 1 << 20, 1 << 20);
        (void)placeAt(part, -5, -5);
    }
}

TEST(LspNames, a_word_is_found_from_each_of_its_ends) {
    for (const int column : {3, 4, 5, 6})
        EXPECT_EQ(wordAt("a gXY + b", column), "gXY") << column;
    EXPECT_EQ(wordAt("a gXY + b", 7), "");
    EXPECT_EQ(wordAt("", 1), "");
    EXPECT_EQ(wordAt("abc", 99), "abc");
    EXPECT_EQ(wordAt("abc", -1), "");
}

TEST(LspDocuments, columns_count_sixteen_bit_units) {
    const std::string line = "/* \xC3\xA9 \xF0\x9F\x98\x80 */ x"; // e with an accent: 2 bytes, 1 unit; a face: 4 bytes, 2 units
    EXPECT_EQ(byteColumn(line, 3), 4);
    EXPECT_EQ(byteColumn(line, 4), 6);
    EXPECT_EQ(byteColumn(line, 7), 11);
    EXPECT_EQ(unitsBefore(line, 11), 7);
    EXPECT_EQ(byteColumn(line, 999), static_cast<int>(line.size()) + 1);
    EXPECT_EQ(byteColumn("\xF0\x9F", 5), 3) << "a character that is cut off";
}

TEST(LspDocuments, files_are_named_as_editors_do) {
    EXPECT_EQ(pathOf("file:///a/b%20c/%C3%A9.fx"), "/a/b c/\xC3\xA9.fx");
    EXPECT_EQ(pathOf("file:///a/../b.fx"), "/b.fx");
    EXPECT_EQ(pathOf(uriOf("/a/b c/\xC3\xA9#1.fx")), "/a/b c/\xC3\xA9#1.fx");
    for (const char* none : {"", "http://a/b", "file://", "file://relative", "untitled:1", "file:///a%00b"})
        EXPECT_EQ(pathOf(none), "") << none;
    EXPECT_EQ(pathOf("file:///a%"), "/a%");
}

} // namespace tegument::lsp
