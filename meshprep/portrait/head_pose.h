#pragma once
// How a head lies in a mesh file: which way is up, where the face looks, and how large it is, by its shape alone.

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tegument {

/// What is known before the shape is looked at; directions are axes of the file.
struct HeadPoseHints {
    std::optional<glm::dvec3> up;    // unit
    std::optional<glm::dvec3> front; // unit, from the head to what it looks at
};

/// A frame of the head and a point of the face. Lengths in units of the file.
struct HeadPose {
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 front{0, 0, 1};
    glm::dvec3 left{1, 0, 0}; // the head's own left: cross(up, front)
    glm::dvec3 nasion{0};     // on the skin between the eyes
    double millimetre = 1;    // this long, by the size of the face of a grown person
    double symmetry = 0;      // 1: each half mirrors the other; 0: no more than by chance
    double likeness = 0;      // of the best view to a face, at most 1
    double runnerUp = 0;      // of the best view that is another one
    bool onAxes = false;      // up and front are axes of the file
};

/// Above these the pose is trusted.
inline constexpr double kLeastLikeness = 0.82;
inline constexpr double kLeastLead = 0.08;

[[nodiscard]] bool isCertain(const HeadPose& pose);

/// The best guess, certain or not. None where the triangles have no area.
[[nodiscard]] std::optional<HeadPose> guessHeadPose(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                                    const HeadPoseHints& hints = {});

} // namespace tegument
