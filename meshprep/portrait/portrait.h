#pragma once
// A head as a portrait wants it: upright, looking along z, in millimetres; and what of it is in the picture.

#include "host/mesh/mesh.h"
#include "meshprep/portrait/head_pose.h"

#include <string>
#include <vector>

namespace tegument {

/// What need not be guessed.
struct PortraitHints {
    std::optional<glm::dvec3> up;    // unit, along an axis of the file
    std::optional<glm::dvec3> front; // likewise
    std::optional<double> unitMm;
    std::optional<bool> flipV;
    std::optional<bool> mirror; // left and right change
    std::string colorMap;       // a file; empty: the mesh's own
};

struct LaidHead {
    glm::vec3 nasion{0};              // on the skin between the eyes
    float millimetre = 1;             // of a grown person's face, in mm of this one
    std::vector<std::string> guesses; // a line each, with the option that says otherwise
};

/// What one unit of the file is, where a face's millimetre is so long in it: `declared` if that gives a face's size, else a common unit
/// that does, else two digits.
[[nodiscard]] double unitOfFace(double millimetre, double declared);

/// Whether the picture shows lips and brows where the face has them once v is flipped, or as it stands; none where it shows them neither
/// way.
[[nodiscard]] std::optional<bool> isFlipped(const Mesh& mesh, const HeadPose& pose, const Image& picture);

/// Whether the face's triangles are seen from behind, as those of a file whose left and right were changed.
[[nodiscard]] bool isInsideOut(const Mesh& mesh, const HeadPose& pose);

/// Turns, mirrors and scales the mesh, which was read with `mesh.unitMm`, and flips v. TG5336 where its shape does not say how it lies.
[[nodiscard]] Result<LaidHead> layHead(Mesh& mesh, const PortraitHints& hints);

/// The places of a laid head that the picture shows whole: from the crown to the neck.
[[nodiscard]] std::vector<glm::vec3> framedPoints(const Mesh& mesh, const LaidHead& head);

} // namespace tegument
