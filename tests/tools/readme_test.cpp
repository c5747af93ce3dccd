// The snippets of README.md do what they say.

#include "host/effect/model.h"
#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <unistd.h>

using namespace tegument;
namespace fs = std::filesystem;

namespace {

/// The code blocks of one language, in order.
std::vector<std::string> snippets(const std::string& language) {
    const std::string page = *readFile("README.md");
    const std::string fence = "```" + language + "\n";
    std::vector<std::string> found;
    for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
        const std::size_t from = at + fence.size();
        found.push_back(page.substr(from, page.find("```", from) - from));
    }
    return found;
}

/// A user's project: a folder of shaders beside a copy of hlsl/, and nothing else of this repository.
class Consumer : public testing::TestWithParam<Compiler> {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
        folder_ = fs::temp_directory_path() / ("tegument-consumer-" + std::to_string(::getpid()));
        fs::create_directories(folder_ / "mine");
        fs::copy("hlsl", folder_ / "hlsl", fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }
    fs::path folder_;
};

} // namespace

TEST_P(Consumer, readme_shader_compiles_beside_a_copy_of_hlsl_alone) {
    const auto code = snippets("hlsl");
    ASSERT_EQ(code.size(), 1U);
    const fs::path file = folder_ / "mine" / "shader.hlsl";
    const auto shader = compileShader(
        {.code = code[0], .file = file.string(), .entry = "main", .stage = ShaderStage::Pixel, .includeFolders = {folder_ / "mine"}},
        GetParam());
    ASSERT_TRUE(shader) << format(shader.error());
    std::set<std::string> inputs;
    for (const StageVariable& input : shader->reflection.inputs)
        inputs.insert(input.semantic);
    EXPECT_EQ(inputs, (std::set<std::string>{"NORMAL0", "TEXCOORD0", "TEXCOORD1"}));
}

INSTANTIATE_TEST_SUITE_P(Readme, Consumer, testing::Values(Compiler::Dxc, Compiler::Glslang),
                         [](const auto& parameter) { return parameter.param == Compiler::Dxc ? "dxc" : "glslang"; });

TEST(Readme, every_parameter_set_in_the_snippets_is_one_of_the_effect) {
    const auto effect = loadEffect("effects/OriginalTexture.fx");
    ASSERT_TRUE(effect) << format(effect.error());
    const auto blocks = snippets("cpp");
    ASSERT_EQ(blocks.size(), 2U);
    for (const std::string& block : blocks) {
        const std::regex quotedGlobal("\"(g[A-Z]\\w*)\"");
        std::sregex_iterator name(block.begin(), block.end(), quotedGlobal);
        ASSERT_NE(name, std::sregex_iterator()) << block;
        for (; name != std::sregex_iterator(); ++name)
            EXPECT_TRUE(effect->findParameter((*name)[1].str())) << (*name)[1].str();
    }
}
