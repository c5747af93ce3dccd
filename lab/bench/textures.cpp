#include "lab/bench/textures.h"

#include "host/support/text.h"
#include "lab/bench/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tegument::bench {

namespace {

constexpr int kWide = 16; // bits per channel of means, so that they need not be rounded to 8

/// Workspace entries that would be read in place of the mesh's own maps.
bool isMap(const std::string& name) {
    return equalsIgnoreCase(name, "DIFFUSE") || equalsIgnoreCase(name, "NORMAL") || name == "gSkinMap" || name == "gNormalMap";
}

} // namespace

Image halved(const Image& image, MeanOf mean) {
    Image half = mean == MeanOf::Light ? encoded(tegument::halved(decoded(image))) : tegument::halved(image);
    half.bitsPerChannel = std::max(kWide, image.bitsPerChannel);
    return half;
}

double texelsPerPixel(const std::vector<reference::ShadedPoint>& points, int size) {
    constexpr double kSameChart = 0.05; // a step of texture coordinates that is no jump between charts
    std::map<std::pair<int, int>, glm::dvec2> uvs;
    for (const reference::ShadedPoint& point : points)
        uvs[{point.x, point.y}] = point.point.uv;
    std::vector<double> steps;
    for (const reference::ShadedPoint& point : points) {
        const auto right = uvs.find({point.x + 1, point.y});
        const auto below = uvs.find({point.x, point.y + 1});
        if (right == uvs.end() || below == uvs.end()) continue;
        const double step = std::max(glm::length(right->second - point.point.uv), glm::length(below->second - point.point.uv));
        if (step < kSameChart) steps.push_back(step * size);
    }
    return steps.empty() ? 0 : quantile(steps, 0.75);
}

void fitTextures(Scene& scene, const std::vector<reference::ShadedPoint>& points) {
    for (EmbeddedTexture& texture : scene.mesh.textures) {
        if (texture.role != "color" && texture.role != "normal") continue;
        double texels = texelsPerPixel(points, std::max(texture.image.width, texture.image.height));
        for (; texels > 1 && std::max(texture.image.width, texture.image.height) > 1; texels /= 2)
            texture.image = halved(texture.image, texture.role == "color" ? MeanOf::Light : MeanOf::Values);
    }
    std::erase_if(scene.workspace.textures, [](const auto& texture) { return isMap(texture.first); });
}

} // namespace tegument::bench
