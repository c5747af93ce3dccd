#pragma once
// What stands under the cursor, in the target that is shown and in all others, and how a target's values are spread. Needs no window and no
// GPU.

#include "host/image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tegument::view {

/// Where the cursor is on a picture that is scaled into the window by its shape, as Canvas::show does; both from 0 to 1, from the left top.
/// None beside the picture.
[[nodiscard]] std::optional<glm::dvec2> placeOnPicture(glm::dvec2 cursor, glm::ivec2 picture, glm::ivec2 window);

/// Which texel lies there.
[[nodiscard]] glm::ivec2 texelAt(glm::dvec2 place, glm::ivec2 size);

/// A texel of a target, or of what stands beside the picture.
struct ProbedTexel {
    std::string name; // empty: the picture
    int level = 0;    // of the mip chain
    glm::ivec2 at{0};
    std::vector<float> values;
};
[[nodiscard]] ProbedTexel probedTexel(std::string name, const Image& image, glm::dvec2 place);

/// One line for the place and one for each target, the shown one first: its texel there and the texel's values.
[[nodiscard]] std::vector<std::string> probeLines(const std::vector<ProbedTexel>& targets, const std::string& shown, glm::dvec2 place);

/// Three lines: the values beside the picture, the picture's less those, and that as a share of those.
[[nodiscard]] std::vector<std::string> besideLines(const ProbedTexel& picture, const ProbedTexel& beside);

/// Of the colours, from their least to their largest finite value; texels that are 0 in all of them count as not written. Alpha, which is
/// 1 wherever something was drawn, would hide the rest.
struct Histogram {
    static constexpr std::size_t kBins = 64;
    static constexpr std::size_t kChannels = 3;
    float low = 0;
    float high = 0;
    std::array<std::array<std::size_t, kBins>, kChannels> counts{};
    int channels = 0;
    std::size_t notFinite = 0; // values
};
[[nodiscard]] Histogram histogramOf(const Image& image);

} // namespace tegument::view
