// What stands in for textures whose files are not there.
// The passes of Main.fx read what Tables 5 and 6 of the source give them, and nothing else. Names are those of
// docs/design/tables/main-passes.csv.

#include "host/run/procedures.h"
#include "host/run/program.h"
#include "host/support/file.h"
#include "tests/run/fixture.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tegument::run {
namespace {

TEST(PlainPictures, of_one_colour_are_that_colour_everywhere) {
    for (const auto& [name, colour] : {std::pair("white", glm::vec4(1)), std::pair("grey", glm::vec4(0.5F, 0.5F, 0.5F, 1)),
                                       std::pair("normal", glm::vec4(0.5F, 0.5F, 1, 1))}) {
        const Image picture = plainPicture(name);
        ASSERT_EQ(picture.channels, 4);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                for (int channel = 0; channel < 4; ++channel)
                    ASSERT_EQ(picture.at(x, y, channel), colour[channel]) << name << " at " << x << ", " << y;
    }
}

TEST(PlainPictures, a_ramp_rises_from_black_to_white_by_the_same_step) {
    const Image picture = plainPicture("ramp");
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int channel = 0; channel < 4; ++channel)
                ASSERT_NEAR(picture.at(x, y, channel), channel == 3 ? 1 : static_cast<double>(x) / (picture.width - 1), 1e-7); // a float's
}

TEST(PlainPictures, noise_is_within_its_range_in_channels_of_their_own) {
    const Image picture = plainPicture("noise");
    const auto [least, most] = std::ranges::minmax(picture.pixels);
    EXPECT_GE(least, 0);
    EXPECT_LE(most, 1);
    for (int channel = 0; channel < 4; ++channel) {
        double sum = 0, other = 0;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                sum += picture.at(x, y, channel) - 0.5;
                other += (picture.at(x, y, channel) - 0.5) * (picture.at(x, y, (channel + 1) % 4) - 0.5);
            }
        const double texels = picture.width * picture.height;
        EXPECT_LT(std::abs(sum) / texels, 4 * std::sqrt(1 / 12.0 / texels)) << "four standard deviations of the mean";
        EXPECT_LT(std::abs(other) / texels, 4.0 / 12 / std::sqrt(texels)) << "the same of the product";
    }
}

/// Sine of the elevation of a texel of +X, which looks along its middle; and the sky's colour there.
struct SkyAt {
    double up;
    glm::vec3 colour;
};
SkyAt skyAt(const Image& face, int y) {
    const int x = face.width / 2;
    const double u = (x + 0.5) / face.width * 2 - 1, v = (y + 0.5) / face.height * 2 - 1;
    return {-v / std::sqrt(1 + u * u + v * v), glm::vec3(face.at(x, y, 0), face.at(x, y, 1), face.at(x, y, 2))};
}

/// Air near the horizon is thick: the colour follows the root of the elevation's sine, so that half of the change is done at 1/4.
TEST(PlainPictures, a_sky_changes_fastest_over_its_bright_horizon_and_the_ground_is_dark) {
    const std::vector<Image> faces = plainCube("sky");
    ASSERT_EQ(faces.size(), 6U);
    const int half = faces[0].height / 2;
    const SkyAt low = skyAt(faces[0], half - 1), high = skyAt(faces[0], 0);
    for (int y = 1; y < half - 1; ++y) {
        const SkyAt sky = skyAt(faces[0], y);
        const double share = (std::sqrt(sky.up) - std::sqrt(low.up)) / (std::sqrt(high.up) - std::sqrt(low.up));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR((sky.colour[channel] - low.colour[channel]) / (high.colour[channel] - low.colour[channel]), share, 1e-4) << y;
    }
    EXPECT_GT(faces[2].at(half, half, 2), faces[2].at(half, half, 0)) << "blue above";
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_GT(low.colour[channel], faces[2].at(half, half, channel)) << "the horizon is the brightest";
        EXPECT_LT(faces[3].at(half, half, channel), 0.3F) << "below it is dark";
    }
}

TEST(PlainPictures, a_cube_of_normals_holds_each_direction) {
    const std::vector<Image> faces = plainCube("normals");
    // The axis of each face, and where its u and v point (Direct3D: the cube is seen from within, v goes down).
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const glm::dvec3 axes[6][3] = {{x, -z, -y}, {-x, z, -y}, {y, x, z}, {-y, x, -z}, {z, x, -y}, {-z, -x, -y}};
    for (std::size_t face = 0; face < 6; ++face)
        for (const int row : {0, 20, 63})
            for (const int column : {0, 41, 63}) {
                const double side = faces[face].width, u = (column + 0.5) / side * 2 - 1, v = (row + 0.5) / side * 2 - 1;
                const glm::dvec3 way = glm::normalize(axes[face][0] + u * axes[face][1] + v * axes[face][2]);
                for (int channel = 0; channel < 3; ++channel)
                    EXPECT_NEAR(faces[face].at(column, row, channel), way[channel] / 2 + 0.5, 1e-6) << face << ' ' << row << ' ' << column;
            }
}

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
    const auto effect = loadEffect("effects/Main.fx", {.defines = {{"TEGUMENT_SETTING", setting}}});
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
    for (std::string cell; std::getline(row, cell, ',');)
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

/// The rows `technique,number,pass,draws,parameters,textures,writes` of one technique.
std::map<std::string, ExpectedPass> documentedPasses(const std::string& technique) {
    std::map<std::string, ExpectedPass> rows;
    std::istringstream lines(*readFile("docs/design/tables/main-passes.csv"));
    for (std::string line; std::getline(lines, line);) {
        const std::vector<std::string> cells = cellsOf(line);
        if (cells.size() == 7 && cells[0] == technique) rows[cells[2]] = {cells[2], namesOf(cells[4]), namesOf(cells[5])};
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
