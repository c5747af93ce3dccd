#include "host/mesh/read_mesh.h"
#include "tests/mesh/files.h"

#include <algorithm>
#include <array>
#include <bit>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Ply = SceneFiles;

constexpr std::string_view kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
constexpr std::string_view kFaces = "element face 2\nproperty list uchar int vertex_indices\n";

std::string header(std::string_view format, std::string_view elements) {
    return "ply\nformat " + std::string(format) + " 1.0\n" + std::string(elements) + "end_header\n";
}

std::string header(std::string_view format) {
    return header(format, std::string(kVertices) + std::string(kFaces));
}

template <class T>
void put(std::string& bytes, T value, bool swap) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (swap) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
}

/// A unit square of two triangles.
std::string binarySquare(bool big) {
    std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian");
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
        put(bytes, value, big);
    for (const std::array<int, 3>& face : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        put(bytes, static_cast<unsigned char>(3), big);
        for (const int index : face)
            put(bytes, index, big);
    }
    return bytes;
}

const std::string kSquareText = header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

} // namespace

TEST_F(Ply, text_and_both_byte_orders_give_the_same_mesh) {
    const auto text = load("a.ply", kSquareText);
    const auto little = load("b.ply", binarySquare(false));
    const auto big = load("c.ply", binarySquare(true));
    ASSERT_TRUE(text) << format(text.error());
    ASSERT_TRUE(little) << format(little.error());
    ASSERT_TRUE(big) << format(big.error());
    EXPECT_EQ(text->positions, little->positions);
    EXPECT_EQ(text->positions, big->positions);
    EXPECT_EQ(text->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(text->indices, little->indices);
    EXPECT_EQ(text->indices, big->indices);
}

TEST_F(Ply, quads_become_fans_and_normals_and_uvs_are_read) {
    const auto mesh =
        load("a.ply", header("ascii", "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\n"
                                      "property float ny\nproperty float nz\nproperty float s\nproperty float t\n"
                                      "element face 1\nproperty list uint8 uint32 vertex_index\n") +
                          "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 1 0 1\n4 0 1 2 3\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 6u);
    EXPECT_EQ(mesh->normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh->uvs[0], glm::vec2(0, 1)); // t points up in the file
}

TEST_F(Ply, faces_may_come_first_and_other_elements_and_properties_anywhere) {
    const auto mesh =
        load("a.ply", "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info x\r\nelement face 1\r\nproperty uchar red\r\n"
                      "property list uchar int vertex_indices\r\nproperty list uchar float texcoord\r\nelement edge 1\r\n"
                      "property int vertex1\r\nproperty int vertex2\r\nelement vertex 3\r\nproperty float quality\r\nproperty float x\r\n"
                      "property float y\r\nproperty float z\r\nend_header\r\n"
                      "7 3 0 1 2 2 .5 .5\r\n0 1\r\n9 0 0 0\r\n9 1 0 0\r\n9 0 1 0\r\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3u);
    EXPECT_EQ(mesh->positions[1], glm::vec3(1, 0, 0));
}

TEST_F(Ply, faces_of_fewer_than_three_corners_are_left_out_with_a_count) {
    const auto mesh = load("a.ply", header("ascii", std::string(kVertices) + "element face 4\nproperty list uchar int vertex_indices\n") +
                                        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0\n1 0\n2 0 1\n3 0 1 2\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3u);
    EXPECT_TRUE(hasWarning(*mesh, 5322));
}

TEST_F(Ply, bad_headers_are_named_by_line) {
    const std::vector<Fault> faults = {
        {"ply\nformat ascii 1.0\nelement vertex -4\nend_header\n", 5302, 3},
        {"ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
         5303, 3},
        {header("binary_little_endian", "element face 2000000000\nproperty list uchar int vertex_indices\n") + "xxxx", 5303, 3},
        {"ply\nformat ascii 1.0\nelement vertex 18446744073709551615\nproperty double x\nend_header\n", 5303, 3},
        {"ply\nformat morse 1.0\nend_header\n", 5302, 2},
        {"ply\nelement vertex 0\nend_header\n", 5302, 2},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", 5302, 3},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty quaternion x\nend_header\n", 5302, 4},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n", 5302, 4},
        {"ply\nformat ascii 1.0\nelement face 0\nelements\nend_header\n", 5302, 4},
        {header("ascii", "element vertex 1\nproperty float x\n") + "0\n", 5302, 3}, // no y and z
        {header("ascii", std::string(kVertices) + "element face 1\nproperty int x\n") + "0 0 0 0 0 0 0 0 0 0 0 0 5\n", 5302, 7},
    };
    expectFaults("a.ply", faults);
}

TEST_F(Ply, a_comment_in_several_lines_is_told_and_the_mesh_is_read) {
    std::string text = header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
    text.insert(text.find("element"), "Created by a program, source file:\nhead.blend\n");
    const auto mesh = load("a.ply", text);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 6U);
    ASSERT_TRUE(hasWarning(*mesh, 5323));
    EXPECT_EQ(mesh->warnings[0].at.line, 3);
}

TEST_F(Ply, faces_of_more_values_than_declared_are_told_and_read) {
    const std::string four = header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const auto mesh = load("a.ply", four + "3 0 1 2 9 1 1 .5\n3 0 2 3 9 1 1 .5\n\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_TRUE(hasWarning(*mesh, 5323));
    const auto wrapped = load("a.ply", four + "3 0 1\n2 3 0\n2 3\n");
    ASSERT_TRUE(wrapped) << "rows that end elsewhere than lines" << format(wrapped.error());
    EXPECT_EQ(wrapped->indices, mesh->indices);
    EXPECT_FALSE(hasWarning(*wrapped, 5323));
}

TEST_F(Ply, bad_data_is_one_error) {
    const std::string four = header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    EXPECT_EQ(codeOf(load("a.ply", four + "3 0 1 2\n3 0 2 4\n")), 5304);
    EXPECT_EQ(codeOf(load("a.ply", four + "3 0 1 2\n3 0 2 -1\n")), 5304);
    EXPECT_EQ(codeOf(load("a.ply", four + "3 0 1 2\n3 0 2 1.5\n")), 5302);
    EXPECT_EQ(codeOf(load("a.ply", four + "3 0 1 2\n200 0 2 3\n")), 5303);
    EXPECT_EQ(codeOf(load("a.ply", four + "3 0 1 2\n-3 0 2 3\n")), 5303);
    EXPECT_EQ(codeOf(load("a.ply", header("ascii") + "0 0 nan\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")), 5305);
    EXPECT_EQ(codeOf(load("a.ply", header("ascii") + "0 0 0,5\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")), 5302);
    EXPECT_EQ(codeOf(load("a.ply", four + "2 0 1\n2 0 1\n")), 5306);
}

TEST_F(Ply, an_index_error_names_the_face) {
    const auto mesh = load("a.ply", header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 7\n");
    ASSERT_FALSE(mesh);
    EXPECT_NE(format(mesh.error()).find("face 1 refers to vertex 7 of 4"), std::string::npos) << format(mesh.error());
}

TEST_F(Ply, every_truncation_is_an_error) {
    const std::string binary = binarySquare(false);
    for (std::size_t size = 0; size < binary.size(); ++size)
        EXPECT_FALSE(load("a.ply", binary.substr(0, size))) << size;
    for (std::size_t size = 0; size + 2 < kSquareText.size(); ++size) // the last line is whole without its line end
        EXPECT_FALSE(load("a.ply", kSquareText.substr(0, size))) << size;
}

TEST_F(Ply, a_truncated_binary_names_the_byte) {
    const std::string binary = binarySquare(false);
    const auto mesh = load("a.ply", binary.substr(0, binary.size() - 5));
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().diagnostics.front().at.byte, binary.size() - 12) << "behind the length of the list that is cut";
    EXPECT_NE(format(mesh.error()).find("3 entries, but only 7 bytes are left"), std::string::npos) << format(mesh.error());
}

namespace {

/// Two triangles of a square that meet at a seam of texture coordinates, as MeshLab writes them.
std::string wedged(const std::string& comments, const std::string& second = "6 0.9 0.1 0.9 0.9 0.6 0.9") {
    return "ply\nformat ascii 1.0\n" + comments +
           "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nproperty float quality\nelement face 2\nproperty list uchar int vertex_indices\n"
           "property list uchar float texcoord\nproperty int texnumber\nend_header\n0 0 0 255 0 0 1\n90 0 0 0 255 0 2\n90 90 0 0 0 255 3\n"
           "0 90 0 9 9 9 4\n3 0 1 2 6 0 0 0.5 0 0.5 0.5 0\n3 0 2 3 " +
           second + " 0\n";
}

} // namespace

TEST_F(Ply, texture_coordinates_of_corners_split_vertices_at_seams_only) {
    const auto mesh = load("a.ply", wedged(""));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->positions.size(), 6U) << "two corners lie on the seam";
    ASSERT_EQ(mesh->uvs.size(), 6U);
    ASSERT_EQ(mesh->colors.size(), 6U);
    const auto cornerAt = [&](std::size_t i) { return mesh->indices[i]; };
    EXPECT_EQ(mesh->uvs[cornerAt(1)], glm::vec2(0.5F, 1)) << "v points up in the file";
    EXPECT_EQ(mesh->uvs[cornerAt(3)], glm::vec2(0.9F, 1 - 0.1F));
    EXPECT_EQ(mesh->positions[cornerAt(3)], mesh->positions[cornerAt(0)]);
    EXPECT_EQ(mesh->colors[cornerAt(3)], mesh->colors[cornerAt(0)]) << "copies carry what the vertex has";
    ASSERT_EQ(mesh->attributes.size(), 1U);
    EXPECT_EQ(mesh->attributes[0].values[cornerAt(4)], 3);
    EXPECT_TRUE(mesh->warnings.empty());
    EXPECT_EQ(load("b.ply", wedged("", "6 0 0 0.5 0.5 0 0.5"))->positions.size(), 4U) << "no seam";
}

TEST_F(Ply, copies_at_seams_are_no_vertices_that_a_face_may_refer_to) {
    std::string bad = wedged("");
    bad.replace(bad.find("face 2"), 6, "face 3");
    const auto mesh = load("a.ply", bad + "3 0 1 5 6 0 0 0 0 0 0 0\n");
    ASSERT_FALSE(mesh) << "the seam has made six of four";
    EXPECT_NE(format(mesh.error()).find("face 2 refers to vertex 5 of 4"), std::string::npos) << format(mesh.error());
}

TEST_F(Ply, faces_of_two_elements_split_vertices_once) {
    std::string twice = wedged("");
    twice.replace(twice.find("end_header"), 0,
                  "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n");
    const auto mesh = load("a.ply", twice + "3 0 2 3 6 0.9 0.1 0.9 0.9 0.6 0.9\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->positions.size(), 6U) << "the last face is the one before again";
}

TEST_F(Ply, corners_without_texture_coordinates_among_others_are_told) {
    const auto mesh = load("a.ply", wedged("", "0"));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->positions.size(), 4U);
    EXPECT_TRUE(std::ranges::any_of(mesh->warnings, [](const Diagnostic& warning) { return warning.code == 5325; }));
}

TEST_F(Ply, the_picture_that_a_comment_names_is_the_colour_map) {
    ASSERT_TRUE(writePng(folder_ / "my scan.png", {.width = 1, .height = 1, .channels = 3, .pixels = {1, 0, 0}}, PngEncoding::Raw));
    for (const char* name : {"my scan.png", "C:\\scans\\My Scan.PNG"}) {
        const auto mesh = load("a.ply", wedged(std::string("comment TextureFile ") + name + "\n"));
        ASSERT_TRUE(mesh);
        ASSERT_EQ(mesh->textures.size(), 1U) << name;
        EXPECT_EQ(mesh->textures[0].role, "color");
        const auto carried = readMesh(folder_ / "a.ply", {.carryMaterials = true});
        ASSERT_TRUE(carried);
        EXPECT_EQ(carried->mesh.materials.images.size(), 1U) << "prepared meshes keep it";
        EXPECT_TRUE(carried->mesh.parts.front().material.has_value());
    }
    const auto gone = load("a.ply", wedged("comment TextureFile gone.png\ncomment TextureFile other.png\n"));
    ASSERT_EQ(gone->warnings.size(), 2U);
    EXPECT_EQ(gone->warnings[0].code, 5326);
    EXPECT_EQ(gone->warnings[1].code, 5328);
    EXPECT_NE(gone->warnings[1].text.find("gone.png"), std::string::npos);
}

TEST_F(Ply, names_and_types_that_only_some_programs_use_are_understood) {
    const auto mesh =
        load("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty double X\nproperty double Y\nproperty double Z\n"
                      "property ushort u\nproperty ushort v\nelement face 1\nproperty list uint8 uint32 vertex_list\nend_header\n"
                      "0 0 0 0 0\n90 0 0 65535 0\n0 90 0 0 65535\n3 0 1 2\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3U);
    EXPECT_EQ(mesh->uvs[1], glm::vec2(1, 1));
    EXPECT_EQ(mesh->uvs[2], glm::vec2(0, 0));
    EXPECT_EQ(codeOf(load("b.ply",
                          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                          "property list uchar int a\nproperty list uchar int b\nend_header\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2 1 7\n")),
              5302)
        << "two lists: nobody knows which";
}

TEST_F(Ply, a_row_with_more_values_than_declared_is_named) {
    for (const std::string more : {"255 0 0", "0 0 1 128", "0.5"}) { // colours, a normal and a quality, a weight
        std::string rows;
        for (const char* place : {"0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 "})
            rows += place + more + "\n";
        const auto mesh = load("a.ply", header("ascii") + rows + "3 0 1 2\n3 0 2 3\n");
        ASSERT_EQ(codeOf(mesh), 5302) << more;
        EXPECT_NE(format(mesh.error()).find("'vertex'"), std::string::npos) << format(mesh.error());
        EXPECT_NE(format(mesh.error()).find(more), std::string::npos) << format(mesh.error());
    }
}

TEST_F(Ply, no_numbers_of_old_windows_programs_are_understood) {
    for (const char* number : {"1.#QNAN", "-1.#IND00", "1.#INF", "-1.#INF000", "1.#SNAN"}) {
        const std::string text = header("ascii") + "0 0 " + number + "\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
        EXPECT_EQ(codeOf(load("a.ply", text)), 5305) << number << ": not finite, rather than not a number";
    }
    EXPECT_EQ(codeOf(load("a.ply", header("ascii") + "0 0 1.#\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")), 5302);
}

TEST_F(Ply, each_face_has_the_picture_that_its_number_names) {
    const auto picture = [&](const std::string& name, int width, int height, const glm::vec3& colour) {
        Image image{.width = width, .height = height, .channels = 3};
        for (int i = 0; i < width * height; ++i)
            image.pixels.insert(image.pixels.end(), {colour.r, colour.g, colour.b});
        ASSERT_TRUE(writePng(folder_ / name, image, PngEncoding::Raw));
    };
    picture("red.png", 2, 2, {1, 0, 0});
    picture("green.png", 4, 8, {0, 1, 0});
    picture("blue.png", 3, 5, {0, 0, 1});
    const std::vector<std::string> names = {"red.png", "green.png", "blue.png"};
    for (const std::array<int, 2>& of : {std::array<int, 2>{0, 1}, {2, 0}, {1, 2}}) {
        std::string text = "ply\nformat ascii 1.0\n";
        for (const std::string& name : names)
            text += "comment TextureFile " + name + "\n";
        text += "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\nend_header\n"
                "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0.1 0.1 0.9 0.1 0.9 0.9 " +
                std::to_string(of[0]) + "\n3 0 2 3 6 0.1 0.1 0.9 0.9 0.1 0.9 " + std::to_string(of[1]) + "\n";
        const auto mesh = load("a.ply", text);
        ASSERT_TRUE(mesh) << format(mesh.error());
        EXPECT_FALSE(hasWarning(*mesh, 5326));
        ASSERT_EQ(mesh->textures.size(), 1U);
        const Image& sheet = mesh->textures[0].image;
        for (std::size_t face = 0; face < 2; ++face)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const glm::vec2 uv = mesh->uvs[mesh->indices[3 * face + corner]];
                const int x = static_cast<int>(uv.x * static_cast<float>(sheet.width)),
                          y = static_cast<int>(uv.y * static_cast<float>(sheet.height));
                for (int c = 0; c < 3; ++c)
                    EXPECT_EQ(sheet.at(x, y, c), c == of[face] ? 1 : 0) << "face " << face << ", corner " << corner;
            }
    }
}
