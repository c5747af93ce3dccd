#include "tests/spirv/support.h"

#include "host/spirv/cache.h"
#include "host/support/cache.h"
#include "host/support/file.h"
#include "tests/spirv/missing.h"

#include <utility>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

class Cache : public CompileTest {
protected:
    static constexpr std::string_view kCode = "float4 gTint; Texture2D gMap; SamplerState gSampler;"
                                              "float4 PS(float2 uv : TEXCOORD0) : SV_Target { return gMap.Sample(gSampler, uv) * gTint; }";

    [[nodiscard]] Shader compile(std::string_view code = kCode,
                                 const std::vector<std::pair<std::string, std::string>>& defines = {}) const {
        auto shader = compileShader(
            {.code = code, .file = "test.fx", .entry = "PS", .stage = ShaderStage::Pixel, .defines = defines, .includeFolders = {folder()}},
            Compiler::Glslang);
        if (shader) return std::move(*shader);
        ADD_FAILURE() << format(shader.error());
        return {};
    }
    [[nodiscard]] std::vector<fs::path> entries() const {
        std::vector<fs::path> found;
        if (fs::exists(folder() / "spirv"))
            for (const auto& entry : fs::directory_iterator(folder() / "spirv"))
                found.push_back(entry.path());
        return found;
    }
    [[nodiscard]] std::string onlyEntry() const {
        const auto all = entries();
        EXPECT_EQ(all.size(), 1U);
        return all.empty() ? std::string() : loadCached(fs::path("spirv") / all[0].filename()).value_or("");
    }
};

void expectSame(const Shader& a, const Shader& b) {
    EXPECT_EQ(a.spirv, b.spirv);
    EXPECT_EQ(a.entry, b.entry);
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(encodeShader({a, {}}), encodeShader({b, {}}));
}

TEST_F(Cache, what_comes_back_is_what_was_compiled) {
    const Shader fresh = compile();
    const auto cached = decodeShader(onlyEntry());
    ASSERT_TRUE(cached);
    expectSame(cached->shader, fresh);
    expectSame(compile(), fresh);
    EXPECT_EQ(entries().size(), 1U);
}

TEST_F(Cache, a_file_cut_short_anywhere_is_a_miss) {
    const Shader fresh = compile();
    const std::string bytes = onlyEntry();
    for (std::size_t length = 0; length < bytes.size(); ++length)
        ASSERT_FALSE(decodeShader(std::string_view(bytes).substr(0, length))) << length;
    const std::string file = *readFile(entries()[0]);
    ASSERT_TRUE(writeFile(entries()[0], file.substr(0, file.size() / 2)));
    expectSame(compile(), fresh);
}

TEST_F(Cache, a_changed_byte_behind_a_right_checksum_is_a_miss_or_means_what_it_says) {
    (void)compile();
    std::string bytes = onlyEntry();
    std::size_t misses = 0;
    for (char& byte : bytes) {
        const char was = std::exchange(byte, static_cast<char>(byte ^ 16)); // no truth value, a length beyond the end, another letter
        const auto cached = decodeShader(bytes);
        misses += cached ? 0 : 1;
        if (cached) {
            ASSERT_EQ(encodeShader(*cached), bytes) << &byte - bytes.data();
        }
        byte = was;
    }
    EXPECT_GT(misses, 0U);
}

TEST_F(Cache, a_damaged_file_is_replaced_by_a_good_one) {
    const Shader fresh = compile();
    ASSERT_TRUE(writeFile(entries()[0], "not a shader"));
    expectSame(compile(), fresh);
    EXPECT_TRUE(decodeShader(onlyEntry()));
}

TEST_F(Cache, a_folder_that_cannot_be_written_costs_only_time) {
    ASSERT_TRUE(writeFile(folder() / "spirv", "a file where the folder should be"));
    EXPECT_FALSE(compile().spirv.empty());
}

TEST_F(Cache, other_code_entry_and_defines_have_other_entries) {
    (void)compile();
    (void)compile(std::string(kCode) + " ");
    (void)compile(kCode, {{"A", "1"}});
    (void)compile(kCode, {{"A", "2"}});
    (void)compile(kCode, {{"A1", ""}});
    EXPECT_EQ(entries().size(), 5U);
}

TEST_F(Cache, a_changed_include_is_compiled_anew) {
    const std::string code = "#include \"value.fxh\"\nfloat4 PS() : SV_Target { return kValue; }";
    ASSERT_TRUE(writeFile(folder() / "value.fxh", "static const float kValue = 2;"));
    const Shader first = compile(code);
    ASSERT_TRUE(writeFile(folder() / "value.fxh", "static const float kValue = 3;"));
    EXPECT_NE(compile(code).spirv, first.spirv);
    ASSERT_TRUE(writeFile(folder() / "value.fxh", "static const float kValue = 2;"));
    EXPECT_EQ(compile(code).spirv, first.spirv);
}

TEST_F(Cache, errors_are_not_cached) {
    EXPECT_FALSE(compileShader({.code = "nonsense", .file = "test.fx", .entry = "PS"}, Compiler::Glslang));
    EXPECT_TRUE(entries().empty());
}

TEST_F(Cache, both_compilers_have_entries_of_their_own) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    (void)compile();
    ASSERT_TRUE(compileShader({.code = kCode, .file = "test.fx", .entry = "PS", .stage = ShaderStage::Pixel, .includeFolders = {folder()}},
                              Compiler::Dxc));
    EXPECT_EQ(entries().size(), 2U);
}

} // namespace
} // namespace tegument::test
