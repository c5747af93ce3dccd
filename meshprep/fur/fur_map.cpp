#include "meshprep/fur/fur_map.h"

#include "meshprep/fur/root_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace tegument {

namespace {

Image emptyMap(int width, int height) {
    Image map{.width = width, .height = height, .channels = 4, .bitsPerChannel = 8};
    map.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    for (std::size_t i = 0; i < map.pixels.size(); ++i)
        map.pixels[i] = i % 4 == 3 ? 0.0F : 1.0F;
    return map;
}

/// The height at which a strand ends over a point at `distance` from its axis.
double heightAt(const Strand& strand, double distance, double radius, bool taper) {
    if (distance > radius) return 0;
    return taper ? strand.length * (1 - distance / radius) : strand.length;
}

template <class Space>
RootGrid<Space> gridOf(const StrandSet& set, const Space& space, double reach) {
    RootGrid<Space> grid(space, reach, set.strands.size());
    for (std::size_t i = 0; i < set.strands.size(); ++i)
        grid.add(set.strands[i].root, static_cast<std::uint32_t>(i));
    return grid;
}

template <class Space>
double tallestOver(const RootGrid<Space>& grid, const StrandSet& set, const glm::dvec3& point, double radius, bool taper) {
    double height = 0;
    grid.visit(point, [&](std::uint32_t index, double distance) {
        height = std::max(height, heightAt(set.strands[index], distance, radius, taper));
    });
    return height;
}

/// A strand between the centres of texels must not be lost: the texel in which it stands is its own.
void plant(Image& map, const glm::dvec2& uv, double length) {
    const int x = std::clamp(static_cast<int>(uv.x * map.width), 0, map.width - 1);
    const int y = std::clamp(static_cast<int>(uv.y * map.height), 0, map.height - 1);
    map.at(x, y, 3) = std::max(map.at(x, y, 3), static_cast<float>(length));
}

/// Fills alpha by the height over the point that each texel's centre shows.
template <class Space, class PointOf>
void fill(Image& map, const RootGrid<Space>& grid, const StrandSet& set, double radius, bool taper, PointOf&& pointOf) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const glm::dvec3 point = pointOf((x + 0.5) / map.width, (y + 0.5) / map.height);
            map.at(x, y, 3) = static_cast<float>(tallestOver(grid, set, point, radius, taper));
        }
}

struct FaceAxes {
    glm::dvec3 forward, right, down;
};
// Direct3D's cube map: u to the right and v down as seen from inside.
constexpr std::array<FaceAxes, 6> kFaces{{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                          {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                          {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                          {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                          {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                          {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

template <class Weight>
double weightedCoverage(std::span<const Image> images, Weight&& weight) {
    double covered = 0;
    double whole = 0;
    for (const Image& image : images)
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const double area = weight((x + 0.5) / image.width, (y + 0.5) / image.height);
                whole += area;
                if (image.at(x, y, 3) > 0) covered += area;
            }
    return whole > 0 ? covered / whole : 0;
}

} // namespace

std::size_t sphereMapTexels(int side) {
    return static_cast<std::size_t>(std::llround(std::numbers::pi / 4 * side * side));
}

int cubeMapSide(int sphereMapSide) {
    return std::max(1, static_cast<int>(std::lround(sphereMapSide / std::sqrt(6.0) / 4)) * 4);
}

std::size_t cubeMapTexels(int side) {
    return 6 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

glm::dvec3 sphereMapDirection(double s, double t) {
    glm::dvec2 xy(2 * s - 1, 1 - 2 * t);
    if (const double r = glm::length(xy); r > 1) xy /= r;
    const double z = std::sqrt(std::max(0.0, 1 - glm::dot(xy, xy)));
    return {2 * z * xy.x, 2 * z * xy.y, 2 * z * z - 1};
}

glm::dvec2 sphereMapTexture(const glm::dvec3& direction) {
    const glm::dvec3 sum = direction + glm::dvec3(0, 0, 1);
    const double length = glm::length(sum);
    if (length < 1e-12) return {1, 0.5}; // -z itself: any point of the rim
    return {0.5 + 0.5 * sum.x / length, 0.5 - 0.5 * sum.y / length};
}

glm::dvec3 cubeMapDirection(int face, double u, double v) {
    const FaceAxes& axes = kFaces.at(static_cast<std::size_t>(face));
    return glm::normalize(axes.forward + (2 * u - 1) * axes.right + (2 * v - 1) * axes.down);
}

CubePoint cubeMapTexture(const glm::dvec3& direction) {
    int face = 0;
    for (int i = 1; i < 6; ++i)
        if (glm::dot(direction, kFaces.at(static_cast<std::size_t>(i)).forward) >
            glm::dot(direction, kFaces.at(static_cast<std::size_t>(face)).forward))
            face = i;
    const FaceAxes& axes = kFaces.at(static_cast<std::size_t>(face));
    const glm::dvec3 onFace = direction / glm::dot(direction, axes.forward);
    return {face, {0.5 + 0.5 * glm::dot(onFace, axes.right), 0.5 + 0.5 * glm::dot(onFace, axes.down)}};
}

Image drawFurTexture(const StrandSet& set, int width, int height, const FurOptions& options) {
    Image map = emptyMap(width, height);
    const auto grid = gridOf(set, TorusSpace(width, height), options.radius);
    fill(map, grid, set, options.radius, options.taper, [&](double u, double v) { return glm::dvec3(u * width, v * height, 0); });
    for (const Strand& strand : set.strands)
        plant(map, glm::dvec2(strand.root) / glm::dvec2(width, height), strand.length);
    return map;
}

Image drawSphereMap(const StrandSet& set, int side, const FurOptions& options) {
    Image map = emptyMap(side, side);
    const double texel = texelAngle(sphereMapTexels(side));
    const auto grid = gridOf(set, SphereSpace{}, options.radius * texel);
    fill(map, grid, set, options.radius * texel, options.taper, sphereMapDirection);
    for (const Strand& strand : set.strands)
        plant(map, sphereMapTexture(strand.root), strand.length);
    return map;
}

std::array<Image, 6> drawCubeMap(const StrandSet& set, int side, const FurOptions& options) {
    const double texel = texelAngle(cubeMapTexels(side));
    const auto grid = gridOf(set, SphereSpace{}, options.radius * texel);
    std::array<Image, 6> faces;
    for (int face = 0; face < 6; ++face) {
        Image& map = faces.at(static_cast<std::size_t>(face));
        map = emptyMap(side, side);
        fill(map, grid, set, options.radius * texel, options.taper, [&](double u, double v) { return cubeMapDirection(face, u, v); });
    }
    for (const Strand& strand : set.strands) {
        const CubePoint point = cubeMapTexture(strand.root);
        plant(faces.at(static_cast<std::size_t>(point.face)), point.uv, strand.length);
    }
    return faces;
}

double coverage(const Image& texture) {
    return weightedCoverage({&texture, 1}, [](double, double) { return 1.0; });
}

double sphereCoverage(const Image& sphereMap) {
    return weightedCoverage({&sphereMap, 1},
                            [](double s, double t) { return glm::length(glm::dvec2(2 * s - 1, 2 * t - 1)) < 1 ? 1.0 : 0.0; });
}

double cubeCoverage(const std::array<Image, 6>& faces) {
    // Solid angle of a face's texel: (1 + x^2 + y^2)^(-3/2) times its area.
    return weightedCoverage(faces, [](double u, double v) {
        const glm::dvec2 onFace(2 * u - 1, 2 * v - 1);
        return std::pow(1 + glm::dot(onFace, onFace), -1.5);
    });
}

Image unfoldCube(const std::array<Image, 6>& faces) {
    constexpr std::array<glm::ivec2, 6> kPlaces{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
    const int side = faces.front().width;
    Image cross = emptyMap(4 * side, 3 * side);
    for (std::size_t face = 0; face < faces.size(); ++face)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (int c = 0; c < 4; ++c)
                    cross.at(kPlaces.at(face).x * side + x, kPlaces.at(face).y * side + y, c) = faces.at(face).at(x, y, c);
    return cross;
}

} // namespace tegument
