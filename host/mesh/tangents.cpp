// Tangents by the MikkTSpace convention (M. S. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, master's thesis, University of
// Copenhagen, 2008, section 3.7; the convention is named by the glTF 2.0 specification, 3.7.2.1), so that normal maps baked elsewhere
// decode without seams:
//  1. each triangle has a direction of growing u, and a sign: +1 where its chart is not mirrored;
//  2. around each vertex (one position, normal and UV), triangles of one sign that are joined by edges form a group;
//  3. a group's tangent is the sum of its triangles' directions, each projected into the vertex's tangent plane, made unit and weighted by
//  the triangle's
//     angle there (measured in that plane too); it is made unit again.
// Triangles without UV area have no direction and no sign of their own: they join any group. A vertex of several groups is split.
// glTF's v points down and MikkTSpace's up: with v turned, bitangent = w * cross(normal, tangent) points towards decreasing v.

#include "host/mesh/mesh_file.h"
#include "host/mesh/welding.h"
#include "host/support/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tegument {

namespace {

struct Face {
    glm::dvec3 alongU{0}; // unit, or 0 where the UVs have no area
    int sign = 0;         // +1, -1, or 0 for any
};

Face faceOf(const Mesh& mesh, std::size_t triangle) {
    std::array<glm::dvec3, 3> p{};
    std::array<glm::dvec2, 3> t{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.indices[3 * triangle + c];
        p[c] = glm::dvec3(mesh.positions[vertex]);
        t[c] = {mesh.uvs[vertex].x, -mesh.uvs[vertex].y}; // v up
    }
    const glm::dvec2 t1 = t[1] - t[0];
    const glm::dvec2 t2 = t[2] - t[0];
    const double area = t1.x * t2.y - t1.y * t2.x;
    const glm::dvec3 direction = (t2.y * (p[1] - p[0]) - t1.y * (p[2] - p[0])) * (area < 0 ? -1.0 : 1.0);
    const double length = glm::length(direction);
    if (area == 0 || !(length > 0)) return {};
    return {.alongU = direction / length, .sign = area > 0 ? 1 : -1};
}

class TangentMaker {
public:
    explicit TangentMaker(Mesh& mesh) : mesh_(mesh), groups_(mesh.indices.size()) {}

    void run() {
        for (std::size_t triangle = 0; triangle < mesh_.indices.size() / 3; ++triangle) {
            faces_.push_back(faceOf(mesh_, triangle));
            signs_.insert(signs_.end(), 3, faces_.back().sign);
        }
        weldVertices();
        joinAcrossEdges();
        sumGroups();
        assignToVertices();
    }

private:
    void weldVertices() {
        welded_ = weld<8>(mesh_.positions.size(), [&](std::uint32_t i) {
            const glm::vec3& p = mesh_.positions[i];
            const glm::vec3& n = mesh_.normals[i];
            const glm::vec2& t = mesh_.uvs[i];
            return std::array<float, 8>{p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y};
        });
    }

    [[nodiscard]] std::uint32_t vertexAt(std::size_t corner) const { return welded_[mesh_.indices[corner]]; }

    /// An edge with both its triangles; the corners are those at `from` and `to`.
    struct HalfEdge {
        std::uint32_t low, high; // welded vertices, ordered
        bool forwards;           // runs from low to high
        std::uint32_t atLow, atHigh;
    };

    /// Two triangles that run through an edge in opposite directions, and do not differ in sign, share a group at both of its ends.
    void joinAcrossEdges() {
        std::vector<HalfEdge> edges;
        edges.reserve(mesh_.indices.size());
        for (std::uint32_t corner = 0; corner < mesh_.indices.size(); ++corner) {
            const std::uint32_t next = corner - corner % 3 + (corner + 1) % 3;
            const std::uint32_t a = vertexAt(corner);
            const std::uint32_t b = vertexAt(next);
            if (a < b)
                edges.push_back({a, b, true, corner, next});
            else if (b < a)
                edges.push_back({b, a, false, next, corner});
        }
        std::ranges::stable_sort(edges, {}, [](const HalfEdge& edge) { return std::pair(edge.low, edge.high); });
        // First the triangles with a sign of their own; then those without, which must not connect mirrored neighbours.
        for (const bool anySign : {false, true})
            for (std::size_t i = 0; i < edges.size();)
                i = joinOneEdge(edges, i, anySign);
    }

    std::size_t joinOneEdge(const std::vector<HalfEdge>& edges, std::size_t first, bool anySign) {
        std::size_t end = first;
        while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high)
            ++end;
        for (std::size_t i = first; i < end; ++i) {
            const std::size_t partner = partnerOf(edges, i, end);
            if (partner < end) joinPair(edges[i], edges[partner], anySign);
        }
        return end;
    }

    /// The first later half-edge in the other direction: manifold edges have exactly one.
    static std::size_t partnerOf(const std::vector<HalfEdge>& edges, std::size_t i, std::size_t end) {
        for (std::size_t k = i + 1; k < end; ++k)
            if (edges[k].forwards != edges[i].forwards) return k;
        return end;
    }

    void joinPair(const HalfEdge& a, const HalfEdge& b, bool anySign) {
        joinCorners(a.atLow, b.atLow, anySign);
        joinCorners(a.atHigh, b.atHigh, anySign);
    }

    void joinCorners(std::uint32_t a, std::uint32_t b, bool anySign) {
        const int signA = signs_[groups_.find(a)];
        const int signB = signs_[groups_.find(b)];
        const bool same = signA == signB && signA != 0;
        const bool open = signA == 0 || signB == 0;
        if (!same && !(anySign && open)) return;
        groups_.join(a, b);
        signs_[groups_.find(a)] = signA != 0 ? signA : signB;
    }

    /// The triangle's contribution at one corner.
    [[nodiscard]] glm::dvec3 contribution(std::uint32_t corner) const {
        const glm::dvec3 normal(mesh_.normals[mesh_.indices[corner]]);
        const auto inPlane = [&](const glm::dvec3& v) {
            const glm::dvec3 flat = v - normal * glm::dot(normal, v);
            const double length = glm::length(flat);
            return length > 1e-12 * glm::length(v) ? flat / length : glm::dvec3(0);
        };
        const std::uint32_t first = corner - corner % 3;
        const auto position = [&](std::uint32_t which) { return glm::dvec3(mesh_.positions[mesh_.indices[first + which % 3]]); };
        const glm::dvec3 here = position(corner % 3);
        const glm::dvec3 a = inPlane(position(corner % 3 + 1) - here);
        const glm::dvec3 b = inPlane(position(corner % 3 + 2) - here);
        return inPlane(faces_[corner / 3].alongU) * std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
    }

    void sumGroups() {
        sums_.assign(mesh_.indices.size(), glm::dvec3(0));
        for (std::uint32_t corner = 0; corner < mesh_.indices.size(); ++corner)
            sums_[groups_.find(corner)] += contribution(corner);
    }

    [[nodiscard]] glm::vec4 tangentOf(std::uint32_t group, const glm::vec3& normal) const {
        const double length = glm::length(sums_[group]);
        const glm::vec3 tangent = length > 1e-9 ? glm::vec3(sums_[group] / length) : anyPerpendicular(normal);
        return {tangent, signs_[group] < 0 ? -1.0f : 1.0f};
    }

    static glm::vec3 anyPerpendicular(const glm::vec3& normal) {
        const glm::vec3 axis = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        return glm::normalize(axis - normal * glm::dot(normal, axis));
    }

    /// The first group met keeps the vertex; others get copies behind the last vertex.
    void assignToVertices() {
        constexpr std::uint32_t kNone = UINT32_MAX;
        std::vector<std::uint32_t> firstGroup(mesh_.positions.size(), kNone);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies; // (vertex, group) -> copy
        mesh_.tangents.assign(mesh_.positions.size(), glm::vec4(1, 0, 0, 1));
        for (std::uint32_t corner = 0; corner < mesh_.indices.size(); ++corner) {
            const std::uint32_t vertex = mesh_.indices[corner];
            const std::uint32_t group = groups_.find(corner);
            const glm::vec4 tangent = tangentOf(group, mesh_.normals[vertex]);
            if (firstGroup[vertex] == kNone) {
                firstGroup[vertex] = group;
                mesh_.tangents[vertex] = tangent;
            } else if (mesh_.tangents[vertex] != tangent) {
                const auto [copy, isNew] = copies.emplace(std::pair(vertex, group), static_cast<std::uint32_t>(mesh_.positions.size()));
                if (isNew) {
                    meshfile::copyVertex(mesh_, vertex);
                    mesh_.tangents.back() = tangent;
                }
                mesh_.indices[corner] = copy->second;
            }
        }
    }

    Mesh& mesh_;
    DisjointSets groups_; // of corners
    std::vector<Face> faces_;
    std::vector<std::uint32_t> welded_;
    std::vector<int> signs_; // by group root; a group that no signed triangle joined keeps 0 and counts as not mirrored
    std::vector<glm::dvec3> sums_;
};

} // namespace

void computeTangents(Mesh& mesh) {
    assert(mesh.normals.size() == mesh.positions.size() && mesh.uvs.size() == mesh.positions.size());
    mesh.tangents.clear();
    TangentMaker(mesh).run();
}

} // namespace tegument
