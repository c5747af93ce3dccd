// Every number of every stream: however a file packs what its vertices hold, it is read as from the plain file; and what is no number does
// not reach what is written.
// Colours and properties of a scan's vertices, at the same places whatever is done to the mesh.

#include "host/mesh/read_mesh.h"
#include "host/mesh/vertex_values.h"
#include "host/support/file.h"
#include "tests/meshprep/prepare/glb_text.h"
#include "tests/meshprep/prepare/meshes.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
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
    Stream{"COLOR_0", 4, 5126, 1},      Stream{"COLOR_0", 4, 5121, 255},      Stream{"COLOR_0", 4, 5123, 65535},
    Stream{"TEXCOORD_0", 2, 5126, 1},   Stream{"TEXCOORD_0", 2, 5121, 255},   Stream{"TEXCOORD_0", 2, 5123, 65535},
    Stream{"TEXCOORD_1", 2, 5121, 255}, Stream{"TEXCOORD_1", 2, 5123, 65535}, Stream{"_HEAT", 4, 5121, 255},
    Stream{"NORMAL", 4, 5120, 127},
};

/// Of place and channel: fifteenths, which 8 and 16 bits hold exactly. Normals are unit vectors along axes.
double meant(const Stream& stream, std::size_t place, std::size_t channel) {
    if (std::string_view(stream.name) == "NORMAL") return channel == place % 3 ? (place == 3 ? -1 : 1) : 0;
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
    const int places = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    withValues(stream, [&](const auto& values, draco::DataType type) {
        const auto channels = static_cast<std::int8_t>(channelsOf(stream));
        const int extra = builder.AddAttribute(draco::GeometryAttribute::GENERIC, channels, type);
        for (std::uint32_t f = 0; f < 4; ++f) {
            const auto& t = kFaces[f];
            const draco::FaceIndex face(f);
            builder.SetAttributeValuesForFace(places, face, kPlaces[t[0]].data(), kPlaces[t[1]].data(), kPlaces[t[2]].data());
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
        gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
            {"bufferView", view},
            {"attributes", {{"POSITION", mesh->attribute(places)->unique_id()}, {stream.name, mesh->attribute(extra)->unique_id()}}}};
    });
}

std::string fileOf(const Stream& stream, Packing packing) {
    GltfText gltf = tetrahedron();
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

TEST_F(Streams, colours_of_ply_are_alike_in_every_type) {
    const auto colours = [&](const char* type, const char* one, const char* half) {
        std::string text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
        for (const char* channel : {"red", "green", "blue"})
            text += std::string("property ") + type + " " + channel + "\n";
        text += kPlyFaces;
        for (const auto& p : kPlaces)
            text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + " " + one + " " + half + " 0\n";
        const auto read = readMesh(write("colours.ply", text + kPlyCorners), {.unitMm = 1});
        EXPECT_TRUE(read) << type;
        return read ? read->mesh.colors : std::vector<glm::vec4>();
    };
    const auto bytes = colours("uchar", "255", "51");
    ASSERT_EQ(bytes.size(), 4U);
    for (const auto& other : {colours("ushort", "65535", "13107"), colours("float", "1", "0.2"), colours("double", "1.0", "0.2")}) {
        ASSERT_EQ(other.size(), 4U);
        EXPECT_NEAR(glm::length(other[0] - bytes[0]), 0, 1e-6);
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
