// What Microsoft's compiler has made is kept: when it is found again, and when not.

#include "tools/direct3d/microsoft.h"

#include "host/support/file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// A name that no run before has used: the store outlives the tests.
std::string uniqueName() {
    static int count = 0;
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    return "gKept" + std::to_string(::getpid()) + "_" + std::to_string(now) + "_" + std::to_string(++count);
}

/// A stored file that holds this name: a parameter's stands in what is compiled.
fs::path storedFile(const std::string& name) {
    for (const auto& entry : fs::recursive_directory_iterator(cacheFolder() / "microsoft"))
        if (entry.is_regular_file())
            if (const auto bytes = readFile(entry.path()); bytes && bytes->find(name) != std::string::npos) return entry.path();
    return {};
}

class Kept : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
        folder_ = fs::temp_directory_path() / ("tegument kept " + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        if (folder_.empty()) return;
        fs::remove_all(folder_);
        const std::string ours = "gKept" + std::to_string(::getpid());
        for (fs::path stored = storedFile(ours); !stored.empty(); stored = storedFile(ours))
            fs::remove(stored);
    }

    [[nodiscard]] fs::path file(const std::string& name, const std::string& text) const {
        EXPECT_TRUE(writeFile(folder_ / name, text));
        return folder_ / name;
    }
    static MicrosoftResult compile(const fs::path& source, std::vector<std::pair<std::string, std::string>> defines = {},
                                   const std::string& profile = "ps_5_0") {
        auto results = compileWithMicrosoft({{.profile = profile, .entry = "PS", .source = source, .defines = std::move(defines)}});
        if (results && results->size() == 1) return std::move(results->front());
        ADD_FAILURE() << "nothing was run";
        return {};
    }

private:
    fs::path folder_;
};

std::string shader(const std::string& name) {
    return "float4 " + name + ";\nfloat4 PS() : SV_Target0 { return " + name + " * FACTOR; }\n";
}

TEST_F(Kept, the_same_code_in_another_file_gives_the_same_result_without_compiling) {
    const std::string code = "#define FACTOR 2\n" + shader(uniqueName());
    const MicrosoftResult first = compile(file("first.fx", code));
    const MicrosoftResult second = compile(file("second.fx", "// as above\n" + code));
    EXPECT_FALSE(first.kept);
    EXPECT_TRUE(second.kept);
    EXPECT_TRUE(second.ok);
    EXPECT_EQ(second.binary, first.binary);
    ASSERT_TRUE(second.sm5);
    EXPECT_EQ(second.sm5->reflection.globals->members.at(0).name, first.sm5->reflection.globals->members.at(0).name);
}

TEST_F(Kept, what_a_shader_takes_of_model_3_is_found_again) {
    const fs::path source = file("three.fx", "#define FACTOR 2\n" + shader(uniqueName()));
    const MicrosoftResult first = compile(source, {}, "ps_3_0");
    const MicrosoftResult second = compile(source, {}, "ps_3_0");
    EXPECT_TRUE(second.kept);
    ASSERT_TRUE(first.sm3 && second.sm3);
    EXPECT_EQ(second.sm3->instructionSlots, first.sm3->instructionSlots);
    EXPECT_EQ(second.sm3->constants, first.sm3->constants);
}

TEST_F(Kept, a_macro_that_the_code_uses_makes_it_other_code) {
    const fs::path source = file("macro.fx", shader(uniqueName()));
    const MicrosoftResult two = compile(source, {{"FACTOR", "2"}});
    const MicrosoftResult three = compile(source, {{"FACTOR", "3"}});
    EXPECT_FALSE(three.kept);
    EXPECT_NE(two.binary, three.binary);
    EXPECT_TRUE(compile(source, {{"FACTOR", "3"}, {"UNUSED", "1"}}).kept);
}

TEST_F(Kept, another_profile_is_another_result) {
    const fs::path source = file("profile.fx", "#define FACTOR 2\n" + shader(uniqueName()));
    EXPECT_TRUE(compile(source).ok);
    EXPECT_FALSE(compile(source, {}, "ps_4_0").kept);
}

TEST_F(Kept, an_include_that_has_changed_is_compiled_again) {
    const std::string name = uniqueName();
    const fs::path source = file("outer.fx", "#include \"inner.fxh\"\n" + shader(name));
    ASSERT_TRUE(file("inner.fxh", "#define FACTOR 2\n") != source);
    const MicrosoftResult two = compile(source);
    ASSERT_TRUE(file("inner.fxh", "#define FACTOR 3\n") != source);
    const MicrosoftResult three = compile(source);
    EXPECT_FALSE(three.kept);
    EXPECT_NE(two.binary, three.binary);
}

TEST_F(Kept, a_pragma_counts_as_code) {
    const std::string name = uniqueName();
    const std::string code = "float4x4 " + name + ";\nfloat4 PS(float4 p : TEXCOORD0) : SV_Target0 { return mul(p, " + name + "); }\n";
    const MicrosoftResult columns = compile(file("columns.fx", code));
    const MicrosoftResult rows = compile(file("rows.fx", "#pragma pack_matrix(row_major)\n" + code));
    EXPECT_FALSE(rows.kept);
    EXPECT_NE(rows.binary, columns.binary);
}

TEST_F(Kept, what_was_refused_is_tried_again) {
    const fs::path source = file("refused.fx", "float4 PS() : SV_Target0 { return " + uniqueName() + "; }\n");
    for (int attempt = 0; attempt < 2; ++attempt) {
        const MicrosoftResult result = compile(source);
        EXPECT_FALSE(result.ok);
        EXPECT_FALSE(result.kept);
        EXPECT_FALSE(result.diagnostics.empty());
    }
}

TEST_F(Kept, a_warning_names_the_file_that_it_is_about) {
    const std::string name = uniqueName();
    const std::string code = "float4 " + name + ";\nfloat4 PS() : SV_Target0 { float3 x = " + name + "; return x.xyzz; }\n"; // X3206
    for (const char* file : {"one.fx", "one.fx", "other.fx"}) {
        const fs::path source = this->file(file, code);
        const MicrosoftResult result = compile(source);
        ASSERT_EQ(result.diagnostics.size(), 1U);
        EXPECT_EQ(result.diagnostics[0].at.file, source.string());
    }
    EXPECT_TRUE(compile(file("other.fx", code)).kept);
}

TEST_F(Kept, a_file_that_is_damaged_counts_as_not_there) {
    const std::string name = uniqueName();
    const fs::path source = file("damaged.fx", "#define FACTOR 2\n" + shader(name));
    const MicrosoftResult whole = compile(source);
    const fs::path stored = storedFile(name);
    ASSERT_FALSE(stored.empty());
    auto bytes = readFile(stored);
    ASSERT_TRUE(bytes);
    bytes->at(bytes->size() / 2) ^= 1;
    for (const std::string& damaged : {*bytes, bytes->substr(0, bytes->size() / 2), std::string()}) {
        ASSERT_TRUE(writeFile(stored, damaged));
        const MicrosoftResult again = compile(source);
        EXPECT_FALSE(again.kept) << damaged.size();
        EXPECT_EQ(again.binary, whole.binary);
    }
    EXPECT_TRUE(compile(source).kept) << "it was written anew";
}

} // namespace
} // namespace tegument::test
