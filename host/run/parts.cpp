#include "host/run/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tegument::run {

namespace {

std::set<std::string> namedBy(const Effect& effect) {
    std::set<std::string> names;
    for (const Technique& technique : effect.techniques)
        for (const Pass& pass : technique.passes)
            if (const auto part = pass.annotations.string("Part")) names.insert(*part);
    return names;
}

void append(std::vector<IndexRange>& ranges, const IndexRange& range) {
    if (!ranges.empty() && ranges.back().first + ranges.back().count == range.first)
        ranges.back().count += range.count;
    else
        ranges.push_back(range);
}

Error noSuchPart(const Pass& pass, const std::string& part, const Mesh& mesh) {
    std::vector<std::string> names;
    for (const MeshPart& other : mesh.parts)
        names.push_back(other.name);
    return inputError(4060, {.file = mesh.name, .byte = {}},
                      fmt::format("pass {} draws the mesh's part '{}', and there is none: it has {}", pass.name, part,
                                  names.empty() ? "no parts" : fmt::format("{}", fmt::join(names, ", "))),
                      part == kStrandsPart || part == kUnderfurPart ? "tegument fur strands MESH -o NEW.glb makes them"
                                                                    : "name a primitive of the glTF file so");
}

} // namespace

Result<std::vector<IndexRange>> partOf(const Effect& effect, const Pass& pass, const Mesh& mesh) {
    const auto part = pass.annotations.string("Part");
    if (!part) return std::vector<IndexRange>{{.first = 0, .count = static_cast<std::uint32_t>(mesh.indices.size())}};
    const bool named = std::ranges::any_of(mesh.parts, [&](const MeshPart& own) { return own.name == *part; });
    if (!named && *part != kSkinPart) return noSuchPart(pass, *part, mesh);
    const std::set<std::string> others = namedBy(effect);
    std::vector<IndexRange> ranges;
    for (const MeshPart& own : mesh.parts)
        if (named ? own.name == *part : !others.contains(own.name)) append(ranges, {.first = own.firstIndex, .count = own.indexCount});
    if (ranges.empty()) return noSuchPart(pass, *part, mesh);
    return ranges;
}

} // namespace tegument::run
