// What a file holds is in what is written, or a warning names it.
#include "host/image/image.h"
#include "host/mesh/motion.h"
#include "host/mesh/read_mesh.h"
#include "meshprep/fur/roots/vertex_values.h"
#include "meshprep/write/write_mesh.h"
#include "tests/meshprep/prepare/glb_text.h"
#include "tests/meshprep/prepare/meshes.h"

#include <fmt/format.h>

#include <meshoptimizer.h>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

using namespace tegument;
using namespace tegument::testing_prep;

namespace {

class NothingLost : public PrepFolder {
protected:
    [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        EXPECT_TRUE(writeFile(folder_ / name, bytes));
        return folder_ / name;
    }
    [[nodiscard]] prep::Prepared prepared(const std::filesystem::path& file, const prep::PrepOptions& options = inMillimetres()) const {
        auto result = prep::prepareMesh(file, options);
        if (!result) {
            ADD_FAILURE() << format(result.error());
            return {};
        }
        return std::move(*result);
    }
    static prep::PrepOptions inMillimetres() {
        prep::PrepOptions options;
        options.read.unitMm = 1;
        return options;
    }
    /// Written as glb and found again.
    [[nodiscard]] std::filesystem::path asGlb(const prep::Prepared& result, const std::string& name = "out.glb") const {
        EXPECT_TRUE(writeGlb(folder_ / name, result.mesh, result.glb));
        return folder_ / name;
    }
};

std::size_t warningsOf(const std::vector<Diagnostic>& warnings, int code, const std::string& part = "") {
    return static_cast<std::size_t>(
        std::ranges::count_if(warnings, [&](const Diagnostic& w) { return w.code == code && w.text.find(part) != std::string::npos; }));
}

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        area += glm::length(glm::cross(p(1) - p(0), p(2) - p(0))) / 2;
    }
    return area;
}

constexpr glm::dvec3 kSurvey(448265.123, 5411932.678, 312.5); // metres: zone 32N, near Freudenstadt

/// A terrain of 20 by 20 points, 0.1 units apart, as text in double precision.
std::string survey(const glm::dvec3& place, double step = 0.1, const char* type = "double") {
    std::string vertices;
    std::string faces;
    for (int i = 0; i < 400; ++i) {
        const int row = i / 20;
        vertices += fmt::format("{:.6f} {:.6f} {:.6f}\n", place.x + i % 20 * step, place.y + row * step,
                                place.z + 0.05 * std::sin(i * 0.7) * step / 0.1);
    }
    int count = 0;
    for (int y = 0; y < 19; ++y)
        for (int x = 0; x < 19; ++x, count += 2)
            faces += fmt::format("3 {0} {1} {2}\n3 {1} {3} {2}\n", 20 * y + x, 20 * y + x + 1, 20 * y + x + 20, 20 * y + x + 21);
    return fmt::format("ply\nformat ascii 1.0\nelement vertex 400\nproperty {0} x\nproperty {0} y\nproperty {0} z\nelement face {1}\n"
                       "property list uchar int vertex_indices\nend_header\n{2}{3}",
                       type, count, vertices, faces);
}

} // namespace

TEST_F(NothingLost, a_mesh_far_from_the_origin_keeps_its_shape_and_its_place) {
    prep::PrepOptions options;
    options.read.unitMm = 1000;
    const prep::Prepared near = prepared(write("near.ply", survey(glm::dvec3(0))), options);
    const prep::Prepared far = prepared(write("far.ply", survey(kSurvey)), options);
    ASSERT_EQ(far.mesh.positions.size(), 400u);
    EXPECT_EQ(far.mesh.indices.size(), near.mesh.indices.size());
    std::set<float> heights, rows;
    for (const glm::vec3& p : far.mesh.positions)
        rows.insert(p.y), heights.insert(p.z);
    EXPECT_EQ(rows.size(), 20u) << "distinct rows";
    EXPECT_GT(heights.size(), 390u);
    // the file's six decimals are a thousandth of a millimetre
    EXPECT_NEAR(areaOf(far.mesh) / areaOf(near.mesh), 1, 1e-5);

    const Json node = jsonOf(asGlb(far))["nodes"][0];
    for (std::size_t i = 0; i < 3; ++i) {
        const double middle = kSurvey[static_cast<glm::length_t>(i)] + (i < 2 ? 0.95 : 0);
        EXPECT_NEAR(node["translation"][i].get<double>(), middle, 0.1) << i;
        EXPECT_NEAR(far.report.centring.moved[static_cast<glm::length_t>(i)], -1000 * node["translation"][i].get<double>(), 1e-3) << i;
    }
    EXPECT_EQ(warningsOf(far.report.warnings, 5329), 0u);
}

TEST_F(NothingLost, what_is_written_far_away_is_read_again_bit_for_bit) {
    prep::PrepOptions options;
    options.read.unitMm = 1000;
    const prep::Prepared far = prepared(write("far.ply", survey(kSurvey)), options);
    const auto again = loadMesh(asGlb(far));
    ASSERT_TRUE(again) << format(again.error());
    ASSERT_EQ(again->positions.size(), far.mesh.positions.size());
    double greatest = 0;
    for (std::size_t i = 0; i < again->positions.size(); ++i)
        greatest = std::max(greatest, static_cast<double>(glm::distance(again->positions[i], far.mesh.positions[i])));
    EXPECT_LT(greatest, 1e-6) << "mm; the translation in metres is rounded to doubles";
    EXPECT_NEAR(glm::distance(again->origin, far.glb.place), 0, 1e-6);
}

TEST_F(NothingLost, a_mesh_that_stays_far_away_is_doubles_in_a_ply_file) {
    prep::PrepOptions options = inMillimetres();
    options.centre = prep::CentreMode::None;
    const prep::Prepared far = prepared(write("far.ply", survey(kSurvey)), options);
    ASSERT_TRUE(writePly(folder_ / "out.ply", far.mesh));
    const auto text = readFile(folder_ / "out.ply");
    EXPECT_NE(text->find("property double x"), std::string::npos);
    const prep::Prepared again = prepared(folder_ / "out.ply", options);
    EXPECT_NEAR(areaOf(again.mesh) / areaOf(far.mesh), 1, 1e-6);
    EXPECT_NEAR(glm::distance(again.mesh.origin, far.mesh.origin), 0, 1);
}

TEST_F(NothingLost, a_gltf_node_far_away_is_no_place_for_floats_either) {
    GltfText gltf = tetrahedron();
    gltf.json["nodes"][0]["translation"] = {4.5e8, 5.4e9, 3e5};
    const prep::Prepared far = prepared(write("far.glb", gltf.glb()));
    EXPECT_NEAR(areaOf(far.mesh), 150 + 50 * std::sqrt(3.0), 1e-3);
    EXPECT_NEAR(jsonOf(asGlb(far))["nodes"][0]["translation"][1].get<double>(), 5.4e6, 0.02);
}

TEST_F(NothingLost, floats_that_were_too_coarse_in_the_file_are_told) {
    const std::string text = survey(kSurvey, 0.1, "float");
    std::string binary = text.substr(0, text.find("end_header\n") + 11);
    binary.replace(binary.find("ascii"), 5, "binary_little_endian");
    std::string body;
    std::istringstream lines(text.substr(text.find("end_header\n") + 11));
    for (int i = 0; i < 400; ++i)
        for (int c = 0; c < 3; ++c) {
            double value = 0;
            lines >> value;
            const auto rounded = static_cast<float>(value);
            body.append(reinterpret_cast<const char*>(&rounded), 4);
        }
    for (int i = 0; i < 722; ++i) {
        body.push_back('\3');
        lines.ignore(16, '3');
        for (int c = 0; c < 3; ++c) {
            std::int32_t corner = 0;
            lines >> corner;
            body.append(reinterpret_cast<const char*>(&corner), 4);
        }
    }
    const auto far = prep::prepareMesh(write("floats.ply", binary + body), inMillimetres());
    ASSERT_TRUE(far) << format(far.error());
    EXPECT_EQ(warningsOf(far->report.warnings, 5329, "32-bit floats"), 1u);
}

/// A header for so many vertices and one element with a list of their numbers.
std::string plyHeader(const char* number, int vertices, const char* element, const char* list) {
    return fmt::format("ply\nformat ascii 1.0\nelement vertex {1}\nproperty {0} x\nproperty {0} y\nproperty {0} z\nelement {2}\n"
                       "property list {3} int vertex_indices\nend_header\n",
                       number, vertices, element, list);
}

TEST_F(NothingLost, places_that_floats_merge_are_counted_in_a_warning) {
    const std::string text = plyHeader("double", 6, "face 2", "uchar") +
                             "0 0 0\n1000 0 0\n1000.00001 1000 0\n1000 1000 0\n1000.00001 0 0\n2000 500 0\n3 0 1 3\n3 4 5 2\n";
    const prep::Prepared result = prepared(write("dense.ply", text));
    EXPECT_EQ(warningsOf(result.report.warnings, 5329, "2 vertices"), 1u);
}

TEST_F(NothingLost, cracks_of_the_last_digit_are_closed_and_wider_ones_are_not) {
    const auto pair = [](const char* noise) {
        return fmt::format(
            "solid cad\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
            "facet normal 0 0 0\nouter loop\nvertex 1 {0} {0}\nvertex 1 1 0.5\nvertex {0} 1 0\nendloop\nendfacet\nendsolid cad\n",
            noise);
    };
    const prep::Prepared joined = prepared(write("cad.stl", pair("2.7e-16")));
    EXPECT_EQ(joined.mesh.positions.size(), 4u);
    EXPECT_EQ(joined.report.places.cracks, 2u);
    EXPECT_EQ(joined.report.topology.boundaryEdges, 4u);
    EXPECT_EQ(prepared(write("cad.stl", pair("1e-5"))).mesh.positions.size(), 6u) << "nobody's rounding";
    prep::PrepOptions exact = inMillimetres();
    exact.same.epsilon = 0;
    EXPECT_EQ(prepared(write("cad.stl", pair("2.7e-16")), exact).mesh.positions.size(), 6u) << "0 is exact";
    prep::PrepOptions wide = inMillimetres();
    wide.same.epsilon = 1e-3;
    EXPECT_EQ(prepared(write("cad.stl", pair("1e-5")), wide).mesh.positions.size(), 4u);
}

TEST_F(NothingLost, a_tiny_piece_beside_a_huge_one_is_not_welded_away) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\nelement face 3\n"
                       "property list uchar int vertex_indices\nend_header\n0 0 0\n1e6 0 0\n0 1e6 0\n"
                       "1 1 0\n1.01 1 0\n1 1.01 0\n1.01 1.01 0\n3 0 1 2\n3 3 4 5\n3 4 6 5\n";
    EXPECT_EQ(prepared(write("scales.ply", text)).mesh.positions.size(), 7u) << "a step of a float at 1e6 is 0.06";
}

TEST_F(NothingLost, colours_and_properties_of_a_scan_go_through_every_step) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nproperty uchar fur_length\nproperty float quality\nelement face 4\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0 255 0 17 51 0.25\n10 0 0 1 2 3 102 1.5\n0 10 0 128 64 32 255 -3\n0 0 10 200 100 50 0 1e6\n"
        "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    const auto source = write("scan.ply", text);
    const prep::Prepared result = prepared(source);
    EXPECT_TRUE(writePly(folder_ / "out.ply", result.mesh));
    const std::vector<std::string> names = {"red", "green", "blue", "fur_length", "quality"};
    const auto before = readVertexValues(source, names, 1);
    ASSERT_TRUE(before);
    for (const auto& [file, unit] : {std::pair(folder_ / "out.ply", 1.0), std::pair(asGlb(result), 1000.0)}) {
        const auto after = readVertexValues(file, names, unit);
        ASSERT_TRUE(after) << format(after.error());
        EXPECT_EQ(after->whole, before->whole) << file;
        ASSERT_EQ(after->positions.size(), 4u);
        for (std::size_t v = 0; v < 4; ++v) { // found by place: preparation moves and reorders
            const glm::dvec3 place = glm::dvec3(after->positions[v]) - result.report.centring.moved;
            std::size_t from = 0;
            while (from < 3 && glm::distance(glm::dvec3(before->positions[from]), place) > 1e-4)
                ++from;
            for (std::size_t k = 0; k < names.size(); ++k)
                EXPECT_NEAR(after->values[k][v], before->values[k][from], 1e-6) << file << " " << names[k];
        }
    }
    EXPECT_EQ(warningsOf(result.report.warnings, 5331), 0u);
}

TEST_F(NothingLost, corners_that_differ_by_colour_alone_stay_apart) {
    const std::string text =
        "v 0 0 0 1 0 0\nv 10 0 0 1 0 0\nv 0 10 0 1 0 0\nv 10 0 0 0 1 0\nv 0 10 0 0 1 0\nv 10 10 0 0 1 0\nf 1 2 3\nf 4 6 5\n";
    const prep::Prepared result = prepared(write("two.obj", text));
    EXPECT_EQ(result.mesh.positions.size(), 6u);
    ASSERT_EQ(result.mesh.colors.size(), 6u);
    EXPECT_EQ(std::ranges::count(result.mesh.colors, glm::vec4(0, 1, 0, 1)), 3);
}

TEST_F(NothingLost, colours_of_off_files_are_kept_in_both_spellings) {
    for (const char* green : {"0 1 0 1", "0 255 0 255"}) {
        const prep::Prepared result =
            prepared(write("c.off", fmt::format("COFF\n3 1 0\n0 0 0 {0}\n9 0 0 {0}\n0 9 0 {0}\n3 0 1 2\n", green)));
        ASSERT_EQ(result.mesh.colors.size(), 3u);
        EXPECT_EQ(result.mesh.colors[0], glm::vec4(0, 1, 0, 1)) << green;
    }
}

TEST_F(NothingLost, materials_and_their_pictures_are_carried_byte_for_byte) {
    Image image{.width = 4, .height = 4, .channels = 3, .pixels = std::vector<float>(48, 0.5f), .bitsPerChannel = 8};
    ASSERT_TRUE(writeJpeg(folder_ / "picture.jpg", image));
    const std::string jpeg = *readFile(folder_ / "picture.jpg");
    GltfText gltf = tetrahedron();
    const auto uv = gltf.addAccessor<float>({0, 0, 1, 0, 0, 1, 1, 1}, 5126, "VEC2", 2);
    Json& primitives = gltf.json["meshes"][0]["primitives"];
    primitives[0]["attributes"]["TEXCOORD_0"] = uv;
    primitives[0]["attributes"]["TEXCOORD_1"] = uv;
    primitives[0]["material"] = 1;
    primitives.push_back(primitives[0]);
    primitives[1]["material"] = 0;
    primitives[1]["indices"] = gltf.addAccessor<std::uint16_t>({0, 1, 2}, 5123, "SCALAR", 1);
    gltf.json["images"] = Json::array({{{"bufferView", gltf.addBytes(jpeg)}, {"mimeType", "image/jpeg"}}});
    gltf.json["textures"] = Json::array({{{"source", 0}}});
    gltf.json["materials"] = {
        {{"name", "plain"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}},
        {{"name", "rich"},
         {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}, {"baseColorTexture", {{"index", 0}}}}},
         {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}},
         {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}}}}}}};
    gltf.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
    const auto out = asGlb(prepared(write("rich.glb", gltf.glb())));
    const Json json = jsonOf(out);
    EXPECT_EQ(json["materials"], gltf.json["materials"]);
    EXPECT_EQ(json["images"][0]["mimeType"], "image/jpeg");
    EXPECT_EQ(viewOf(out, json["images"][0]["bufferView"].get<std::size_t>()), jpeg);
    EXPECT_EQ(json["meshes"][0]["primitives"][0]["material"], 1);
    EXPECT_EQ(json["meshes"][0]["primitives"][1]["material"], 0);
    EXPECT_TRUE(json["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_1"));
    EXPECT_EQ(json["extensionsUsed"][0], "KHR_materials_clearcoat");
    const auto drawn = loadMesh(out);
    ASSERT_TRUE(drawn) << format(drawn.error());
    ASSERT_EQ(drawn->textures.size(), 1u);
    EXPECT_EQ(drawn->textures[0].role, "color");
}

TEST_F(NothingLost, materials_of_other_types_than_gltf_s_become_plain_with_a_warning) {
    for (const char* material :
         {R"({"pbrMetallicRoughness":["no object"]})", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":-1}}})",
          R"({"normalTexture":{"scale":1}})", R"({"emissiveTexture":{"index":3}})",
          R"({"normalTexture":{"index":0,"scale":"not a number"}})", R"({"emissiveFactor":[0,"1",0]})",
          R"({"occlusionTexture":{"index":0,"extensions":{"KHR_texture_transform":"no object"}}})"}) {
        GltfText gltf = tetrahedron();
        gltf.json["textures"] = Json::array({Json::object()});
        gltf.json["materials"] = Json::array({Json::parse(material), {{"name", "good"}, {"emissiveFactor", {0, 1, 0}}}});
        gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
        const prep::Prepared mesh = prepared(write("odd.glb", gltf.glb()));
        EXPECT_EQ(warningsOf(mesh.report.warnings, 5331, "materials[0]"), 1U) << material;
        const Json json = jsonOf(asGlb(mesh));
        EXPECT_EQ(json["materials"][0], Json::object()) << material;
        EXPECT_EQ(json["materials"][1], gltf.json["materials"][1]) << material;
    }
}

TEST_F(NothingLost, a_picture_that_cannot_be_read_is_a_warning) {
    GltfText gltf = tetrahedron();
    gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
    gltf.json["images"] = Json::array({{{"uri", "missing.png"}}});
    gltf.json["textures"] = Json::array({{{"source", 0}}});
    gltf.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    const auto file = write("missing.glb", gltf.glb());
    EXPECT_EQ(warningsOf(prepared(file).report.warnings, 5328, "missing.png"), 1u);
    const auto drawn = loadMesh(file);
    ASSERT_TRUE(drawn) << format(drawn.error());
    EXPECT_EQ(warningsOf(drawn->warnings, 5328, "missing.png"), 1u);
}

TEST_F(NothingLost, materials_of_an_obj_file_become_those_of_gltf) {
    Image image{.width = 2, .height = 2, .channels = 3, .pixels = std::vector<float>(12, 0.5f), .bitsPerChannel = 8};
    ASSERT_TRUE(writeJpeg(folder_ / "kd.jpg", image));
    EXPECT_FALSE(
        write("m.mtl", "newmtl red\nKd 1 0 0\nKs 1 1 1\nNs 100\nillum 2\nnewmtl glass\nKd 0 0 0\nd 0.25\nmap_Kd kd.jpg\n").empty());
    const prep::Prepared result =
        prepared(write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 10 0 0\nv 0 10 0\nv 10 10 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\n"
                                "f 1/1 2/2 3/3\nusemtl glass\nf 2/1 4/2 3/3\n"));
    const auto out = asGlb(result);
    const Json json = jsonOf(out);
    ASSERT_EQ(json["materials"].size(), 2u);
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"], Json({1.0, 0.0, 0.0, 1.0}));
    EXPECT_NEAR(json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"].get<double>(), std::sqrt(2.0 / 102), 1e-9);
    EXPECT_EQ(json["materials"][1]["alphaMode"], "BLEND");
    EXPECT_EQ(json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"][3], 0.25);
    EXPECT_EQ(viewOf(out, json["images"][0]["bufferView"].get<std::size_t>()), *readFile(folder_ / "kd.jpg"));
    EXPECT_EQ(warningsOf(result.report.warnings, 5331, "illum, ks"), 1u);
}

TEST_F(NothingLost, each_kind_of_thing_that_goes_is_one_warning) {
    GltfText gltf = tetrahedron();
    Json& primitive = gltf.json["meshes"][0]["primitives"][0];
    primitive["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
    primitive["attributes"]["JOINTS_0"] = gltf.addAccessor<std::uint16_t>(std::vector<std::uint16_t>(16, 0), 5123, "VEC4", 4);
    primitive["attributes"]["WEIGHTS_0"] = gltf.addAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4);
    gltf.json["skins"] = Json::array({{{"joints", {0}}}});
    gltf.json["nodes"][0]["skin"] = 0;
    gltf.json["nodes"].push_back({{"mesh", 0}, {"translation", {100, 0, 0}}});
    gltf.json["scenes"][0]["nodes"].push_back(1);
    gltf.json["animations"] = Json::array({{{"channels", Json::array()}, {"samplers", Json::array()}}});
    gltf.json["cameras"] = Json::array({{{"type", "perspective"}}});
    const auto place = gltf.addAccessor<float>({0, 0, 0}, 5126, "VEC3", 3);
    gltf.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = place; // instances do not move
    const prep::Prepared result = prepared(write("rig.glb", gltf.glb()));
    EXPECT_EQ(result.mesh.indices.size() / 3, 8u) << "drawn twice";
    for (const char* what : {"2 morph targets", "joints and weights", "1 animations", "1 cameras", "1 copies"})
        EXPECT_EQ(warningsOf(result.report.warnings, 5331, what), 1u) << what;
    EXPECT_EQ(result.report.warnings.size(), 5u);
}

TEST_F(NothingLost, what_moves_a_mesh_is_written_again_and_what_cannot_be_is_named) {
    GltfText gltf = tetrahedron();
    Json& primitive = gltf.json["meshes"][0]["primitives"][0];
    primitive["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
    gltf.json["meshes"][0]["extras"]["targetNames"] = {"smile", "frown"};
    primitive["attributes"]["JOINTS_0"] =
        gltf.addAccessor<std::uint16_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, 5123, "VEC4", 4);
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 0.25, 0.75, 0, 0, 1, 0, 0, 0};
    primitive["attributes"]["WEIGHTS_0"] = gltf.addAccessor<float>(weights, 5126, "VEC4", 4);
    gltf.json["skins"] = Json::array({{{"joints", {1, 2}}, {"name", "body"}}});
    gltf.json["nodes"][0]["skin"] = 0;
    gltf.json["nodes"].push_back({{"name", "hip"}, {"children", Json::array({2})}, {"translation", {0, 1, 0}}});
    gltf.json["nodes"].push_back({{"name", "head"}, {"camera", 0}, {"extensions", {{"ACME_hat", Json::object()}}}});
    gltf.json["scenes"][0]["nodes"].push_back(1);
    gltf.json["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
    const auto times = gltf.addAccessor<float>({0, 0.1f}, 5126, "SCALAR", 1);
    const auto turns = gltf.addAccessor<float>({0, 0, 0, 1, 0.6f, 0, 0, 0.8f}, 5126, "VEC4", 4);
    const auto channel = [](const Json& target) { return Json{{"sampler", 0}, {"target", target}}; };
    gltf.json["animations"] =
        Json::array({{{"name", "nod"},
                      {"channels", {channel({{"node", 2}, {"path", "rotation"}}), channel(Json::object({{"path", "pointer"}}))}},
                      {"samplers", Json::array({{{"input", times}, {"output", turns}}})}},
                     {{"name", "broken"},
                      {"channels", Json::array({channel({{"node", 2}, {"path", "rotation"}})})},
                      {"samplers", Json::array({{{"input", turns}, {"output", turns}}})}}});
    const prep::Prepared result = prepared(write("rig.glb", gltf.glb()));
    for (const char* what : {"ACME_hat of node 'head'", "1 channels of animation 'nod'", "animation 'broken' is left out"})
        EXPECT_EQ(warningsOf(result.report.warnings, 5331, what), 1u) << what;
    EXPECT_EQ(result.report.warnings.size(), 3u);
    const auto out = asGlb(result);
    const Json json = jsonOf(out);
    ASSERT_EQ(json["skins"].size(), 1u);
    EXPECT_EQ(json["skins"][0]["joints"], Json({1, 2}));
    EXPECT_EQ(json["nodes"][1]["translation"], Json({0, 1, 0}));
    EXPECT_EQ(json["nodes"][2]["camera"], 0);
    EXPECT_EQ(json["meshes"][0]["extras"]["targetNames"], Json({"smile", "frown"}));
    ASSERT_EQ(json["animations"].size(), 1u);
    EXPECT_EQ(json["animations"][0]["channels"].size(), 1u);
    const auto again = readMesh(out, {});
    ASSERT_TRUE(again) << format(again.error());
    const MotionRun& run = again->mesh.motion->runs.front();
    std::set<std::vector<float>> rows;
    for (std::size_t i = 0; i < run.count; ++i)
        rows.insert(
            {run.weights.begin() + static_cast<std::ptrdiff_t>(4 * i), run.weights.begin() + static_cast<std::ptrdiff_t>(4 * i + 4)});
    EXPECT_EQ(rows, (std::set<std::vector<float>>{{1, 0, 0, 0}, {0.25f, 0.75f, 0, 0}}));
    EXPECT_EQ(again->mesh.motion->animations[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0.6f, 0, 0, 0.8f}));
}

TEST_F(NothingLost, instances_are_drawn_where_they_stand) {
    GltfText gltf = tetrahedron();
    const auto places = gltf.addAccessor<float>({0, 0, 0, 100, 0, 0, 0, 200, 0}, 5126, "VEC3", 3);
    gltf.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    gltf.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const prep::Prepared result = prepared(write("forest.glb", gltf.glb()));
    EXPECT_EQ(result.mesh.indices.size() / 3, 12u);
    EXPECT_NEAR(result.mesh.bounds.maximum.x - result.mesh.bounds.minimum.x, 110, 1e-3);
    EXPECT_NEAR(result.mesh.bounds.maximum.y - result.mesh.bounds.minimum.y, 210, 1e-3);
}

TEST_F(NothingLost, meshes_packed_by_meshoptimizer_are_read) {
    const std::vector<float> positions = {0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10};
    const std::vector<std::uint32_t> indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), 4, 12));
    std::vector<unsigned char> corners(meshopt_encodeIndexBufferBound(12, 4));
    corners.resize(meshopt_encodeIndexBuffer(corners.data(), corners.size(), indices.data(), 12));
    GltfText gltf = tetrahedron();
    const auto pack = [&](std::size_t view, const std::vector<unsigned char>& bytes, std::size_t count, std::size_t stride,
                          const char* mode) {
        const std::size_t at = gltf.addView(bytes);
        Json packed = gltf.json["bufferViews"][at];
        packed.update({{"count", count}, {"byteStride", stride}, {"mode", mode}});
        gltf.json["bufferViews"][view] = {
            {"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{"EXT_meshopt_compression", packed}}}};
    };
    pack(0, vertices, 4, 12, "ATTRIBUTES");
    pack(1, corners, 12, 4, "TRIANGLES");
    gltf.json["accessors"][1]["componentType"] = 5125;
    gltf.json["buffers"] = {{{"byteLength", 0}}, {{"byteLength", 96}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    gltf.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    const prep::Prepared result = prepared(write("packed.glb", gltf.glb()));
    EXPECT_EQ(result.mesh.positions.size(), 4u);
    EXPECT_NEAR(areaOf(result.mesh), 150 + 50 * std::sqrt(3.0), 1e-4);
    gltf.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1 << 20;
    const auto bomb = prep::prepareMesh(write("bomb.glb", gltf.glb()), inMillimetres());
    ASSERT_FALSE(bomb);
    EXPECT_EQ(bomb.error().diagnostics.front().code, 5303);
}

TEST_F(NothingLost, meshes_packed_by_draco_are_read) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(4);
    const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const float p[4][3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (int f = 0; f < 4; ++f)
        builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(static_cast<std::uint32_t>(f)), p[faces[f][0]], p[faces[f][1]],
                                          p[faces[f][2]]);
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer packed;
    ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &packed).ok());
    GltfText gltf = tetrahedron();
    const std::size_t view = gltf.addBytes({packed.data(), packed.size()});
    for (Json& accessor : gltf.json["accessors"])
        accessor.erase("bufferView");
    gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(attribute)->unique_id()}}}};
    gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const prep::Prepared result = prepared(write("draco.glb", gltf.glb()));
    EXPECT_EQ(result.mesh.indices.size(), 12u);
    EXPECT_NEAR(areaOf(result.mesh), 150 + 50 * std::sqrt(3.0), 1e-4);
    gltf.binary.resize(gltf.binary.size() / 2);
    EXPECT_FALSE(prep::prepareMesh(write("cut.glb", gltf.glb()), inMillimetres()));
}

TEST_F(NothingLost, pieces_with_vertices_of_their_own_say_their_stride) {
    prep::PrepOptions options = inMillimetres();
    options.chunk16 = true;
    options.levels = 2;
    const prep::Prepared result = prepare(prep::makeShape(prep::Shape::Terrain, 300), options);
    ASSERT_GT(result.report.chunks.count, 1u);
    const Json json = jsonOf(asGlb(result));
    std::map<std::size_t, std::size_t> users;
    for (const Json& mesh : json["meshes"])
        for (const Json& primitive : mesh["primitives"])
            for (const Json& accessor : primitive["attributes"])
                ++users[json["accessors"][accessor.get<std::size_t>()]["bufferView"].get<std::size_t>()];
    for (const auto& [view, count] : users)
        EXPECT_TRUE(count < 2 || json["bufferViews"][view].contains("byteStride")) << view;
}

TEST_F(NothingLost, strips_of_triangles_are_read_as_they_turn) {
    const std::string text = plyHeader("float", 6, "tristrips 1", "int") + "0 0 0\n0 10 0\n10 0 0\n10 10 0\n20 0 0\n20 10 0\n"
                                                                           "9 0 1 2 3 -1 2 3 4 5\n";
    const prep::Prepared result = prepared(write("strips.ply", text));
    EXPECT_EQ(result.mesh.indices.size() / 3, 4u);
    EXPECT_EQ(result.report.topology.opposedEdges, 0u) << "all face one way";
    EXPECT_NEAR(areaOf(result.mesh), 200, 1e-4);
}

TEST_F(NothingLost, lines_that_end_as_on_old_macintoshes_are_lines) {
    std::string obj = "# made long ago\nv 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n";
    std::string ply = survey(glm::dvec3(0));
    for (std::string* text : {&obj, &ply})
        std::ranges::replace(*text, '\n', '\r');
    EXPECT_EQ(prepared(write("mac.obj", obj)).mesh.indices.size() / 3, 1u);
    EXPECT_EQ(prepared(write("mac.ply", ply)).mesh.indices.size() / 3, 722u);
}

TEST_F(NothingLost, a_file_without_triangles_is_an_error) {
    const std::vector<std::pair<std::string, std::string>> files = {{"points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n"},
                                                                    {"comment.obj", "# nothing\n"},
                                                                    {"nothing.off", "OFF\n0 0 0\n"},
                                                                    {"nothing.glb", GltfText().glb()}};
    for (const auto& [name, bytes] : files) {
        const auto result = prep::prepareMesh(write(name, bytes), inMillimetres());
        ASSERT_FALSE(result) << name;
        EXPECT_EQ(result.error().diagnostics.front().code, 7021) << name;
    }
}
