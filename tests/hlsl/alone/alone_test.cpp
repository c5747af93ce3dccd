// Every file of hlsl/ compiles alone: a client beside it includes it, and nothing else.

#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "tests/spirv/missing.h"
#include "tools/direct3d/microsoft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> headers(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".fxh") found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
}

/// Of a pixel shader beside `header`. Compilers read every function, whether it is called or not.
std::string client(const fs::path& header) {
    return "#include \"" + header.filename().string() + "\"\nfloat4 main(float2 uv : TEXCOORD0) : SV_Target0\n{\n    return uv.xyxy;\n}\n";
}

class Alone : public testing::TestWithParam<Compiler> {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }
};

TEST_P(Alone, every_header_compiles_to_spirv_in_every_setting) {
    const std::vector<fs::path> all = headers("hlsl");
    ASSERT_GT(all.size(), 30U) << "the files were not found";
    for (const fs::path& header : all)
        for (const char* setting : {"0", "1", "2"}) {
            const auto shader = compileShader({.code = client(header),
                                               .file = (header.parent_path() / "client.hlsl").string(),
                                               .entry = "main",
                                               .stage = ShaderStage::Pixel,
                                               .defines = {{"TEGUMENT_SETTING", setting}}},
                                              GetParam());
            EXPECT_TRUE(shader) << header << " in setting " << setting << "\n" << format(shader.error());
        }
}

TEST_P(Alone, a_header_that_leaves_out_what_it_needs_is_found) {
    const auto shader = compileShader({.code = "float3 f(float3 v) { return tgSafeNormalize(v); }\n" + client("halves.fxh"),
                                       .file = "hlsl/surface/client.hlsl",
                                       .entry = "main",
                                       .stage = ShaderStage::Pixel},
                                      GetParam());
    EXPECT_FALSE(shader);
}

INSTANTIATE_TEST_SUITE_P(Compilers, Alone, testing::Values(Compiler::Dxc, Compiler::Glslang),
                         [](const auto& tested) { return tested.param == Compiler::Dxc ? "Dxc" : "Glslang"; });

/// Microsoft's own include handler: a copy, because its clients must be files.
class AloneMicrosoft : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
        folder_ = fs::temp_directory_path() / ("tegument-alone-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        fs::copy("hlsl", folder_ / "hlsl", fs::copy_options::recursive); // groups name it in their paths
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }
    fs::path folder_;
};

TEST_F(AloneMicrosoft, every_header_compiles_for_shader_models_3_and_5) {
    std::vector<MicrosoftJob> jobs;
    for (const fs::path& header : headers(folder_ / "hlsl")) {
        const fs::path source = header.parent_path() / (header.stem().string() + "_client.hlsl");
        ASSERT_TRUE(writeFile(source, client(header)));
        for (const char* setting : {"0", "2"}) {
            jobs.push_back({.profile = "ps_3_0", .entry = "main", .source = source, .defines = {{"TEGUMENT_SETTING", setting}}});
            jobs.push_back(
                {.profile = "ps_5_0", .entry = "main", .source = source, .defines = {{"TEGUMENT_SETTING", setting}, {"FX_ENTRY", "1"}}});
        }
    }
    ASSERT_GT(jobs.size(), 120U) << "the files were not found";
    const auto results = compileWithMicrosoft(jobs);
    ASSERT_TRUE(results) << format(results.error());
    for (std::size_t i = 0; i < jobs.size(); ++i)
        EXPECT_TRUE((*results)[i].ok) << jobs[i].profile << " " << jobs[i].source.filename() << "\n"
                                      << ((*results)[i].diagnostics.empty() ? "" : format((*results)[i].diagnostics.front()));
}

} // namespace
} // namespace tegument::test
