// Both compilers see the same interface in every entry point of every effect: parameters, types, offsets, resources, semantics.

#include "host/effect/model.h"
#include "host/spirv/compile.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace tegument {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> effectFiles() {
    std::vector<std::string> files;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator("effects", code))
        if (entry.path().extension() == ".fx") files.push_back(entry.path().string());
    std::ranges::sort(files);
    return files;
}

std::set<std::pair<std::string, Stage>> entryPoints(const Effect& effect) {
    std::set<std::pair<std::string, Stage>> entries;
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes) {
            if (pass.vertexShader) entries.emplace(pass.vertexShader->entry, Stage::Vertex);
            if (pass.pixelShader) entries.emplace(pass.pixelShader->entry, Stage::Pixel);
            if (pass.computeShader) entries.emplace(pass.computeShader->entry, Stage::Compute);
        }
    return entries;
}

void compare(const Effect& effect, const std::string& entry, Stage stage) {
    SCOPED_TRACE(entry);
    const ShaderRequest request{
        .code = effect.code, .file = effect.file.string(), .entry = entry, .stage = stage, .defines = {}, .includeFolders = {}};
    const auto dxc = compileShader(request, Compiler::Dxc);
    const auto glslang = compileShader(request, Compiler::Glslang);
    ASSERT_TRUE(dxc) << format(dxc.error());
    ASSERT_TRUE(glslang) << format(glslang.error());
    for (const std::string& difference : compareReflections(dxc->reflection, glslang->reflection))
        ADD_FAILURE() << difference;
}

TEST(EffectFiles, there_are_effects_to_look_at) {
    EXPECT_FALSE(effectFiles().empty()) << "run from the repository's root";
}

class EffectLayouts : public testing::TestWithParam<std::string> {};

TEST_P(EffectLayouts, are_the_same_from_both_compilers_in_every_setting) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    for (const char* setting : {"0", "1", "2"}) {
        SCOPED_TRACE(setting);
        const auto effect = loadEffect(GetParam(), {.defines = {{"TEGUMENT_SETTING", setting}}, .includeFolders = {}});
        ASSERT_TRUE(effect) << format(effect.error());
        for (const auto& [entry, stage] : entryPoints(*effect))
            compare(*effect, entry, stage);
    }
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectLayouts, testing::ValuesIn(effectFiles()),
                         [](const auto& entry) { return fs::path(entry.param).stem().string(); });

} // namespace
} // namespace tegument
