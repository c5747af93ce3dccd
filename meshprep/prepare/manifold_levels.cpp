// Half-edge collapses by OpenMesh, which refuses one that would change the topology (the link condition: T. Dey et al., Topology Preserving
// Edge Contraction, 1999). Cost: quadrics weighted by area (M. Garland, P. Heckbert, Surface simplification using quadric error metrics,
// SIGGRAPH 1997), with their planes across borders, which OpenMesh's own module lacks: holes grew without them (docs/meshprep.md).

#include "meshprep/prepare/manifold_levels.h"

#include "host/mesh/welding.h"
#include "meshprep/prepare/topology.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh> // before the others: QuadricT.hh uses what it does not include

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>

#include <algorithm>
#include <numeric>
#include <optional>

namespace tegument::prep {

namespace {

namespace Decimater = OpenMesh::Decimater;
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Quadric = OpenMesh::Geometry::QuadricT<double>;
using Vector = HalfEdgeMesh::Point;

/// Of the border against the surface, as Garland and Heckbert leave it open and meshoptimizer has it.
constexpr double kBorderWeight = 10;

Quadric planeThrough(const Vector& point, const Vector& normal, double weight) {
    Quadric quadric(normal[0], normal[1], normal[2], -(normal | point));
    quadric *= weight;
    return quadric;
}

class QuadricError : public Decimater::ModBaseT<HalfEdgeMesh> {
public:
    using Handle = Decimater::ModHandleT<QuadricError>;
    using Info = Decimater::CollapseInfoT<HalfEdgeMesh>;

    explicit QuadricError(HalfEdgeMesh& mesh) : ModBaseT(mesh, false) { this->mesh().add_property(quadrics_); }
    ~QuadricError() override { mesh().remove_property(quadrics_); }
    QuadricError(const QuadricError&) = delete;
    QuadricError& operator=(const QuadricError&) = delete;
    [[nodiscard]] const std::string& name() const override {
        static const std::string kName = "QuadricError";
        return kName;
    }

    void initialize() override {
        for (const auto face : mesh().faces())
            for (const auto vertex : face.vertices())
                of(vertex) += planeThrough(mesh().point(vertex), mesh().normal(face), mesh().calc_face_area(face));
        for (const auto edge : mesh().halfedges())
            if (edge.is_boundary()) addBorder(edge);
    }

    float collapse_priority(const Info& collapse) override {
        if (makesChord(collapse)) return ILLEGAL_COLLAPSE;
        Quadric sum = of(collapse.v0);
        sum += of(collapse.v1);
        return static_cast<float>(std::max(0.0, sum(collapse.p1)));
    }

    void postprocess_collapse(const Info& collapse) override { of(collapse.v1) += of(collapse.v0); }

private:
    Quadric& of(OpenMesh::VertexHandle vertex) { return mesh().property(quadrics_, vertex); }

    [[nodiscard]] bool stays(OpenMesh::VertexHandle vertex) { return mesh().status(vertex).locked(); }

    /// Whether there would be a new edge between two vertices that stay. The surface on the other side of them could get the same one.
    [[nodiscard]] bool makesChord(const Info& collapse) {
        if (!stays(collapse.v1)) return false;
        return std::ranges::any_of(mesh().vv_range(collapse.v0), [&](OpenMesh::VertexHandle other) {
            return stays(other) && other != collapse.v1 && other != collapse.vl && other != collapse.vr;
        });
    }

    /// The plane through the edge that stands on its triangle.
    void addBorder(const OpenMesh::SmartHalfedgeHandle& edge) {
        const Vector from = mesh().point(edge.from());
        const Vector along = mesh().point(edge.to()) - from;
        Vector across = along % mesh().normal(edge.opp().face());
        if (!(across.sqrnorm() > 0)) return;
        const Quadric quadric = planeThrough(from, across.normalize(), kBorderWeight * along.sqrnorm());
        of(edge.from()) += quadric;
        of(edge.to()) += quadric;
    }

    OpenMesh::VPropHandleT<Quadric> quadrics_;
};

bool isManifold(std::span<const std::uint32_t> indices, std::size_t vertices) {
    Surface surface;
    surface.mesh.indices.assign(indices.begin(), indices.end());
    surface.mesh.positions.resize(vertices);
    surface.point.resize(vertices);
    std::iota(surface.point.begin(), surface.point.end(), 0u);
    surface.pointCount = static_cast<std::uint32_t>(vertices);
    const Topology topology = examine(surface);
    return topology.crowdedEdges + topology.opposedEdges + topology.bowTies == 0;
}

/// False when OpenMesh refuses a triangle, which for a manifold it does not.
bool fill(HalfEdgeMesh& mesh, std::span<const std::uint32_t> indices, const std::vector<glm::vec3>& positions) {
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    mesh.request_face_normals();
    mesh.reserve(positions.size(), indices.size() / 2, indices.size() / 3);
    for (const glm::vec3& p : positions)
        mesh.add_vertex(Vector(p.x, p.y, p.z));
    const auto vertex = [&](std::size_t corner) { return mesh.vertex_handle(indices[corner]); };
    for (std::size_t i = 0; i < indices.size(); i += 3)
        if (!mesh.add_face(vertex(i), vertex(i + 1), vertex(i + 2)).is_valid()) return false;
    mesh.update_face_normals();
    return true;
}

bool hasSeams(const std::vector<glm::vec3>& positions) {
    const std::vector<std::uint32_t> first = weldPositions(positions);
    for (std::uint32_t v = 0; v < first.size(); ++v)
        if (first[v] != v) return true;
    return false;
}

void lockBorder(HalfEdgeMesh& mesh) {
    for (const auto vertex : mesh.vertices())
        if (vertex.is_boundary()) mesh.status(vertex).set_locked(true);
}

} // namespace

struct ManifoldSimplifier::State {
    HalfEdgeMesh mesh;
    std::optional<Decimater::DecimaterT<HalfEdgeMesh>> decimater; // once the mesh is there
    std::size_t triangles = 0;
};

ManifoldSimplifier::ManifoldSimplifier(std::unique_ptr<State> state) : state_(std::move(state)) {}

ManifoldSimplifier::~ManifoldSimplifier() = default;

bool ManifoldSimplifier::available() {
    return true;
}

std::unique_ptr<ManifoldSimplifier> ManifoldSimplifier::make(std::span<const std::uint32_t> indices,
                                                             const std::vector<glm::vec3>& positions, bool keepBorder) {
    auto state = std::make_unique<State>();
    if (hasSeams(positions) || !isManifold(indices, positions.size()) || !fill(state->mesh, indices, positions)) return nullptr;
    if (keepBorder) lockBorder(state->mesh);
    state->triangles = state->mesh.n_faces();
    auto& decimater = state->decimater.emplace(state->mesh);
    QuadricError::Handle error;
    Decimater::ModNormalFlippingT<HalfEdgeMesh>::Handle flipping; // refuses to turn a triangle by more than a right angle
    decimater.add(error);
    decimater.add(flipping);
    if (!decimater.initialize()) return nullptr;
    return std::unique_ptr<ManifoldSimplifier>(new ManifoldSimplifier(std::move(state)));
}

std::vector<std::uint32_t> ManifoldSimplifier::reduceTo(std::size_t target) {
    HalfEdgeMesh& mesh = state_->mesh;
    // OpenMesh counts from all triangles that ever were
    if (target < state_->triangles) state_->decimater->decimate_to_faces(0, mesh.n_faces() - (state_->triangles - target));
    std::vector<std::uint32_t> simplified;
    for (const auto face : mesh.faces())
        if (!mesh.status(face).deleted())
            for (const auto vertex : face.vertices())
                simplified.push_back(static_cast<std::uint32_t>(vertex.idx()));
    state_->triangles = simplified.size() / 3;
    return simplified;
}

} // namespace tegument::prep
