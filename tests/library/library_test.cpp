// tegument.hlsl compiles for every target from a client of ten lines.

#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "tests/library/dxil.h"
#include "tests/spirv/missing.h"
#include "tools/direct3d/microsoft.h"
#include "tools/emit/flatten.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// A folder with tegument.hlsl and the clients, and nothing else of this repository.
class Library : public testing::Test {
protected:
    void SetUp() override {
        const auto text = flattenLibrary("hlsl/tegument.fxh", {.read = readFile});
        ASSERT_TRUE(text) << format(text.error());
        text_ = *text;
        folder_ = fs::temp_directory_path() / ("tegument-library-" + std::to_string(::getpid()));
        fs::copy("tests/library/clients", folder_);
        ASSERT_TRUE(writeFile(folder_ / "tegument.hlsl", text_));
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }
    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] fs::path client(const std::string& name) const { return folder_ / name; }

private:
    std::string text_;
    fs::path folder_;
};

TEST_F(Library, compiles_for_direct3d_9_10_and_11_by_microsofts_compiler) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const auto job = [&](const char* profile, const char* name) {
        return MicrosoftJob{.profile = profile, .entry = "main", .source = client(name)};
    };
    const std::vector<MicrosoftJob> jobs = {job("ps_3_0", "model3.hlsl"), job("ps_4_0", "model4.hlsl"), job("ps_5_0", "model4.hlsl")};
    const auto results = compileWithMicrosoft(jobs);
    ASSERT_TRUE(results) << format(results.error());
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const MicrosoftResult& result = (*results)[i];
        EXPECT_TRUE(result.ok) << jobs[i].profile;
        for (const Diagnostic& diagnostic : result.diagnostics) // warnings, too
            ADD_FAILURE() << jobs[i].profile << "\n" << format(diagnostic);
    }
}

TEST_F(Library, compiles_to_dxil_for_shader_model_6) {
    if (const std::string missing = dxilMissing(); !missing.empty()) GTEST_SKIP() << missing;
    EXPECT_EQ(compileDxil(client("model4.hlsl"), "ps_6_0"), "");
    ASSERT_TRUE(writeFile(client("wrong.hlsl"), "#include \"tegument.hlsl\"\nfloat4 main() : SV_Target { return noSuchFunction(1.0); }\n"));
    EXPECT_NE(compileDxil(client("wrong.hlsl"), "ps_6_0"), "") << "an error goes by unseen";
}

class LibrarySpirv : public Library, public testing::WithParamInterface<Compiler> {};

TEST_P(LibrarySpirv, compiles) {
    if (const std::string missing = compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    const auto code = readFile(client("model4.hlsl"));
    ASSERT_TRUE(code);
    const auto shader =
        compileShader({.code = *code, .file = client("model4.hlsl").string(), .entry = "main", .stage = ShaderStage::Pixel}, GetParam());
    ASSERT_TRUE(shader) << format(shader.error());
    std::set<std::string> resources;
    for (const Resource& resource : shader->reflection.resources)
        resources.insert(resource.name);
    EXPECT_EQ(resources, (std::set<std::string>{"depths", "nearest"})) << "the library declares none of its own";
    EXPECT_FALSE(shader->reflection.globals) << "nor a parameter";
}

INSTANTIATE_TEST_SUITE_P(Compilers, LibrarySpirv, testing::Values(Compiler::Dxc, Compiler::Glslang),
                         [](const auto& tested) { return tested.param == Compiler::Dxc ? "Dxc" : "Glslang"; });

TEST_F(Library, holds_functions_only_and_redefines_no_keyword) {
    EXPECT_TRUE(text().starts_with("// Tegument")) << "its manual comes first";
    const std::regex effect(R"(\n(?:technique|pass|Texture2D|SamplerState|sampler2D|cbuffer|uniform)\b|<\s*string\b|\bFX_\w+|\n#include)");
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text(), found, effect)) << found.str();
    const std::regex keyword(R"(\n#define (?:tex\w*|technique\w*|pass|sampler\w*|compile|Texture\w*)\b)");
    EXPECT_FALSE(std::regex_search(text(), found, keyword)) << found.str();
}

TEST_F(Library, leaves_the_printed_forms_out) {
    EXPECT_EQ(text().find("kTgDepthInMillimetres"), std::string::npos);
    EXPECT_EQ(text().find("begin printed/"), std::string::npos);
    EXPECT_EQ(text().find("_FXH"), std::string::npos) << "a guard of a file that is merged";
}

} // namespace
} // namespace tegument::test
