#pragma once
// Diffusion profiles that stand for skin in the literature and in this project, and how far each is from simulated skin.

#include "lab/reference/profile.h"
#include "lab/reference/tissue.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace tegument::reference {

/// Light by its distance, one function for the three channels.
struct NamedProfile {
    std::string name;
    std::string source;
    std::function<glm::dvec3(double radius)> within; // share that leaves within this radius
    std::function<glm::dvec3(double x)> halfPlane;   // light on x > 0, seen at x
};
[[nodiscard]] NamedProfile named(const std::string& name, const std::string& source, const Profile& gaussians);
[[nodiscard]] NamedProfile namedBurley(const std::string& name, const std::string& source, const glm::dvec3& d);

/// The six Gaussians refitted with `count` of them, 2 to 5: edge response, least squares.
[[nodiscard]] const Profile& refittedProfile(int count);
/// d'Eon's table of the Game Developers Conference 2007, "Advanced Skin Rendering", slide 98.
[[nodiscard]] const Profile& conferenceProfile();
/// Six Gaussians fitted to three-layer skin as followPhotons draws it (diffuse launch).
[[nodiscard]] const Profile& physicalProfile();

/// Simulated skin, one result for each channel.
using SimulatedSkin = std::array<Photons, 3>;
[[nodiscard]] SimulatedSkin simulateSkin(std::size_t photons, std::uint64_t seed);

/// Light on x > 0 of a plane, seen at x: each ring's share on that side. Of 1.
[[nodiscard]] double halfPlane(const RingHistogram& rings, double x);

/// d in mm for each channel that comes closest to the simulation: the largest difference of the share within any radius is least.
[[nodiscard]] glm::dvec3 fittedBurley(const SimulatedSkin& skin);

struct ModelError {
    glm::dvec3 within{0};    // largest |difference| of the share within any radius: energy in the wrong place
    glm::dvec3 halfPlane{0}; // largest |difference| across an edge of light
};
[[nodiscard]] ModelError modelError(const NamedProfile& profile, const SimulatedSkin& skin);

} // namespace tegument::reference
