// Default values of the effects against the sources that print them, and against the table that says what users meet.

#include "host/effect/model.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace tegument;

namespace {

std::vector<double> defaultOf(const char* name, const char* setting, const char* file = "effects/Main.fx") {
    const auto effect = loadEffect(file, {.defines = {{"TEGUMENT_SETTING", setting}}, .includeFolders = {}});
    if (!effect) {
        ADD_FAILURE() << format(effect.error());
        return {};
    }
    const Parameter* parameter = effect->findParameter(name);
    const auto* numbers = parameter && parameter->defaultValue ? std::get_if<std::vector<double>>(&*parameter->defaultValue) : nullptr;
    EXPECT_TRUE(numbers) << name;
    return numbers ? *numbers : std::vector<double>();
}

/// d'Eon, Luebke, Enderton 2007, and GPU Gems 3, chapter 14, figure 14-13: weights of red, green and blue, variance in mm^2.
constexpr std::array<std::array<double, 4>, 6> kPrintedProfile = {{{.233, .455, .649, .0064},
                                                                   {.100, .336, .344, .0484},
                                                                   {.118, .198, 0, .187},
                                                                   {.113, .007, .007, .567},
                                                                   {.358, .004, 0, 1.99},
                                                                   {.078, 0, 0, 7.41}}};

/// What a parameter is called and has before anybody turns it: with its effects, a row of docs/design/tables/defaults.md.
using Defaults = std::map<std::pair<std::string, std::string>, std::set<std::string>>;

void addDefaults(const std::filesystem::path& file, Defaults& defaults) {
    const std::vector<std::pair<std::string, std::string>> defines = {
        {"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_LOBES", "1"}, {"TEGUMENT_MOTION", "1"}, {"TEGUMENT_FUR_POSE", "1"}};
    const auto effect = loadEffect(file, {.defines = defines, .includeFolders = {}});
    ASSERT_TRUE(effect) << format(effect.error());
    const auto note = [&](const Parameter& parameter, const char* what, const std::vector<double>& numbers) {
        defaults[{parameter.name, fmt::format("{}{:.7g}", what, fmt::join(numbers, " "))}].insert(file.stem().string());
    };
    for (const Parameter& parameter : effect->parameters) {
        if (const auto texel = parameter.annotations.numbers("Fallback")) note(parameter, "texel ", *texel);
        if (parameter.annotations.find("UIName") && parameter.defaultValue)
            if (const auto* numbers = std::get_if<std::vector<double>>(&*parameter.defaultValue)) note(parameter, "", *numbers);
    }
}

std::set<std::string> rowsOf(const Defaults& defaults) {
    std::set<std::string> rows;
    for (const auto& [parameter, effects] : defaults)
        rows.insert(fmt::format("| `{}` | {} | {} |", parameter.first, parameter.second, fmt::join(effects, ", ")));
    return rows;
}

} // namespace

TEST(PublishedValues, defaults_are_those_of_the_table) {
    Defaults defaults;
    for (const auto& entry : std::filesystem::directory_iterator("effects"))
        if (entry.path().extension() == ".fx") addDefaults(entry.path(), defaults);
    std::set<std::string> table;
    std::ifstream file("docs/design/tables/defaults.md");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("| `")) table.insert(line);
    const std::set<std::string> rows = rowsOf(defaults);
    for (const std::string& row : rows)
        EXPECT_TRUE(table.contains(row)) << "not in docs/design/tables/defaults.md: " << row;
    for (const std::string& row : table)
        EXPECT_TRUE(rows.contains(row)) << "no effect has what docs/design/tables/defaults.md says: " << row;
}

TEST(PublishedValues, the_profile_is_the_printed_table_of_six_gaussians) {
    const std::vector<double> profile = defaultOf("gGaussianWeight", "2");
    ASSERT_EQ(profile.size(), 24U);
    for (std::size_t gaussian = 0; gaussian < 6; ++gaussian)
        for (std::size_t column = 0; column < 4; ++column)
            EXPECT_DOUBLE_EQ(profile[4 * gaussian + column], kPrintedProfile[gaussian][column]) << gaussian << ", " << column;
}

TEST(PublishedValues, the_library_has_the_same_table_and_widths) {
    std::ifstream file("hlsl/scatter/profile.fxh");
    std::vector<double> numbers;
    for (std::string line; std::getline(file, line);) {
        static const std::regex kNumber(R"([{(, ](\d+\.\d+))");
        if (!line.starts_with("//"))
            for (auto match = std::sregex_iterator(line.begin(), line.end(), kNumber); match != std::sregex_iterator(); ++match)
                numbers.push_back(std::stod((*match)[1]));
    }
    ASSERT_EQ(numbers.size(), 30U);
    for (std::size_t gaussian = 0; gaussian < 6; ++gaussian) {
        for (std::size_t column = 0; column < 4; ++column)
            EXPECT_DOUBLE_EQ(numbers[4 * gaussian + column], kPrintedProfile[gaussian][column]) << gaussian << ", " << column;
        EXPECT_NEAR(numbers[24 + gaussian], std::sqrt(kPrintedProfile[gaussian][3]), 5.1e-4) << gaussian;
    }
}

TEST(PublishedValues, each_setting_has_the_numbers_of_its_source) {
    // Settings 0 seed, 1 deon2007, 2 corrected; docs/settings.md names the places.
    const std::map<std::string, std::array<double, 3>> printed = {
        {"gMix", {0.4, 0.5, 0.5}},    {"gRoughness", {0.3, 0.3, 0.3}}, {"gShadowTolerance", {0.005, 2.0, 0.3}},
        {"gTransmission", {1, 1, 1}}, {"gBlurSize", {1.5, 1.5, 1.2}},  {"gFurKajiyaKay", {0, 1, 1}},
        {"gFurTaper", {0, 0, 0}},     {"gFurFringes", {0, 0, 1}}};
    for (const auto& [name, values] : printed)
        for (std::size_t setting = 0; setting < 3; ++setting) {
            const char* file = name.starts_with("gFur") ? "effects/Fur.fx" : "effects/Main.fx";
            const std::vector<double> value = defaultOf(name.c_str(), std::to_string(setting).c_str(), file);
            ASSERT_EQ(value.size(), 1U) << name;
            EXPECT_DOUBLE_EQ(value.front(), values[setting]) << name << " in setting " << setting;
        }
}
