// Numbers on their way from the effect file to the shader, by both compilers.
// Default values of the effects against the sources that print them, and against the table that says what users meet.

#include "host/effect/model.h"
#include "host/scene/view.h"
#include "tests/run/fixture.h"
#include "tests/spirv/missing.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace tegument::test {
namespace {

constexpr int kValues = 14;

class Values : public Run, public testing::WithParamInterface<Compiler> {
protected:
    void SetUp() override {
        Run::SetUp();
        if (IsSkipped()) return;
        if (const std::string missing = test::compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    void expectValue(int index, std::array<float, 4> expected) {
        const auto result = run("values.fx", row(kValues, "Values", GetParam()));
        ASSERT_TRUE(succeeded(result));
        EXPECT_TRUE(pixelIs(result->image, index, 0, expected));
    }
};

TEST_P(Values, scalars_and_vectors_arrive) {
    expectValue(0, {1.5F, 2, 3, 4});
}
TEST_P(Values, arrays_of_scalars_arrive) {
    expectValue(1, {10, 11, 12, 13});
}
TEST_P(Values, what_follows_an_array_arrives) {
    expectValue(2, {14, 20, 21, 22});
}
TEST_P(Values, arrays_of_vectors_and_integers_arrive) {
    expectValue(3, {23, 24, 25, -7});
}
TEST_P(Values, booleans_and_integer_vectors_arrive) {
    expectValue(4, {1, 0, 30, -31});
}
// (1, 2, 3, 4) times the matrix of rows 1..4, 5..8, 9..12, 13..16.
TEST_P(Values, mul_takes_vectors_as_rows) {
    expectValue(5, {90, 100, 110, 120});
}
TEST_P(Values, mul_takes_columns_on_the_right) {
    expectValue(6, {30, 70, 110, 150});
}
TEST_P(Values, three_by_three_matrices_arrive) {
    expectValue(7, {30, 36, 42, 0});
}
TEST_P(Values, four_by_three_matrices_arrive) {
    expectValue(8, {70, 80, 90, 0});
}
TEST_P(Values, row_major_matrices_arrive) {
    expectValue(9, {90, 100, 110, 120});
}
TEST_P(Values, arrays_of_matrices_arrive) {
    expectValue(10, {1090, 1100, 1110, 1120});
}
TEST_P(Values, an_indexed_matrix_is_its_row) {
    expectValue(11, {5, 6, 7, 8});
}
TEST_P(Values, what_follows_matrices_arrives) {
    expectValue(12, {40, 41, 42, 43});
}

INSTANTIATE_TEST_SUITE_P(Compilers, Values, testing::Values(Compiler::Dxc, Compiler::Glslang),
                         [](const auto& entry) { return entry.param == Compiler::Dxc ? "dxc" : "glslang"; });

class ValueSources : public Run {};

TEST_F(ValueSources, the_workspace_wins_over_the_default) {
    Workspace workspace;
    workspace.parameters["gScalar"] = {7};
    const auto result = run("values.fx", row(kValues, "Values"), nullptr, workspace);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(0, 0, 0), 7.0F);
}

TEST_F(ValueSources, set_wins_over_the_workspace) {
    Workspace workspace;
    workspace.parameters["gScalar"] = {7};
    RunOptions options = row(kValues, "Values");
    options.parameters["gScalar"] = {8};
    const auto result = run("values.fx", options, nullptr, workspace);
    ASSERT_TRUE(succeeded(result));
    EXPECT_EQ(result->image.at(0, 0, 0), 8.0F);
}

TEST_F(ValueSources, the_workspace_may_name_parameters_of_other_effects) {
    Workspace workspace;
    workspace.parameters["gSomethingElse"] = {1, 2, 3};
    EXPECT_TRUE(succeeded(run("values.fx", row(kValues, "Values"), nullptr, workspace)));
}

TEST_F(ValueSources, setting_an_unknown_parameter_is_an_error_with_the_nearest_name) {
    RunOptions options = row(kValues, "Values");
    options.parameters["gScaler"] = {1};
    const auto result = run("values.fx", options);
    ASSERT_EQ(code(result), 4010);
    EXPECT_EQ(result.error().diagnostics.front().hint, "did you mean 'gScalar'?");
}

TEST_F(ValueSources, a_wrong_number_of_values_is_an_error) {
    RunOptions options = row(kValues, "Values");
    options.parameters["gVector"] = {1, 2};
    const auto result = run("values.fx", options);
    ASSERT_EQ(code(result), 4011);
    EXPECT_NE(format(result.error()).find("takes 3 numbers, 2 given"), std::string::npos) << format(result.error());
}

TEST_F(ValueSources, an_integer_takes_whole_numbers_only) {
    RunOptions options = row(kValues, "Values");
    options.parameters["gInteger"] = {2.5};
    EXPECT_EQ(code(run("values.fx", options)), 4016);
}

TEST_F(ValueSources, a_value_beyond_32_bits_is_an_error) {
    RunOptions options = row(kValues, "Values");
    options.parameters["gInteger"] = {4e9};
    EXPECT_EQ(code(run("values.fx", options)), 4016);
}

TEST_F(ValueSources, a_value_outside_its_ui_range_warns_and_is_used) {
    RunOptions options = row(kValues, "Values");
    options.parameters["gBounded"] = {1.5};
    const auto result = run("values.fx", options);
    ASSERT_TRUE(succeeded(result));
    ASSERT_EQ(result->warnings.size(), 1U);
    EXPECT_EQ(result->warnings.front().code, 4012);
    EXPECT_EQ(result->image.at(13, 0, 0), 1.5F);
}

TEST_F(ValueSources, a_used_parameter_without_any_value_is_an_error) {
    const auto result = run("values.fx", row(1, "Never"));
    ASSERT_EQ(code(result), 4018);
    EXPECT_EQ(result.error().diagnostics.front().hint, "give one: --set gNeverGiven=VALUE");
}

TEST_F(ValueSources, a_misspelt_semantic_is_an_error_with_the_nearest_name) {
    const auto result = run("semantics.fx", row(1, "Misspelt"));
    ASSERT_EQ(code(result), 4017);
    EXPECT_EQ(result.error().diagnostics.front().hint, "did you mean 'NEARCLIP'?");
}

TEST_F(ValueSources, a_semantic_that_does_not_fit_the_type_is_an_error) {
    EXPECT_EQ(code(run("semantics.fx", row(1, "TooShort"))), 4013);
}

TEST_F(ValueSources, an_unknown_object_is_an_error) {
    EXPECT_EQ(code(run("semantics.fx", row(1, "Elsewhere"))), 4014);
}

TEST_F(ValueSources, bounds_without_a_mesh_are_an_error) {
    EXPECT_EQ(code(run("semantics.fx", row(14, "Semantics"))), 4015);
}

/// Semantics against the same matrices computed by GLM.
class Semantics : public Run {
protected:
    void SetUp() override {
        Run::SetUp();
        if (IsSkipped()) return;
        mesh_ = square();
        mesh_.positions[0].z = 4; // bounds that are not symmetrical
        computeBounds(mesh_);
        placed_ = placeScene(workspace_, mesh_.bounds);
        camera_ = cameraMatrices(placed_.camera, 14.0);
        light_ = lightMatrices(placed_.light, mesh_.bounds);
        const auto result = run("semantics.fx", row(14, "Semantics"), &mesh_, workspace_);
        ASSERT_TRUE(succeeded(result));
        image_ = result->image;
    }

    void expect(int index, const glm::vec4& v) {
        // A product of four terms rounds four times: 4 * 2^-24 of the largest term, which is below 100 here times 1000.
        const float tolerance = 4e-7F * std::max(1000.0F, glm::length(v));
        EXPECT_TRUE(pixelIs(image_, index, 0, {v.x, v.y, v.z, v.w}, tolerance));
    }

    const glm::vec4 v_{10, -20, 30, 1};
    const Workspace workspace_ = closeUp();
    Mesh mesh_;
    PlacedScene placed_;
    Matrices camera_;
    Matrices light_;
    Image image_;
};

TEST_F(Semantics, the_camera_s_matrix_is_what_glm_computes) {
    expect(0, camera_.viewProjection * v_);
}
TEST_F(Semantics, the_light_s_matrix_is_what_glm_computes) {
    expect(1, light_.viewProjection * v_);
}
TEST_F(Semantics, the_inverse_is_that_of_the_camera) {
    expect(2, camera_.inverseView * v_);
}
TEST_F(Semantics, the_world_matrix_is_the_identity) {
    expect(3, v_);
}
TEST_F(Semantics, the_transpose_swaps_rows_and_columns) {
    expect(4, glm::transpose(camera_.view) * v_);
}
TEST_F(Semantics, the_light_s_place_and_the_near_plane_arrive) {
    expect(5, glm::vec4(placed_.light.position, camera_.nearPlane));
}
TEST_F(Semantics, the_light_s_colour_arrives_with_alpha_one) {
    expect(6, {0.5F, 0.25F, 2.0F, 1.0F});
}
TEST_F(Semantics, the_camera_s_place_and_the_far_plane_arrive) {
    expect(7, glm::vec4(placed_.camera.position, camera_.farPlane));
}
TEST_F(Semantics, fields_of_view_are_radians) {
    expect(8, {glm::radians(25.0F), light_.horizontalFov, mesh_.bounds.radius, 0});
}
TEST_F(Semantics, the_viewport_is_the_picture_here) {
    expect(9, {14, 1, 1, 0});
}
TEST_F(Semantics, the_centre_arrives) {
    expect(10, glm::vec4(mesh_.bounds.centre, 0));
}
TEST_F(Semantics, the_box_arrives) {
    expect(11, glm::vec4(mesh_.bounds.minimum, 0));
    expect(12, glm::vec4(mesh_.bounds.maximum, 0));
    expect(13, glm::vec4(mesh_.bounds.maximum - mesh_.bounds.minimum, 0));
}

/// In a world of metres the same place has other coordinates, and clip space keeps its w in metres.
TEST_F(Semantics, in_a_world_of_metres_all_lengths_are_metres) {
    Workspace metres = workspace_;
    metres.worldUnitMm = 1000;
    const auto result = run("semantics.fx", row(14, "Semantics"), &mesh_, metres);
    ASSERT_TRUE(succeeded(result));
    const auto isThousandth = [&](int index, const glm::vec4& inMillimetres, float last) {
        const glm::vec4 v = inMillimetres / 1000.0F;
        return pixelIs(result->image, index, 0, {v.x, v.y, v.z, last}, 1e-6F * glm::length(v));
    };
    EXPECT_TRUE(isThousandth(5, glm::vec4(placed_.light.position, 0), camera_.nearPlane / 1000));
    EXPECT_TRUE(isThousandth(7, glm::vec4(placed_.camera.position, 0), camera_.farPlane / 1000));
    EXPECT_TRUE(isThousandth(10, glm::vec4(mesh_.bounds.centre, 0), 0));
    EXPECT_TRUE(isThousandth(13, glm::vec4(mesh_.bounds.maximum - mesh_.bounds.minimum, 0), 0));
    EXPECT_TRUE(pixelIs(result->image, 9, 0, {14, 1, 1000, 0}));
    EXPECT_NEAR(result->image.at(8, 0, 2), mesh_.bounds.radius / 1000, 1e-6F);
    // gWorld brings the mesh's millimetres there; its inverse transpose of (10, -20, 30, 1) is a thousand times as long.
    EXPECT_TRUE(pixelIs(result->image, 3, 0, {10000, -20000, 30000, 1}, 0.1F));
}

TEST_F(ValueSources, a_unit_that_the_world_does_not_have_is_warned_of) {
    RunOptions options = row(10, "Semantics");
    options.parameters["gUnitMm"] = {1000};
    const Mesh mesh = square();
    const auto result = run("semantics.fx", options, &mesh);
    ASSERT_TRUE(succeeded(result));
    EXPECT_TRUE(std::ranges::any_of(result->warnings, [](const Diagnostic& d) { return d.code == 4052; }));
    Workspace metres;
    metres.worldUnitMm = 1000;
    const auto agreed = run("semantics.fx", options, &mesh, metres);
    ASSERT_TRUE(succeeded(agreed));
    EXPECT_FALSE(std::ranges::any_of(agreed->warnings, [](const Diagnostic& d) { return d.code == 4052; }));
}

std::vector<double> defaultOf(const char* name, const char* setting, const char* file = "effects/Main.fx") {
    const auto effect = loadEffect(file, {.defines = {{"TEGUMENT_SETTING", setting}}});
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

/// What a parameter is called and has before anybody turns it: with its effects, a row of docs/design/tables/defaults.csv.
using Defaults = std::map<std::pair<std::string, std::string>, std::set<std::string>>;

void addDefaults(const std::filesystem::path& file, Defaults& defaults) {
    const std::vector<std::pair<std::string, std::string>> defines = {
        {"TEGUMENT_LAMPS", "3"}, {"TEGUMENT_LOBES", "1"}, {"TEGUMENT_MOTION", "1"}, {"TEGUMENT_FUR_POSE", "1"}};
    const auto effect = loadEffect(file, {.defines = defines});
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
        rows.insert(fmt::format("{},{},\"{}\"", parameter.first, parameter.second, fmt::join(effects, ", ")));
    return rows;
}

} // namespace

TEST(PublishedValues, defaults_are_those_of_the_table) {
    Defaults defaults;
    for (const auto& entry : std::filesystem::directory_iterator("effects"))
        if (entry.path().extension() == ".fx") addDefaults(entry.path(), defaults);
    std::set<std::string> table;
    std::ifstream file("docs/design/tables/defaults.csv");
    for (std::string line; std::getline(file, line);)
        if (line != "parameter,default,effects") table.insert(line);
    const std::set<std::string> rows = rowsOf(defaults);
    for (const std::string& row : rows)
        EXPECT_TRUE(table.contains(row)) << "not in docs/design/tables/defaults.csv: " << row;
    for (const std::string& row : table)
        EXPECT_TRUE(rows.contains(row)) << "no effect has what docs/design/tables/defaults.csv says: " << row;
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
    const std::map<std::string, std::array<double, 3>> printed = {{"gMix", {0.4, 0.5, 0.5}},
                                                                  {"gRoughness", {0.3, 0.3, 0.3}},
                                                                  {"gSpecularIntensity", {0.18, 0.18, 1}},
                                                                  {"gShadowTolerance", {0.005, 2.0, 0.3}},
                                                                  {"gTransmission", {1, 1, 1}},
                                                                  {"gBlurSize", {1.5, 1.5, 1.2}},
                                                                  {"gFurKajiyaKay", {0, 1, 1}},
                                                                  {"gFurTaper", {0, 0, 0}},
                                                                  {"gFurFringes", {0, 0, 1}}};
    for (const auto& [name, values] : printed)
        for (std::size_t setting = 0; setting < 3; ++setting) {
            const char* file = name.starts_with("gFur") ? "effects/Fur.fx" : "effects/Main.fx";
            const std::vector<double> value = defaultOf(name.c_str(), std::to_string(setting).c_str(), file);
            ASSERT_EQ(value.size(), 1U) << name;
            EXPECT_DOUBLE_EQ(value.front(), values[setting]) << name << " in setting " << setting;
        }
}

} // namespace tegument::test
