#pragma once
// The coarse bust: head, neck and eyeballs taken from the MakeHuman body, still quads.

#include "host/support/result.h"
#include "meshprep/human/quad_mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tegument {

enum class BustPart : std::uint8_t { Skin, LeftEye, RightEye, Base };

struct Eyeball {
    glm::vec3 centre{0}; // mm
    float radius = 0;    // mm, of the white
};

/// Of the iris, mm along the eyeball: that of a real one (5.5 to 6), though the file's eyeballs are a quarter larger than real ones, as its
/// lids' openings are no larger.
inline constexpr float kIrisRadius = 5.6f;

/// The face looks along +z, y is up, the left eye has x > 0; the origin is the centre of the kept skin's bounding box.
struct Bust {
    std::vector<glm::vec3> positions; // mm
    std::vector<glm::vec2> uvs;       // v up; of the skin as in the file; of the eyes by `eyeChart`
    std::vector<Quad> quads;
    std::vector<BustPart> parts;       // of each quad
    std::vector<std::uint8_t> support; // of each quad: 1 where it only shapes the surface beside the cut and is not kept
    std::array<Eyeball, 2> eyes;       // left, right
};

/// Takes the chart with the highest vertex of group `body` (the head's skin), the charts that share vertices with it, and of the one that
/// goes on below it, the trunk's, the first `neckRings` rings of quads: so the cut runs along an edge loop. One more ring is support. The
/// eyeballs are the groups `helper-l-eye` and `helper-r-eye`. TG7004 without these groups, TG7005 when nothing goes on below the head.
[[nodiscard]] Result<Bust> takeBust(const QuadMesh& body, const std::string& file, int neckRings);

/// The chart of an eyeball: azimuthal equidistant around the axis of sight (+z), in mm: (0, 0) is the pupil's centre, v points up.
/// Areas come out at most 5 % too small up to 30 degrees off the axis.
[[nodiscard]] glm::vec2 eyeChart(const Eyeball& eye, const glm::vec3& position);

/// mm from the eye's centre to its surface in a direction (unit): the sphere, and before the iris the cornea, more curved than it.
[[nodiscard]] float eyeSurface(const Eyeball& eye, const glm::vec3& outward);
/// The normal there.
[[nodiscard]] glm::vec3 eyeNormal(const Eyeball& eye, const glm::vec3& outward);

/// Makes room for the cornea under the lids: what of the skin lies near the eyeball moves outwards as far as the cornea stands out.
void raiseLids(Bust& bust);

} // namespace tegument
