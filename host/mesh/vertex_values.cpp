#include "host/mesh/vertex_values.h"

#include "host/mesh/ply_values.h"
#include "host/support/file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
        return noSuchProperty(source_, {.name = "vertex", .line = 1, .properties = {}}, names.front());
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

} // namespace

Result<VertexValues> readVertexValues(const std::filesystem::path& path, std::span<const std::string> names, double unitMm) {
    const Result<std::string> bytes = readFile(path);
    if (!bytes) return bytes.error();
    const Source source{.path = path, .bytes = *bytes, .unitMm = unitMm};
    if (!bytes->starts_with("ply"))
        return inputError(5313, source.whole(),
                          fmt::format("only PLY files name what their vertices hold: '{}' is not found", names.front()),
                          "export the mesh as PLY, with that as a property of its vertices");
    const Result<PlyHeader> header = readPlyHeader(source);
    if (!header) return header.error();
    return Reader(source, *header).read(names);
}

} // namespace tegument
