#pragma once
// What the tests of fur on bodies share: a picture with other parameters, and figures of pictures.

#include "host/run/run.h"
#include "lab/verify/scene.h"
#include "tests/lab/verify/fixture.h"
#include "tests/run/slider_ends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace tegument::test {

using Parameters = std::map<std::string, std::vector<double>>;

class FurPictures : public Verify {
protected:
    /// The scene as verify draws it, with `changed` instead of the options' own parameters. Every value of it is finite.
    Image drawn(const Effect& effect, const verify::Scene& scene, RunOptions options, const Parameters& changed) {
        for (const auto& [name, value] : changed)
            options.parameters[name] = value;
        auto run = runEffect(*device_, effect, &scene.mesh, scene.workspace, options);
        EXPECT_TRUE(run) << format(run.error());
        if (!run) return {};
        EXPECT_TRUE(std::ranges::all_of(run->image.pixels, [](float value) { return std::isfinite(value); }));
        return std::move(run->image);
    }
};

inline void addHardFaces(Mesh& mesh) {
    std::vector<std::uint32_t>& indices = mesh.indices;
    for (std::uint32_t i = 0; i + 300 < indices.size(); i += 300) {
        indices.insert(indices.end(), {indices[i], indices[i + 1], indices[i + 200]}); // a third face at an edge
        indices.insert(indices.end(), {indices[i], indices[i + 2], indices[i + 1]});   // the same face from behind
        indices.insert(indices.end(), {indices[i], indices[i], indices[i + 1]});       // a line
    }
    mesh.parts.front().indexCount = static_cast<std::uint32_t>(indices.size());
}

/// Draws with one slider after the other at each of its ends; gives their number.
template <class Draw>
std::size_t atSliderEnds(const char* file, Draw draw) {
    const auto effect = loadEffect(file);
    EXPECT_TRUE(effect) << format(effect.error());
    if (!effect) return 0;
    const std::vector<SliderEnd> ends = sliderEnds(*effect);
    for (const SliderEnd& end : ends) {
        SCOPED_TRACE(end.parameter + " = " + std::to_string(end.value));
        draw({{end.parameter, {end.value}}});
    }
    return ends.size();
}

/// Pixels whose alpha is not 0.
inline std::size_t covered(const Image& picture) {
    std::size_t count = 0;
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
        count += picture.pixels[i] > 0 ? 1 : 0;
    return count;
}

/// Of the first three channels.
inline float brightest(const Image& picture) {
    float largest = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        if (i % 4 != 3) largest = std::max(largest, picture.pixels[i]);
    return largest;
}

/// Sum of the first three channels, over all four's count.
inline double mean(const Image& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        if (i % 4 != 3) sum += static_cast<double>(picture.pixels[i]);
    return sum / static_cast<double>(picture.pixels.size());
}

} // namespace tegument::test
