// The presets that come along.
#include "host/effect/model.h"
#include "host/scene/presets.h"

#include <gtest/gtest.h>

TEST(OwnPresets, lie_within_the_ranges_and_differ_from_the_defaults) {
    for (const char* name : {"effects/Main.fx", "effects/Pyramid.fx", "effects/Fur.fx", "effects/FurRoots.fx"}) {
        const auto effect = tegument::loadEffect(name);
        const auto presets = tegument::loadPresets(name);
        ASSERT_TRUE(effect && presets) << name;
        EXPECT_EQ(presets->size(), std::string(name).find("Fur") == std::string::npos ? 9U : 3U) << name << ": three looks, and six skins";
        for (const tegument::Preset& preset : *presets) {
            EXPECT_FALSE(preset.comment.empty()) << preset.name;
            bool differs = false;
            for (const auto& [parameter, value] : preset.parameters) {
                const tegument::Parameter* found = effect->findParameter(parameter);
                ASSERT_TRUE(found) << name << " " << preset.name << " " << parameter;
                const auto least = found->annotations.numbers("UIMin");
                const auto most = found->annotations.numbers("UIMax");
                for (const double number : value) {
                    EXPECT_TRUE(!least || number >= least->front()) << preset.name << " " << parameter;
                    EXPECT_TRUE(!most || number <= most->front()) << preset.name << " " << parameter;
                }
                const auto* usual = found->defaultValue ? std::get_if<std::vector<double>>(&*found->defaultValue) : nullptr;
                differs = differs || !usual || *usual != value;
            }
            EXPECT_TRUE(differs) << preset.name;
        }
    }
}
