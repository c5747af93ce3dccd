// Every number of every stream: however a file packs what its vertices hold, it is read as from the plain file; and what is no number does
// not reach what is written.
// Colours and properties of a scan's vertices, at the same places whatever is done to the mesh.

#include "host/mesh/read_mesh.h"
#include "host/support/file.h"
#include "meshprep/fur/roots/vertex_values.h"
#include "meshprep/write/write_mesh.h"
#include "tests/meshprep/prepare/glb_text.h"
#include "tests/meshprep/prepare/meshes.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

using namespace tegument;
using namespace tegument::testing_prep;

namespace {

enum class Packing { Plain, Sparse, Meshopt, Draco, DracoNormalised };
constexpr std::array kPackings = {Packing::Plain, Packing::Sparse, Packing::Meshopt, Packing::Draco, Packing::DracoNormalised};
constexpr std::array kPackingNames = {"plain", "sparse", "meshopt", "Draco", "Draco that says normalised"};
constexpr std::array<std::array<float, 3>, 4> kPlaces = {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}};
constexpr std::array<std::array<std::uint32_t, 3>, 4> kFaces = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

/// What the attribute stands for at each place, and how the file stores it.
struct Stream {
    const char* name;
    std::size_t components;
    int componentType;
    double one; // what stands for 1 in the file
};

constexpr std::array kStreams = {
    Stream{"POSITION", 3, 5126, 1},       Stream{"POSITION", 3, 5120, 127},     Stream{"POSITION", 3, 5121, 255},
    Stream{"POSITION", 3, 5122, 32767},   Stream{"POSITION", 3, 5123, 65535},   Stream{"COLOR_0", 3, 5126, 1},
    Stream{"COLOR_0", 3, 5121, 255},      Stream{"COLOR_0", 3, 5123, 65535},    Stream{"COLOR_0", 4, 5126, 1},
    Stream{"COLOR_0", 4, 5121, 255},      Stream{"COLOR_0", 4, 5123, 65535},    Stream{"TEXCOORD_0", 2, 5126, 1},
    Stream{"TEXCOORD_0", 2, 5121, 255},   Stream{"TEXCOORD_0", 2, 5123, 65535}, Stream{"TEXCOORD_1", 2, 5121, 255},
    Stream{"TEXCOORD_1", 2, 5123, 65535}, Stream{"_HEAT", 4, 5121, 255},        Stream{"NORMAL", 4, 5120, 127},
    Stream{"NORMAL", 4, 5122, 32767},     Stream{"NORMAL", 4, 5126, 1},         Stream{"TANGENT", 4, 5120, 127},
    Stream{"TANGENT", 4, 5122, 32767},    Stream{"TANGENT", 4, 5126, 1},
};

/// Of place and channel: fifteenths, which 8 and 16 bits hold exactly. Normals and tangents are unit vectors along axes, places tenths of
/// what the node makes of them.
double meant(const Stream& stream, std::size_t place, std::size_t channel) {
    const std::string_view name = stream.name;
    if (name == "POSITION") return static_cast<double>(kPlaces[place][channel]) / 10;
    if (name == "TANGENT" && channel == 3) return place % 2 == 0 ? 1 : -1;
    if (name == "NORMAL" || name == "TANGENT") return channel == place % 3 ? (place == 3 ? -1 : 1) : 0;
    return static_cast<double>((place * 4 + channel) % 16) / 15;
}

template <class T>
std::vector<T> stored(const Stream& stream) {
    std::vector<T> values;
    for (std::size_t place = 0; place < 4; ++place)
        for (std::size_t c = 0; c < stream.components; ++c)
            values.push_back(static_cast<T>(std::round(meant(stream, place, c) * stream.one * 1e6) / 1e6));
    return values;
}

/// Calls `use` with the values in the stream's type, and Draco's name of it.
template <class Use>
void withValues(const Stream& stream, Use use) {
    switch (stream.componentType) {
    case 5120: return use(stored<std::int8_t>(stream), draco::DT_INT8);
    case 5121: return use(stored<std::uint8_t>(stream), draco::DT_UINT8);
    case 5122: return use(stored<std::int16_t>(stream), draco::DT_INT16);
    case 5123: return use(stored<std::uint16_t>(stream), draco::DT_UINT16);
    default: return use(stored<float>(stream), draco::DT_FLOAT32);
    }
}

std::size_t channelsOf(const Stream& stream) {
    return std::string_view(stream.name) == "NORMAL" ? 3 : stream.components; // four bytes, three of them numbers
}

void addDraco(GltfText& gltf, const Stream& stream, bool normalised) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(4);
    withValues(stream, [&](const auto& values, draco::DataType type) {
        const auto channels = static_cast<std::int8_t>(channelsOf(stream));
        const bool isPlace = std::string_view(stream.name) == "POSITION";
        const auto kind = isPlace ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::GENERIC;
        const int places = isPlace ? -1 : builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
        const int extra = builder.AddAttribute(kind, channels, type);
        for (std::uint32_t f = 0; f < 4; ++f) {
            const auto& t = kFaces[f];
            const draco::FaceIndex face(f);
            if (!isPlace) builder.SetAttributeValuesForFace(places, face, kPlaces[t[0]].data(), kPlaces[t[1]].data(), kPlaces[t[2]].data());
            builder.SetAttributeValuesForFace(extra, face, &values[t[0] * stream.components], &values[t[1] * stream.components],
                                              &values[t[2] * stream.components]);
        }
        const auto mesh = builder.Finalize();
        mesh->attribute(extra)->set_normalized(normalised && stream.one > 1);
        draco::Encoder encoder;
        encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
        draco::EncoderBuffer packed;
        ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &packed).ok());
        const std::size_t view = gltf.addBytes({packed.data(), packed.size()});
        for (Json& accessor : gltf.json["accessors"])
            accessor.erase("bufferView");
        Json& packing = gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
        packing = {{"bufferView", view}, {"attributes", {{stream.name, mesh->attribute(extra)->unique_id()}}}};
        if (!isPlace) packing["attributes"]["POSITION"] = mesh->attribute(places)->unique_id();
    });
}

std::string fileOf(const Stream& stream, Packing packing) {
    GltfText gltf = tetrahedron();
    if (std::string_view(stream.name) == "POSITION") gltf.json["nodes"][0]["scale"] = {10, 10, 10};
    const char* type = channelsOf(stream) == 2 ? "VEC2" : channelsOf(stream) == 3 ? "VEC3" : "VEC4";
    withValues(stream, [&](const auto& values, draco::DataType) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const std::size_t stride = stream.components * sizeof(T);
        const std::size_t accessor = gltf.addAccessor(values, stream.componentType, type, stream.components);
        Json& json = gltf.json["accessors"][accessor];
        if (stream.one > 1) json["normalized"] = true;
        gltf.json["meshes"][0]["primitives"][0]["attributes"][stream.name] = accessor;
        const std::size_t view = json["bufferView"];
        const std::size_t padded = (stride + 3) / 4 * 4;
        if (padded != stride || channelsOf(stream) != stream.components) {
            std::string rows;
            for (std::size_t place = 0; place < 4; ++place) {
                rows.append(reinterpret_cast<const char*>(&values[place * stream.components]), stride);
                rows.resize((place + 1) * padded, '\0');
            }
            json["bufferView"] = gltf.addBytes(rows);
            gltf.json["bufferViews"][json["bufferView"].get<std::size_t>()]["byteStride"] = padded;
        }
        if (packing == Packing::Sparse) {
            const std::size_t indices = gltf.addView(std::vector<std::uint16_t>{0, 1, 2, 3});
            const std::size_t tight = channelsOf(stream) == stream.components ? view : json["bufferView"].get<std::size_t>();
            if (channelsOf(stream) != stream.components) return; // sparse values have no stride
            json.erase("bufferView");
            json["sparse"] = {
                {"count", 4}, {"indices", {{"bufferView", indices}, {"componentType", 5123}}}, {"values", {{"bufferView", tight}}}};
        }
        if (packing == Packing::Meshopt) {
            const std::size_t at = json["bufferView"];
            const std::string rows = gltf.binary.substr(gltf.json["bufferViews"][at]["byteOffset"], 4 * padded);
            std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, padded));
            bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), rows.data(), 4, padded));
            Json packed = gltf.json["bufferViews"][gltf.addView(bytes)];
            packed.update({{"count", 4}, {"byteStride", padded}, {"mode", "ATTRIBUTES"}});
            gltf.json["bufferViews"][at] = {
                {"buffer", 1}, {"byteLength", 4 * padded}, {"extensions", {{"EXT_meshopt_compression", packed}}}};
            if (padded != sizeof(T) * channelsOf(stream)) gltf.json["bufferViews"][at]["byteStride"] = padded;
            gltf.json["buffers"] = {{{"byteLength", 0}},
                                    {{"byteLength", 64}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
        }
    });
    if (packing == Packing::Draco || packing == Packing::DracoNormalised) addDraco(gltf, stream, packing == Packing::DracoNormalised);
    return gltf.glb();
}

/// What the file gives each place.
std::map<std::array<float, 3>, std::vector<double>> readStream(const Mesh& mesh, const Stream& stream) {
    std::map<std::array<float, 3>, std::vector<double>> found;
    const std::string_view name = stream.name;
    const auto kept = std::ranges::find(mesh.attributes, name.substr(name.starts_with('_') ? 1 : 0), &MeshAttribute::name);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        std::vector<double>& values = found[{mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z}];
        values.clear(); // vertices of one place are alike
        for (std::size_t c = 0; c < channelsOf(stream); ++c) {
            const auto channel = static_cast<glm::length_t>(c);
            if (name == "COLOR_0" && !mesh.colors.empty()) values.push_back(static_cast<double>(mesh.colors[v][channel]));
            if (name == "TEXCOORD_0" && !mesh.uvs.empty()) values.push_back(static_cast<double>(mesh.uvs[v][channel]));
            if (name == "POSITION") values.push_back(static_cast<double>(mesh.positions[v][channel]) / 10);
            if (name == "TANGENT" && !mesh.tangents.empty()) values.push_back(static_cast<double>(mesh.tangents[v][channel]));
            if (name == "NORMAL" && !mesh.normals.empty()) values.push_back(static_cast<double>(mesh.normals[v][channel]));
            if (kept != mesh.attributes.end()) values.push_back(kept->values[v * kept->components + c] / stream.one);
        }
    }
    return found;
}

class Streams : public PrepFolder {
protected:
    [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        EXPECT_TRUE(writeFile(folder_ / name, bytes));
        return folder_ / name;
    }
};

bool warns(const std::vector<Diagnostic>& warnings, int code) {
    return std::ranges::any_of(warnings, [&](const Diagnostic& warning) { return warning.code == code; });
}

template <class Vectors>
bool finite(const Vectors& vectors) {
    return std::ranges::all_of(vectors, [](const auto& v) {
        for (glm::length_t i = 0; i < v.length(); ++i)
            if (!std::isfinite(v[i])) return false;
        return true;
    });
}

const std::string kPlyFaces = "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPlyCorners = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

using Colours = PrepFolder;

/// A square of side x side points, 1 mm apart, whose bytes say where they are.
std::string painted(int side) {
    std::string vertices, faces;
    for (int i = 0; i < side * side; ++i)
        vertices +=
            fmt::format("{} {} {} {} {} 77 {}\n", i % side, i / side, i % 3, i % side % 256, i / side % 256, (i % side + i / side) % 256);
    for (int i = 0; i < side * side - side; ++i)
        if (i % side < side - 1) faces += fmt::format("3 {0} {1} {2}\n3 {1} {3} {2}\n", i, i + 1, i + side, i + side + 1);
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nproperty uchar fur_length\nelement face {}\n"
        "property list uchar int vertex_indices\nend_header\n{}{}",
        side * side, 2 * (side - 1) * (side - 1), vertices, faces);
}

/// Values that do not belong to their vertex's place.
std::size_t misplaced(const VertexValues& values, const glm::dvec3& moved) {
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < values.positions.size(); ++v) {
        const glm::dvec3 place = glm::dvec3(values.positions[v]) - moved;
        const long x = std::lround(place.x), y = std::lround(place.y);
        const std::array<long, 4> expected = {x % 256, y % 256, 77, (x + y) % 256};
        for (std::size_t k = 0; k < expected.size(); ++k)
            wrong += std::lround(255 * values.values[k][v]) != expected[k];
    }
    return wrong;
}

const std::vector<std::string> kNames = {"red", "green", "blue", "fur_length"};

struct Case {
    const char* name;
    int side;
    void (*choose)(prep::PrepOptions&);
};

constexpr Case kCases[] = {
    {"pieces", 270, [](prep::PrepOptions& o) { o.chunk16 = true, o.levels = 1; }},
    {"levels by OpenMesh", 20, [](prep::PrepOptions& o) { o.levelMethod = prep::LevelMethod::OpenMesh; }},
    {"16-bit numbers", 20, [](prep::PrepOptions& o) { o.precision = prep::VertexPrecision::Unorm16; }},
    {"halves", 20, [](prep::PrepOptions& o) { o.precision = prep::VertexPrecision::Half; }},
    {"overdraw", 20, [](prep::PrepOptions& o) { o.overdraw = true; }},
    {"the file's order", 20, [](prep::PrepOptions& o) { o.order = std::nullopt; }},
    {"the file's place", 20, [](prep::PrepOptions& o) { o.centre = prep::CentreMode::None; }},
    {"the scan's texture coordinates made", 12, [](prep::PrepOptions& o) { o.unwrap = true, o.levels = 1; }},
};

} // namespace

TEST_F(Streams, are_read_alike_however_they_are_stored_and_packed) {
    for (const Stream& stream : kStreams)
        for (std::size_t i = 0; i < kPackings.size(); ++i) {
            const std::string what = std::string(stream.name) + " as " + std::to_string(stream.componentType) + ", " + kPackingNames[i];
            const auto read = readMesh(write("packed.glb", fileOf(stream, kPackings[i])), {.unitMm = 1});
            ASSERT_TRUE(read) << what << format(read.error());
            const auto found = readStream(read->mesh, stream);
            for (std::size_t place = 0; place < 4; ++place) {
                const auto& values = found.at(kPlaces[place]);
                ASSERT_EQ(values.size(), channelsOf(stream)) << what;
                for (std::size_t c = 0; c < values.size(); ++c)
                    EXPECT_NEAR(values[c], meant(stream, place, c), 1e-6) << what << ", place " << place << ", channel " << c;
            }
        }
}

namespace {

enum class Order { Text, Little, Big };

/// Places, normals, texture coordinates with v up, and colours: of each place the same numbers whatever the format.
struct Row {
    std::array<double, 3> place{}, normal{};
    std::array<double, 2> uv{};
    std::array<double, 3> color{};
};

Row rowAt(std::size_t place) {
    Row row;
    for (std::size_t c = 0; c < 3; ++c) {
        row.place[c] = static_cast<double>(kPlaces[place][c]);
        row.normal[c] = c == place % 3 ? 1 : 0;
        row.color[c] = static_cast<double>((place * 3 + c) % 6) / 5;
    }
    row.uv = {static_cast<double>(place) / 4, static_cast<double>(place * place) / 16}; // floats, exactly
    return row;
}

template <class T>
std::string bytesOf(double value, bool swap) {
    const auto number = static_cast<T>(value);
    std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
    if (swap) std::ranges::reverse(bytes);
    return bytes;
}

std::string plyNumber(double value, const std::string& type, Order order) {
    if (order == Order::Text) return fmt::format("{} ", value);
    const bool swap = (order == Order::Big) == (std::endian::native == std::endian::little);
    if (type == "uchar") return bytesOf<std::uint8_t>(value, swap);
    if (type == "ushort") return bytesOf<std::uint16_t>(value, swap);
    if (type == "int") return bytesOf<std::int32_t>(value, swap);
    return type == "float" ? bytesOf<float>(value, swap) : bytesOf<double>(value, swap);
}

/// `type` of all numbers but the colours'; `one`: what stands for 1 there.
std::string plyOf(Order order, const std::string& type, const std::string& colorType, double one) {
    constexpr std::array kOrders = {"ascii", "binary_little_endian", "binary_big_endian"};
    std::string text = fmt::format("ply\nformat {} 1.0\nelement vertex 4\n", kOrders[static_cast<std::size_t>(order)]);
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
        text += "property " + type + " " + name + "\n";
    for (const char* name : {"red", "green", "blue"})
        text += "property " + colorType + " " + name + "\n";
    text += kPlyFaces;
    for (std::size_t place = 0; place < 4; ++place) {
        const Row row = rowAt(place);
        for (const double value :
             {row.place[0], row.place[1], row.place[2], row.normal[0], row.normal[1], row.normal[2], row.uv[0], row.uv[1]})
            text += plyNumber(value, type, order);
        for (const double value : row.color)
            text += plyNumber(value * one, colorType, order);
        if (order == Order::Text) text += "\n";
    }
    for (const auto& face : kFaces) {
        text += plyNumber(3, "uchar", order);
        for (const std::uint32_t corner : face)
            text += plyNumber(corner, "int", order);
        if (order == Order::Text) text += "\n";
    }
    return text;
}

std::string objOf() {
    std::string text;
    for (std::size_t place = 0; place < 4; ++place) {
        const auto [p, n, t, c] = rowAt(place);
        text +=
            fmt::format("v {} {} {} {} {} {}\nvt {} {}\nvn {} {} {}\n", p[0], p[1], p[2], c[0], c[1], c[2], t[0], t[1], n[0], n[1], n[2]);
    }
    for (const auto& f : kFaces)
        text += fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    return text;
}

std::string offOf(double one) {
    std::string text = "STCNOFF\n4 4 0\n";
    for (std::size_t place = 0; place < 4; ++place) {
        const auto [p, n, t, c] = rowAt(place);
        text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", p[0], p[1], p[2], n[0], n[1], n[2], one * c[0], one * c[1], one * c[2],
                            one, t[0], t[1]);
    }
    for (const auto& f : kFaces)
        text += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
    return text;
}

} // namespace

TEST_F(Streams, are_alike_in_every_format_of_text_and_order_of_bytes) {
    std::vector<std::pair<std::string, std::string>> files = {{"a.obj", objOf()}, {"bytes.off", offOf(255)}};
    const std::array<std::pair<const char*, double>, 4> colors = {{{"uchar", 255}, {"ushort", 65535}, {"float", 1}, {"double", 1}}};
    for (const Order order : {Order::Text, Order::Little, Order::Big})
        for (const char* type : {"float", "double"})
            for (const auto& [colorType, one] : colors)
                files.emplace_back(fmt::format("{}_{}_{}.ply", static_cast<int>(order), type, colorType),
                                   plyOf(order, type, colorType, one));
    for (const auto& [name, bytes] : files) {
        const auto read = readMesh(write(name, bytes), {.unitMm = 1});
        ASSERT_TRUE(read) << name << format(read.error());
        const Mesh& mesh = read->mesh;
        ASSERT_EQ(mesh.positions.size(), 4U) << name;
        ASSERT_EQ(mesh.indices.size(), 12U) << name;
        ASSERT_EQ(mesh.colors.size(), 4U) << name;
        ASSERT_EQ(mesh.uvs.size(), 4U) << name;
        for (std::size_t v = 0; v < 4; ++v) {
            const std::size_t place = mesh.positions[v].x > 0 ? 1 : mesh.positions[v].y > 0 ? 2 : mesh.positions[v].z > 0 ? 3 : 0;
            const Row row = rowAt(place);
            EXPECT_EQ(mesh.positions[v], glm::vec3(row.place[0], row.place[1], row.place[2])) << name;
            EXPECT_EQ(mesh.uvs[v], glm::vec2(row.uv[0], 1 - row.uv[1])) << name;
            ASSERT_EQ(mesh.normals.size(), 4U) << name;
            EXPECT_EQ(mesh.normals[v], glm::vec3(row.normal[0], row.normal[1], row.normal[2])) << name;
            for (glm::length_t c = 0; c < 3; ++c) // sRGB, IEC 61966-2-1
                EXPECT_NEAR(mesh.colors[v][c],
                            row.color[static_cast<std::size_t>(c)] > 0
                                ? std::pow((row.color[static_cast<std::size_t>(c)] + 0.055) / 1.055, 2.4)
                                : 0,
                            1e-5)
                    << name;
        }
    }
}

TEST_F(Streams, of_numbers_that_are_none_are_written_finite_with_a_warning) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const auto gltfWith = [&](const char* name, const char* type, std::size_t components, float bad) {
        GltfText gltf = tetrahedron();
        std::vector<float> values(4 * components, 0.5F);
        values[components] = bad;
        gltf.json["meshes"][0]["primitives"][0]["attributes"][name] = gltf.addAccessor(values, 5126, type, components);
        return gltf.glb();
    };
    const std::string plyStart = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    const struct {
        const char* name;
        std::string bytes;
        int warning;
    } cases[] = {
        {"uv.glb", gltfWith("TEXCOORD_0", "VEC2", 2, nan), 5335},
        {"far.glb", gltfWith("TEXCOORD_0", "VEC2", 2, infinity), 5335},
        {"colour.glb", gltfWith("COLOR_0", "VEC4", 4, -infinity), 5335},
        {"normal.glb", gltfWith("NORMAL", "VEC3", 3, nan), 5324},
        {"uv.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nvt 0 0\nvt 1e999 0\nvt 0 nan\nf 1/1 2/2 3/3\n", 5335},
        {"uv.ply",
         plyStart + "property float s\nproperty float t\n" + kPlyFaces + "0 0 0 0 nan\n10 0 0 1 0\n0 10 0 -inf 1\n0 0 10 0 0\n" +
             kPlyCorners,
         5335},
        {"colour.ply",
         plyStart + "property float red\nproperty float green\nproperty float blue\n" + kPlyFaces +
             "0 0 0 0 1.#QNAN 0\n10 0 0 1 0 0\n0 10 0 1 1 1\n0 0 10 0 0 -1.#IND\n" + kPlyCorners,
         5335},
    };
    for (const auto& one : cases) {
        prep::PrepOptions options;
        options.read = {.unitMm = 1, .dropNotFinite = true};
        const auto prepared = prep::prepareMesh(write(one.name, one.bytes), options);
        ASSERT_TRUE(prepared) << one.name << format(prepared.error());
        EXPECT_TRUE(warns(prepared->report.warnings, one.warning)) << one.name;
        EXPECT_TRUE(finite(prepared->mesh.uvs) && finite(prepared->mesh.colors) && finite(prepared->mesh.normals) &&
                    finite(prepared->mesh.tangents))
            << one.name;
        if (one.warning != 5335) continue;
        const auto drawn = loadMesh(folder_ / one.name, {.unitMm = 1});
        ASSERT_FALSE(drawn) << one.name << ": drawn, it is an error as before";
        EXPECT_EQ(drawn.error().diagnostics.front().code, 5305) << one.name;
    }
}

TEST_F(Colours, stay_at_their_places_whatever_is_done_to_the_mesh) {
    for (const Case& one : kCases) {
        prep::PrepOptions options;
        options.read.unitMm = 1;
        one.choose(options);
        ASSERT_TRUE(writeFile(folder_ / "painted.ply", painted(one.side)));
        const auto result = prep::prepareMesh(folder_ / "painted.ply", options);
        if (!result && options.unwrap) continue; // built without xatlas
        ASSERT_TRUE(result) << one.name << format(result.error());
        ASSERT_TRUE(writeGlb(folder_ / "out.glb", result->mesh, result->glb));
        ASSERT_TRUE(writePly(folder_ / "out.ply", result->mesh));
        for (const auto& [file, unit] : {std::pair(folder_ / "out.glb", 1000.0), std::pair(folder_ / "out.ply", 1.0)}) {
            const auto after = readVertexValues(file, kNames, unit);
            ASSERT_TRUE(after) << one.name << format(after.error());
            EXPECT_GE(after->positions.size(), static_cast<std::size_t>(one.side * one.side)) << one.name;
            EXPECT_EQ(misplaced(*after, result->report.centring.moved), 0u) << one.name << ", " << file.extension();
        }
        EXPECT_EQ(std::ranges::count(result->report.warnings, 5331, &Diagnostic::code), 0) << one.name;
    }
}
