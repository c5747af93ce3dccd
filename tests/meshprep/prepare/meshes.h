#pragma once
// Small meshes for tests, and the way to prepare what is in memory.

#include "meshprep/prepare/points.h"
#include "meshprep/prepare/prepare.h"
#include "meshprep/prepare/shapes.h"
#include "meshprep/write/write_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <unistd.h>

namespace tegument::testing_prep {

class PrepFolder : public testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("tegument-prep-" + std::to_string(::getpid()) + "-" + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] prep::Prepared prepare(const Mesh& mesh, const prep::PrepOptions& options = {}) const {
        EXPECT_TRUE(writePly(folder_ / "in.ply", mesh));
        auto result = prep::prepareMesh(folder_ / "in.ply", options);
        if (!result) {
            ADD_FAILURE() << format(result.error());
            return {};
        }
        return std::move(*result);
    }

    std::filesystem::path folder_;
};

inline prep::Surface surfaceOf(Mesh mesh) {
    prep::Surface surface{.mesh = std::move(mesh)};
    prep::findPlaces(surface, {});
    return surface;
}

inline Mesh meshOf(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    mesh.parts.push_back({.name = "all", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())});
    return mesh;
}

/// By the arc tangent: the arc cosine of a product near 1 loses half of its digits.
inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

inline std::size_t changedBy(const prep::PrepReport& report, const std::string& name) {
    for (const prep::PrepStep& step : report.steps)
        if (step.name == name) return step.changed;
    return 0;
}

} // namespace tegument::testing_prep
