#include "meshprep/fur/roots/vertex_values.h"

#include "host/image/image.h"
#include "host/mesh/ply_values.h"
#include "host/support/file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

namespace tegument {

namespace {

using namespace meshfile;

/// What stands for 1 in the types that colours have; others hold their numbers as they are.
std::optional<double> greatest(PlyType type) {
    switch (type) {
    case PlyType::Int8: return std::numeric_limits<std::int8_t>::max();
    case PlyType::Uint8: return std::numeric_limits<std::uint8_t>::max();
    case PlyType::Int16: return std::numeric_limits<std::int16_t>::max();
    case PlyType::Uint16: return std::numeric_limits<std::uint16_t>::max();
    default: return std::nullopt;
    }
}

Error noSuchProperty(const Source& source, const PlyElement& element, const std::string& name) {
    std::vector<std::string> names;
    for (const PlyProperty& property : element.properties)
        if (!property.listCount) names.push_back(property.name);
    return inputError(5313, source.atLine(element.line), fmt::format("the vertices have no property '{}'", name),
                      names.empty() ? "they have none at all" : fmt::format("they have {}", fmt::join(names, ", ")));
}

class Reader {
public:
    Reader(const Source& source, const PlyHeader& header) : source_(source), header_(header), values_(source, header) {}

    Result<VertexValues> read(std::span<const std::string> names) {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") return readVertices(element, names);
            values_.skip(element);
            if (values_.error()) return *values_.error();
        }
        return noSuchProperty(source_, {.name = "vertex", .line = 1}, names.front());
    }

private:
    Result<VertexValues> readVertices(const PlyElement& element, std::span<const std::string> names) {
        std::vector<std::size_t> columns;
        VertexValues found;
        for (const std::string& name : names) {
            const auto column = element.find({name});
            if (!column || element.properties[*column].listCount) return noSuchProperty(source_, element, name);
            columns.push_back(*column);
            found.whole.push_back(greatest(element.properties[*column].type).has_value());
        }
        const auto x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
        if (!x || !y || !z) return malformed(source_.atLine(element.line), "the vertices have no x, y and z");
        if (element.count > kMaxVertices) return tooLarge(source_.atLine(element.line));
        found.values.resize(names.size());
        std::vector<double> row;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            values_.nextRow(element, row);
            if (values_.error()) return *values_.error();
            found.positions.push_back(scaled({row[*x], row[*y], row[*z]}, source_.unitMm));
            for (std::size_t k = 0; k < columns.size(); ++k)
                found.values[k].push_back(row[columns[k]] / greatest(element.properties[columns[k]].type).value_or(1));
        }
        return found;
    }

    const Source& source_;
    const PlyHeader& header_;
    PlyValues values_;
};

/// What `tegument prep` has carried from a PLY file into a glb.
Result<VertexValues> ofGltf(const Source& source, std::span<const std::string> names) {
    auto file = readMesh(source.path, {.unitMm = source.unitMm});
    if (!file) return file.error();
    const Mesh& mesh = file->mesh;
    VertexValues found{.positions = mesh.positions};
    constexpr std::array<std::string_view, 4> kChannels = {"red", "green", "blue", "alpha"};
    for (const std::string& name : names) {
        const auto known = std::ranges::find(mesh.attributes, name, &MeshAttribute::name);
        const auto* channel = std::ranges::find(kChannels, name);
        std::vector<double>& values = found.values.emplace_back();
        if (known != mesh.attributes.end() && known->components == 1) {
            values = known->values;
            for (double& value : values)
                value /= greatest(known->type).value_or(1);
            found.whole.push_back(greatest(known->type).has_value());
        } else if (channel != kChannels.end() && !mesh.colors.empty()) {
            const auto c = static_cast<glm::length_t>(channel - kChannels.begin());
            for (const glm::vec4& color : mesh.colors)
                values.push_back(static_cast<double>(c < 3 ? linearToSrgb(color[c]) : color[c]));
            found.whole.push_back(true);
        } else {
            PlyElement element{.name = "vertex", .line = 0};
            for (const MeshAttribute& attribute : mesh.attributes)
                element.properties.push_back({.name = attribute.name, .type = attribute.type});
            for (const std::string_view c : kChannels)
                if (!mesh.colors.empty()) element.properties.push_back({.name = std::string(c), .type = NumberType::Uint8});
            return noSuchProperty(source, element, name);
        }
    }
    return found;
}

} // namespace

Result<VertexValues> readVertexValues(const std::filesystem::path& path, std::span<const std::string> names, double unitMm) {
    const Result<std::string> bytes = readFile(path);
    if (!bytes) return bytes.error();
    const Source source{.path = path, .bytes = *bytes, .unitMm = unitMm};
    if (bytes->starts_with("glTF")) return ofGltf(source, names);
    if (!bytes->starts_with("ply"))
        return inputError(5313, source.whole(),
                          fmt::format("only PLY and glb files name what their vertices hold: '{}' is not found", names.front()),
                          "export the mesh as PLY, with that as a property of its vertices");
    const Result<PlyHeader> header = readPlyHeader(source);
    if (!header) return header.error();
    return Reader(source, *header).read(names);
}

} // namespace tegument
