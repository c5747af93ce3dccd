#include "meshprep/fur/roots/vertex_maps.h"

#include "host/mesh/vertex_values.h"
#include "host/mesh/welding.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument {

namespace {

/// loadMesh leaves vertices out and splits others, but moves none: they are found by their place.
std::vector<glm::dvec3> atVertices(const Mesh& mesh, const VertexValues& file) {
    std::vector<glm::vec3> places = file.positions;
    places.insert(places.end(), mesh.positions.begin(), mesh.positions.end());
    const std::vector<std::uint32_t> first = weldPositions(places);
    std::vector<glm::dvec4> sums(file.positions.size(), glm::dvec4(0));
    for (std::size_t i = 0; i < file.positions.size(); ++i) {
        glm::dvec4 value(0, 0, 0, 1);
        for (std::size_t k = 0; k < file.values.size(); ++k)
            value[static_cast<glm::length_t>(k)] = file.values[k][i];
        sums[first[i]] += value;
    }
    std::vector<glm::dvec3> values;
    values.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::uint32_t place = first[file.positions.size() + i];
        assert(place < sums.size());
        values.emplace_back(glm::dvec3(sums[place]) / sums[place].w);
    }
    return values;
}

Result<void> check(const std::filesystem::path& path, const VertexValues& file, std::span<const std::string> names, bool shares) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::vector<double>& values = file.values[k];
        const auto wrong = std::ranges::find_if(values, [&](double v) { return shares ? !(v >= 0 && v <= 1) : !std::isfinite(v); });
        if (wrong == values.end()) continue;
        const SourcePosition at{.file = path.string(), .byte = {}};
        const std::string what = fmt::format("vertex {} has {} {}", wrong - values.begin(), names[k], *wrong);
        if (!std::isfinite(*wrong)) return inputError(7108, at, what + ", which is not finite", "mend the values of the vertices");
        const auto [low, high] = std::ranges::minmax(values);
        return inputError(7108, at, what + ", which is no share",
                          fmt::format("they lie between {:g} and {:g}: scale them to 0 to 1", low, high));
    }
    return {};
}

Result<VertexValues> checkedValues(const std::filesystem::path& path, std::span<const std::string> names, const Mesh& mesh, bool shares) {
    auto values = readVertexValues(path, names, mesh.unitMm);
    if (!values) return values.error();
    if (const auto checked = check(path, *values, names, shares); !checked) return checked.error();
    return values;
}

std::vector<std::string> split(std::string_view list) {
    std::vector<std::string> names;
    while (true) {
        const std::size_t end = list.find(',');
        names.emplace_back(trim(list.substr(0, end)));
        if (end == std::string_view::npos) break;
        list.remove_prefix(end + 1);
    }
    return names;
}

} // namespace

Result<FurMap> readVertexShares(const std::filesystem::path& path, const std::string& name, const Mesh& mesh) {
    const std::vector<std::string> names{name};
    const auto values = checkedValues(path, names, mesh, true);
    if (!values) return values.error();
    return FurMap(atVertices(mesh, *values));
}

namespace {

Result<std::vector<std::string>> threeOf(const std::string& list, const char* what) {
    std::vector<std::string> names = split(list);
    if (names.size() == 3) return names;
    return usageError(7103, fmt::format("'{}' names {} properties for a {}", list, names.size(), what),
                      "name three with commas between, as nx,ny,nz or red,green,blue");
}

} // namespace

Result<FurMap> readVertexColors(const std::filesystem::path& path, const std::string& list, const Mesh& mesh) {
    const auto names = threeOf(list, "colour");
    if (!names) return names.error();
    auto values = checkedValues(path, *names, mesh, true);
    if (!values) return values.error();
    for (std::size_t k = 0; k < names->size(); ++k)
        if (values->whole[k])
            for (double& value : values->values[k])
                value = static_cast<double>(srgbToLinear(static_cast<float>(value)));
    return FurMap(atVertices(mesh, *values));
}

Result<FurMap> readVertexDirections(const std::filesystem::path& path, const std::string& list, const Mesh& mesh) {
    const auto three = threeOf(list, "direction");
    if (!three) return three.error();
    const std::vector<std::string>& names = *three;
    auto values = checkedValues(path, names, mesh, false);
    if (!values) return values.error();
    for (std::size_t k = 0; k < names.size(); ++k)
        if (!values->whole[k])
            for (double& value : values->values[k])
                value = (value + 1) / 2; // as maps hold it
    return FurMap(atVertices(mesh, *values));
}

} // namespace tegument
