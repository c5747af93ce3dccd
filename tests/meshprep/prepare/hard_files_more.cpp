// Hard files 55 to 86: what real collections of meshes brought.
#include "tests/meshprep/prepare/glb_text.h"
#include "tests/meshprep/prepare/hard_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tegument::testing_prep {

namespace {

class More {
public:
    std::vector<HardFile> files;

    void fails(int number, std::string name, std::string bytes, int code) {
        files.push_back(
            {.number = number, .name = std::move(name), .bytes = std::move(bytes), .expected = {.error = code, .anywhere = true}});
    }
    void gives(int number, std::string name, std::string bytes, std::size_t vertices, std::size_t triangles, int warning = 0) {
        files.push_back({.number = number,
                         .name = std::move(name),
                         .bytes = std::move(bytes),
                         .expected = {.vertices = vertices, .triangles = triangles, .warning = warning}});
    }
};

/// A square of two triangles.
std::string square(const std::string& type, const std::string& properties, const std::vector<std::string>& rows,
                   const std::string& face = "", const std::string& more = "") {
    std::string text =
        fmt::format("ply\nformat ascii 1.0\nelement vertex 4\nproperty {0} x\nproperty {0} y\nproperty {0} z\n{1}element face 2\n"
                    "property list uchar int vertex_indices\n{2}end_header\n",
                    type, properties, face);
    for (const std::string& row : rows)
        text += row + "\n";
    return text + "3 0 1 2" + more + "\n3 1 3 2" + more + "\n";
}

const std::vector<std::string> kSquare = {"0 0 0", "10 0 0", "0 10 0", "10 10 1"};

std::vector<std::string> with(const std::vector<std::string>& ends) {
    std::vector<std::string> rows = kSquare;
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] += " " + ends[i];
    return rows;
}

std::string replaced(std::string text, char from, char to) {
    std::ranges::replace(text, from, to);
    return text;
}

void addForms(More& c) {
    const std::string obj = "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n";
    c.gives(55, "strips.ply",
            "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
            "property list int int vertex_indices\nend_header\n0 0 0\n0 10 0\n10 0 0\n10 10 0\n20 0 0\n8 0 1 2 3 -1 2 3 4\n",
            5, 3);
    c.gives(56, "carriage_returns.obj", replaced("# old\n" + obj, '\n', '\r'), 3, 1);
    c.gives(57, "carriage_returns.ply", replaced(square("float", "", kSquare), '\n', '\r'), 4, 2);
    c.fails(58, "points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n", 7021);
    c.fails(59, "comments.obj", "# nothing else\n", 7021);
    c.fails(60, "nothing.off", "OFF\n0 0 0\n", 7021);
    c.fails(61, "nothing.glb", GltfText().glb(), 7021);
    std::string groups;
    for (int i = 0; i < 500; ++i)
        groups += fmt::format("g empty{}\n", i);
    c.gives(81, "empty_groups.obj", groups + obj + "g last\n", 3, 1);
    std::string parts;
    for (int i = 0; i < 5000; ++i)
        parts += fmt::format("g part{0}\nv {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf -3 -2 -1\n", i);
    c.gives(82, "five_thousand_parts.obj", parts, 15000, 5000);
    std::string book;
    for (int i = 0; i < 100; ++i)
        book += fmt::format("v {} {} 5\n", std::cos(i * 0.0628), std::sin(i * 0.0628));
    book += "v 0 0 0\nv 0 0 10\n";
    for (int i = 1; i <= 100; ++i)
        book += fmt::format("f 101 {} 102\n", i);
    c.gives(83, "book.obj", book, 102, 100);
}

/// A disc whose top and bottom are slivers from the middle.
std::string sliveredDisc(int corners) {
    std::string points, faces;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        const double x = 40 * std::cos(angle), y = 40 * std::sin(angle);
        points += fmt::format("{0:.6f} {1:.6f} 0\n{0:.6f} {1:.6f} 5\n", x, y);
        const int low = 2 * i, next = 2 * ((i + 1) % corners), middle = 2 * corners;
        faces += fmt::format("3 {} {} {}\n3 {} {} {}\n", low, next, next + 1, low, next + 1, low + 1);
        faces += fmt::format("3 {} {} {}\n3 {} {} {}\n", middle, next, low, middle + 1, low + 1, next + 1);
    }
    return fmt::format("OFF\n{} {} 0\n", 2 * corners + 2, 4 * corners) + points + "0 0 0\n0 0 5\n" + faces;
}

void addPlaces(More& c) {
    const std::vector<std::string> far = {"448265123.1 5411932678.2 312", "448265133.1 5411932678.2 312", "448265123.1 5411932688.2 312",
                                          "448265133.1 5411932688.2 313"};
    c.gives(62, "survey.ply", square("double", "", far), 4, 2);
    GltfText node = tetrahedron();
    node.json["nodes"][0]["translation"] = {4.5e8, 5.4e9, 3e5};
    c.gives(63, "far_node.glb", node.glb(), 4, 4);
    std::string floats = square("float", "", {}).substr(0, square("float", "", {}).find("end_header"));
    floats.replace(floats.find("ascii"), 5, "binary_little_endian");
    floats += "end_header\n";
    for (const auto& [x, y] : {std::pair(0.f, 0.f), std::pair(64.f, 0.f), std::pair(0.f, 64.f), std::pair(64.f, 64.f)})
        for (const float value : {4.48265e8f + x, 3e8f + y, 0.f})
            floats.append(reinterpret_cast<const char*>(&value), 4);
    for (const std::array<std::int32_t, 3>& face : {std::array<std::int32_t, 3>{0, 1, 2}, std::array<std::int32_t, 3>{1, 3, 2}}) {
        floats += '\3';
        floats.append(reinterpret_cast<const char*>(face.data()), 12);
    }
    c.gives(64, "survey_in_floats.ply", floats, 4, 2, 5329);
    c.gives(
        65, "finer_than_floats.ply",
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double z\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1000 0 0\n1000.00001 1000 0\n1000 1000 0\n1000.00001 0 0\n2000 500 0\n"
        "3 0 1 3\n3 4 5 2\n",
        4, 2, 5329);
    c.gives(66, "cracks.stl",
            "solid cad\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 0\n"
            "outer loop\nvertex 1 2.7e-16 -2.7e-16\nvertex 1 1 0.5\nvertex 2.7e-16 1 0\nendloop\nendfacet\nendsolid cad\n",
            4, 2);
    // Many slivers' boxes hold each point, so that nearest points are not exact: the error of a level has to be bounded without them.
    c.gives(86, "slivers.off", sliveredDisc(1500), 3002, 6000);
    c.gives(80, "offset_1e30.ply", square("double", "", {"1e30 0 0", "1.0000000001e30 0 0", "1e30 1e20 0", "1.0000000001e30 1e20 0"}), 4,
            2);
}

void addValues(More& c) {
    c.gives(67, "colours.ply",
            square("float", "property uchar red\nproperty uchar green\nproperty uchar blue\n", with({"1 2 3", "4 5 6", "7 8 9", "0 0 0"})),
            4, 2);
    c.gives(68, "values_that_are_none.ply", square("float", "property float quality\n", with({"nan", "1", "inf", "2"})), 4, 2, 5331);
    c.gives(69, "colours_behind_places.obj", "v 0 0 0 1 0 0\nv 10 0 0 0 1 0\nv 0 10 0 0 0 1\nf 1 2 3\n", 3, 1);
    c.gives(70, "colours.off", "COFF\n3 1 0\n0 0 0 255 0 0 255\n9 0 0 0 255 0 255\n0 9 0 0 0 255 255\n3 0 1 2\n", 3, 1);
    c.gives(71, "colours_of_faces.ply", square("float", "", kSquare, "property uchar red\n", " 7"), 4, 2, 5331);
    std::string stl(80, ' ');
    const auto put = [&](const auto& value) { stl.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(std::uint32_t{1});
    for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        put(value);
    put(std::uint16_t{0x801f});
    c.gives(72, "colours.stl", stl, 3, 1, 5331);
}

void addGltf(More& c) {
    GltfText morphed = tetrahedron();
    morphed.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
    c.gives(73, "morph_targets.glb", morphed.glb(), 4, 4);
    GltfText textured = tetrahedron();
    textured.json["meshes"][0]["primitives"][0]["material"] = 0;
    textured.json["images"] = Json::array({{{"uri", "gone.png"}}});
    textured.json["textures"] = Json::array({{{"source", 0}}});
    textured.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    c.gives(74, "picture_gone.glb", textured.glb(), 4, 4, 5328);
    c.gives(75, "library_gone.obj", "mtllib gone.mtl\nv 0 0 0\nv 10 0 0\nv 0 10 0\nusemtl red\nf 1 2 3\n", 3, 1, 5328);
    GltfText forest = tetrahedron();
    const auto places = forest.addAccessor<float>({0, 0, 0, 100, 0, 0}, 5126, "VEC3", 3);
    forest.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    forest.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    c.gives(76, "instances.glb", forest.glb(), 8, 8, 5331);
    const auto packed = [](std::size_t count, const char* bytes) {
        GltfText gltf = tetrahedron();
        const std::size_t at = gltf.addBytes(bytes);
        Json extension = gltf.json["bufferViews"][at];
        extension.update({{"count", count}, {"byteStride", 12}, {"mode", "ATTRIBUTES"}});
        gltf.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = extension;
        return gltf.glb();
    };
    c.fails(77, "packed_wrongly.glb", packed(4, "this is no run of vertices packed by any codec"), 5307);
    c.fails(78, "packed_bomb.glb", packed(60'000'000, "small"), 5303);
    GltfText draco = tetrahedron();
    draco.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", draco.addBytes("DRACO, but no more")}, {"attributes", {{"POSITION", 0}}}};
    c.fails(79, "draco_of_nothing.glb", draco.glb(), 5302);
    GltfText weighted = tetrahedron();
    weighted.json["animations"] = Json::array({Json::object()});
    c.gives(84, "animated.glb", weighted.glb(), 4, 4, 5331);
    GltfText foreign = tetrahedron();
    foreign.json["extensionsRequired"] = {"ACME_spheres"};
    c.fails(85, "required_extension.glb", foreign.glb(), 5307);
}

} // namespace

std::vector<HardFile> moreHardFiles() {
    More c;
    addForms(c);
    addPlaces(c);
    addValues(c);
    addGltf(c);
    return std::move(c.files);
}

} // namespace tegument::testing_prep
