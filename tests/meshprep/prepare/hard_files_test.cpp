// Every hard file behaves as docs/design/meshprep-tables.md says: one precise error, or a mesh whose repairs are counted.
#include "host/support/file.h"
#include "host/support/sanitized.h"
#include "meshprep/prepare/prepare.h"
#include "tests/meshprep/prepare/hard_files.h"
#include "tests/meshprep/prepare/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sys/resource.h>
#include <unistd.h>

using namespace tegument;
using namespace tegument::testing_prep;
namespace fs = std::filesystem;

namespace {

class HardFiles : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  ("tegument-hard-" + std::to_string(::getpid()) + "-" + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
        limitMemory();
    }
    void TearDown() override {
        setrlimit(RLIMIT_AS, &before_);
        fs::remove_all(folder_);
    }

    /// So that a case which takes all memory fails, and the machine goes on.
    void limitMemory() {
        getrlimit(RLIMIT_AS, &before_);
        if (!kMemoryCanBeLimited) return;
        constexpr rlim_t kMost = rlim_t{8} << 30;
        const rlimit limit{.rlim_cur = std::min(kMost, before_.rlim_max), .rlim_max = before_.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
    }

    [[nodiscard]] Result<prep::Prepared> prepare(const HardFile& file, const prep::PrepOptions& options = lenient()) const {
        EXPECT_TRUE(writeFile(folder_ / file.name, file.bytes));
        return prep::prepareMesh(folder_ / file.name, options);
    }

    /// NaN and infinity are counted and left out, as `tegument prep` does unless told otherwise.
    static prep::PrepOptions lenient() {
        prep::PrepOptions options;
        options.read.dropNotFinite = true;
        return options;
    }

    [[nodiscard]] Result<prep::Prepared> prepare(int number, const prep::PrepOptions& options = lenient()) const {
        for (const HardFile& file : hardFiles())
            if (file.number == number) return prepare(file, options);
        return inputError(1, {}, "no such file");
    }

    fs::path folder_;
    rlimit before_{};
};

void expectError(const HardFile& file, const Result<prep::Prepared>& result) {
    ASSERT_FALSE(result) << "no error";
    ASSERT_EQ(result.error().diagnostics.size(), 1u) << format(result.error());
    const Diagnostic& diagnostic = result.error().diagnostics.front();
    EXPECT_EQ(diagnostic.code, file.expected.error) << format(result.error());
    if (!file.expected.anywhere) {
        EXPECT_EQ(diagnostic.at.line, file.expected.line) << format(result.error());
        EXPECT_EQ(diagnostic.at.byte.value_or(0), file.expected.byte.value_or(0)) << format(result.error());
    }
    EXPECT_FALSE(diagnostic.hint.empty());
}

void expectSound(const Mesh& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const std::uint32_t index : mesh.indices)
        ASSERT_LT(index, mesh.positions.size());
    for (const glm::vec3& normal : mesh.normals)
        ASSERT_NEAR(glm::length(glm::dvec3(normal)), 1, 1e-6);
    for (const glm::vec3& position : mesh.positions)
        ASSERT_TRUE(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
}

} // namespace

TEST_F(HardFiles, each_gives_its_error_or_its_counts) {
    for (const HardFile& file : hardFiles()) {
        SCOPED_TRACE(std::to_string(file.number) + " " + file.name);
        const auto result = prepare(file);
        if (file.expected.error != 0) {
            expectError(file, result);
            continue;
        }
        ASSERT_TRUE(result) << format(result.error());
        EXPECT_EQ(result->mesh.positions.size(), file.expected.vertices);
        EXPECT_EQ(result->mesh.indices.size() / 3, file.expected.triangles);
        expectSound(result->mesh);
        EXPECT_EQ(result->report.bytes.indexBytes, file.expected.vertices <= 65535 ? 2u : 4u) << "65535 cuts a strip";
        EXPECT_EQ(changedBy(result->report, file.expected.step), file.expected.changed) << file.expected.step;
        const auto told = std::ranges::count(result->report.warnings, file.expected.warning, &Diagnostic::code);
        EXPECT_EQ(told, file.expected.warning == 0 ? 0 : 1) << "warnings of TG" << file.expected.warning;
    }
}

TEST_F(HardFiles, cover_the_table) {
    std::set<int> numbers = {46, 47, 48}; // real scans and ten million triangles: tests of their own
    for (const HardFile& file : hardFiles())
        numbers.insert(file.number);
    EXPECT_EQ(numbers.size(), 86u);
    EXPECT_EQ(*numbers.rbegin(), 86);
}

TEST_F(HardFiles, corners_of_all_kinds_refer_to_the_same_four_places) {
    prep::PrepOptions options = lenient();
    options.keepDuplicates = true; // the quad repeats the first triangle
    const auto result = prepare(35, options);
    ASSERT_TRUE(result) << format(result.error());
    std::set<std::array<float, 3>> places;
    for (const glm::vec3& p : result->mesh.positions)
        places.insert({p.x, p.y, p.z});
    EXPECT_EQ(places.size(), 4u);
    EXPECT_EQ(result->mesh.indices.size() / 3, 4u);
}

TEST_F(HardFiles, a_concave_polygon_is_cut_inside_its_outline) {
    const auto result = prepare(7);
    ASSERT_TRUE(result) << format(result.error());
    double area = 0;
    for (std::size_t i = 0; i < 9; i += 3) {
        const auto p = [&](std::size_t k) { return glm::dvec3(result->mesh.positions[result->mesh.indices[i + k]]); };
        const double twice = glm::cross(p(1) - p(0), p(2) - p(0)).z;
        EXPECT_GT(twice, 0) << "a triangle outside the outline would face the other way";
        area += twice / 2;
    }
    EXPECT_NEAR(area, 10, 1e-6) << "16 of the square, less the notch of 4 * 3 / 2";
}

TEST_F(HardFiles, bad_indices_can_be_left_out_with_a_count) {
    prep::PrepOptions options = lenient();
    options.read.dropBadFaces = true;
    for (const int number : {13, 14, 34}) {
        const auto result = prepare(number, options);
        ASSERT_TRUE(result) << number << format(result.error());
        EXPECT_EQ(result->mesh.indices.size() / 3, 1u) << number;
        EXPECT_EQ(changedBy(result->report, "bad faces"), 1u) << number;
    }
}

TEST_F(HardFiles, nan_and_infinity_can_be_refused_by_line) {
    for (const int number : {15, 16}) {
        const auto result = prepare(number, prep::PrepOptions{});
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().diagnostics.front().code, 5305);
        EXPECT_EQ(result.error().diagnostics.front().at.line, 13);
    }
}

TEST_F(HardFiles, a_triangle_without_area_is_flagged) {
    const auto result = prepare(19);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->report.topology.flatTriangles, 1u);
}

TEST_F(HardFiles, sheets_back_to_back_have_opposite_normals) {
    const auto result = prepare(21);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->report.topology.backToBackPairs, 4u);
    for (std::size_t triangle = 0; triangle < 8; ++triangle) {
        const std::uint32_t* t = &result->mesh.indices[3 * triangle];
        const auto p = [&](std::size_t k) { return glm::dvec3(result->mesh.positions[t[k]]); };
        const glm::dvec3 face = glm::cross(p(1) - p(0), p(2) - p(0));
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_GT(glm::dot(face, glm::dvec3(result->mesh.normals[t[k]])), 0) << "triangle " << triangle;
    }
}

TEST_F(HardFiles, sheets_back_to_back_share_vertices_by_option) {
    prep::PrepOptions options = lenient();
    options.normals.sharing = prep::NormalSharing::Place;
    const auto result = prepare(21, options);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.positions.size(), 4u);
    expectSound(result->mesh);
}

TEST_F(HardFiles, edges_of_three_triangles_and_bow_ties_are_counted) {
    const auto edge = prepare(22);
    const auto tie = prepare(23);
    ASSERT_TRUE(edge && tie);
    EXPECT_EQ(edge->report.topology.crowdedEdges, 1u);
    EXPECT_EQ(tie->report.topology.bowTies, 1u);
    EXPECT_EQ(tie->report.topology.components, 1u);
}

TEST_F(HardFiles, a_bow_tie_has_a_normal_per_fan_by_option) {
    prep::PrepOptions options = lenient();
    options.normals.sharing = prep::NormalSharing::Fan;
    const auto result = prepare(23, options);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.positions.size(), 8u);
}

TEST_F(HardFiles, a_flipped_triangle_is_counted_and_turned_by_option) {
    const auto asIs = prepare(24);
    ASSERT_TRUE(asIs);
    EXPECT_EQ(asIs->report.topology.opposedEdges, 3u);
    prep::PrepOptions options = lenient();
    options.orient = true;
    const auto turned = prepare(24, options);
    ASSERT_TRUE(turned);
    EXPECT_EQ(changedBy(turned->report, "orient"), 1u);
    EXPECT_EQ(turned->report.topology.opposedEdges, 0u);
}

TEST_F(HardFiles, the_bounding_ball_ignores_what_no_triangle_uses) {
    const auto result = prepare(25);
    ASSERT_TRUE(result);
    EXPECT_LT(result->mesh.bounds.radius, 1);
}

TEST_F(HardFiles, an_epsilon_joins_what_one_ulp_parts) {
    prep::PrepOptions options = lenient();
    options.same.epsilon = 1e-5;
    const auto result = prepare(41, options);
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->mesh.positions.size(), 4u);
    EXPECT_EQ(result->mesh.indices.size() / 3, 2u);
}

TEST_F(HardFiles, denormal_normals_are_kept_as_directions) {
    prep::PrepOptions options = lenient();
    options.normals.mode = prep::NormalMode::Keep;
    const auto result = prepare(54, options);
    ASSERT_TRUE(result);
    for (const glm::vec3& normal : result->mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST_F(HardFiles, cut_anywhere_give_an_error_or_less_never_a_crash) {
    for (const HardFile& file : hardFiles()) {
        if (file.bytes.size() > 3000) continue;
        for (std::size_t size = 0; size < file.bytes.size(); size += 7) {
            const auto result = prepare({.number = file.number, .name = file.name, .bytes = file.bytes.substr(0, size)});
            if (result) expectSound(result->mesh);
        }
    }
}
