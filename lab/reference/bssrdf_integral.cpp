// The surface integral for one point.

#include "lab/reference/bssrdf.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::reference {

namespace {

struct TriangleNode {
    glm::dvec3 weights; // barycentric
    double weight;      // sums to 1
};

/// Radon's rule of seven nodes.
const std::array<TriangleNode, 7>& radonNodes() {
    static const std::array<TriangleNode, 7> kNodes = [] {
        const double root = std::sqrt(15.0);
        std::array<TriangleNode, 7> nodes{};
        nodes[0] = {glm::dvec3(1.0 / 3), 9.0 / 40};
        for (int sign = 0; sign < 2; ++sign) {
            const double s = sign == 0 ? root : -root;
            const double b = (6 + s) / 21;
            for (int corner = 0; corner < 3; ++corner) {
                glm::dvec3 weights(b);
                weights[corner] = 1 - 2 * b;
                nodes[static_cast<std::size_t>(1 + 3 * sign + corner)] = {weights, (155 + s) / 1200};
            }
        }
        return nodes;
    }();
    return kNodes;
}

/// Part of a triangle. Columns are its corners.
struct Piece {
    glm::dmat3 weights; // barycentric in the triangle
    glm::dmat3 corners; // mm

    [[nodiscard]] double area() const { return 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])); }
};

struct Edge {
    int from = 0; // of from, from + 1, opposite = from + 2
    double length = 0;
};

Edge longestEdge(const Piece& piece) {
    Edge longest;
    for (int i = 0; i < 3; ++i)
        if (const double length = glm::length(piece.corners[(i + 1) % 3] - piece.corners[i]); length > longest.length)
            longest = {i, length};
    return longest;
}

std::array<Piece, 2> halves(const Piece& piece, int edge) {
    std::array<Piece, 2> both = {piece, piece};
    const int next = (edge + 1) % 3;
    const glm::dvec3 weights = 0.5 * (piece.weights[edge] + piece.weights[next]);
    const glm::dvec3 corner = 0.5 * (piece.corners[edge] + piece.corners[next]);
    both[0].weights[next] = weights;
    both[0].corners[next] = corner;
    both[1].weights[edge] = weights;
    both[1].corners[edge] = corner;
    return both;
}

class Integral {
public:
    Integral(const RayScene& surface, const Irradiance& irradiance, const RadialProfile& profile, const glm::dvec3& at,
             const Quadrature& quadrature, const glm::dvec3& normal)
        : mesh_(surface.mesh()), irradiance_(irradiance), profile_(profile), at_(at), normal_(normal), quadrature_(quadrature) {}

    void add(std::uint32_t triangle) {
        triangle_ = triangle;
        Piece whole{.weights = glm::dmat3(1), .corners = glm::dmat3(0)};
        for (int c = 0; c < 3; ++c)
            whole.corners[c] =
                glm::dvec3(mesh_.positions[mesh_.indices[3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(c)]]);
        divide(whole);
    }
    [[nodiscard]] const Diffused& sum() const { return sum_; }

private:
    /// No point of the piece is nearer.
    [[nodiscard]] double nearest(const Piece& piece) const {
        const glm::dvec3 centre = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
        const double radius = std::max(
            {glm::length(piece.corners[0] - centre), glm::length(piece.corners[1] - centre), glm::length(piece.corners[2] - centre)});
        return std::max(0.0, glm::length(at_ - centre) - radius);
    }

    void divide(const Piece& piece) {
        const double distance = nearest(piece);
        if (distance > profile_.reach) return;
        const Edge longest = longestEdge(piece);
        const double allowed = quadrature_.fineness * std::max(distance, profile_.finest);
        if (longest.length <= allowed) return evaluate(piece, distance, quadrature_.halvings, longest.length <= kSmall * allowed);
        for (const Piece& half : halves(piece, longest.from))
            divide(half);
    }

    void evaluate(const Piece& piece, double distance, int halvings, bool small) {
        const double area = piece.area();
        if (small) {
            addNode(piece, {glm::dvec3(1.0 / 3), 1}, area);
            return;
        }
        const Diffused before = sum_;
        int lit = 0;
        for (const TriangleNode& node : radonNodes())
            lit += addNode(piece, node, area) ? 1 : 0;
        if (lit == 0 || lit == 7 || halvings == 0 || area * largest(distance) < quadrature_.negligible) return;
        sum_ = before; // an edge of light crosses it
        for (const Piece& half : halves(piece, longestEdge(piece).from))
            evaluate(half, nearest(half), halvings - 1, false);
    }

    [[nodiscard]] double largest(double distance) const {
        const glm::dvec3 density = profile_.density(std::max(distance, 0.5 * profile_.finest));
        return std::max({density.x, density.y, density.z});
    }

    /// 1 + c h.
    [[nodiscard]] glm::dvec3 throughFlesh(const SurfacePoint& from) const {
        if (profile_.flesh == glm::dvec3(0)) return glm::dvec3(1);
        const double length = glm::length(from.normal);
        const glm::dvec3 normal = length > 0 ? from.normal / length : faceNormal(mesh_, triangle_);
        return 1.0 + profile_.flesh * std::max(0.0, 0.5 * glm::dot(at_ - from.position, normal_ - normal));
    }

    /// Whether there is light.
    bool addNode(const Piece& piece, const TriangleNode& node, double area) {
        const double distance = glm::length(piece.corners * node.weights - at_);
        if (distance > profile_.reach) return false;
        const SurfacePoint from = interpolate(mesh_, {triangle_, piece.weights * node.weights});
        const glm::dvec3 density = profile_.density(distance) * throughFlesh(from) * (node.weight * area);
        const glm::dvec3 light = irradiance_(from);
        sum_.share += density;
        sum_.light += density * light;
        return light != glm::dvec3(0);
    }

    static constexpr double kSmall = 0.2; // a piece so much shorter than allowed does with one node

    const Mesh& mesh_;
    const Irradiance& irradiance_;
    const RadialProfile& profile_;
    glm::dvec3 at_;
    glm::dvec3 normal_;
    Quadrature quadrature_;
    std::uint32_t triangle_ = 0;
    Diffused sum_;
};

} // namespace

Quadrature halved(const Quadrature& quadrature) {
    Quadrature finer = quadrature;
    finer.fineness /= 2;
    finer.negligible /= 4;
    return finer;
}

Diffused diffuse(const RayScene& surface, const Irradiance& irradiance, const RadialProfile& profile, const glm::dvec3& at,
                 const Quadrature& quadrature, const glm::dvec3& normal) {
    Integral integral(surface, irradiance, profile, at, quadrature, normal);
    for (const std::uint32_t triangle : surface.around(at, profile.reach))
        integral.add(triangle);
    return integral.sum();
}

} // namespace tegument::reference
