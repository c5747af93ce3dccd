#include "tools/emit/flatten.h"

#include <gtest/gtest.h>

#include <map>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// Texts by name, in no file.
struct Tree {
    std::map<std::string, std::string> files;

    [[nodiscard]] Result<std::string> flatten() const {
        return flattenEffect("main.fx", {.includeFolders = {"shared"}, .read = [this](const fs::path& path) -> Result<std::string> {
                                             const auto found = files.find(path.lexically_normal().string());
                                             if (found == files.end()) return inputError(5001, {.file = path.string()}, "not there");
                                             return found->second;
                                         }});
    }
};

int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++found;
    return found;
}

int codeOf(const Result<std::string>& result) {
    return result ? 0 : result.error().diagnostics.at(0).code;
}

constexpr const char* kGuarded = "// Licence: ours.\n#ifndef A\n#define A\nfloat a;\n#endif\n";

TEST(Flatten, merges_a_guarded_file_once_and_keeps_its_comments) {
    const auto text = Tree{{{"main.fx", "#include \"a.fxh\"\n#include \"b.fxh\"\nfloat m; // main\n"},
                            {"a.fxh", kGuarded},
                            {"b.fxh", "#include \"a.fxh\"\nfloat b;\n"}}}
                          .flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float a;"), 1) << *text;
    EXPECT_EQ(count(*text, "// Licence: ours."), 1);
    EXPECT_EQ(count(*text, "float m; // main"), 1);
    EXPECT_EQ(count(*text, "#include"), 0);
    EXPECT_EQ(count(*text, "#line"), 0);
}

TEST(Flatten, keeps_every_branch_of_a_conditional) {
    const auto text = Tree{
        {{"main.fx", "#ifdef FX_D3D11\n#include \"a.fxh\"\n#else\nfloat nine;\n#endif\n#include \"a.fxh\"\nfloat m;\n"},
         {"a.fxh",
          kGuarded}}}.flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float a;"), 2) << "the first may not be read\n" << *text;
    EXPECT_EQ(count(*text, "float nine;"), 1);
}

TEST(Flatten, repeats_a_file_without_a_guard) {
    const auto text =
        Tree{{{"main.fx", "#define N x\n#include \"v.fxh\"\n#undef N\n#define N y\n#include \"v.fxh\"\n"}, {"v.fxh", "float N;"}}}
            .flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float N;\n"), 2) << *text;
}

TEST(Flatten, turns_pragma_once_into_a_guard) {
    const auto text =
        Tree{{{"main.fx", "#ifdef X\n#include \"o.fxh\"\n#endif\n#include \"o.fxh\"\n"}, {"o.fxh", "#pragma once\nfloat o;\n"}}}.flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "#pragma once"), 0) << *text;
    EXPECT_EQ(count(*text, "#ifndef TEGUMENT_FLATTENED_"), 2);
}

TEST(Flatten, leaves_an_include_inside_a_comment_alone) {
    const auto text = Tree{{{"main.fx", "/*\n#include \"gone.fxh\"\n*/\nfloat m;\n"}}}.flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "#include \"gone.fxh\""), 1);
}

TEST(Flatten, searches_the_include_folders) {
    const auto text = Tree{{{"main.fx", "#include <s.fxh>\n"}, {"shared/s.fxh", "float s;\n"}}}.flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float s;"), 1);
}

TEST(Flatten, a_missing_include_is_an_error_where_it_stands) {
    const auto text = Tree{{{"main.fx", "float m;\n#include \"gone.fxh\"\n"}}}.flatten();
    ASSERT_EQ(codeOf(text), 1001);
    EXPECT_EQ(text.error().diagnostics[0].at.line, 2);
}

TEST(Flatten, a_file_that_includes_itself_is_an_error) {
    EXPECT_EQ(codeOf(Tree{{{"main.fx", "#include \"main.fx\"\n"}}}.flatten()), 1002);
}

TEST(Flatten, endless_text_behind_a_condition_is_an_error) {
    EXPECT_NE(codeOf(Tree{{{"main.fx", "#ifdef X\n#include \"main.fx\"\n#include \"main.fx\"\n#endif\nfloat m;\n"}}}.flatten()), 0);
}

TEST(Flatten, an_include_named_by_a_macro_is_an_error) {
    EXPECT_EQ(codeOf(Tree{{{"main.fx", "#define NAME \"a.fxh\"\n#include NAME\n"}, {"a.fxh", kGuarded}}}.flatten()), 3305);
}

TEST(Flatten, a_file_that_undoes_its_guard_is_read_as_often_as_before) {
    const auto text = Tree{{{"main.fx", "#include \"a.fxh\"\n#undef A\n#include \"a.fxh\"\n"}, {"a.fxh", kGuarded}}}.flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float a;"), 2) << *text;
}

TEST(Flatten, what_a_file_needs_is_left_out_where_it_is_above) {
    const auto text = Tree{{{"main.fx", "#include \"a.fxh\"\n#include \"b.fxh\"\n"},
                            {"a.fxh", kGuarded},
                            {"b.fxh", "#ifndef A\n#include \"a.fxh\"\n#endif\n#ifndef B\n#define B\nfloat b;\n#endif\n"}}}
                          .flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float a;"), 1) << *text;
    EXPECT_EQ(count(*text, "#ifndef A"), 1) << *text;
}

TEST(Flatten, what_a_file_needs_is_read_where_it_is_not_above) {
    const auto text = Tree{{{"main.fx", "#include \"b.fxh\"\n#include \"b.fxh\"\n"},
                            {"a.fxh", kGuarded},
                            {"b.fxh", "#ifndef A\n#include \"a.fxh\"\n#endif\n#ifndef B\n#define B\nfloat b;\n#endif\n"}}}
                          .flatten();
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float a;"), 1) << *text;
    EXPECT_EQ(count(*text, "float b;"), 1) << *text;
}

Result<std::string> library(std::map<std::string, std::string> files) {
    const auto read = [files = std::move(files)](const fs::path& path) -> Result<std::string> {
        const auto found = files.find(path.lexically_normal().string());
        if (found == files.end()) return inputError(5001, {.file = path.string()}, "not there");
        return found->second;
    };
    return flattenLibrary("head.fxh", {.read = read});
}

TEST(FlattenLibrary, decides_what_the_library_and_guards_decide_and_leaves_the_rest_to_the_client) {
    const auto text = library(
        {{"head.fxh", "// Manual.\n#include \"a.fxh\"\n#include \"b.fxh\"\n"},
         {"a.fxh", "#ifndef A\n#define A\n#ifdef TEGUMENT_LIBRARY\n#define B\n#else\nfloat effect;\n#endif\n#ifndef SIZE\n#define SIZE "
                   "4\n#endif\nfloat f() { return SIZE; }\n#endif\n"},
         {"b.fxh", "// Not for libraries.\n#ifndef B\n#define B\nfloat b;\n#endif\n"}});
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(*text,
              "// Manual.\n#ifndef TEGUMENT_HLSL\n#define TEGUMENT_HLSL\n\n// ---- begin a.fxh\n#ifndef SIZE\n#define SIZE 4\n#endif\n"
              "float f() { return SIZE; }\n\n#endif\n");
}

TEST(FlattenLibrary, a_client_s_conditional_keeps_both_branches) {
    const auto text =
        library({{"head.fxh", "#include \"a.fxh\"\n"},
                 {"a.fxh", "#ifndef A\n#define A\n#ifdef TEGUMENT_HLSL_3\nfloat three;\n#else\nfloat four;\n#endif\n#endif\n"}});
    ASSERT_TRUE(text) << format(text.error());
    EXPECT_EQ(count(*text, "float three;") + count(*text, "float four;"), 2) << *text;
}

TEST(FlattenLibrary, a_missing_include_is_an_error) {
    EXPECT_EQ(codeOf(library({{"head.fxh", "#include \"gone.fxh\"\n"}})), 1001);
}

} // namespace
} // namespace tegument::test
