#include "meshprep/human/kernel_size.h"

#include <algorithm>

namespace tegument {

namespace {

// Shares of the radius; judged by eye on the rendered head. Thin skin with sharp detail gets little, soft tissue much.
constexpr float kSkin = 0.6f;
constexpr float kCheeks = 0.98f;
constexpr float kEars = 0.8f; // thin, and lit from behind
constexpr float kNose = 0.7f;
constexpr float kForehead = 0.5f; // skin over bone
constexpr float kLips = 0.25f;    // their grooves are to stay
constexpr float kLids = 0.2f;
constexpr int kSoftening = 2; // binomial filters of five taps, one after the other

} // namespace

float kernelSize(const SurfacePoint& point, const Face& face, const Brows& brows) {
    if (point.part != BustPart::Skin) return 0;
    const Regions r = face.regionsAt(point);
    float size = kSkin;
    size = glm::mix(size, kForehead, r.forehead);
    size = glm::mix(size, kNose, r.nose);
    size = glm::mix(size, kCheeks, r.cheeks);
    size = glm::mix(size, kEars, r.ears);
    size = glm::mix(size, kLids, std::max(r.lids, r.waterline));
    size = glm::mix(size, kLips, r.lips);
    size *= 1 - brows.presence(point.position); // blurred hairs would be a smear
    return std::min(size, kLargestKernelSize);
}

Image bakeKernelSize(const HeadSurface& head, int size, const Face& face, const Brows& brows) {
    Image map = bakeTexture(head, size, 1, [&](const SurfacePoint& point) { return glm::vec4(kernelSize(point, face, brows)); });
    soften(map, kSoftening);
    return map;
}

} // namespace tegument
