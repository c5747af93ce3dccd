// Pictures that go on beyond the unit square otherwise than by repeating, which is what effects do: laid out over the tiles in use.

#include "host/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::meshfile {

namespace {

/// Tiles along one axis that the coordinates use.
struct Tiles {
    int first = 0;
    int count = 1;
};

Tiles tilesOf(const Mesh& mesh, glm::length_t axis, bool clamps) {
    float low = 0, high = 1;
    for (const glm::vec2& uv : mesh.uvs) {
        low = std::min(low, uv[axis] + kUvRounding);
        high = std::max(high, uv[axis] - kUvRounding);
    }
    if (low >= 0 && high <= 1) return {};
    if (!clamps) return {.first = 0, .count = 2}; // the picture and its mirror image repeat
    const auto within = [](float tile) { return static_cast<int>(std::clamp(tile, -1.0F * kMostPictureSide, 1.0F * kMostPictureSide)); };
    return {.first = within(std::floor(low)), .count = within(std::ceil(high)) - within(std::floor(low))};
}

Image laidOut(const Image& from, const std::array<Tiles, 2>& tiles, const PictureEdges& edges) {
    Image image = from;
    image.width = from.width * tiles[0].count;
    image.height = from.height * tiles[1].count;
    const auto channels = static_cast<std::size_t>(from.channels);
    image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * channels);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < from.channels; ++c)
                image.at(x, y, c) = from.at(wrapped(x + tiles[0].first * from.width, from.width, edges[0]),
                                            wrapped(y + tiles[1].first * from.height, from.height, edges[1]), c);
    return image;
}

} // namespace

void layOutPictures(const Source& source, const std::vector<PictureEdges>& edges, Mesh& mesh) {
    std::array<Tiles, 2> tiles;
    for (glm::length_t axis = 0; axis < 2; ++axis) {
        const auto uses = [&](PictureEdge edge) {
            return std::ranges::any_of(edges, [&](const PictureEdges& of) { return of[static_cast<std::size_t>(axis)] == edge; });
        };
        if (uses(PictureEdge::Clamp) || uses(PictureEdge::Mirror))
            tiles[static_cast<std::size_t>(axis)] = tilesOf(mesh, axis, uses(PictureEdge::Clamp));
    }
    if (tiles[0].count * tiles[1].count == 1) return;
    for (const auto& [role, image] : mesh.textures)
        if (tiles[0].count > kMostPictureSide / image.width || tiles[1].count > kMostPictureSide / image.height ||
            static_cast<std::size_t>(tiles[0].count * image.width) * static_cast<std::size_t>(tiles[1].count * image.height) >
                kMostPictureTexels)
            return warn(mesh, 5323, source.whole(),
                        fmt::format("how its pictures go on beyond their edges is ignored: over {} x {} tiles they are too large",
                                    tiles[0].count, tiles[1].count),
                        "move the texture coordinates into the unit square");
    for (std::size_t i = 0; i < mesh.textures.size(); ++i)
        mesh.textures[i].image = laidOut(mesh.textures[i].image, tiles, edges[i]);
    for (glm::vec2& uv : mesh.uvs)
        for (glm::length_t axis = 0; axis < 2; ++axis) {
            const Tiles& along = tiles[static_cast<std::size_t>(axis)];
            uv[axis] = (uv[axis] - static_cast<float>(along.first)) / static_cast<float>(along.count);
        }
}

} // namespace tegument::meshfile
