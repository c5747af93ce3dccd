#include "lab/bench/shapes.h"

#include "lab/bench/patch.h"
#include "lab/reference/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::bench {

namespace {

constexpr double kHalfPlane = 30;    // mm
constexpr double kPlaneChart = 0.62; // of the texture's side; the rest is for what throws shadows
constexpr double kGap = 0.02;
constexpr int kPlaneQuads = 32;
constexpr int kRoundQuads = 96;

Mesh finished(Mesh mesh, std::string name) {
    mesh.name = std::move(name);
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

void addPlane(Mesh& mesh) {
    addPatch(mesh, {.position = [](double s, double t) { return glm::dvec3(2 * s - 1, 1 - 2 * t, 0) * kHalfPlane; },
                    .normal = [](double, double) { return glm::dvec3(0, 0, 1); },
                    .uv = square({kGap, kGap}, kPlaneChart),
                    .columns = kPlaneQuads,
                    .rows = kPlaneQuads});
}

/// Three columns of two charts each, below and beside what `at` names.
void addBox(Mesh& mesh, const glm::dmat3& axes, const glm::dvec3& centre, const glm::dvec3& half, glm::dvec2 at, double side) {
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const double sign = face % 2 == 0 ? 1 : -1;
        const glm::dvec3 normal = axes[axis] * sign;
        const glm::dvec3 right = axes[(axis + 1) % 3] * half[(axis + 1) % 3];
        const glm::dvec3 up = axes[(axis + 2) % 3] * half[(axis + 2) % 3];
        const double cell = side / 3;
        addPatch(mesh,
                 {.position = [=](double s, double t) { return centre + normal * half[axis] + right * (2 * s - 1) + up * (1 - 2 * t); },
                  .normal = [=](double, double) { return normal; },
                  .uv = square(at + cell * glm::dvec2(face % 3, face / 3) + 0.05 * cell, 0.9 * cell),
                  .columns = 4,
                  .rows = 4});
    }
}

/// A flat ring, parallel to the plane: above, below, outside, and the wall of the hole.
void addRing(Mesh& mesh, const glm::dvec3& centre, double inner, double outer, double half, glm::dvec2 at, double side) {
    const auto around = [](double s) {
        const double angle = 2 * std::numbers::pi * s;
        return glm::dvec3(std::cos(angle), std::sin(angle), 0);
    };
    const glm::dvec3 z(0, 0, 1);
    for (int face = 0; face < 4; ++face) {
        const bool flat = face < 2;
        const double sign = face % 2 == 0 ? 1 : -1;
        const double radius = sign > 0 ? outer : inner;
        addPatch(mesh, {.position =
                            [=](double s, double t) {
                                return flat ? centre + around(s) * std::lerp(inner, outer, t) + z * (half * sign)
                                            : centre + around(s) * radius + z * (half * (1 - 2 * t));
                            },
                        .normal = [=](double s, double) { return flat ? z * sign : around(s) * sign; },
                        .uv = rectangle(at + glm::dvec2(0, face * side / 4), {side, 0.22 * side}),
                        .columns = kRoundQuads,
                        .rows = 4});
    }
}

/// A cube of directions, each divided by `shape` on the way out: an ellipsoid with these half axes.
void addEllipsoid(Mesh& mesh, const glm::dvec3& centre, const glm::dvec3& shape, int cells, int firstCell, int quads) {
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        glm::dvec3 forward(0);
        glm::dvec3 right(0);
        forward[axis] = face % 2 == 0 ? 1 : -1;
        right[(axis + 1) % 3] = 1;
        const glm::dvec3 up = glm::cross(forward, right);
        const auto direction = [=](double s, double t) {
            const auto bend = [](double x) { return std::tan(std::numbers::pi / 4 * (2 * x - 1)); }; // nearly equal steps of angle
            return glm::normalize(forward + right * bend(s) + up * bend(t));
        };
        const double cell = 1.0 / cells;
        const int place = firstCell + face;
        const glm::dvec2 corner = cell * glm::dvec2(place % cells, place / cells);
        addPatch(mesh, {.position = [=](double s, double t) { return centre + shape * direction(s, t); },
                        .normal = [=](double s, double t) { return glm::normalize(direction(s, t) / shape); },
                        .uv = square(corner + 0.04 * cell, 0.92 * cell),
                        .columns = quads,
                        .rows = quads});
    }
}

/// Of the square s, t onto the disc of radius 1.
glm::dvec2 onDisc(double s, double t) {
    const double a = 2 * s - 1;
    const double b = 2 * t - 1;
    return {a * std::sqrt(1 - b * b / 2), b * std::sqrt(1 - a * a / 2)};
}

std::function<glm::dvec2(double, double)> discChart(glm::dvec2 corner, double side) {
    return [=](double s, double t) { return corner + side * (0.5 + 0.5 * onDisc(s, t)); };
}

/// Half a sphere in a stereographic chart: of all charts the one that keeps angles, and with it the shape of a kernel.
void addHalfSphere(Mesh& mesh, double radius, double sign, glm::dvec2 corner, double side, int quads) {
    const auto direction = [=](double s, double t) {
        const glm::dvec2 d = onDisc(s, t);
        const double square = glm::dot(d, d);
        return glm::dvec3(sign * 2 * d.x, -2 * d.y, sign * (1 - square)) / (1 + square);
    };
    addPatch(mesh, {.position = [=](double s, double t) { return radius * direction(s, t); },
                    .normal = direction,
                    .uv = discChart(corner, side),
                    .columns = quads,
                    .rows = quads});
}

void addCap(Mesh& mesh, double radius, double height, double sign, glm::dvec2 at, double side) {
    addPatch(mesh,
             {.position = [=](double s, double t) { return glm::dvec3(radius * onDisc(s, t).x, sign * height, radius * onDisc(s, t).y); },
              .normal = [=](double, double) { return glm::dvec3(0, sign, 0); },
              .uv = discChart(at, side),
              .columns = kPlaneQuads,
              .rows = kPlaneQuads});
}

glm::dmat3 identity() {
    return glm::dmat3(1);
}

} // namespace

Mesh planeWithEdge(double angle) {
    constexpr double kNear = 15; // mm from the block to the border of its shadow
    constexpr double kHalfThickness = 4;
    Mesh mesh;
    addPlane(mesh);
    const double height = kNear / std::tan(glm::radians(angle));
    addBox(mesh, identity(), {-kNear - kHalfThickness, 0, height / 2 + 0.01}, {kHalfThickness, kHalfPlane, height / 2}, {0.66, kGap}, 0.32);
    return finished(std::move(mesh), "plane with an edge");
}

Mesh planeWithDisc(double angle) {
    constexpr double kHole = 4; // mm
    constexpr double kOuter = 12;
    constexpr double kAside = 34; // so far that the camera, which sees 24 mm, does not see the plate
    Mesh mesh;
    addPlane(mesh);
    const glm::dvec3 centre(-kAside, 0, kAside / std::tan(glm::radians(angle)));
    addRing(mesh, centre, kHole, kOuter, 0.25, {kGap, 0.66}, 0.32);
    return finished(std::move(mesh), "plane with a disc");
}

Mesh sphere(double radius, int quads) {
    constexpr double kSide = 0.5 - 1.5 * kGap;
    Mesh mesh;
    addHalfSphere(mesh, radius, 1, {kGap, kGap}, kSide, quads);
    addHalfSphere(mesh, radius, -1, {2 * kGap + kSide, kGap}, kSide, quads);
    return finished(std::move(mesh), "sphere");
}

Mesh cylinder() {
    constexpr double kRadius = 10;
    constexpr double kHalfHeight = 20;
    constexpr double kWidth = 1 - 2 * kGap;                              // of the side's chart
    constexpr double kPerMm = kWidth / (2 * std::numbers::pi * kRadius); // texture to the mm
    Mesh mesh;
    addPatch(mesh, {.position =
                        [](double s, double t) { // the seam is behind
                            const double angle = 2 * std::numbers::pi * s + std::numbers::pi;
                            return glm::dvec3(kRadius * std::sin(angle), kHalfHeight * (1 - 2 * t), kRadius * std::cos(angle));
                        },
                    .normal =
                        [](double s, double) {
                            const double angle = 2 * std::numbers::pi * s + std::numbers::pi;
                            return glm::dvec3(std::sin(angle), 0, std::cos(angle));
                        },
                    .uv = rectangle({kGap, kGap}, {kWidth, 2 * kHalfHeight * kPerMm}),
                    .columns = 2 * kRoundQuads,
                    .rows = kRoundQuads});
    const double below = 2 * kGap + 2 * kHalfHeight * kPerMm;
    addCap(mesh, kRadius, kHalfHeight, 1, {kGap, below}, 2 * kRadius * kPerMm);
    addCap(mesh, kRadius, kHalfHeight, -1, {2 * kGap + 2 * kRadius * kPerMm, below}, 2 * kRadius * kPerMm);
    return finished(std::move(mesh), "cylinder");
}

Mesh lobes() {
    const glm::dvec3 shape(8, 16, 8); // mm
    Mesh mesh;
    addEllipsoid(mesh, {-shape.x, 0, 0}, shape, 4, 0, 48);
    addEllipsoid(mesh, {shape.x, 0, 0}, shape, 4, 6, 48);
    return finished(std::move(mesh), "two lobes");
}

namespace {

struct FreeSquare {
    glm::dvec2 corner{0};
    double side = 0;
};

/// The largest square of the texture that no triangle covers, by a grid of 128 cells a side.
FreeSquare largestFreeSquare(const Mesh& mesh) {
    constexpr int kCells = 128;
    const reference::Unwrapped cover = reference::unwrap(mesh, 4 * kCells);
    const auto index = [](int x, int y) { return static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x); };
    std::vector<int> largest(index(0, kCells), 0); // side of the free square that ends in this cell
    FreeSquare best;
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
            bool free = true;
            for (int i = 0; i < 16 && free; ++i)
                free = !cover.at(4 * x + i % 4, 4 * y + i / 4);
            const auto at = [&](int i, int j) { return i < 0 || j < 0 ? 0 : largest[index(i, j)]; };
            const int side = free ? 1 + std::min({at(x - 1, y), at(x, y - 1), at(x - 1, y - 1)}) : 0;
            largest[index(x, y)] = side;
            if (side <= best.side * kCells) continue;
            best = {.corner = glm::dvec2(x + 1 - side, y + 1 - side) / static_cast<double>(kCells),
                    .side = static_cast<double>(side) / kCells};
        }
    return best;
}

} // namespace

bool addBar(Mesh& mesh, const glm::dvec3& toLight) {
    constexpr double kAway = 1.6; // radii
    constexpr double kHalfThickness = 1.0 / 16;
    const FreeSquare room = largestFreeSquare(mesh);
    if (room.side < 1.0 / 64) return false;
    const double radius = static_cast<double>(mesh.bounds.radius);
    const glm::dvec3 l = glm::normalize(toLight);
    const glm::dvec3 across = glm::normalize(glm::cross(std::abs(l.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), l));
    const glm::dmat3 axes(across, glm::cross(l, across), l);
    mesh.tangents.clear(); // made anew when the file is read
    const std::size_t before = mesh.indices.size();
    const double inset = 0.15 * room.side;
    addBox(mesh, axes, glm::dvec3(mesh.bounds.centre) + l * (kAway * radius), glm::dvec3(kHalfThickness, 1, kHalfThickness) * radius,
           room.corner + inset, room.side - 2 * inset);
    mesh.parts.push_back({.name = "bar",
                          .firstIndex = static_cast<std::uint32_t>(before),
                          .indexCount = static_cast<std::uint32_t>(mesh.indices.size() - before)});
    computeBounds(mesh);
    return true;
}

namespace {

template <class Function>
Image paint(int size, int channels, Function value) {
    Image image{.width = size, .height = size, .channels = channels, .bitsPerChannel = 8};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::dvec4 texel = value(x, y);
            for (int c = 0; c < channels; ++c)
                image.pixels.push_back(static_cast<float>(std::round(255 * texel[c]) / 255));
        }
    return image;
}

} // namespace

Image bumpMap() {
    constexpr int kSize = 1024;
    constexpr double kWaves = 96;
    constexpr double kSlope = 0.3;
    return paint(kSize, 3, [](int x, int y) {
        const double step = 2 * std::numbers::pi * kWaves / kSize;
        const glm::dvec3 normal(kSlope * std::sin(step * (x + 0.5)), kSlope * std::sin(step * (y + 0.5)), 1);
        return glm::dvec4(0.5 + 0.5 * glm::normalize(normal), 1);
    });
}

Image checkerMap() {
    constexpr int kSize = 1024;
    constexpr int kSquare = kSize / 64;
    return paint(kSize, 3, [](int x, int y) {
        const bool light = (x / kSquare + y / kSquare) % 2 == 0;
        return light ? glm::dvec4(0.91, 0.80, 0.73, 1) : glm::dvec4(0.45, 0.27, 0.20, 1);
    });
}

} // namespace tegument::bench
