#pragma once
// Where on the head a point is: landmarks from the geometry, regions from the file's masks.

#include "host/image/image.h"
#include "host/support/result.h"
#include "meshprep/human/bake.h"
#include "meshprep/human/eye_opening.h"
#include "meshprep/human/head_surface.h"

#include <array>
#include <filesystem>
#include <vector>

namespace tegument {

/// Grey region maps in the file's atlas: 1 inside.
struct RegionMasks {
    Image lips;
    Image eyelids;
    Image ears;
};

/// mpfb_lips.jpg, mpfb_eyelids.jpg and mpfb_ears.jpg.
[[nodiscard]] std::vector<std::filesystem::path> regionMaskFiles(const std::filesystem::path& folder);
/// Reads them and softens their jagged borders. TG52xx when one cannot be read.
[[nodiscard]] Result<RegionMasks> loadRegionMasks(const std::filesystem::path& folder);

/// Between the four texels around a place (v up); 0 of no image.
[[nodiscard]] float maskAt(const Image& mask, const glm::vec2& uv);

/// How much a point belongs to each region, 0 to 1. Regions overlap and fade.
struct Regions {
    float lips = 0;
    float lids = 0;
    float ears = 0;
    float nose = 0;
    float cheeks = 0;
    float chin = 0;
    float forehead = 0;
    float tZone = 0; // its middle and the bridge of the nose, where sebum is
    float underEyes = 0;
    float neck = 0;
    float waterline = 0;   // the moist rim of the lids
    float upperLashes = 0; // the dark line of their roots
    float lowerLashes = 0;
};

class Face {
public:
    Face(const HeadSurface& head, RegionMasks masks);

    [[nodiscard]] Regions regionsAt(const SurfacePoint& point) const;

    /// Of the eye on the point's side.
    [[nodiscard]] const Eyeball& eyeAt(const glm::vec3& position) const { return eyes_[position.x >= 0 ? 0 : 1]; }
    [[nodiscard]] const EyeOpening& openingAt(const glm::vec3& position) const { return openings_[position.x >= 0 ? 0 : 1]; }
    [[nodiscard]] const std::array<EyeOpening, 2>& openings() const { return openings_; }

private:
    std::array<Eyeball, 2> eyes_;
    std::array<EyeOpening, 2> openings_;
    RegionMasks masks_;
    glm::vec3 noseTip_{0};
    float chin_ = 0; // height
};

} // namespace tegument
