#include "host/run/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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

void append(std::vector<ListedRange>& ranges, const ListedRange& range) {
    if (!ranges.empty() && ranges.back().first + ranges.back().count == range.first)
        ranges.back().count += range.count;
    else
        ranges.push_back(range);
}

Error noSuchPart(const Pass& pass, const std::string& part, const Mesh& mesh) {
    std::vector<std::string> names;
    for (const MeshPart& other : mesh.parts)
        names.push_back(other.name);
    return inputError(4060, {.file = mesh.name},
                      fmt::format("pass {} draws the mesh's part '{}', and there is none: it has {}", pass.name, part,
                                  names.empty() ? "no parts" : fmt::format("{}", fmt::join(names, ", "))),
                      "name a primitive of the glTF file so");
}

/// Without the clusters that cannot be seen.
void appendPart(std::vector<ListedRange>& ranges, const MeshPart& part, const PartView* view) {
    if (!view || part.clusters.empty()) return append(ranges, {.first = part.firstIndex, .count = part.indexCount});
    for (const MeshCluster& cluster : part.clusters)
        if (canBeSeen(cluster, *view)) append(ranges, {.first = part.firstIndex + cluster.firstIndex, .count = cluster.indexCount});
}

/// Whether a ball lies on the outer side of one of the picture's edges.
bool outside(const PartView& view, const glm::dvec3& centre, double radius) {
    return std::ranges::any_of(view.edges, [&](const glm::dvec4& edge) { return glm::dot(edge, glm::dvec4(centre, 1)) < -radius; });
}

} // namespace

bool drawsPart(const Effect& effect, const std::string& part) {
    return namedBy(effect).contains(part);
}

PartView partView(const glm::dmat4& toClip, const glm::dvec3& eye, double reach) {
    const glm::dmat4 rows = glm::transpose(toClip);
    PartView view{.edges = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]}, .eye = eye, .reach = reach};
    for (glm::dvec4& edge : view.edges)
        edge /= std::max(glm::length(glm::dvec3(edge)), 1e-30);
    return view;
}

glm::dvec3 eyeOf(const SceneView& scene) {
    return glm::dvec3(glm::inverse(scene.world) * glm::dvec4(glm::dvec3(scene.camera.position), 1));
}

bool canBeSeen(const glm::dvec3& place, const glm::dvec3& normal, const PartView& view) {
    const glm::dvec3 toEye = view.eye - place;
    const bool hidden = glm::dot(normal, toEye) <= view.hidden * glm::length(toEye); // not where that is no number
    return !hidden && !outside(view, place, view.reach);
}

bool canBeSeen(const MeshCluster& cluster, const PartView& view) {
    const glm::dvec3 centre(cluster.centre);
    const double radius = static_cast<double>(cluster.radius);
    if (outside(view, centre, radius + view.reach)) return false;
    const glm::dvec3 toEye = view.eye - centre;
    const double distance = glm::length(toEye);
    if (!(distance > radius)) return true;
    // The least angle between a normal of the cone and the way to the eye from somewhere in the ball.
    const double between = std::acos(std::clamp(glm::dot(glm::dvec3(cluster.axis), toEye) / distance, -1.0, 1.0));
    const double least = between - std::acos(static_cast<double>(cluster.cosine)) - std::asin(radius / distance);
    return least <= std::acos(view.hidden);
}

Result<std::vector<ListedRange>> partOf(const Effect& effect, const Pass& pass, const Mesh& mesh, const PartView* view) {
    const auto part = pass.annotations.string("Part");
    if (!part) return std::vector<ListedRange>{{.first = 0, .count = static_cast<std::uint32_t>(mesh.indices.size())}};
    const bool named = std::ranges::any_of(mesh.parts, [&](const MeshPart& own) { return own.name == *part; });
    if (!named && *part != kSkinPart) return noSuchPart(pass, *part, mesh);
    const std::set<std::string> others = namedBy(effect);
    std::vector<ListedRange> ranges;
    bool any = false;
    for (const MeshPart& own : mesh.parts)
        if (named ? own.name == *part : !others.contains(own.name)) {
            appendPart(ranges, own, view);
            any = true;
        }
    if (!any) return noSuchPart(pass, *part, mesh);
    return ranges;
}

} // namespace tegument::run
