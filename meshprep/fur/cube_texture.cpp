#include "meshprep/fur/cube_texture.h"

#include "meshprep/fur/fur_map.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace tegument {

namespace {

struct Texel {
    int face = 0;
    int x = 0;
    int y = 0;
};

/// On the face that meets `face` at this point of its border.
Texel across(int face, double u, double v, int side) {
    constexpr double kBeyond = 1e-6;
    const auto outwards = [](double at) { return at <= 0 ? at - kBeyond : at >= 1 ? at + kBeyond : at; };
    const CubePoint there = cubeMapTexture(cubeMapDirection(face, outwards(u), outwards(v)));
    const auto texel = [&](double at) { return std::clamp(static_cast<int>(at * side), 0, side - 1); };
    return {there.face, texel(there.uv.x), texel(there.uv.y)};
}

/// The texel itself, and those that meet it: one across an edge, two at a corner, all others where a face is one texel.
std::vector<Texel> meeting(const Texel& texel, int side) {
    if (side == 1) return {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}};
    std::vector<Texel> all{texel};
    const double u = (texel.x + 0.5) / side;
    const double v = (texel.y + 0.5) / side;
    if (texel.x == 0) all.push_back(across(texel.face, 0, v, side));
    if (texel.x == side - 1) all.push_back(across(texel.face, 1, v, side));
    if (texel.y == 0) all.push_back(across(texel.face, u, 0, side));
    if (texel.y == side - 1) all.push_back(across(texel.face, u, 1, side));
    return all;
}

using Level = std::array<Image*, 6>;

float meanOf(const Level& level, const std::vector<Texel>& texels, int channel) {
    double sum = 0; // exact, so that the texels of a group come to one value in whatever order
    for (const Texel& texel : texels)
        sum += static_cast<double>(level.at(static_cast<std::size_t>(texel.face))->at(texel.x, texel.y, channel));
    return static_cast<float>(sum / static_cast<double>(texels.size()));
}

void joinFaces(const Level& level) {
    const int side = level[0]->width;
    std::array<Image, 6> joined;
    for (int face = 0; face < 6; ++face) {
        Image& image = joined.at(static_cast<std::size_t>(face)) = *level.at(static_cast<std::size_t>(face));
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; x += y == 0 || y == side - 1 ? 1 : std::max(side - 1, 1)) { // along the border
                const std::vector<Texel> texels = meeting({face, x, y}, side);
                for (int channel = 0; channel < image.channels; ++channel)
                    image.at(x, y, channel) = meanOf(level, texels, channel);
            }
    }
    for (std::size_t face = 0; face < 6; ++face)
        *level.at(face) = std::move(joined.at(face));
}

} // namespace

DdsTexture cubeTexture(const std::array<Image, 6>& faces, DdsFormat format) {
    DdsTexture cube{.format = format, .faces = 6, .mips = 1};
    for (const Image& face : faces) {
        DdsTexture one = makeDds(face, format, true);
        cube.mips = one.mips;
        std::ranges::move(one.images, std::back_inserter(cube.images));
    }
    for (int mip = 0; mip < cube.mips; ++mip) {
        Level level{};
        for (int face = 0; face < 6; ++face)
            level.at(static_cast<std::size_t>(face)) = &cube.images.at(static_cast<std::size_t>(face * cube.mips + mip));
        joinFaces(level);
    }
    return cube;
}

} // namespace tegument
