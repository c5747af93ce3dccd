// Each triangle is clipped as a polygon (Sutherland and Hodgman, Reentrant polygon clipping, CACM 17(1), 1974) against one plane.

#include "meshprep/human/cut.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <utility>

namespace tegument {

namespace {

constexpr float kSnap = 0.05f; // mm

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class Cutter {
public:
    Cutter(TriangleSurface& surface, float height) : surface_(surface), height_(height) {
        for (glm::vec3& p : surface_.positions)
            if (std::abs(p.y - height_) < kSnap) p.y = height_;
    }

    void cut() {
        std::vector<CornerTriangle> kept;
        for (const CornerTriangle& triangle : surface_.triangles)
            clip(triangle, kept);
        surface_.triangles = std::move(kept);
    }

private:
    struct Corner {
        std::uint32_t position = 0;
        std::uint32_t uv = 0;
    };

    [[nodiscard]] float above(std::uint32_t position) const { return surface_.positions[position].y - height_; }

    void clip(const CornerTriangle& triangle, std::vector<CornerTriangle>& kept) {
        const auto [lowest, highest] = std::minmax({above(triangle.position[0]), above(triangle.position[1]), above(triangle.position[2])});
        if (lowest >= 0) {
            if (highest > 0) kept.push_back(triangle);
            return;
        }
        std::vector<Corner> polygon;
        for (std::size_t c = 0; c < 3; ++c) {
            const Corner a{triangle.position[c], triangle.uv[c]};
            const Corner b{triangle.position[(c + 1) % 3], triangle.uv[(c + 1) % 3]};
            if (above(a.position) >= 0) polygon.push_back(a);
            if (above(a.position) * above(b.position) < 0) polygon.push_back(crossing(a, b));
        }
        for (std::size_t c = 2; c < polygon.size(); ++c)
            kept.push_back({.position = {polygon[0].position, polygon[c - 1].position, polygon[c].position},
                            .uv = {polygon[0].uv, polygon[c - 1].uv, polygon[c].uv},
                            .part = triangle.part});
    }

    /// The point where the edge meets the plane; the same for both triangles at the edge, since it is worked out from the lower index.
    Corner crossing(Corner a, Corner b) {
        if (a.position > b.position) std::swap(a, b);
        const float share = above(a.position) / (above(a.position) - above(b.position));
        const auto [position, newPosition] =
            positions_.try_emplace({a.position, b.position}, static_cast<std::uint32_t>(surface_.positions.size()));
        if (newPosition) {
            glm::vec3 point = glm::mix(surface_.positions[a.position], surface_.positions[b.position], share);
            point.y = height_;
            surface_.positions.push_back(point);
            surface_.normals.push_back(glm::normalize(glm::mix(surface_.normals[a.position], surface_.normals[b.position], share)));
        }
        const auto [uv, newUv] = uvs_.try_emplace({a.uv, b.uv}, static_cast<std::uint32_t>(surface_.uvs.size()));
        if (newUv) surface_.uvs.push_back(glm::mix(surface_.uvs[a.uv], surface_.uvs[b.uv], share));
        return {position->second, uv->second};
    }

    TriangleSurface& surface_;
    float height_;
    std::map<Edge, std::uint32_t> positions_;
    std::map<Edge, std::uint32_t> uvs_;
};

/// Edges in the plane that only one triangle has, in that triangle's direction.
std::vector<Edge> openEdges(const TriangleSurface& surface, float height) {
    std::map<Edge, Edge> open;
    for (const CornerTriangle& triangle : surface.triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = triangle.position[c];
            const std::uint32_t b = triangle.position[(c + 1) % 3];
            if (surface.positions[a].y != height || surface.positions[b].y != height) continue;
            const auto [entry, isNew] = open.try_emplace(std::minmax(a, b), a, b);
            if (!isNew) open.erase(entry);
        }
    std::vector<Edge> result;
    for (const auto& [key, edge] : open)
        result.push_back(edge);
    return result;
}

} // namespace

void cutBelow(TriangleSurface& surface, float height) {
    Cutter(surface, height).cut();
}

std::size_t closeBase(TriangleSurface& surface, float height) {
    const std::vector<Edge> edges = openEdges(surface, height);
    if (edges.empty()) return 0;
    std::map<std::uint32_t, Edge> copies; // old position -> new position and coordinate
    const auto add = [&](const glm::vec3& p) {
        surface.positions.push_back(p);
        surface.normals.emplace_back(0, -1, 0);
        surface.uvs.emplace_back(p.x, p.z);
        return Edge(surface.positions.size() - 1, surface.uvs.size() - 1);
    };
    glm::vec3 centre(0);
    for (const auto& [a, b] : edges)
        centre += surface.positions[a] / static_cast<float>(edges.size());
    centre.y = height;
    for (const auto& [a, b] : edges)
        if (!copies.contains(a)) copies[a] = add(glm::vec3(surface.positions[a]));
    const Edge middle = add(centre);
    for (const auto& [a, b] : edges) {
        if (!copies.contains(b)) continue; // not a closed loop
        const auto [aPosition, aUv] = copies[a];
        const auto [bPosition, bUv] = copies[b];
        surface.triangles.push_back(
            {.position = {bPosition, aPosition, middle.first}, .uv = {bUv, aUv, middle.second}, .part = BustPart::Base});
    }
    return edges.size();
}

EdgeWays waysAlongEdges(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads, const std::vector<std::uint32_t>& sources,
                        float reach) {
    std::vector<std::vector<std::uint32_t>> neighbours(positions.size());
    for (const Quad& quad : quads)
        for (std::size_t c = 0; c < 4; ++c) {
            neighbours[quad.position[c]].push_back(quad.position[(c + 1) % 4]);
            neighbours[quad.position[(c + 1) % 4]].push_back(quad.position[c]);
        }
    EdgeWays ways{.length = std::vector<float>(positions.size(), reach), .source = std::vector<std::uint32_t>(positions.size(), 0)};
    using Step = std::pair<float, std::uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    for (const std::uint32_t v : sources) {
        ways.length[v] = 0;
        ways.source[v] = v;
        open.emplace(0.0f, v);
    }
    while (!open.empty()) {
        const auto [length, v] = open.top();
        open.pop();
        if (length > ways.length[v]) continue;
        for (const std::uint32_t next : neighbours[v]) {
            const float longer = length + glm::distance(positions[v], positions[next]);
            if (longer >= ways.length[next]) continue;
            ways.length[next] = longer;
            ways.source[next] = ways.source[v];
            open.emplace(longer, next);
        }
    }
    return ways;
}

} // namespace tegument
