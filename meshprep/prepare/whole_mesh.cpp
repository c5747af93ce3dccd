#include "meshprep/prepare/whole_mesh.h"

#include "meshprep/prepare/centre.h"
#include "meshprep/prepare/vertices.h"

#include <algorithm>
#include <array>

namespace tegument::prep {

namespace {

using Indices = std::vector<std::uint32_t>;

constexpr std::size_t kMostMatched = 4'000'000; // parts times triangles: 16 MB

/// Where each part's triangles end in a list that has lost some and kept their order: so that as many corners as can be are vertices of
/// their part.
std::vector<std::size_t> endsOfParts(const Mesh& mesh, const Indices& coarse) {
    const std::size_t count = coarse.size() / 3;
    std::vector<Indices> begins;                     // of each part, by where it ends: where it begins at best
    std::vector<std::int64_t> corners(count + 1, 0); // that are right of so many triangles, at best
    std::vector<std::uint8_t> has(mesh.positions.size());
    for (const MeshPart& part : mesh.parts) {
        std::ranges::fill(has, 0);
        for (const std::uint32_t index : std::span(mesh.indices).subspan(part.firstIndex, part.indexCount))
            has[index] = 1;
        Indices& begin = begins.emplace_back(count + 1, 0);
        std::int64_t own = 0; // of the part's, from the first triangle on
        std::int64_t best = 0;
        for (std::uint32_t end = 1; end <= count; ++end) {
            const std::uint32_t* t = &coarse[3 * std::size_t{end - 1}];
            own += has[t[0]] + has[t[1]] + has[t[2]];
            begin[end] = begin[end - 1];
            if (begins.size() > 1 && corners[end] - own > best) { // the first part begins at the first triangle
                best = corners[end] - own;
                begin[end] = end;
            }
            corners[end] = best + own;
        }
    }
    std::vector<std::size_t> ends(mesh.parts.size(), count);
    for (std::size_t part = ends.size() - 1; part > 0; --part)
        ends[part - 1] = begins[part][ends[part]];
    return ends;
}

} // namespace

WholeMesh::WholeMesh(const Mesh& mesh) : mesh_(mesh) {
    const std::vector<glm::vec3> unit = atUnitSize(mesh.positions);
    LocalVertices local(mesh.positions.size());
    for (std::uint32_t part = 0; part < mesh.parts.size(); ++part) {
        const auto own = std::span(mesh.indices).subspan(mesh.parts[part].firstIndex, mesh.parts[part].indexCount);
        const auto first = static_cast<std::uint32_t>(original_.size());
        for (const std::uint32_t index : local.enter(own))
            indices_.push_back(first + index);
        original_.insert(original_.end(), local.global().begin(), local.global().end());
        part_.resize(original_.size(), part);
    }
    for (const std::uint32_t vertex : original_) {
        positions_.push_back(unit[vertex]);
        if (!mesh.normals.empty()) attributes_.push_back(attributesOf(vertex));
    }
    std::vector<std::uint8_t> seen(mesh.positions.size(), 0);
    for (const std::uint32_t vertex : original_)
        shares_ = shares_ || seen[vertex]++ != 0;
}

bool WholeMesh::mayBeOne(std::size_t triangles) const {
    return shares_ && mesh_.parts.size() * triangles <= kMostMatched;
}

Indices WholeMesh::simplified(std::span<const std::uint32_t> from, std::size_t triangles, float normals,
                              std::set<std::uint32_t> locked) const {
    return simplify({.from = from,
                     .positions = positions_,
                     .attributes = attributes_,
                     .counted = mesh_.uvs.empty() ? 3u : 5u,
                     .triangles = triangles,
                     .locked = std::move(locked)},
                    normals);
}

Indices WholeMesh::simplifiedAsOne(std::size_t triangles, float normals) const {
    const std::vector<glm::vec3> unit = atUnitSize(mesh_.positions);
    std::vector<SimplifiedAttributes> attributes;
    for (std::uint32_t vertex = 0; vertex < mesh_.normals.size(); ++vertex)
        attributes.push_back(attributesOf(vertex));
    const Indices coarse = simplify({.from = mesh_.indices,
                                     .positions = unit,
                                     .attributes = attributes,
                                     .counted = mesh_.uvs.empty() ? 3u : 5u,
                                     .triangles = triangles},
                                    normals);
    return toParts(coarse);
}

Indices WholeMesh::partByPart(std::size_t triangles) const {
    Indices coarse;
    std::size_t first = 0;
    for (const MeshPart& part : mesh_.parts) {
        const auto own = std::span(indices_).subspan(first, part.indexCount);
        first += part.indexCount;
        const std::size_t target = part.indexCount / 3 * triangles / (indices_.size() / 3);
        const Indices simple = simplify({.from = own, .positions = positions_, .triangles = target, .keepBorders = true});
        coarse.insert(coarse.end(), simple.begin(), simple.end());
    }
    return coarse;
}

MeshLevel WholeMesh::level(const Indices& coarse) const {
    std::vector<Indices> ofPart(mesh_.parts.size());
    for (std::size_t i = 0; i < coarse.size(); i += 3)
        for (std::size_t k = i; k < i + 3; ++k)
            ofPart[part_[coarse[i]]].push_back(original_[coarse[k]]);
    MeshLevel level;
    for (std::size_t part = 0; part < ofPart.size(); ++part)
        addPart(level, mesh_.parts[part], ofPart[part]);
    return level;
}

void WholeMesh::addPart(MeshLevel& level, const MeshPart& from, const Indices& own) {
    if (own.empty()) return;
    level.parts.push_back({.name = from.name,
                           .firstIndex = static_cast<std::uint32_t>(level.indices.size()),
                           .indexCount = static_cast<std::uint32_t>(own.size()),
                           .material = from.material});
    level.indices.insert(level.indices.end(), own.begin(), own.end());
}

SimplifiedAttributes WholeMesh::attributesOf(std::uint32_t vertex) const {
    const glm::vec3& n = mesh_.normals[vertex];
    const glm::vec2 uv = mesh_.uvs.empty() ? glm::vec2(0) : mesh_.uvs[vertex];
    return {n.x, n.y, n.z, uv.x, uv.y};
}

Indices WholeMesh::toParts(const Indices& coarse) const {
    const std::vector<std::size_t> ends = endsOfParts(mesh_, coarse);
    std::vector<std::uint32_t> number(mesh_.positions.size(), 0);
    for (std::uint32_t own = 0; own < original_.size(); ++own)
        number[original_[own]] = own;
    Indices out;
    std::uint32_t own = 0;
    for (std::uint32_t part = 0, triangle = 0; part < ends.size(); ++part) {
        for (; own < original_.size() && part_[own] == part; ++own)
            number[original_[own]] = own;
        for (; triangle < ends[part]; ++triangle) {
            std::array<std::uint32_t, 3> t{};
            std::ranges::transform(std::span(coarse).subspan(3 * std::size_t{triangle}, 3), t.begin(),
                                   [&](std::uint32_t corner) { return number[corner]; });
            const auto first = std::ranges::find(t, part, [&](std::uint32_t corner) { return part_[corner]; });
            if (first != t.end()) std::rotate(t.begin(), first, t.end());
            out.insert(out.end(), t.begin(), t.end());
        }
    }
    return out;
}

} // namespace tegument::prep
