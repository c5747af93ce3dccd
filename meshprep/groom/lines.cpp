// Grooms as lines of mesh files: OBJ `l`; glTF LINES, LINE_STRIP and LINE_LOOP; edges of PLY.

#include "host/image/image.h"
#include "host/mesh/gltf_document.h"
#include "host/mesh/obj_file.h"
#include "host/mesh/ply_values.h"
#include "meshprep/groom/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tegument::groomfile {

using namespace meshfile;

namespace {

using OrderedJson = nlohmann::ordered_json;

/// What the vertices of a file say; lists are empty where they say nothing.
struct Vertices {
    std::vector<glm::vec3> points{};
    std::vector<glm::vec3> colors{};
    std::vector<float> widths{};
    std::vector<glm::vec2> uvs{};
    std::array<std::vector<float>, 3> numbers{}; // ids, guides, clumps
};

constexpr std::array<const char*, 3> kNumbers = {"groom_id", "groom_guide", "groom_clump"};

/// One strand through these vertices: numbers and texture coordinates are the root's.
void addStrand(const Vertices& vertices, std::span<const std::uint32_t> chain, Groom& groom) {
    for (const std::uint32_t v : chain) {
        groom.points.push_back(vertices.points[v]);
        if (!vertices.colors.empty()) groom.colors.push_back(vertices.colors[v]);
        if (!vertices.widths.empty()) groom.widths.push_back(vertices.widths[v]);
    }
    if (!vertices.uvs.empty()) groom.rootUvs.push_back(vertices.uvs[chain.front()]);
    std::vector<std::int32_t>* const numbers[] = {&groom.ids, &groom.guides, &groom.clumps};
    for (std::size_t i = 0; i < 3; ++i)
        if (!vertices.numbers[i].empty())
            numbers[i]->push_back(static_cast<std::int32_t>(std::clamp(vertices.numbers[i][chain.front()], -16777216.0F, 16777216.0F)));
    groom.endStrand();
}

void addChains(const Source& source, const Vertices& vertices, std::span<const std::pair<std::uint32_t, std::uint32_t>> edges,
               Groom& groom) {
    const std::size_t rings =
        chains(edges, vertices.points.size(), [&](std::span<const std::uint32_t> chain) { addStrand(vertices, chain, groom); });
    if (rings > 0) ignored(groom, source, fmt::format("{} edges of rings are left out: a strand has two ends", rings));
}

/// Of every point, what its strand says of itself.
template <class Value>
std::vector<Value> ofPoints(const Groom& groom, const std::vector<Value>& ofStrands) {
    std::vector<Value> values;
    if (ofStrands.empty()) return values;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        values.insert(values.end(), groom.length(i), ofStrands[i]);
    return values;
}

bool tooMany(const Source& source, std::size_t points) {
    return points > kPointsOfByte * source.bytes.size() || points > kMaxIndices;
}

} // namespace

Result<Groom> readObjLines(const Source& source, std::size_t) {
    Source lenient = source;
    lenient.dropBadFaces = true;
    const auto file = parseObj(lenient);
    if (!file) return file.error();
    Groom groom;
    if (tooMany(source, file->lineCorners.size())) return tooLarge(source.whole());
    const bool uvs = !file->uvs.empty();
    for (std::size_t i = 0; i < file->firstOfLine.size(); ++i) {
        const std::size_t last = i + 1 < file->firstOfLine.size() ? file->firstOfLine[i + 1] : file->lineCorners.size();
        const auto corners = std::span(file->lineCorners).subspan(file->firstOfLine[i], last - file->firstOfLine[i]);
        for (const ObjCorner& corner : corners) {
            if (corner.position >= file->positions.size())
                return badIndex(source.whole(), fmt::format("line {} names vertex {}, and there are {}", i + 1,
                                                            corner.position + std::size_t{1}, file->positions.size()));
            groom.points.push_back(file->positions[corner.position]);
            if (!file->colors.empty()) groom.colors.emplace_back(file->colors[corner.position]);
        }
        const std::uint32_t uv = corners.front().uv;
        if (uvs) groom.rootUvs.emplace_back(uv < file->uvs.size() ? glm::vec2(file->uvs[uv]) : glm::vec2(0));
        groom.endStrand();
    }
    return groom;
}

std::string writeObjLines(const Groom& groom) {
    std::string text = "# Tegument: a groom, a line for each strand\n";
    auto to = std::back_inserter(text);
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
        const glm::vec3& p = groom.points[i];
        fmt::format_to(to, "v {:.9g} {:.9g} {:.9g}", p.x, p.y, p.z);
        if (!groom.colors.empty()) {
            const glm::vec3& c = groom.colors[i];
            fmt::format_to(to, " {:.7g} {:.7g} {:.7g}", linearToSrgb(c.x), linearToSrgb(c.y), linearToSrgb(c.z));
        }
        text.push_back('\n');
    }
    for (const glm::vec2& uv : groom.rootUvs)
        fmt::format_to(to, "vt {:.9g} {:.9g}\n", uv.x, uv.y);
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        text.push_back('l');
        for (std::uint32_t k = groom.first[i]; k < groom.first[i + 1]; ++k) {
            fmt::format_to(to, " {}", k + 1);
            if (!groom.rootUvs.empty()) fmt::format_to(to, "/{}", i + 1);
        }
        text.push_back('\n');
    }
    return text;
}

Result<Groom> readPlyEdges(const Source& source, std::size_t) {
    const auto header = readPlyHeader(source);
    if (!header) return header.error();
    PlyValues values(source, *header);
    Vertices vertices;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<double> row;
    for (const PlyElement& element : header->elements) {
        if (element.count > kMaxIndices) return tooLarge(source.atLine(element.line));
        if (element.name == "vertex") {
            const auto x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
            if (!x || !y || !z) return malformed(source.atLine(element.line), "the vertices have no x, y and z");
            const auto width = element.find({"width"}), radius = element.find({"radius"});
            const auto u = element.find({"s", "u", "texture_u"}), v = element.find({"t", "v", "texture_v"});
            const auto red = element.find({"red"}), green = element.find({"green"}), blue = element.find({"blue"});
            std::array<std::optional<std::size_t>, 3> numbers;
            for (std::size_t i = 0; i < 3; ++i)
                numbers[i] = element.find({kNumbers[i]});
            for (std::uint64_t i = 0; i < element.count && !values.error(); ++i) {
                values.nextRow(element, row);
                vertices.points.emplace_back(row[*x], row[*y], row[*z]);
                if (width || radius) vertices.widths.push_back(static_cast<float>(width ? row[*width] : 2 * row[*radius]));
                if (u && v) vertices.uvs.emplace_back(row[*u], row[*v]);
                if (red && green && blue) {
                    const glm::dvec3 c(row[*red], row[*green], row[*blue]);
                    const bool bytes = element.properties[*red].type == PlyType::Uint8;
                    vertices.colors.push_back(bytes ? glm::vec3(linearColor(glm::dvec4(c / 255.0, 1))) : glm::vec3(c));
                }
                for (std::size_t k = 0; k < 3; ++k)
                    if (numbers[k]) vertices.numbers[k].push_back(static_cast<float>(row[*numbers[k]]));
            }
        } else if (element.name == "edge") {
            const auto a = element.find({"vertex1"}), b = element.find({"vertex2"});
            if (!a || !b) return malformed(source.atLine(element.line), "the edges have no vertex1 and vertex2");
            for (std::uint64_t i = 0; i < element.count && !values.error(); ++i) {
                values.nextRow(element, row);
                const double most = static_cast<double>(vertices.points.size());
                if (!(row[*a] >= 0 && row[*a] < most && row[*b] >= 0 && row[*b] < most))
                    return badIndex(values.at(),
                                    fmt::format("edge {} joins vertices {:g} and {:g}, and there are {}", i, row[*a], row[*b], most));
                edges.emplace_back(static_cast<std::uint32_t>(row[*a]), static_cast<std::uint32_t>(row[*b]));
            }
        } else {
            values.skip(element);
        }
        if (values.error()) return *values.error();
    }
    Groom groom;
    addChains(source, vertices, edges, groom);
    return groom;
}

std::string writePlyEdges(const Groom& groom) {
    const std::vector<glm::vec2> uvs = ofPoints(groom, groom.rootUvs);
    const std::array<std::vector<std::int32_t>, 3> numbers = {ofPoints(groom, groom.ids), ofPoints(groom, groom.guides),
                                                              ofPoints(groom, groom.clumps)};
    std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\ncomment Tegument: a groom, a chain of edges for each strand\n"
                                    "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                                    groom.points.size());
    if (!groom.widths.empty()) bytes += "property float width\n";
    if (!groom.colors.empty()) bytes += "property float red\nproperty float green\nproperty float blue\n";
    if (!uvs.empty()) bytes += "property float s\nproperty float t\n";
    for (std::size_t k = 0; k < 3; ++k)
        if (!numbers[k].empty()) bytes += fmt::format("property int {}\n", kNumbers[k]);
    bytes +=
        fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n", groom.points.size() - groom.strands());
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
        append(bytes, groom.points[i]);
        if (!groom.widths.empty()) append(bytes, groom.widths[i]);
        if (!groom.colors.empty()) append(bytes, groom.colors[i]);
        if (!uvs.empty()) append(bytes, uvs[i]);
        for (const std::vector<std::int32_t>& list : numbers)
            if (!list.empty()) append(bytes, list[i]);
    }
    for (std::size_t i = 0; i < groom.strands(); ++i)
        for (std::uint32_t k = groom.first[i]; k + 1 < groom.first[i + 1]; ++k) {
            append(bytes, k);
            append(bytes, k + 1);
        }
    return bytes;
}

namespace {

class LineReader {
public:
    LineReader(const Source& source, const GltfDocument& document) : source_(source), document_(document) {}

    Result<Groom> read() {
        Mesh warnings;
        const auto places = gltfPlaces(document_, warnings);
        if (!places) return places.error();
        for (const GltfPlace& place : *places) {
            const GltfValue primitives = document_.root()["meshes"][place.mesh]["primitives"];
            for (std::size_t i = 0; i < primitives.size(); ++i)
                if (auto error = addPrimitive(primitives[i], place.matrix)) return *error;
        }
        std::ranges::move(warnings.warnings, std::back_inserter(groom_.warnings));
        return std::move(groom_);
    }

private:
    std::optional<Error> addPrimitive(const GltfValue& primitive, const glm::dmat4& matrix) {
        const auto mode = primitive.whole("mode", 7, 4);
        if (!mode) return mode.error();
        if (*mode == 0 || *mode > 3) return std::nullopt; // points and triangles
        Vertices vertices;
        if (auto error = readVertices(primitive["attributes"], matrix, vertices)) return error;
        const auto count = static_cast<std::uint32_t>(vertices.points.size());
        std::vector<std::uint32_t> corners;
        if (primitive.has("indices")) {
            const auto accessor = primitive.whole("indices", SIZE_MAX, {});
            if (!accessor) return accessor.error();
            auto indices = document_.indices(*accessor);
            if (!indices) return indices.error();
            corners = *std::move(indices);
        } else {
            for (std::uint32_t i = 0; i < count; ++i)
                corners.push_back(i);
        }
        read_ += corners.size();
        if (tooMany(source_, read_)) return tooLarge(source_.whole());
        if (std::ranges::any_of(corners, [&](std::uint32_t i) { return i >= count; }))
            return badIndex(source_.whole(), fmt::format("{} names a vertex that is not there", primitive.path()));
        if (*mode == 1) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
            for (std::size_t i = 0; i + 1 < corners.size(); i += 2)
                edges.emplace_back(corners[i], corners[i + 1]);
            addChains(source_, vertices, edges, groom_);
        } else if (!corners.empty()) {
            addStrand(vertices, corners, groom_);
        }
        return std::nullopt;
    }

    Result<std::vector<float>> attribute(const GltfValue& attributes, const char* name, std::size_t components) {
        if (!attributes.has(name)) return std::vector<float>();
        const auto accessor = attributes.whole(name, SIZE_MAX, {});
        if (!accessor) return accessor.error();
        auto values = document_.floats(*accessor, components);
        if (values) read_ += values->size() / 4;
        if (values && tooMany(source_, read_)) return tooLarge(source_.whole());
        return values;
    }

    std::optional<Error> readVertices(const GltfValue& attributes, const glm::dmat4& matrix, Vertices& vertices) {
        const auto places = attribute(attributes, "POSITION", 3);
        if (!places) return places.error();
        for (std::size_t i = 0; i + 2 < places->size(); i += 3)
            vertices.points.emplace_back(matrix * glm::dvec4((*places)[i], (*places)[i + 1], (*places)[i + 2], 1));
        const auto wanted = [&](const Result<std::vector<float>>& values, std::size_t components) -> std::optional<Error> {
            if (!values) return values.error();
            if (values->empty() || values->size() == components * vertices.points.size()) return std::nullopt;
            return attributes.wrong("has attributes of different lengths");
        };
        auto widths = attribute(attributes, "_WIDTH", 1);
        if (auto error = wanted(widths, 1)) return error;
        vertices.widths = *std::move(widths);
        const auto uvs = attribute(attributes, "TEXCOORD_0", 2);
        if (auto error = wanted(uvs, 2)) return error;
        for (std::size_t i = 0; i < uvs->size(); i += 2)
            vertices.uvs.emplace_back((*uvs)[i], 1 - (*uvs)[i + 1]);
        std::size_t channels = 4;
        if (attributes.has("COLOR_0"))
            if (const auto accessor = attributes.whole("COLOR_0", SIZE_MAX, {})) channels = document_.components(*accessor) == 3 ? 3 : 4;
        const auto colors = attribute(attributes, "COLOR_0", channels);
        if (auto error = wanted(colors, channels)) return error;
        for (std::size_t i = 0; i < colors->size(); i += channels)
            vertices.colors.emplace_back((*colors)[i], (*colors)[i + 1], (*colors)[i + 2]);
        constexpr std::array<const char*, 3> kNames = {"_GROOM_ID", "_GROOM_GUIDE", "_GROOM_CLUMP"};
        for (std::size_t k = 0; k < 3; ++k) {
            auto numbers = attribute(attributes, kNames[k], 1);
            if (auto error = wanted(numbers, 1)) return error;
            vertices.numbers[k] = *std::move(numbers);
        }
        const bool differs = groom_.strands() > 0 &&
                             (vertices.widths.empty() != groom_.widths.empty() || vertices.colors.empty() != groom_.colors.empty() ||
                              vertices.uvs.empty() != groom_.rootUvs.empty() || vertices.numbers[0].empty() != groom_.ids.empty() ||
                              vertices.numbers[1].empty() != groom_.guides.empty() || vertices.numbers[2].empty() != groom_.clumps.empty());
        if (differs)
            return unsupported(source_.whole(), "lines of one file have different attributes", "join them before they are exported");
        return std::nullopt;
    }

    const Source& source_;
    const GltfDocument& document_;
    Groom groom_;
    std::size_t read_ = 0; // numbers, in points
};

class LineWriter {
public:
    explicit LineWriter(const Groom& groom) : groom_(groom) {}

    std::string write() {
        OrderedJson attributes;
        glm::vec3 low = groom_.points.front(), high = low;
        for (const glm::vec3& p : groom_.points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        attributes["POSITION"] = accessor(groom_.points, "VEC3", kFloat);
        accessors_.back()["min"] = {low.x, low.y, low.z};
        accessors_.back()["max"] = {high.x, high.y, high.z};
        if (!groom_.colors.empty()) attributes["COLOR_0"] = accessor(groom_.colors, "VEC3", kFloat);
        std::vector<glm::vec2> uvs = ofPoints(groom_, groom_.rootUvs);
        for (glm::vec2& uv : uvs)
            uv.y = 1 - uv.y;
        if (!uvs.empty()) attributes["TEXCOORD_0"] = accessor(uvs, "VEC2", kFloat);
        if (!groom_.widths.empty()) attributes["_WIDTH"] = accessor(groom_.widths, "SCALAR", kFloat);
        const std::pair<const char*, const std::vector<std::int32_t>*> numbers[] = {
            {"_GROOM_ID", &groom_.ids}, {"_GROOM_GUIDE", &groom_.guides}, {"_GROOM_CLUMP", &groom_.clumps}};
        for (const auto& [name, list] : numbers) {
            const std::vector<std::int32_t> whole = ofPoints(groom_, *list);
            if (!whole.empty()) attributes[name] = accessor(std::vector<float>(whole.begin(), whole.end()), "SCALAR", kFloat);
        }
        std::vector<std::uint32_t> indices;
        for (std::size_t i = 0; i < groom_.strands(); ++i)
            for (std::uint32_t k = groom_.first[i]; k + 1 < groom_.first[i + 1]; ++k)
                indices.insert(indices.end(), {k, k + 1});
        const std::size_t index = accessor(indices, "SCALAR", kUnsignedInt);
        const OrderedJson json = {{"asset", {{"version", "2.0"}, {"generator", "Tegument"}}},
                                  {"scene", 0},
                                  {"scenes", {{{"nodes", {0}}}}},
                                  {"nodes", {{{"mesh", 0}, {"name", "groom"}}}},
                                  {"meshes", {{{"primitives", {{{"attributes", attributes}, {"indices", index}, {"mode", 1}}}}}}},
                                  {"accessors", accessors_},
                                  {"bufferViews", views_},
                                  {"buffers", {{{"byteLength", binary_.size()}}}}};
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        if (text.size() + binary_.size() > UINT32_MAX - 64) return {};
        std::string glb = "glTF";
        const auto chunk = [&](const char* type, const std::string& data) {
            append(glb, static_cast<std::uint32_t>(data.size()));
            glb.append(type, 4).append(data);
        };
        append(glb, std::uint32_t{2});
        append(glb, static_cast<std::uint32_t>(28 + text.size() + binary_.size()));
        chunk("JSON", text);
        chunk("BIN\0", binary_);
        return glb;
    }

private:
    static constexpr int kFloat = 5126;
    static constexpr int kUnsignedInt = 5125;

    template <class Value>
    std::size_t accessor(const std::vector<Value>& values, const char* type, int component) {
        views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size() * sizeof(Value)}});
        append(binary_, values);
        accessors_.push_back({{"bufferView", views_.size() - 1}, {"componentType", component}, {"count", values.size()}, {"type", type}});
        return accessors_.size() - 1;
    }

    const Groom& groom_;
    std::string binary_;
    OrderedJson accessors_ = OrderedJson::array(), views_ = OrderedJson::array();
};

} // namespace

Result<Groom> readGltfLines(const Source& source, std::size_t) {
    const auto document = GltfDocument::open(source);
    if (!document) return document.error();
    return LineReader(source, **document).read();
}

std::string writeGltfLines(const Groom& groom) {
    return LineWriter(groom).write();
}

} // namespace tegument::groomfile
