#include "tests/mesh/files.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Gltf = SceneFiles;

/// Views: 0 positions of a triangle (36 bytes), 1 indices 0 1 2 as uint16 (6, padded to 8), 2 UVs (24). Accessors likewise.
std::string triangleBinary() {
    std::string binary;
    append(binary, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    append(binary, std::vector<std::uint16_t>{0, 1, 2, 0});
    append(binary, std::vector<float>{0, 1, 1, 1, 0, 0});
    return binary;
}

struct Parts {
    std::string asset = R"({"version":"2.0"})";
    std::string primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1})";
    std::string nodes = R"([{"mesh":0}])";
    std::string position = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
    std::string index = R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"})";
    std::string buffer = R"({"byteLength":68})";
    std::string more; // further members of the root
};

std::string json(const Parts& p) {
    return R"({"asset":)" + p.asset + R"(,"nodes":)" + p.nodes + R"(,"meshes":[{"name":"m","primitives":[)" + p.primitive +
           R"(]}],"accessors":[)" + p.position + "," + p.index + R"(,{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],)" +
           R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},{"buffer":0,"byteOffset":44,"byteLength":24}],)" +
           R"("buffers":[)" + p.buffer + "]" + p.more + "}";
}

std::string triangle(const Parts& parts = {}) {
    return glb(json(parts), triangleBinary());
}

const MeshOptions kMillimetres{.unitMm = 1};

glm::vec3 corner(const Mesh& mesh, std::size_t i) {
    return mesh.positions[mesh.indices[i]];
}

} // namespace

TEST_F(Gltf, metres_become_millimetres) {
    const auto mesh = load("a.glb", triangle());
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->unitMm, 1000);
    EXPECT_EQ(corner(*mesh, 1), glm::vec3(1000, 0, 0));
    EXPECT_EQ(mesh->uvs[mesh->indices[0]], glm::vec2(0, 1)) << "v points down in glTF, as here";
}

TEST_F(Gltf, node_transforms_are_applied_from_the_root_down) {
    Parts parts;
    parts.nodes =
        R"([{"children":[1],"translation":[10,0,0]},{"mesh":0,"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,2,2]}])";
    const auto mesh = load("a.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_LT(glm::distance(corner(*mesh, 1), glm::vec3(10, 2, 0)), 1e-6f);
    EXPECT_LT(glm::distance(corner(*mesh, 2), glm::vec3(8, 0, 0)), 1e-6f);
}

TEST_F(Gltf, a_matrix_node_is_column_major) {
    Parts parts;
    parts.nodes = R"([{"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])";
    const auto mesh = load("a.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(corner(*mesh, 0), glm::vec3(5, 6, 7));
}

TEST_F(Gltf, a_mirroring_node_turns_the_winding_so_that_the_normal_stays_outside) {
    Parts parts;
    parts.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
    const auto mesh = load("a.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->normals[0], glm::vec3(0, 0, 1));
}

TEST_F(Gltf, only_the_default_scene_is_read) {
    Parts parts;
    parts.nodes = R"([{"mesh":0},{"mesh":0,"translation":[5,0,0]}])";
    parts.more = R"(,"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])";
    const auto mesh = load("a.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3u);
    EXPECT_EQ(corner(*mesh, 0), glm::vec3(5, 0, 0));
}

TEST_F(Gltf, primitives_become_parts_and_share_vertices_where_they_share_accessors) {
    Parts parts;
    parts.primitive =
        R"({"attributes":{"POSITION":0},"indices":1,"material":0},{"attributes":{"POSITION":0},"indices":1,"extras":{"name":"eye"}})";
    parts.more = R"(,"materials":[{"name":"skin"}])";
    const auto mesh = load("a.glb", triangle(parts));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->positions.size(), 3u);
    ASSERT_EQ(mesh->parts.size(), 2u);
    EXPECT_EQ(mesh->parts[0].name, "skin");
    EXPECT_EQ(mesh->parts[1].name, "eye");
    EXPECT_EQ(mesh->parts[1].firstIndex, 3u);
}

TEST_F(Gltf, strips_and_fans_keep_their_winding) {
    std::string binary;
    append(binary, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    for (const char* mode : {"5", "6"}) {
        const std::string text =
            std::string(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"mode":)") + mode +
            R"(,"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],)"
            R"("bufferViews":[{"buffer":0,"byteLength":48}],"buffers":[{"byteLength":48}]})";
        const auto mesh = load("a.glb", glb(text, binary), kMillimetres);
        ASSERT_TRUE(mesh) << format(mesh.error());
        const glm::vec3 a = corner(*mesh, 3), b = corner(*mesh, 4), c = corner(*mesh, 5);
        EXPECT_EQ(glm::cross(corner(*mesh, 1) - corner(*mesh, 0), corner(*mesh, 2) - corner(*mesh, 0)).z, 1);
        EXPECT_EQ(glm::cross(b - a, c - a).z, mode[0] == '5' ? 1 : -1) << "these four points as a fan fold back";
    }
}

TEST_F(Gltf, normalised_integers_and_sparse_values_are_read) {
    std::string binary;
    append(binary, std::vector<std::uint8_t>{0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0}); // three VEC3 of bytes, stride 4
    append(binary, std::vector<std::uint16_t>{2, 0});                                  // element 2 is replaced
    append(binary, std::vector<std::uint8_t>{0, 51, 255, 0});
    const std::string text = R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5121,"normalized":true,"count":3,"type":"VEC3",
                      "sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}}}],
        "bufferViews":[{"buffer":0,"byteLength":12,"byteStride":4},{"buffer":0,"byteOffset":12,"byteLength":2},{"buffer":0,"byteOffset":16,"byteLength":3}],
        "buffers":[{"byteLength":20}]})";
    const auto mesh = load("a.glb", glb(text, binary), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(corner(*mesh, 1), glm::vec3(1, 0, 0));
    EXPECT_EQ(corner(*mesh, 2), glm::vec3(0, 0.2f, 1));
}

TEST_F(Gltf, external_and_data_buffers_are_read) {
    write("a b.bin", triangleBinary());
    Parts parts;
    parts.buffer = R"({"byteLength":68,"uri":"a%20b.bin"})";
    const auto external = load("a.gltf", json(parts), kMillimetres);
    ASSERT_TRUE(external) << format(external.error());
    EXPECT_EQ(corner(*external, 1), glm::vec3(1, 0, 0));

    // the nine bytes 0 0 0, 1 0 0, 0 1 0 in base64
    const std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5121,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":9}],
        "buffers":[{"byteLength":9,"uri":"data:application/octet-stream;base64,AAAAAQAAAAEA"}]})";
    const auto embedded = load("b.gltf", text, kMillimetres);
    ASSERT_TRUE(embedded) << format(embedded.error());
    EXPECT_EQ(corner(*embedded, 1), glm::vec3(1, 0, 0));
    EXPECT_EQ(corner(*embedded, 2), glm::vec3(0, 1, 0));
}

TEST_F(Gltf, textures_are_found_by_role_embedded_and_beside_the_file) {
    const Image red{.width = 1, .height = 1, .channels = 3, .pixels = {1, 0, 0}, .bitsPerChannel = 8};
    const auto png = encodePng(red, PngEncoding::Raw);
    ASSERT_TRUE(png);
    write("red.png", *png);
    std::string binary = triangleBinary();
    const std::size_t at = binary.size();
    binary += *png;
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})";
    parts.buffer = R"({"byteLength":)" + std::to_string(binary.size()) + "}";
    parts.more = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"normalTexture":{"index":1},
        "extras":{"tegumentTextures":{"kernelSize":1}}}],"textures":[{"source":0},{"source":1}],"images":[{"uri":"red.png"},{"bufferView":3}])";
    std::string text = json(parts);
    text.replace(text.find(R"(],"buffers")"), 1,
                 R"(,{"buffer":0,"byteOffset":)" + std::to_string(at) + R"(,"byteLength":)" + std::to_string(png->size()) + "}]");
    const auto mesh = load("a.glb", glb(text, binary));
    ASSERT_TRUE(mesh) << format(mesh.error());
    std::string roles;
    for (const EmbeddedTexture& texture : mesh->textures) {
        roles += texture.role + " ";
        EXPECT_EQ(texture.image.pixels, red.pixels);
    }
    EXPECT_EQ(roles, "color normal kernelSize ");
}

TEST_F(Gltf, a_second_texture_of_a_role_is_ignored_with_a_warning_where_coordinates_must_stay) {
    const auto png = encodePng({.width = 1, .height = 1, .channels = 3, .pixels = {1, 0, 0}}, PngEncoding::Raw);
    ASSERT_TRUE(png);
    write("red.png", *png);
    write("other.png", *png);
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0},)"
                      R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":1})";
    const std::string pictures = R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"red.png"},{"uri":"other.png"}])";
    for (const auto& [second, own] : {std::pair(R"({"normalTexture":{"index":1}})", true), // as the caller asks
                                      std::pair(R"({"extras":{"tegumentTextures":{"normal":1,"shine":0}}})", false)}) {
        parts.more = R"(,"materials":[{"normalTexture":{"index":0}},)" + std::string(second) + "]," + pictures;
        const auto mesh = load("a.glb", triangle(parts), {.ownCoordinates = own});
        ASSERT_TRUE(mesh) << format(mesh.error());
        EXPECT_EQ(mesh->textures.size(), own ? 1U : 2U);
        EXPECT_TRUE(hasWarning(*mesh, 5326));
        EXPECT_EQ(mesh->uvs[mesh->indices[1]], glm::vec2(1, 1));
    }
}

TEST_F(Gltf, materials_of_several_pictures_and_colours_are_laid_out_in_one_sheet) {
    const auto picture = [&](const std::string& name, int side, const std::vector<float>& colour) {
        Image image{.width = side, .height = side, .channels = 3, .pixels = {}};
        for (int i = 0; i < side * side; ++i)
            image.pixels.insert(image.pixels.end(), colour.begin(), colour.end());
        ASSERT_TRUE(writePng(folder_ / name, image, PngEncoding::Raw));
    };
    picture("red.png", 64, {1, 0, 0});
    picture("blue.png", 16, {0, 0, 1});
    picture("bump.png", 32, {1, 0.5F, 0.5F});
    Parts parts;
    parts.primitive.clear();
    for (const char* material : {R"(,"material":0)", R"(,"material":1)", R"(,"material":2)", R"(,"material":3)", "", R"(,"material":0)"})
        parts.primitive += (parts.primitive.empty() ? "" : ",") +
                           std::string(R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1)") + material + "}";
    parts.more =
        R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}},"normalTexture":{"index":2}},)"
        R"({"pbrMetallicRoughness":{"baseColorFactor":[0,1,0,1]}},)"
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0.25,1,1,1]}}],)"
        R"("textures":[{"source":0},{"source":1},{"source":2}],"images":[{"uri":"red.png"},{"uri":"blue.png"},{"uri":"bump.png"}])";
    const auto mesh = load("a.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    ASSERT_EQ(mesh->parts.size(), 6U);
    ASSERT_EQ(mesh->textures.size(), 2U);
    const auto seen = [&](std::size_t part, std::size_t role) {
        const Image& sheet = mesh->textures[role].image;
        const std::uint32_t* t = &mesh->indices[mesh->parts[part].firstIndex];
        const glm::vec2 middle = (mesh->uvs[t[0]] + mesh->uvs[t[1]] + mesh->uvs[t[2]]) / 3.0F;
        const glm::ivec2 texel = middle * glm::vec2(sheet.width, sheet.height);
        return glm::vec3(sheet.at(texel.x, texel.y, 0), sheet.at(texel.x, texel.y, 1), sheet.at(texel.x, texel.y, 2));
    };
    const float quarter = linearToSrgb(0.25F);
    const std::vector<glm::vec3> colours = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {quarter, 0, 0}, {1, 1, 1}, {1, 0, 0}};
    for (std::size_t part = 0; part < colours.size(); ++part) {
        EXPECT_LT(glm::length(seen(part, 0) - colours[part]), 1e-3F) << part;
        const glm::vec3 flat(0.5F, 0.5F, 1), bump(1, 0.5F, 0.5F);
        EXPECT_LT(glm::length(seen(part, 1) - (part == 1 ? bump : flat)), 5e-3F) << part;
    }
    EXPECT_EQ(mesh->uvs[mesh->indices[0]], mesh->uvs[mesh->indices[mesh->parts[5].firstIndex]]) << "a material has one place";
    parts.more.replace(parts.more.find(R"({"source":2}])"), 13, R"({"source":2},{"source":0}])");
    parts.more.replace(parts.more.find(R"({"index":0},"baseColorFactor":[0.25,1,1,1])"), 42, R"({"index":3})");
    const auto named = load("b.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(named) << format(named.error());
    EXPECT_EQ(named->uvs[named->indices[0]], named->uvs[named->indices[named->parts[3].firstIndex]]) << "a picture of two textures is one";
    for (const glm::vec2& uv : mesh->uvs)
        EXPECT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
}

TEST_F(Gltf, sheets_of_odd_materials_are_small_or_not_made) {
    ASSERT_TRUE(writePng(folder_ / "dot.png", {.width = 1, .height = 1, .channels = 1, .pixels = {0.5F}}, PngEncoding::Raw));
    for (const int plain : {1, 4, 5, 500}) {
        Parts parts;
        parts.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})";
        parts.more =
            R"(,"textures":[{"source":0}],"images":[{"uri":"dot.png"}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
        for (int i = 1; i <= plain; ++i) {
            parts.primitive += R"(,{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":)" + std::to_string(i) + "}";
            parts.more += R"(,{"pbrMetallicRoughness":{"baseColorFactor":[)" + std::to_string(i / 501.0) + ",0,0,1]}}";
        }
        parts.more += "]";
        const auto mesh = load("a.glb", triangle(parts), kMillimetres);
        ASSERT_TRUE(mesh) << plain << format(mesh.error());
        ASSERT_EQ(mesh->textures.size(), 1U) << plain;
        EXPECT_EQ(mesh->textures[0].image.width > 1, plain <= 4) << plain;
    }
}

TEST_F(Gltf, the_factor_of_a_material_colours_its_picture) {
    ASSERT_TRUE(writePng(folder_ / "white.png", {.width = 1, .height = 1, .channels = 3, .pixels = {1, 1, 1}}, PngEncoding::Raw));
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})";
    parts.more = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0.5,1,0,1]}}],)"
                 R"("textures":[{"source":0}],"images":[{"uri":"white.png"}])";
    const auto mesh = load("a.glb", triangle(parts), kMillimetres);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_NEAR(mesh->textures.at(0).image.at(0, 0, 0), linearToSrgb(0.5F), 1e-6);
    EXPECT_NEAR(mesh->textures[0].image.at(0, 0, 1), 1, 1e-6);
    EXPECT_EQ(mesh->textures[0].image.at(0, 0, 2), 0);
}

TEST_F(Gltf, a_missing_texture_file_is_a_warning_that_names_it) {
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})";
    parts.more = R"(,"materials":[{"normalTexture":{"index":0}}],"textures":[{"source":0}],"images":[{"uri":"gone.png"}])";
    const auto mesh = load("a.glb", triangle(parts));
    ASSERT_TRUE(mesh) << format(mesh.error());
    const auto told = std::ranges::find(mesh->warnings, 5328, &Diagnostic::code);
    ASSERT_NE(told, mesh->warnings.end());
    EXPECT_NE(told->text.find("gone.png"), std::string::npos);
}

TEST_F(Gltf, every_truncation_is_one_error_with_the_byte) {
    const std::string whole = triangle();
    for (std::size_t size = 4; size < whole.size(); ++size) {
        const auto mesh = load("a.glb", whole.substr(0, size));
        ASSERT_EQ(codeOf(mesh), 5301) << size;
        EXPECT_EQ(mesh.error().diagnostics.front().at.byte, size);
    }
}

TEST_F(Gltf, chunks_that_claim_more_than_is_there_are_refused) {
    std::string bytes = triangle();
    bytes[12] = '\xff'; // the JSON chunk's length
    bytes[15] = '\x7f';
    EXPECT_EQ(codeOf(load("a.glb", bytes)), 5303);
}

TEST_F(Gltf, broken_json_names_the_byte) {
    const auto mesh = load("a.glb", glb(R"({"asset":{"version":"2.0"},,})", ""));
    ASSERT_EQ(codeOf(mesh), 5302);
    EXPECT_EQ(mesh.error().diagnostics.front().at.byte, 20u + 28u);
}

TEST_F(Gltf, json_nested_without_end_is_refused_without_a_crash) {
    const std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(300000, '[') + std::string(300000, ']') + "}";
    EXPECT_EQ(codeOf(load("a.glb", glb(deep, ""))), 5306) << "legal, but there is no mesh in it";
}

TEST_F(Gltf, hostile_numbers_are_refused) {
    const auto with = [](std::string Parts::*member, std::string value) {
        Parts parts;
        parts.*member = std::move(value);
        return triangle(parts);
    };
    const struct {
        std::string bytes;
        int code;
    } cases[] = {
        {with(&Parts::position, R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})"), 5303},
        {with(&Parts::position, R"({"bufferView":0,"componentType":5126,"count":200000000,"type":"VEC3"})"), 5303},
        {with(&Parts::position, R"({"bufferView":0,"componentType":5126,"count":1e300,"type":"VEC3"})"), 5302},
        {with(&Parts::position, R"({"bufferView":0,"componentType":5126,"count":-3,"type":"VEC3"})"), 5302},
        {with(&Parts::position, R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC3"})"), 5303},
        {with(&Parts::position, R"({"bufferView":0,"byteOffset":4000,"componentType":5126,"count":3,"type":"VEC3"})"), 5302},
        {with(&Parts::position, R"({"bufferView":9,"componentType":5126,"count":3,"type":"VEC3"})"), 5302},
        {with(&Parts::position, R"({"bufferView":0,"componentType":1,"count":3,"type":"VEC3"})"), 5302},
        {with(&Parts::position, R"({"bufferView":0,"componentType":5126,"count":3,"type":"MAT4"})"), 5302},
        {with(&Parts::position, R"({"componentType":5126,"count":100000000,"type":"VEC3"})"), 5303},        // zeros cost no bytes
        {with(&Parts::position, R"({"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"})"), 5302}, // fewer than UVs
        {with(&Parts::index, R"({"bufferView":1,"componentType":5126,"count":1,"type":"SCALAR"})"), 5302},
        {with(&Parts::index, R"({"bufferView":0,"byteOffset":12,"componentType":5125,"count":3,"type":"SCALAR"})"), 5304},
        {with(&Parts::primitive, R"({"attributes":{"POSITION":7}})"), 5302},
        {with(&Parts::primitive, R"({"attributes":{}})"), 5302},
        {with(&Parts::primitive, R"({"attributes":{"POSITION":0},"mode":99})"), 5302},
        {with(&Parts::primitive, R"({"attributes":{"POSITION":0},"mode":1})"), 5306},
        {with(&Parts::primitive, R"({"attributes":{"POSITION":0},"material":3})"), 5302},
        {with(&Parts::nodes, R"([{"mesh":0,"children":[0]}])"), 5306}, // no root
        {with(&Parts::nodes, R"([{"children":[1]},{"children":[2],"mesh":0},{"children":[1]}])"), 5302},
        {with(&Parts::nodes, R"([{"mesh":0,"scale":[1,2]}])"), 5302},
        {with(&Parts::nodes, R"([{"mesh":0,"rotation":[0,0,0,0]}])"), 5302},
        {with(&Parts::nodes, R"([{"mesh":0,"scale":[1e38,1e38,1e38]}])"), 5305},
        {with(&Parts::nodes, R"([{"mesh":5}])"), 5302},
        {with(&Parts::buffer, R"({"byteLength":69})"), 5303},
        {with(&Parts::buffer, R"({"byteLength":68},{"byteLength":1})"), 5302},
        {with(&Parts::buffer, R"({"byteLength":68,"uri":"https://example.org/a.bin"})"), 5302},
        {with(&Parts::buffer, R"({"byteLength":68,"uri":"data:;base64,****"})"), 5302},
        {with(&Parts::asset, R"({"version":"1.0"})"), 5307},
        {with(&Parts::more, R"(,"extensionsRequired":["ACME_spheres"])"), 5307},
    };
    for (std::size_t i = 0; i < std::size(cases); ++i)
        EXPECT_EQ(codeOf(load("a.glb", cases[i].bytes)), cases[i].code) << "case " << i;
}

TEST_F(Gltf, required_extensions_of_looks_alone_do_not_keep_the_shape_back) {
    for (const char* name : {"KHR_materials_unlit", "KHR_techniques_webgl", "KHR_technique_webgl"}) {
        Parts parts;
        parts.more = std::string(R"(,"extensionsRequired":[")") + name + "\"]";
        EXPECT_EQ(codeOf(load("a.glb", triangle(parts))), 0) << name;
    }
}

TEST_F(Gltf, a_position_that_is_not_finite_is_refused) {
    std::string binary = triangleBinary();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(binary.data() + 4, &nan, sizeof nan);
    EXPECT_EQ(codeOf(load("a.glb", glb(json({}), binary))), 5305);
}

TEST_F(Gltf, one_primitive_drawn_by_many_nodes_cannot_exhaust_memory) {
    // 65,536 vertices as zeros from a sparse accessor without data, drawn by 1,100 nodes: more than 2^26
    std::string nodes = "[";
    for (int i = 0; i < 1100; ++i)
        nodes += std::string(i ? "," : "") + R"({"mesh":0})";
    Parts parts;
    parts.nodes = nodes + "]";
    parts.primitive = R"({"attributes":{"POSITION":0}})";
    parts.position = R"({"componentType":5126,"count":65536,"type":"VEC3"})";
    std::string binary = triangleBinary();
    binary.resize(70000);
    EXPECT_EQ(codeOf(load("a.glb", glb(json(parts), binary))), 5310);
}

TEST_F(Gltf, meshes_to_which_no_node_refers_are_read_with_a_warning) {
    for (const char* nodes : {"[]", R"([{"name":"empty"}])", R"([{"children":[1]},{"translation":[1,2,3]}])"}) {
        Parts parts;
        parts.nodes = nodes;
        const auto mesh = load("a.glb", triangle(parts), kMillimetres);
        ASSERT_TRUE(mesh) << nodes << format(mesh.error());
        EXPECT_EQ(mesh->indices.size(), 3U);
        EXPECT_TRUE(hasWarning(*mesh, 5323)) << nodes;
    }
    EXPECT_FALSE(hasWarning(*load("a.glb", triangle(), kMillimetres), 5323));
}

TEST_F(Gltf, the_greatest_index_begins_a_strip_anew) {
    constexpr int kTriangles = 4, kStrip = 5, kFan = 6;
    const auto file = [&](int mode, int type) { // of the greatest index: bytes, 16 bits, 32 bits
        std::string binary;
        append(binary, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0});
        const std::vector<std::uint32_t> indices = {0, 1, 2, 3, UINT32_MAX, 4, 5, 6};
        if (type == 5121) append(binary, std::vector<std::uint8_t>(indices.begin(), indices.end()));
        if (type == 5123) append(binary, std::vector<std::uint16_t>(indices.begin(), indices.end()));
        if (type == 5125) append(binary, indices);
        const std::string size = std::to_string(binary.size() - 84);
        return glb(
            R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_mesh_primitive_restart"],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
            R"({"attributes":{"POSITION":0},"indices":1,"mode":)" +
                std::to_string(mode) +
                R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":7,"type":"VEC3"},{"bufferView":1,"componentType":)" +
                std::to_string(type) +
                R"(,"count":8,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":84},{"buffer":0,"byteOffset":84,"byteLength":)" +
                size + R"(}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) + "}]}",
            binary);
    };
    for (const int type : {5121, 5123, 5125}) {
        for (const int mode : {kStrip, kFan}) {
            const auto mesh = load("a.glb", file(mode, type), kMillimetres);
            ASSERT_TRUE(mesh) << mode << " " << type << format(mesh.error());
            EXPECT_EQ(mesh->indices.size(), 9U) << "two triangles, and one";
        }
        EXPECT_EQ(codeOf(load("a.glb", file(kTriangles, type), kMillimetres)), 5304) << "triangles need no beginning";
    }
}

TEST_F(Gltf, a_header_of_no_length_is_named) {
    const auto expect = [&](const std::string& bytes, const char* what) {
        const auto whole = load("a.glb", bytes);
        ASSERT_EQ(codeOf(whole), 5302) << what;
        EXPECT_NE(format(whole.error()).find(what), std::string::npos) << format(whole.error());
    };
    const auto with = [](std::size_t at, int byte) {
        std::string bytes = triangle();
        std::memset(bytes.data() + at, byte, 4);
        return bytes;
    };
    expect(with(8, 0), "announces 0 bytes");
    expect(with(12, 0), "JSON chunk, or one of length 0");
    expect(with(16, 'X'), "no JSON chunk"); // a chunk of another name
}

TEST_F(Gltf, coordinates_are_those_that_the_colour_map_is_read_with) {
    const auto with = [&](const std::string& texture) {
        Parts parts;
        parts.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":3},"indices":1,"material":0})";
        parts.index += R"(,{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"})"; // pushes the others behind it: 2 and 3
        parts.more = R"(,"textures":[{}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":)" + texture + "}}]";
        return load("a.glb", triangle(parts), kMillimetres);
    };
    const struct {
        const char* texture;
        glm::vec2 first, second; // of (0, 1) and (1, 1)
    } cases[] = {
        {R"({"index":0})", {0, 1}, {1, 1}},
        {R"({"index":0,"texCoord":1})", {0, 1}, {1, 1}},
        {R"({"index":0,"extensions":{"KHR_texture_transform":{"scale":[0.5,0.25]}}})", {0, 0.25F}, {0.5F, 0.25F}},
        {R"({"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.25,0.5],"scale":[0.5,0.5],"texCoord":1}}})",
         {0.25F, 1},
         {0.75F, 1}},
        {R"({"index":0,"extensions":{"KHR_texture_transform":{"rotation":1.5707963267948966,"offset":[0,1]}}})", {1, 1}, {1, 0}},
    };
    for (const auto& one : cases) {
        const auto mesh = with(one.texture);
        ASSERT_TRUE(mesh) << one.texture << format(mesh.error());
        EXPECT_LT(glm::length(mesh->uvs[mesh->indices[0]] - one.first), 1e-6F) << one.texture;
        EXPECT_LT(glm::length(mesh->uvs[mesh->indices[1]] - one.second), 1e-6F) << one.texture;
        EXPECT_FALSE(hasWarning(*mesh, 5323)) << one.texture;
    }
}

TEST_F(Gltf, pictures_go_on_beyond_their_edges_as_their_samplers_say) {
    ASSERT_TRUE(writePng(folder_ / "two.png", {.width = 2, .height = 1, .channels = 3, .pixels = {1, 0, 0, 0, 0, 1}}, PngEncoding::Raw));
    constexpr int kRepeat = 10497, kMirror = 33648, kClamp = 33071;
    for (const int wrap : {kRepeat, kMirror, kClamp}) {
        Parts parts;
        parts.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})";
        parts.more = R"(,"images":[{"uri":"two.png"}],"samplers":[{"wrapS":)" + std::to_string(wrap) +
                     R"(}],"textures":[{"source":0,"sampler":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
                     R"("extensions":{"KHR_texture_transform":{"offset":[-2,0],"scale":[5,1]}}}}}])";
        const auto mesh = load("a.glb", triangle(parts), kMillimetres);
        ASSERT_TRUE(mesh) << wrap << format(mesh.error());
        ASSERT_EQ(mesh->textures.size(), 1U) << wrap;
        const Image& picture = mesh->textures[0].image;
        const float first = mesh->uvs[mesh->indices[0]].x, second = mesh->uvs[mesh->indices[1]].x; // -2 and 3 in the file
        for (double u = -1.95; u < 3; u += 0.1) {
            const double tile = std::floor(u), within = u - tile;
            bool red = within < 0.5;
            if (wrap == kMirror && std::fmod(std::abs(tile), 2) == 1) red = !red;
            if (wrap == kClamp && tile != 0) red = tile < 0;
            const double drawn = std::lerp(static_cast<double>(first), static_cast<double>(second), (u + 2) / 5);
            const auto texel = static_cast<int>((drawn - std::floor(drawn)) * picture.width);
            EXPECT_EQ(picture.at(texel, 0, 0), red ? 1 : 0) << wrap << ", u " << u;
        }
    }
}
