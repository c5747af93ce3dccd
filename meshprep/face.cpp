#include "meshprep/face.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

float bell(float distance, float width) {
    return std::exp(-distance * distance / (2 * width * width));
}

/// A bell over an ellipse in the plane that faces the viewer.
float bell(const glm::vec2& offset, const glm::vec2& widths) {
    return bell(glm::length(offset / widths), 1);
}

float bilinear(const Image& image, const glm::vec2& uv) {
    if (image.pixels.empty()) return 0;
    const float x = uv.x * static_cast<float>(image.width) - 0.5f;
    const float y = (1 - uv.y) * static_cast<float>(image.height) - 0.5f;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const auto at = [&](int dx, int dy) {
        return image.at(std::clamp(column + dx, 0, image.width - 1), std::clamp(row + dy, 0, image.height - 1), 0);
    };
    const float right = x - static_cast<float>(column);
    return glm::mix(glm::mix(at(0, 0), at(1, 0), right), glm::mix(at(0, 1), at(1, 1), right), y - static_cast<float>(row));
}

/// One direction of a binomial filter of five taps: `step` 1 along rows, the width along columns.
void blurLines(Image& image, std::ptrdiff_t step) {
    const std::vector<float> from = image.pixels;
    const auto count = static_cast<std::ptrdiff_t>(from.size());
    const auto at = [&](std::ptrdiff_t i) { return from[static_cast<std::size_t>(std::clamp(i, std::ptrdiff_t{0}, count - 1))]; };
    for (std::ptrdiff_t i = 0; i < count; ++i)
        image.pixels[static_cast<std::size_t>(i)] =
            (at(i - 2 * step) + 4 * at(i - step) + 6 * at(i) + 4 * at(i + step) + at(i + 2 * step)) / 16;
}

Result<Image> loadMask(const std::filesystem::path& path) {
    Result<Image> file = loadImage(path);
    if (!file) return file;
    Image mask{.width = file->width, .height = file->height, .channels = 1, .pixels = {}};
    for (std::size_t i = 0; i < file->pixels.size(); i += static_cast<std::size_t>(file->channels))
        mask.pixels.push_back(file->pixels[i]);
    for (int pass = 0; pass < 2; ++pass) {
        blurLines(mask, 1);
        blurLines(mask, mask.width);
    }
    return mask;
}

} // namespace

Result<RegionMasks> loadRegionMasks(const std::filesystem::path& folder) {
    RegionMasks masks;
    for (const auto& [name, image] :
         {std::pair("lips", &masks.lips), std::pair("eyelids", &masks.eyelids), std::pair("ears", &masks.ears)}) {
        Result<Image> mask = loadMask(folder / (std::string("mpfb_") + name + ".jpg"));
        if (!mask) return mask.error();
        *image = std::move(*mask);
    }
    return masks;
}

Face::Face(const HeadSurface& head, RegionMasks masks) : eyes_(head.eyes), masks_(std::move(masks)), chin_(head.chinHeight) {
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
    r.lips = glm::smoothstep(0.25f, 0.85f, bilinear(masks_.lips, point.sourceUv));
    r.lids = bilinear(masks_.eyelids, point.sourceUv);
    r.ears = bilinear(masks_.ears, point.sourceUv);
    r.nose = bell(glm::distance(p, noseTip_ - glm::vec3(0, 0, 6)), 10);
    r.cheeks = front * (1 - r.nose) * bell(folded - glm::vec2(eyeAtFront.x + 7, noseTip_.y + 4), glm::vec2(17, 14));
    r.chin = front * bell(folded - glm::vec2(0, chin_ + 14), glm::vec2(16, 10));
    r.forehead = front * glm::smoothstep(eyeAtFront.y + 20, eyeAtFront.y + 34, p.y) *
                 (1 - glm::smoothstep(eyeAtFront.y + 75, eyeAtFront.y + 100, p.y));
    r.underEyes = front * bell(folded - eyeAtFront - glm::vec2(-3, -12), glm::vec2(11, 4.5f));
    r.neck = 1 - glm::smoothstep(chin_ - 12, chin_ + 4, p.y + 0.35f * std::min(0.0f, p.z - eye.centre.z));
    const float offEye = glm::distance(p, eye.centre) - eye.radius; // lids lie on the eyeball
    r.waterline = 1 - glm::smoothstep(0.0f, 0.8f, offEye);
    const float lashes = bell(offEye - 1.1f, 0.45f);
    const float upper = glm::smoothstep(-1.5f, 2.5f, p.y - eye.centre.y);
    r.upperLashes = lashes * upper;
    r.lowerLashes = lashes * (1 - upper);
    return r;
}

} // namespace tegument
