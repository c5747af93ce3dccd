// The passes of Main.fx read what Tables 5 and 6 of the source give them, and nothing else. Names are those of docs/design/passes.md.

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

struct ExpectedTechnique {
    std::string name;
    std::vector<ExpectedPass> passes;
};

const Names kLightOnMesh = {"gWorld",  "gWorldInverseTranspose", "gLightViewProjection", "gLightPosition", "gLightColor",
                            "gUnitMm", "gShadowTolerance"};

Names with(Names names, const Names& more) {
    names.insert(more.begin(), more.end());
    return names;
}

ExpectedPass convolution(const std::string& name, const std::string& source) {
    return {name, {"gGaussianWeight", "gLightViewProjection", "gLightNear", "gLightFar", "gUnitMm"}, {"gStretchMap", source}};
}

const ExpectedPass kPrePass1{"PrePass1", {}, {"gSkinMap"}};
const ExpectedPass kPrePass2{"PrePass2", {"gWorld", "gWorldInverseTranspose", "gViewProjection", "gCameraPosition"}, {}};

ExpectedTechnique deonLuebke() {
    return {
        "DEonLuebke",
        {{"TSM", {"gWorld", "gLightViewProjection", "gLightPosition", "gUnitMm"}, {}},
         kPrePass1,
         kPrePass2,
         {"Irradiance",
          with(kLightOnMesh, {"gLightNear", "gLightFar", "gMix", "gRoughness", "gSpecularIntensity"}),
          {"gSkinMap", "gNormalMap", "gEnergyAttenuationMap", "gTsmMap"}},
         convolution("ConvolutionU1", "gIrradianceMap"),
         convolution("ConvolutionUV1", "gIrradianceUMap"),
         convolution("ConvolutionU2", "gIrradiance2Map"),
         convolution("ConvolutionUV2", "gIrradianceUMap"),
         convolution("ConvolutionU3", "gIrradiance3Map"),
         convolution("ConvolutionUV3", "gIrradianceUMap"),
         convolution("ConvolutionU4", "gIrradiance4Map"),
         convolution("ConvolutionUV4", "gIrradianceUMap"),
         convolution("ConvolutionU5", "gIrradiance5Map"),
         convolution("ConvolutionUV5", "gIrradianceUMap"),
         {"Final",
          with(kLightOnMesh, {"gViewProjection", "gLightNear", "gLightFar", "gCameraPosition", "gMix", "gRoughness", "gSpecularIntensity",
                              "gGaussianWeight", "gPlainRoughness", "gPlainIntensity", "gTransmission", "gFlesh"}),
          {"gSkinMap", "gNormalMap", "gEnergyAttenuationMap", "gTsmMap", "gIrradianceMap", "gIrradiance2Map", "gIrradiance3Map",
           "gIrradiance4Map", "gIrradiance5Map", "gIrradiance6Map"}}}};
}

ExpectedPass laterBlur(const std::string& name, const std::string& source) {
    return {name, {"gBlurSize", "gBlurTurn"}, {"gStretchMap", source}};
}

ExpectedPass gosselinFinal(const std::string& name, const std::string& source) {
    return {name,
            with(kLightOnMesh,
                 {"gViewProjection", "gCameraPosition", "gRoughness", "gSpecularIntensity", "gPlainRoughness", "gPlainIntensity"}),
            {"gSkinMap", "gNormalMap", "gShadowMap", source}};
}

/// The eight passes of the table, then those for other numbers of blurs.
ExpectedTechnique gosselin() {
    return {"Gosselin",
            {{"ShadowMap", {"gWorld", "gLightViewProjection", "gLightPosition", "gUnitMm"}, {}},
             kPrePass1,
             kPrePass2,
             {"Irradiance", kLightOnMesh, {"gNormalMap", "gShadowMap", "gKernelSizeMap"}},
             {"Blur1", {"gBlurSize"}, {"gStretchMap", "gIrradianceMap"}},
             laterBlur("Blur2", "gBlurOddMap"),
             laterBlur("Blur3", "gBlurEvenMap"),
             gosselinFinal("Final", "gBlurOddMap"),
             laterBlur("Blur4", "gBlurOddMap"),
             laterBlur("Blur5", "gBlurEvenMap"),
             laterBlur("Blur6", "gBlurOddMap"),
             gosselinFinal("FinalEven", "gBlurEvenMap")}};
}

/// What each pass of a technique reads in one setting.
Result<std::map<std::string, ExpectedPass>> readPasses(const std::string& technique, const std::string& setting) {
    const auto effect = loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_SETTING", setting}}, .includeFolders = {}});
    if (!effect) return effect.error();
    std::map<std::string, ExpectedPass> found;
    for (const Pass& pass : effect->findTechnique(technique)->passes) {
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

class PassInputs : public testing::TestWithParam<ExpectedTechnique> {};

TEST_P(PassInputs, no_setting_reads_more_than_the_table) {
    for (const char* setting : {"0", "1", "2"}) {
        const auto found = readPasses(GetParam().name, setting);
        ASSERT_TRUE(test::succeeded(found));
        for (const ExpectedPass& expected : GetParam().passes) {
            ASSERT_TRUE(found->contains(expected.name)) << expected.name;
            const ExpectedPass& actual = found->at(expected.name);
            EXPECT_EQ(list(beyond(actual.parameters, expected.parameters)), "") << "setting " << setting << ", pass " << expected.name;
            EXPECT_EQ(list(beyond(actual.textures, expected.textures)), "") << "setting " << setting << ", pass " << expected.name;
        }
    }
}

TEST_P(PassInputs, every_input_of_the_table_is_read_in_some_setting) {
    std::map<std::string, ExpectedPass> read;
    for (const char* setting : {"0", "1", "2"}) {
        const auto found = readPasses(GetParam().name, setting);
        ASSERT_TRUE(test::succeeded(found));
        for (const auto& [name, pass] : *found) {
            read[name].parameters.insert(pass.parameters.begin(), pass.parameters.end());
            read[name].textures.insert(pass.textures.begin(), pass.textures.end());
        }
    }
    for (const ExpectedPass& expected : GetParam().passes) {
        EXPECT_EQ(list(beyond(expected.parameters, read[expected.name].parameters)), "") << expected.name;
        EXPECT_EQ(list(beyond(expected.textures, read[expected.name].textures)), "") << expected.name;
    }
}

TEST_P(PassInputs, the_passes_stand_in_the_order_of_the_table) {
    const auto effect = loadEffect("effects/Main.fx");
    ASSERT_TRUE(test::succeeded(effect));
    const auto& passes = effect->findTechnique(GetParam().name)->passes;
    ASSERT_EQ(passes.size(), GetParam().passes.size());
    for (std::size_t i = 0; i < passes.size(); ++i)
        EXPECT_EQ(passes[i].name, GetParam().passes[i].name) << "pass " << i + 1;
}

/// Seed table 5 gives Gosselin's Final no shadow map, its blurs no Stretch, its Irradiance no colour map.
TEST(GosselinInputs, setting_seed_reads_what_table_5_names_and_no_more) {
    const auto found = readPasses("Gosselin", "0");
    ASSERT_TRUE(test::succeeded(found));
    EXPECT_EQ(found->at("Irradiance").textures, (Names{"gNormalMap", "gShadowMap", "gKernelSizeMap"}));
    EXPECT_EQ(found->at("Blur1").textures, (Names{"gIrradianceMap"}));
    EXPECT_EQ(found->at("Final").textures, (Names{"gSkinMap", "gNormalMap", "gBlurOddMap"}));
}

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');)
        cells.push_back(cell);
    return cells;
}

Names namesOf(const std::string& cell) {
    Names names;
    std::istringstream words(cell);
    for (std::string name; words >> name;)
        if (name != "-") names.insert(name);
    return names;
}

/// Cells 2, 4 and 5 of the rows `| n | pass | draws | parameters | textures | writes |` below the heading `## technique`.
std::map<std::string, ExpectedPass> documentedPasses(const std::string& technique) {
    std::map<std::string, ExpectedPass> rows;
    std::istringstream lines(*readFile("docs/design/passes.md"));
    bool here = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## ")) here = line == "## " + technique;
        const std::vector<std::string> cells = cellsOf(line);
        if (!here || cells.size() < 7) continue;
        ExpectedPass pass{{}, namesOf(cells[4]), namesOf(cells[5])};
        std::istringstream(cells[2]) >> pass.name;
        rows[pass.name] = pass;
    }
    return rows;
}

TEST_P(PassInputs, the_documentation_says_the_same) {
    const auto documented = documentedPasses(GetParam().name);
    for (const ExpectedPass& expected : GetParam().passes) {
        ASSERT_TRUE(documented.contains(expected.name)) << expected.name;
        EXPECT_EQ(list(documented.at(expected.name).parameters), list(expected.parameters)) << expected.name;
        EXPECT_EQ(list(documented.at(expected.name).textures), list(expected.textures)) << expected.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Main, PassInputs, testing::Values(deonLuebke(), gosselin()),
                         [](const auto& technique) { return technique.param.name; });

} // namespace
} // namespace tegument::run
