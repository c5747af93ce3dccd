#pragma once
// Inside lab/verify: the references of a scene, and the pixels where a reference has a say.

#include "lab/reference/skin.h"
#include "lab/verify/scene.h"
#include "lab/verify/work.h"

namespace tegument::verify {

struct Truth {
    reference::Pinhole camera;
    reference::Pinhole light; // of the options' map size
    double lightNear = 0;     // the planes of its pyramid or box, mm
    double lightFar = 0;
    reference::SkinScene skin;

    /// Depth of a point between the light's planes as graphics hardware has it.
    [[nodiscard]] double zOverW(const glm::dvec3& point) const;
};

/// `scene` must outlive the result. `parameters`: gMix, gRoughness, gSpecularIntensity in place of the setting's defaults.
[[nodiscard]] Truth truthOf(const Scene& scene, const VerifyOptions& options);

/// What each pixel of a view shows; none: background.
struct Seen {
    int width = 0;
    int height = 0;
    std::vector<std::optional<reference::SurfacePoint>> pixels;
    std::vector<double> distances; // mm from the eye, 0 for background

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};
[[nodiscard]] Seen look(const reference::SkinScene& skin, const reference::Pinhole& view);

/// The same of the mesh unwrapped: distances are 0.
[[nodiscard]] Seen lookUnwrapped(const Mesh& mesh, int size);

/// 1 where something is seen.
[[nodiscard]] std::vector<std::uint8_t> covered(const Seen& seen);
/// 1 where the eight neighbours see the same surface: all of them something, uv within 0.05. Elsewhere a rasteriser may see the other side
/// of an outline, for it snaps vertices to 1/256 pixel.
[[nodiscard]] std::vector<std::uint8_t> interior(const Seen& seen);

/// Those of them whose shadow the map can tell: lit or not, and no shadow's edge within the reach of its filter.
[[nodiscard]] std::vector<std::uint8_t> awayFromShadowEdges(const Truth& truth, const Seen& seen);

/// value(point, pixel) for every pixel that sees something and counts; others stay 0.
template <class Value>
Image paint(const Seen& seen, int channels, Value value) {
    Image image = plainImage(seen.width, seen.height, channels);
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const std::size_t pixel = seen.index(x, y);
            if (!seen.pixels[pixel]) continue;
            const glm::dvec4 color = value(*seen.pixels[pixel], pixel);
            for (int c = 0; c < channels; ++c)
                image.at(x, y, c) = static_cast<float>(color[c]);
        }
    return image;
}

/// Points turned away from the light whose way through the body the map can tell: three texels of it away the way is nearly the same
/// length.
[[nodiscard]] bool thicknessIsKnown(const Truth& truth, const reference::SurfacePoint& point);

/// Red, green and blue of a picture with more.
[[nodiscard]] Image rgb(const Image& image);
/// One channel alone.
[[nodiscard]] Image channel(const Image& image, int which);

/// The scene's mesh seen in its own texture space, cut to where `counts` is 1, with the share left out noted.
void noteApart(ModuleReport& report, const std::string& subject, const std::vector<std::uint8_t>& counts,
               const std::vector<std::uint8_t>& covered, const std::string& why);

} // namespace tegument::verify
