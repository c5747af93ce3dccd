#include "meshprep/human/face.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

constexpr float kLidMm = 4; // lids stand no farther before the eyeball

float bell(float distance, float width) {
    return std::exp(-distance * distance / (2 * width * width));
}

/// A bell over an ellipse in the plane that faces the viewer.
float bell(const glm::vec2& offset, const glm::vec2& widths) {
    return bell(glm::length(offset / widths), 1);
}

Result<Image> loadMask(const std::filesystem::path& path) {
    Result<Image> file = loadImage(path);
    if (!file) return file;
    Image mask{.width = file->width, .height = file->height, .channels = 1};
    for (std::size_t i = 0; i < file->pixels.size(); i += static_cast<std::size_t>(file->channels))
        mask.pixels.push_back(file->pixels[i]);
    soften(mask, 2);
    return mask;
}

} // namespace

float maskAt(const Image& mask, const glm::vec2& uv) {
    if (mask.pixels.empty()) return 0;
    const float x = uv.x * static_cast<float>(mask.width) - 0.5f;
    const float y = (1 - uv.y) * static_cast<float>(mask.height) - 0.5f;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const auto at = [&](int dx, int dy) {
        return mask.at(std::clamp(column + dx, 0, mask.width - 1), std::clamp(row + dy, 0, mask.height - 1), 0);
    };
    const float right = x - static_cast<float>(column);
    return glm::mix(glm::mix(at(0, 0), at(1, 0), right), glm::mix(at(0, 1), at(1, 1), right), y - static_cast<float>(row));
}

std::vector<std::filesystem::path> regionMaskFiles(const std::filesystem::path& folder) {
    return {folder / "mpfb_lips.jpg", folder / "mpfb_eyelids.jpg", folder / "mpfb_ears.jpg"};
}

Result<RegionMasks> loadRegionMasks(const std::filesystem::path& folder) {
    RegionMasks masks;
    const std::vector<std::filesystem::path> files = regionMaskFiles(folder);
    const std::array images = {&masks.lips, &masks.eyelids, &masks.ears};
    for (std::size_t i = 0; i < images.size(); ++i) {
        Result<Image> mask = loadMask(files[i]);
        if (!mask) return mask.error();
        *images[i] = std::move(*mask);
    }
    return masks;
}

Face::Face(const HeadSurface& head, RegionMasks masks)
    : eyes_(head.eyes), openings_{EyeOpening(head, head.eyes[0]), EyeOpening(head, head.eyes[1])}, masks_(std::move(masks)),
      chin_(head.chinHeight) {
    noseTip_.z = -1e9f;
    for (const glm::vec3& p : head.mesh.positions)
        if (p.y < eyes_[0].centre.y && p.y > glm::mix(chin_, eyes_[0].centre.y, 0.4f) && p.z > noseTip_.z) noseTip_ = p;
    noseTip_.x = 0;
}

Regions Face::regionsAt(const SurfacePoint& point) const {
    Regions r;
    if (point.part != BustPart::Skin) return r;
    const glm::vec3& p = point.position;
    const Eyeball& eye = eyeAt(p);
    const float front = glm::smoothstep(eye.centre.z - 70, eye.centre.z - 20, p.z);
    const glm::vec2 folded(std::abs(p.x), p.y); // both sides alike
    const glm::vec2 eyeAtFront(std::abs(eye.centre.x), eye.centre.y);
    r.lips = glm::smoothstep(0.25f, 0.85f, maskAt(masks_.lips, point.sourceUv));
    r.lids = maskAt(masks_.eyelids, point.sourceUv);
    r.ears = maskAt(masks_.ears, point.sourceUv);
    r.nose = bell(glm::distance(p, noseTip_ - glm::vec3(0, 0, 6)), 10);
    r.cheeks = front * (1 - r.nose) * bell(folded - glm::vec2(eyeAtFront.x + 7, noseTip_.y + 4), glm::vec2(17, 14));
    r.chin = front * bell(folded - glm::vec2(0, chin_ + 14), glm::vec2(16, 10));
    r.forehead = front * glm::smoothstep(eyeAtFront.y + 20, eyeAtFront.y + 34, p.y) *
                 (1 - glm::smoothstep(eyeAtFront.y + 75, eyeAtFront.y + 100, p.y));
    r.tZone = front * glm::smoothstep(noseTip_.y - 8, noseTip_.y + 4, p.y) *
              std::max(bell(p.x, 7) * (1 - glm::smoothstep(eyeAtFront.y + 10, eyeAtFront.y + 30, p.y)), r.forehead * bell(p.x, 26));
    r.underEyes = front * bell(folded - eyeAtFront - glm::vec2(-3, -12), glm::vec2(11, 4.5f));
    r.neck = 1 - glm::smoothstep(chin_ - 12, chin_ + 4, p.y + 0.35f * std::min(0.0f, p.z - eye.centre.z));
    const glm::vec3 fromEye = p - eye.centre;
    const float offEye = glm::length(fromEye) - eyeSurface(eye, glm::normalize(fromEye)); // lids lie on the eyeball
    r.waterline = 1 - glm::smoothstep(0.0f, 0.8f, offEye);
    if (offEye < kLidMm && p.z > eye.centre.z) {
        const LidDistances lids = openingAt(p).distances(p);
        const float outside = glm::smoothstep(0.4f, 1.2f, offEye);
        r.upperLashes = outside * bell(lids.upper, 0.8f);
        r.lowerLashes = outside * bell(lids.lower, 0.6f) * (1 - r.upperLashes);
    }
    return r;
}

} // namespace tegument
