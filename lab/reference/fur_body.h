#pragma once
// Fur whose picture is known exactly on a curved body: straight strands along the normals of a ball or a torus, by rays against every cone.
// Lengths in mm.

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace tegument::reference {

/// A torus round the y axis, or a ball.
struct FurBody {
    double ring = 0;   // radius of the circle that the tube follows; 0: a ball
    double radius = 1; // of the tube, or of the ball
};

struct OnFurBody {
    glm::dvec3 skin{0};   // nearest point of the surface
    glm::dvec3 normal{0}; // there, outwards
    double distance = 0;  // from it, below 0 inside
};
[[nodiscard]] OnFurBody onFurBody(const FurBody& body, const glm::dvec3& point);

struct FurCone {
    glm::dvec3 root{0};   // on the skin
    glm::dvec3 normal{0}; // there
    double length = 1;
    double radius = 0; // at the root
};

/// What strands are between their roots and the top of the coat.
enum class FurShape {
    Cones,   // of circular section in space
    Carried, // sections in places of the skin below, as layers have them: above a convex skin they widen with the coat
};

class FurOnBody {
public:
    /// `coat`: no strand is longer.
    FurOnBody(const FurBody& body, double coat, std::vector<FurCone> strands);

    struct Hit {
        bool strand = false; // or the skin
        double along = 0;    // the strand, 0 root, 1 tip
    };
    /// What a ray from outside of the coat meets first, if anything. `step`: for carried sections, how far apart points along the ray are
    /// tested, shares of the mean radius of strands.
    [[nodiscard]] std::optional<Hit> meet(const glm::dvec3& origin, const glm::dvec3& direction, FurShape shape, double step = 0.1) const;

private:
    struct Stretch {
        double begin = 0;
        double end = 0;
        bool skin = false; // at the end
    };
    [[nodiscard]] std::vector<Stretch> inCoat(const glm::dvec3& origin, const glm::dvec3& direction) const;
    [[nodiscard]] std::optional<double> meetCones(const glm::dvec3& origin, const glm::dvec3& direction, const Stretch& part) const;
    [[nodiscard]] std::optional<double> meetSections(const glm::dvec3& origin, const glm::dvec3& direction, const Stretch& part,
                                                     double step) const;
    [[nodiscard]] std::size_t cell(const glm::dvec3& point) const;
    void list(std::uint32_t strand);

    FurBody body_;
    double coat_ = 0;
    std::vector<FurCone> strands_;
    double radius_ = 0; // mean, at the root
    double cell_ = 1;
    glm::ivec3 cells_{0};
    glm::dvec3 origin_{0};
    std::vector<std::vector<std::uint32_t>> grid_; // strands that come near a cell
};

} // namespace tegument::reference
