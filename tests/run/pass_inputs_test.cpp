// The passes of Main.fx read what Table 6 of the source gives them, and nothing else. Names are those of docs/passes.md.

#include "host/run/program.h"
#include "host/support/file.h"
#include "tests/run/fixture.h"

#include <algorithm>
#include <sstream>

namespace tegument::run {
namespace {

using Names = std::set<std::string>;

struct ExpectedPass {
    std::string name;
    Names parameters;
    Names textures;
};

const Names kBlurNumbers = {"gGaussianSigma"};

ExpectedPass blur(const std::string& name, const std::string& source) {
    return {name, kBlurNumbers, {"gStretchMap", source}};
}

std::vector<ExpectedPass> expectedPasses() {
    return {
        {"TSM", {"gWorld", "gLightViewProjection", "gLightPosition"}, {}},
        {"PrePass1", {}, {"gSkinMap"}},
        {"PrePass2", {"gWorld", "gWorldInverseTranspose", "gViewProjection", "gCameraPosition"}, {}},
        {"Irradiance",
         {"gWorld", "gWorldInverseTranspose", "gLightViewProjection", "gLightPosition", "gLightColor", "gLightFov", "gLightNear",
          "gLightFar", "gShadowTolerance", "gMix", "gRoughness", "gSpecularIntensity"},
         {"gSkinMap", "gNormalMap", "gEnergyAttenuationMap", "gTsmMap"}},
        blur("ConvolutionU1", "gIrradianceMap"),
        blur("ConvolutionUV1", "gIrradianceUMap"),
        blur("ConvolutionU2", "gIrradiance2Map"),
        blur("ConvolutionUV2", "gIrradianceUMap"),
        blur("ConvolutionU3", "gIrradiance3Map"),
        blur("ConvolutionUV3", "gIrradianceUMap"),
        blur("ConvolutionU4", "gIrradiance4Map"),
        blur("ConvolutionUV4", "gIrradianceUMap"),
        blur("ConvolutionU5", "gIrradiance5Map"),
        blur("ConvolutionUV5", "gIrradianceUMap"),
        {"Final",
         {"gWorld", "gWorldInverseTranspose", "gViewProjection", "gLightViewProjection", "gLightPosition", "gLightColor", "gLightFov",
          "gLightNear", "gLightFar", "gCameraPosition", "gShadowTolerance", "gMix", "gRoughness", "gSpecularIntensity", "gGaussianWeight",
          "gPlainRoughness", "gPlainIntensity", "gTransmission"},
         {"gSkinMap", "gNormalMap", "gEnergyAttenuationMap", "gTsmMap", "gIrradianceMap", "gIrradiance2Map", "gIrradiance3Map",
          "gIrradiance4Map", "gIrradiance5Map", "gIrradiance6Map"}},
    };
}

/// What each pass of DEonLuebke reads in one setting.
Result<std::map<std::string, ExpectedPass>> readPasses(const std::string& setting) {
    const auto effect = loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_SETTING", setting}}, .includeFolders = {}});
    if (!effect) return effect.error();
    std::map<std::string, ExpectedPass> found;
    for (const Pass& pass : effect->findTechnique("DEonLuebke")->passes) {
        const auto program = compilePass(*effect, pass, defaultCompiler());
        if (!program) return program.error();
        found[pass.name] = {pass.name, program->numbers, program->use.sampled};
    }
    return found;
}

Names beyond(const Names& actual, const Names& allowed) {
    Names result;
    std::ranges::set_difference(actual, allowed, std::inserter(result, result.end()));
    return result;
}

std::string list(const Names& names) {
    std::string text;
    for (const std::string& name : names)
        text += name + " ";
    return text;
}

TEST(PassInputs, no_setting_reads_more_than_the_table) {
    for (const char* setting : {"0", "1", "2"}) {
        const auto found = readPasses(setting);
        ASSERT_TRUE(test::succeeded(found));
        for (const ExpectedPass& expected : expectedPasses()) {
            ASSERT_TRUE(found->contains(expected.name)) << expected.name;
            const ExpectedPass& actual = found->at(expected.name);
            EXPECT_EQ(list(beyond(actual.parameters, expected.parameters)), "") << "setting " << setting << ", pass " << expected.name;
            EXPECT_EQ(list(beyond(actual.textures, expected.textures)), "") << "setting " << setting << ", pass " << expected.name;
        }
    }
}

TEST(PassInputs, every_input_of_the_table_is_read_in_some_setting) {
    std::map<std::string, ExpectedPass> read;
    for (const char* setting : {"0", "1", "2"}) {
        const auto found = readPasses(setting);
        ASSERT_TRUE(test::succeeded(found));
        for (const auto& [name, pass] : *found) {
            read[name].parameters.insert(pass.parameters.begin(), pass.parameters.end());
            read[name].textures.insert(pass.textures.begin(), pass.textures.end());
        }
    }
    for (const ExpectedPass& expected : expectedPasses()) {
        EXPECT_EQ(list(beyond(expected.parameters, read[expected.name].parameters)), "") << expected.name;
        EXPECT_EQ(list(beyond(expected.textures, read[expected.name].textures)), "") << expected.name;
    }
}

TEST(PassInputs, the_technique_has_the_fifteen_passes_in_the_order_of_the_table) {
    const auto effect = loadEffect("effects/Main.fx");
    ASSERT_TRUE(test::succeeded(effect));
    const auto expected = expectedPasses();
    const auto& passes = effect->findTechnique("DEonLuebke")->passes;
    ASSERT_EQ(passes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(passes[i].name, expected[i].name) << "pass " << i + 1;
}

/// Cells 2, 4 and 5 of the rows `| n | pass | draws | parameters | textures | writes |`.
std::map<std::string, ExpectedPass> documentedPasses() {
    std::map<std::string, ExpectedPass> rows;
    std::istringstream lines(*readFile("docs/passes.md"));
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '|');)
            cells.push_back(cell);
        if (cells.size() < 7) continue;
        ExpectedPass pass;
        std::istringstream(cells[2]) >> pass.name;
        std::istringstream parameters(cells[4]);
        std::istringstream textures(cells[5]);
        for (std::string name; parameters >> name;)
            if (name != "-") pass.parameters.insert(name);
        for (std::string name; textures >> name;)
            if (name != "-") pass.textures.insert(name);
        rows[pass.name] = pass;
    }
    return rows;
}

TEST(PassInputs, the_documentation_says_the_same) {
    const auto documented = documentedPasses();
    for (const ExpectedPass& expected : expectedPasses()) {
        ASSERT_TRUE(documented.contains(expected.name)) << expected.name;
        EXPECT_EQ(list(documented.at(expected.name).parameters), list(expected.parameters)) << expected.name;
        EXPECT_EQ(list(documented.at(expected.name).textures), list(expected.textures)) << expected.name;
    }
}

} // namespace
} // namespace tegument::run
