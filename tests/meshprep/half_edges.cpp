#include "tests/meshprep/half_edges.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>

namespace tegument::testing_prep {

namespace {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// The number of triangles refused.
std::size_t fill(HalfEdgeMesh& mesh, std::span<const std::uint32_t> corners) {
    omerr().disable(); // it has a line for each
    std::size_t refused = 0;
    const auto vertex = [&](std::size_t corner) { return mesh.vertex_handle(corners[corner]); };
    for (std::size_t i = 0; i < corners.size(); i += 3)
        refused += !mesh.add_face(vertex(i), vertex(i + 1), vertex(i + 2)).is_valid();
    return refused;
}

std::size_t countLoops(HalfEdgeMesh& mesh) {
    std::vector<bool> seen(mesh.n_halfedges(), false);
    std::size_t loops = 0;
    for (const auto start : mesh.halfedges()) {
        if (!start.is_boundary() || seen[static_cast<std::size_t>(start.idx())]) continue;
        ++loops;
        for (auto at = start; !seen[static_cast<std::size_t>(at.idx())]; at = at.next())
            seen[static_cast<std::size_t>(at.idx())] = true;
    }
    return loops;
}

/// By a flood along the sides of triangles: OpenMesh goes round one fan of a bow tie only.
std::size_t countComponents(std::span<const std::uint32_t> corners, std::size_t count) {
    std::vector<std::vector<std::uint32_t>> next(count);
    for (std::size_t i = 0; i < corners.size(); ++i)
        next[corners[i]].push_back(corners[i % 3 == 2 ? i - 2 : i + 1]);
    std::vector<bool> seen(count, false);
    std::vector<std::uint32_t> open;
    std::size_t components = 0;
    for (const std::uint32_t start : corners) {
        components += !seen[start];
        for (open.assign(1, start); !open.empty();) {
            const std::uint32_t at = open.back();
            open.pop_back();
            if (!seen[at]) open.insert(open.end(), next[at].begin(), next[at].end());
            seen[at] = true;
        }
    }
    return components;
}

} // namespace

HalfEdgeFigures judge(std::span<const std::uint32_t> places, std::size_t count) {
    HalfEdgeMesh mesh;
    for (std::size_t i = 0; i < count; ++i)
        mesh.add_vertex({0, 0, 0});
    HalfEdgeFigures figures{.refused = fill(mesh, places)};
    for (const auto edge : mesh.edges())
        figures.boundaryEdges += edge.is_boundary();
    for (const auto vertex : mesh.vertices()) {
        if (!vertex.halfedge().is_valid()) continue;
        ++figures.euler;
        figures.bowTies += !mesh.is_manifold(vertex);
    }
    figures.boundaryLoops = countLoops(mesh);
    figures.components = countComponents(places, count);
    figures.euler += static_cast<std::ptrdiff_t>(mesh.n_faces()) - static_cast<std::ptrdiff_t>(mesh.n_edges());
    return figures;
}

std::vector<std::uint32_t> simplifyElsewhere(std::span<const std::uint32_t> indices, const std::vector<glm::vec3>& positions,
                                             std::size_t target) {
    HalfEdgeMesh mesh;
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    for (const glm::vec3& p : positions)
        mesh.add_vertex({p.x, p.y, p.z});
    fill(mesh, indices);
    OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadrics;
    decimater.add(quadrics);
    decimater.module(quadrics).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, target);
    std::vector<std::uint32_t> simplified;
    for (const auto face : mesh.faces())
        if (!mesh.status(face).deleted())
            for (const auto vertex : face.vertices())
                simplified.push_back(static_cast<std::uint32_t>(vertex.idx()));
    return simplified;
}

} // namespace tegument::testing_prep
