#pragma once
// Light beside the light of a scene, as docs/settings.md defines it: lamps (points, spots, parallel light, with a size) and surroundings.

#include "host/image/image.h"

#include <glm/glm.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tegument::reference {

/// Lengths in mm; colours are irradiance / pi on a surface that faces the lamp.
struct Lamp {
    glm::dvec4 place{0, 0, 1, 0};  // w 1: a point; 0: the direction that parallel light comes from
    glm::dvec4 colour{0};          // w: the distance where it is that, then inverse square; 0: everywhere
    glm::dvec4 axis{0, 0, -1, 0};  // the way that a spot shines; w: radius, of parallel light the sine of its half angle
    glm::dvec4 spot{-1, -2, 1, 1}; // cosines of the inner and the outer half angle; weight of the shadow; of the highlight
};

/// As parameters of the effects: four numbers of each lamp, one behind the other.
[[nodiscard]] std::map<std::string, std::vector<double>> lampParameters(const std::vector<Lamp>& lamps);

/// Light that arrives at a point along one direction.
struct Beam {
    glm::dvec3 towards{0}; // to where it comes from, unit
    glm::dvec3 light{0};   // irradiance / pi on a surface that faces it
    double highlight = 1;  // its weight in what is mirrored
};

/// A piece of the sky, with the middle of its own light.
struct SkyPiece {
    glm::dvec3 direction{0};
    glm::dvec3 light{0}; // radiance times solid angle / pi
};

/// A panorama (equirectangular, its middle column along -z, row 0 up) in rows * 2 rows pieces of the same solid angle; dark ones are left
/// out.
[[nodiscard]] std::vector<SkyPiece> skyPieces(const Image& panorama, int rows);

struct MoreLight {
    std::vector<Lamp> lamps;
    std::vector<SkyPiece> diffuseSky;  // for what enters
    std::vector<SkyPiece> specularSky; // for what is mirrored: finer
    int lampSide = 1;                  // nodes across a lamp's disc; 1: its centre alone

    [[nodiscard]] bool none() const { return lamps.empty() && diffuseSky.empty() && specularSky.empty(); }
};

/// Whether light from there reaches the point. `direction`: unit; `distance`: infinite for what is far away.
using Visible = std::function<bool(const glm::dvec3& direction, double distance)>;

/// What arrives at `point` from the lamps and from these pieces of sky, above the horizon of `normal` only.
[[nodiscard]] std::vector<Beam> beamsAt(const MoreLight& more, const std::vector<SkyPiece>& sky, const glm::dvec3& point,
                                        const glm::dvec3& normal, const Visible& visible);

} // namespace tegument::reference
