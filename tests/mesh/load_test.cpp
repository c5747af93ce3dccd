// What loadMesh checks whatever the format.

#include "host/mesh/extent.h"
#include "host/mesh/triangles.h"
#include "meshprep/write/write_mesh.h"
#include "tests/mesh/files.h"

#include <algorithm>
#include <random>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Loading = SceneFiles;

/// A flat "head" of this height in file units, with a UV square.
std::string panel(double height, std::string_view moreFaces = "") {
    const std::string h = std::to_string(height);
    return "v 0 0 0\nv 1 0 0\nv 1 " + h + " 0\nv 0 " + h + " 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n" +
           std::string(moreFaces);
}

std::string messageOf(const Result<Mesh>& mesh) {
    return mesh ? std::string("no error") : format(mesh.error());
}

/// Two squares, each a chart, at these corners of the texture.
std::string twoCharts(const glm::vec2& a, const glm::vec2& b, float side = 0.4F) {
    std::string text;
    for (const glm::vec2& corner : {a, b})
        for (const glm::vec2& at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            text += "v " + std::to_string(100 * (at.x + 2 * corner.x)) + " " + std::to_string(100 * at.y) + " 0\n";
            text += "vt " + std::to_string(corner.x + side * at.x) + " " + std::to_string(corner.y + side * at.y) + "\n";
        }
    return text + "f 1/1 2/2 3/3 4/4\nf 5/5 6/6 7/7 8/8\n";
}

using RoundTrip = SceneFiles;

/// A bumpy sheet with two parts, every float of it "random", with normals and tangents made.
Mesh sheet() {
    Mesh mesh;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> jitter(-0.3f, 0.3f);
    constexpr std::uint32_t kSide = 12;
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const glm::vec2 at(x, y);
            mesh.positions.push_back(glm::vec3(at + jitter(random), jitter(random)) * 17.3f);
            mesh.uvs.push_back((at + 0.5f) / static_cast<float>(kSide));
        }
    addGrid(mesh.indices, kSide - 1, kSide - 1, "abcbdc");
    const auto count = static_cast<std::uint32_t>(mesh.indices.size());
    mesh.parts = {{"skin", 0, 300}, {"eye \"left\"", 300, count - 300}};
    mesh.name = "sheet";
    mesh.attribution = "Someone, CC BY";
    computeNormals(mesh);
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

Image checker() {
    Image image{.width = 3, .height = 2, .channels = 3, .bitsPerChannel = 8};
    for (int i = 0; i < 18; ++i)
        image.pixels.push_back(static_cast<float>(i * 13 % 256) / 255.0f);
    return image;
}

} // namespace

TEST_F(Loading, a_mesh_without_area_is_refused_as_nothing_of_it_could_be_seen) {
    for (const std::string places : {"v 0 0 0\nv 1 1 1\nv 3 3 3\n", "v 5 5 5\nv 5 5 5\nv 5 5 5\n", "v 0.1 0 0\nv 0.3 0 0\nv 0.7 0 0\n"}) {
        const auto flat = load("a.obj", places + "f 1 2 3\nf 3 2 1\n");
        EXPECT_EQ(codeOf(flat), 5306) << places;
        EXPECT_NE(messageOf(flat).find("no triangle of the mesh has an area"), std::string::npos) << messageOf(flat);
    }
    EXPECT_TRUE(load("a.obj", "v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nv 0 0 0\nf 1 2 4\nf 1 2 3\n")) << "one triangle is enough, however small";
}

TEST_F(Loading, a_head_of_plausible_size_is_accepted) {
    EXPECT_TRUE(load("a.obj", panel(240), {.expectHead = true}));
    EXPECT_TRUE(load("a.obj", panel(2.4), {.unitMm = 100, .expectHead = true}));
}

TEST_F(Loading, a_head_of_implausible_size_is_refused_with_the_likely_unit) {
    EXPECT_NE(messageOf(load("a.obj", panel(2.4), {.expectHead = true})).find("try 100"), std::string::npos);
    EXPECT_NE(messageOf(load("a.obj", panel(24), {.expectHead = true})).find("try 10"), std::string::npos);
    EXPECT_NE(messageOf(load("a.obj", panel(0.3), {.expectHead = true})).find("try 1000"), std::string::npos);
    EXPECT_NE(messageOf(load("a.obj", panel(240), {.unitMm = 1000, .expectHead = true})).find("try 1"), std::string::npos);
    const std::string lps = messageOf(load("a.obj", panel(7.945), {.unitMm = 1000, .expectHead = true}));
    EXPECT_NE(lps.find("TG5309"), std::string::npos) << lps;
    EXPECT_NE(lps.find("--unit-mm X"), std::string::npos) << lps;
    EXPECT_NE(lps.find("try 35"), std::string::npos) << "no common unit fits: 280 / 7.945. " << lps;
}

TEST_F(Loading, an_implausible_size_gets_a_likely_unit_where_one_may_be_guessed) {
    const std::pair<double, double> known[] = {
        {1.8, 1000}, {0.15, 1000}, {5, 10}, {0.007, 1000}, {1e6, 0.00028}}; // height in the file, unit
    for (const auto& [height, unit] : known) {
        const auto mesh = load("a.obj", panel(height), {.guessUnit = true});
        ASSERT_TRUE(mesh) << height;
        EXPECT_DOUBLE_EQ(mesh->unitMm, unit) << height;
        EXPECT_NEAR(mesh->bounds.maximum.y - mesh->bounds.minimum.y, height * unit, 1e-5 * height * unit);
        ASSERT_FALSE(mesh->warnings.empty());
        EXPECT_EQ(mesh->warnings.back().code, 5327);
    }
    for (const double height : {12.0, 240.0, 19'000.0})
        EXPECT_EQ(load("a.obj", panel(height), {.guessUnit = true})->unitMm, 1) << height << " mm are plausible";
    EXPECT_EQ(load("a.obj", panel(1.8), {.unitMm = 1, .guessUnit = true})->unitMm, 1) << "what is said is done";
    EXPECT_EQ(load("a.obj", panel(1.8))->unitMm, 1) << "nobody asked";
}

TEST_F(Loading, a_head_is_judged_by_the_size_that_it_is_scaled_to) {
    EXPECT_TRUE(load("a.obj", panel(0.24), {.expectHead = true, .scale = {1, -1000, 1}}));
    const std::string message = messageOf(load("a.obj", panel(240), {.expectHead = true, .scale = glm::vec3(10)}));
    EXPECT_NE(message.find("2400 mm high with 1 mm per unit, scaled by 10"), std::string::npos) << message;
}

TEST_F(Loading, a_head_without_height_is_refused) {
    EXPECT_EQ(codeOf(load("a.obj", panel(0), {.expectHead = true})), 5309);
}

TEST_F(Loading, a_mesh_without_uvs_is_an_error_only_where_they_are_needed) {
    const std::string_view bare = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_TRUE(load("a.obj", bare));
    EXPECT_EQ(codeOf(load("a.obj", bare, {.requireUvs = true})), 5308);
}

TEST_F(Loading, overlapping_uvs_are_warned_of_with_the_share) {
    const auto mesh = load("a.obj", panel(1, "f 1/1 4/4 3/3\n"));
    ASSERT_TRUE(mesh);
    ASSERT_TRUE(hasWarning(*mesh, 5320));
    EXPECT_NE(mesh->warnings[0].text.find("66.7 % of the UV area"), std::string::npos) << mesh->warnings[0].text;
    EXPECT_FALSE(mesh->warnings[0].hint.empty());
}

TEST_F(Loading, uvs_outside_the_square_are_warned_of_with_the_share) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt .5 0\nvt 1.5 0\nvt 1.5 1\nvt .5 1\nf 1/1 2/2 3/3 4/4\n");
    ASSERT_TRUE(mesh);
    ASSERT_TRUE(hasWarning(*mesh, 5321));
    EXPECT_NE(mesh->warnings[0].text.find("50.0 %"), std::string::npos) << mesh->warnings[0].text;
}

TEST_F(Loading, clean_uvs_are_not_warned_of) {
    EXPECT_TRUE(load("a.obj", panel(1))->warnings.empty());
}

TEST_F(Loading, a_uv_that_is_not_finite_is_refused) {
    EXPECT_EQ(codeOf(load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt nan 0\nf 1/1 2/1 3/1\n")), 5305);
}

TEST_F(Loading, normals_of_other_lengths_are_made_unit_and_zero_ones_renew_all) {
    const auto scaled = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nf 1//1 2//1 3//1\n");
    ASSERT_TRUE(scaled);
    EXPECT_EQ(scaled->normals[0], glm::vec3(0, 0, 1));
    const auto zero = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 1 0 0\nf 1//1 2//2 3//2\n");
    ASSERT_TRUE(zero);
    EXPECT_EQ(zero->normals[1], glm::vec3(0, 0, 1));
    EXPECT_TRUE(hasWarning(*zero, 5324));
}

TEST_F(Loading, unknown_missing_and_empty_files_are_told_apart) {
    EXPECT_EQ(codeOf(load("a.xyz", "1 2 3\n")), 5300);
    EXPECT_EQ(codeOf(load("a.glb", "PK\3\4")), 5300);
    EXPECT_EQ(codeOf(load("a.ply", "")), 5300);
    EXPECT_EQ(codeOf(loadMesh(folder_ / "none.obj")), 5001);
    EXPECT_EQ(codeOf(loadMesh(folder_)), 5001);
}

TEST_F(Loading, glb_and_ply_are_known_by_content_whatever_their_name) {
    EXPECT_EQ(codeOf(load("a.obj", "glTF")), 5301);
    EXPECT_EQ(codeOf(load("a.txt", "ply\nformat morse 1.0\nend_header\n")), 5302);
}

TEST_F(Loading, a_unit_that_is_no_length_is_a_usage_error) {
    for (const double unit : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto mesh = load("a.obj", panel(1), {.unitMm = unit});
        ASSERT_EQ(codeOf(mesh), 5312);
        EXPECT_EQ(mesh.error().blame, Blame::Usage);
    }
}

TEST_F(Loading, what_is_no_mesh_is_named_whatever_it_is_called) {
    using namespace std::string_literals;
    const auto hintOf = [&](const std::string& name, const std::string& bytes) {
        const auto mesh = load(name, bytes);
        EXPECT_EQ(codeOf(mesh), 5300) << name;
        return messageOf(mesh);
    };
    for (const char* name : {"a.ply", "a.obj", "a.glb"}) {
        EXPECT_NE(hintOf(name, "\x1f\x8b\x08\0\0"s).find("gunzip"), std::string::npos);
        EXPECT_NE(hintOf(name, "PK\x03\x04\0\0"s).find("zip archive"), std::string::npos);
        EXPECT_NE(hintOf(name, "version https://git-lfs.example/spec/v1\noid sha256:a\n").find("git lfs pull"), std::string::npos);
        EXPECT_NE(hintOf(name, "<!DOCTYPE html><html>404").find("web page"), std::string::npos);
    }
}

TEST_F(Loading, a_byte_order_mark_before_a_text_does_not_matter) {
    const std::string mark = "\xef\xbb\xbf";
    EXPECT_TRUE(load("a.ply", mark + "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n"));
    EXPECT_TRUE(load("a.off", mark + "OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n"));
    EXPECT_TRUE(load("a.obj", mark + "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n"));
}

TEST_F(Loading, lengths_in_messages_are_written_out) {
    const auto mesh = load("a.obj", panel(55'530), {.guessUnit = true});
    ASSERT_TRUE(mesh);
    ASSERT_FALSE(mesh->warnings.empty());
    EXPECT_NE(mesh->warnings.back().text.find("would be 55530 mm long"), std::string::npos) << mesh->warnings.back().text;
    EXPECT_EQ(lengthText(999.4), "999");
    EXPECT_EQ(lengthText(999.7), "1000") << "not 1e+03";
    EXPECT_EQ(lengthText(-4e9), "-4000000000");
    EXPECT_EQ(lengthText(0.01234), "0.0123");
}

TEST_F(Loading, charts_of_other_tiles_lie_in_the_unit_square) {
    const auto home = load("a.obj", twoCharts({0.05F, 0.1F}, {0.55F, 0.5F}));
    ASSERT_TRUE(home);
    for (const auto& [a, b] : {std::pair(glm::vec2(0, 1), glm::vec2(0, 1)), std::pair(glm::vec2(-2, 3), glm::vec2(0, 0)),
                               std::pair(glm::vec2(7, -1), glm::vec2(-1, 0))}) {
        const auto mesh = load("b.obj", twoCharts(glm::vec2(0.05F, 0.1F) + a, glm::vec2(0.55F, 0.5F) + b));
        ASSERT_TRUE(mesh) << format(mesh.error());
        EXPECT_FALSE(hasWarning(*mesh, 5321)) << a.x << " " << a.y;
        ASSERT_EQ(mesh->uvs.size(), home->uvs.size());
        for (std::size_t i = 0; i < mesh->uvs.size(); ++i)
            EXPECT_LT(glm::length(mesh->uvs[i] - home->uvs[i]), 1e-5F) << i;
    }
    const auto across = load("c.obj", twoCharts({0.8F, 0.1F}, {0.05F, 0.5F}));
    ASSERT_TRUE(across);
    EXPECT_TRUE(hasWarning(*across, 5321)) << "a chart of two tiles stays where it is";
}

TEST_F(Loading, a_normalised_mesh_without_a_unit_is_as_large_as_a_head) {
    const auto box = [](double x, double y, double z) {
        std::string text;
        for (const double i : {0.0, 1.0})
            for (const double j : {0.0, 1.0})
                for (const double k : {0.0, 1.0})
                    text += "v " + std::to_string(x * i) + " " + std::to_string(y * j) + " " + std::to_string(z * k) + "\n";
        return text + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
    };
    const struct {
        double x, y, z;
        bool head;
    } cases[] = {{0.4, 2, 0.3, true},    {1, 0.2, 0.6, true},      {1.2, 1.9, 1.4, true},
                 {0.5, 1.8, 0.3, false}, {0.15, 0.24, 0.2, false}, {0.9, 1.001, 0.2, false}};
    for (const auto& one : cases) {
        const auto mesh = load("a.obj", box(one.x, one.y, one.z), {.guessUnit = true});
        ASSERT_TRUE(mesh) << format(mesh.error());
        const double longest = std::max({one.x, one.y, one.z}) * mesh->unitMm;
        EXPECT_TRUE(hasWarning(*mesh, 5327)) << longest;
        if (one.head)
            EXPECT_TRUE(longest >= 150 && longest <= 700) << longest;
        else
            EXPECT_EQ(mesh->unitMm, 1000) << longest;
        EXPECT_EQ(load("a.obj", box(one.x, one.y, one.z), {.unitMm = 1, .guessUnit = true})->unitMm, 1) << "what is said is done";
    }
}

TEST_F(RoundTrip, a_glb_returns_every_float_index_part_texture_and_name) {
    Mesh mesh = sheet();
    for (const char* role : {"color", "normal", "kernelSize"})
        mesh.textures.push_back({.role = role, .image = checker()});
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->positions, mesh.positions);
    EXPECT_EQ(read->normals, mesh.normals);
    EXPECT_EQ(read->tangents, mesh.tangents);
    EXPECT_EQ(read->uvs, mesh.uvs);
    EXPECT_EQ(read->indices, mesh.indices);
    EXPECT_EQ(read->name, mesh.name);
    EXPECT_EQ(read->attribution, mesh.attribution);
    EXPECT_EQ(read->bounds.radius, mesh.bounds.radius);
    ASSERT_EQ(read->parts.size(), 2u);
    EXPECT_EQ(read->parts[1].name, mesh.parts[1].name);
    EXPECT_EQ(read->parts[1].firstIndex, 300u);
    ASSERT_EQ(read->textures.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(read->textures[i].role, mesh.textures[i].role);
        EXPECT_EQ(read->textures[i].image.pixels, mesh.textures[i].image.pixels);
    }
    EXPECT_TRUE(read->warnings.empty()) << format(read->warnings.front());
}

TEST_F(RoundTrip, the_file_is_in_metres_for_other_programs) {
    Mesh mesh = sheet();
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto metres = loadMesh(folder_ / "a.glb", {.unitMm = 1});
    ASSERT_TRUE(metres);
    EXPECT_FLOAT_EQ(metres->bounds.radius, mesh.bounds.radius / 1000);
}

TEST_F(RoundTrip, a_mesh_without_uvs_stays_without) {
    Mesh mesh = sheet();
    mesh.uvs.clear();
    mesh.tangents.clear();
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->uvs.empty());
    EXPECT_TRUE(read->tangents.empty());
}

TEST_F(RoundTrip, a_folder_that_cannot_be_written_is_the_machines_fault) {
    const auto written = writeGlb("/proc/nowhere/a.glb", sheet());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().blame, Blame::Machine);
}

TEST_F(RoundTrip, clusters_of_a_part_return_and_know_where_they_are) {
    Mesh mesh = sheet();
    mesh.parts[1].clusters = {{.firstIndex = 0, .indexCount = 99}, {.firstIndex = 99, .indexCount = mesh.parts[1].indexCount - 99}};
    computeClusters(mesh, mesh.parts[1]);
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_TRUE(read->parts[0].clusters.empty());
    ASSERT_EQ(read->parts[1].clusters.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const MeshCluster& written = mesh.parts[1].clusters[i];
        const MeshCluster& found = read->parts[1].clusters[i];
        EXPECT_EQ(found.firstIndex, written.firstIndex);
        EXPECT_EQ(found.indexCount, written.indexCount);
        EXPECT_EQ(found.centre, written.centre);
        EXPECT_EQ(found.radius, written.radius);
        EXPECT_EQ(found.axis, written.axis);
        EXPECT_EQ(found.cosine, written.cosine);
    }
}

// The file's own balls and cones are for other readers: wrong ones would make ours leave out what can be seen.
TEST_F(RoundTrip, balls_of_clusters_are_not_believed) {
    Mesh mesh = sheet();
    mesh.parts[0].clusters = {{.firstIndex = 0, .indexCount = 300, .centre = {900, 0, 0}, .radius = 0.1F, .cosine = 1}};
    ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
    const auto read = loadMesh(folder_ / "a.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_LT(glm::length(read->parts[0].clusters[0].centre), 300);
    EXPECT_GT(read->parts[0].clusters[0].radius, 50);
}

TEST_F(RoundTrip, clusters_that_do_not_fill_their_part_are_refused) {
    const std::vector<std::vector<std::uint32_t>> wrong = {{299}, {297}, {150, 153}, {0, 300}, {600}, {300, 3}};
    for (const auto& counts : wrong) {
        Mesh mesh = sheet();
        for (const std::uint32_t count : counts)
            mesh.parts[0].clusters.push_back({.indexCount = count});
        ASSERT_TRUE(writeGlb(folder_ / "a.glb", mesh));
        const auto read = loadMesh(folder_ / "a.glb");
        ASSERT_FALSE(read) << counts.front();
        EXPECT_EQ(read.error().diagnostics.front().code, 5302) << format(read.error());
        EXPECT_NE(format(read.error()).find("clusters"), std::string::npos) << format(read.error());
    }
}

TEST_F(RoundTrip, parts_that_a_shader_expands_are_no_overlap_of_texture_coordinates) {
    Mesh mesh = sheet();
    const std::vector<std::uint32_t> again(mesh.indices.begin(), mesh.indices.begin() + 300);
    mesh.parts.push_back({.name = "more", .firstIndex = static_cast<std::uint32_t>(mesh.indices.size()), .indexCount = 300});
    mesh.indices.insert(mesh.indices.end(), again.begin(), again.end());
    EXPECT_GT(examineUvs(mesh).overlapping, 0.1);
    mesh.parts.back().expanded = true;
    EXPECT_LT(examineUvs(mesh).overlapping, 0.1);
}
