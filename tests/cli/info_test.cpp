// `tegument info` is to be read: in 100 columns, what can be turned first.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace tegument::test {
namespace {

std::string info(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"info"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = tegument(arguments);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
}

/// The first line that holds the word.
std::string lineOf(const std::string& text, const std::string& word) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        if (line.find(word) != std::string::npos) return line;
    return {};
}

TEST(Info, of_every_effect_fits_into_100_columns) {
    int effects = 0;
    for (const char* folder : {"effects", "effects/peers"})
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".fx") continue;
            ++effects;
            for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--all"}}) {
                std::vector<std::string> arguments = {entry.path().string()};
                arguments.insert(arguments.end(), more.begin(), more.end());
                std::istringstream in(info(arguments));
                for (std::string line; std::getline(in, line);)
                    EXPECT_LE(line.size(), 100U) << line;
            }
        }
    EXPECT_GE(effects, 16);
}

TEST(Info, shows_what_can_be_turned_with_range_default_and_unit) {
    const std::string text = info({"Main"});
    EXPECT_LT(text.find("gRoughness"), text.find("gSkinMap"));
    const std::string line = lineOf(text, "gRoughness");
    for (const char* word : {"float", "0.05..1", "0.3", "rms slope"})
        EXPECT_NE(line.find(word), std::string::npos) << line;
    EXPECT_NE(lineOf(text, "gShadowTolerance").find("mm"), std::string::npos) << text;
}

TEST(Info, keeps_internals_behind_all) {
    const std::string text = info({"Main"});
    for (const char* name : {"gWorldInverseTranspose", "gClearEmpty", "gTsmDepthMap", "IrradiancePS"}) {
        EXPECT_EQ(text.find(name), std::string::npos) << name;
        EXPECT_NE(info({"Main", "--all"}).find(name), std::string::npos) << name;
    }
    EXPECT_NE(text.find("--all"), std::string::npos) << "and says how to see them";
}

TEST(Info, counts_passes_as_the_documents_do) {
    const std::string text = info({"Main"});
    EXPECT_EQ(lineOf(text, "technique DEonLuebke:").find("technique DEonLuebke: 15 passes"), 0U) << text;
    EXPECT_EQ(lineOf(text, "technique Gosselin:").find("technique Gosselin: 8 passes"), 0U) << text;
    EXPECT_NE(lineOf(text, "technique Gosselin:").find("4 more for other values"), std::string::npos) << text;
    EXPECT_EQ(lineOf(info({"OriginalTexture"}), "technique"), "technique OriginalTexture: 1 pass");
}

} // namespace
} // namespace tegument::test
