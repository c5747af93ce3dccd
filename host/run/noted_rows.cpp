#include "host/run/noted_rows.h"

#include "host/mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument::run {

namespace {

constexpr double kRootColumns = 4096; // texels in a row of the texture of roots (docs/design/fur.md)

/// Of the parameter that the annotation names; `otherwise` where there is none.
Result<double> rowsNumber(const RunInput& input, const Prepared& prepared, const Pass& pass, const char* annotation, double otherwise) {
    const auto name = pass.annotations.string(annotation);
    if (!name) return otherwise;
    const Parameter* parameter = input.effect.findParameter(*name);
    assert(parameter); // host/effect has checked the annotation
    const auto value = prepared.values.require(*parameter);
    if (!value) return value.error();
    return value->front();
}

/// Strands of a root, and rows of each.
struct Noted {
    double strands = 1;
    double rows = 1;
};

Result<Noted> notedBy(const RunInput& input, const Prepared& prepared, const Pass& pass) {
    const auto strands = rowsNumber(input, prepared, pass, "RowsStrands", 1);
    if (!strands) return strands.error();
    const auto more = rowsNumber(input, prepared, pass, "RowsMore", 0);
    if (!more) return more.error();
    const auto segments = rowsNumber(input, prepared, pass, "RowsEach", 0);
    if (!segments) return segments.error();
    const auto scale = pass.annotations.numbers("RowsScale");
    return Noted{.strands = *strands + *more, .rows = std::ceil((scale ? scale->front() : 1) * std::round(*segments)) + 1};
}

std::string howToGive(const Pass& pass, double wanted) {
    const auto macro = pass.annotations.string("RowsMacro");
    if (!macro || wanted > kMaxExtent)
        return fmt::format("take fewer strands, or a technique without compute shaders: a target has {} rows at most", kMaxExtent);
    return fmt::format("-D {}={:.0f}, fewer strands, or a technique without compute shaders", *macro, wanted);
}

} // namespace

std::uint32_t rootRowsOf(const Mesh& mesh, const std::string& part) {
    const auto named = std::ranges::find(mesh.parts, part, &MeshPart::name);
    if (named == mesh.parts.end() || !isRibbons(*named) || named->indexCount == 0 || mesh.uvs.empty()) return 0;
    const auto addressAt = [&](std::uint32_t i) { return mesh.uvs[mesh.indices[named->firstIndex + i]].y; };
    std::uint32_t ribbon = 3; // indices of one: all have as many
    while (ribbon < named->indexCount && addressAt(ribbon) == addressAt(0))
        ribbon += 3;
    double least = static_cast<double>(addressAt(0));
    double most = least;
    for (std::uint32_t i = 0; i < named->indexCount; i += ribbon) {
        least = std::min(least, static_cast<double>(addressAt(i)));
        most = std::max(most, static_cast<double>(addressAt(i)));
    }
    return static_cast<std::uint32_t>(std::floor(most / kRootColumns) - std::floor(least / kRootColumns)) + 1;
}

Result<void> checkNotedRows(const RunInput& input, const Prepared& prepared, const Pass& pass) {
    const auto target = pass.annotations.string("Rows");
    const auto part = pass.annotations.string("Part");
    const auto found = prepared.targets.find(target.value_or(""));
    if (!target || !part || !input.mesh || found == prepared.targets.end()) return {};
    const auto noted = notedBy(input, prepared, pass);
    if (!noted) return noted.error();
    const double roots = rootRowsOf(*input.mesh, *part);
    const auto threads = prepared.targets.find(pass.annotations.string("Threads").value_or(""));
    if (threads != prepared.targets.end() && roots > threads->second.extent.height)
        return inputError(4064, pass.at,
                          fmt::format("pass {} notes {:.0f} rows of roots, and {} holds {}", pass.name, roots, threads->first,
                                      threads->second.extent.height),
                          "grow fewer strands, or take a technique without compute shaders");
    const double wanted = std::ceil(roots * noted->strands * noted->rows);
    if (wanted <= found->second.extent.height) return {};
    return inputError(4064, pass.at,
                      fmt::format("pass {} notes {:.0f} rows of strands, and {} holds {}: {:.0f} rows of roots, {:g} strands to a root, "
                                  "{:.0f} rows to a strand",
                                  pass.name, wanted, *target, found->second.extent.height, roots, noted->strands, noted->rows),
                      howToGive(pass, wanted));
}

} // namespace tegument::run
