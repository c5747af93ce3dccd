// Direct3D 9 draws lights of their own passes where shader model 3 has no slots for them in one (effects/passes/light_by_light.fxh);
// everything else has one pass, whatever the number of lights.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

using Defines = std::vector<std::pair<std::string, std::string>>;

const Defines kThreeLamps = {{"TEGUMENT_LAMPS", "3"}};
const Defines kStudio = {{"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_SURROUNDINGS", "1"}};

/// The passes that a technique has on Direct3D 9 only, and that its script plays there.
std::vector<std::string> passesOfNine(const std::string& file, const std::string& name, const Defines& defines) {
    const LoadOptions options{.defines = defines, .includeFolders = {}, .setting = {}};
    const Effect effect = loaded(loadEffect(file, options));
    const Effect nine = loaded(loadEffectOfDirect3D9(file, options));
    const Technique& one = *effect.findTechnique(name);
    const Technique& other = *nine.findTechnique(name);
    const std::string script = other.annotations.string("Script").value_or("");
    std::vector<std::string> names;
    for (const Pass& pass : other.passes)
        if (std::ranges::find(one.passes, pass.name, &Pass::name) == one.passes.end() && script.find(pass.name) != std::string::npos)
            names.push_back(pass.name);
    EXPECT_EQ(other.passes.size(), one.passes.size() + names.size());
    return names;
}

using Names = std::vector<std::string>;

TEST(LightByLight, of_one_lamp_is_one_pass_in_main) {
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", {}), Names());
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", {{"TEGUMENT_LAMPS", "1"}}), Names());
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", {{"TEGUMENT_SURROUNDINGS", "1"}}), Names());
}

TEST(LightByLight, is_a_pass_for_each_light_on_direct3d_9_alone) {
    EXPECT_EQ(passesOfNine("effects/Main.fx", "DEonLuebke", kThreeLamps), (Names{"SkinLamp1", "SkinLamp2", "SkinLamp3"}));
    EXPECT_EQ(passesOfNine("effects/Main.fx", "Lambert", kStudio),
              (Names{"LambertSurroundings", "LambertLamp1", "LambertLamp2", "LambertLamp3"}));
    EXPECT_EQ(passesOfNine("effects/Main.fx", "Gosselin", kThreeLamps),
              (Names{"GosselinLamp1", "GosselinLamp2", "GosselinLamp3", "GosselinEvenLamp1", "GosselinEvenLamp2", "GosselinEvenLamp3"}));
    EXPECT_EQ(passesOfNine("effects/Pyramid.fx", "PyramidLinked", {{"TEGUMENT_LAMPS", "1"}}), Names{"PyramidLamp1"});
    EXPECT_EQ(passesOfNine("effects/peers/Preintegrated.fx", "PreintegratedPenumbra", {{"TEGUMENT_SURROUNDINGS", "1"}}),
              Names{"PreintegratedSurroundings"});
}

TEST(LightByLight, is_not_asked_where_one_pass_has_slots_for_all) {
    EXPECT_EQ(passesOfNine("effects/peers/Separable.fx", "Separable7", kStudio), Names());
    EXPECT_EQ(passesOfNine("effects/peers/Burley.fx", "Burley20", kStudio), Names());
}

TEST(LightByLight, adds_to_the_picture_behind_the_pass_that_it_adds_to) {
    const Effect nine = loaded(loadEffectOfDirect3D9("effects/Main.fx", {.defines = kThreeLamps, .includeFolders = {}, .setting = {}}));
    const std::vector<Pass>& passes = nine.findTechnique("DEonLuebke")->passes;
    const Pass& lamp = passes.back();
    EXPECT_EQ(passes[passes.size() - 4].name, "Final");
    EXPECT_TRUE(lamp.state.depthTest);
    EXPECT_FALSE(lamp.state.depthWrite);
    EXPECT_TRUE(lamp.state.targets[0].enable);
    EXPECT_EQ(lamp.state.targets[0].src, BlendFactor::One);
    EXPECT_EQ(lamp.state.targets[0].dst, BlendFactor::One);
    EXPECT_EQ(lamp.state.depthCompare, CompareOp::Equal) << "no more than once at a pixel";
}

} // namespace
} // namespace tegument::test
