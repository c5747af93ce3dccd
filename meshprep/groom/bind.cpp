#include "meshprep/groom/bind.h"

#include "host/support/parallel.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/prepare/near_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

constexpr std::size_t kTexels = std::size_t{kRootColumns} * kRootColumns;
constexpr std::size_t kRootsOfRow = kRootColumns / kRootTexels;
constexpr double kUsualSnap = 0.02; // radii

/// A ball amid the roots, too small to be seen: what stands for a skin that nobody gave.
void makeSkin(const Groom& groom, Mesh& mesh) {
    glm::dvec3 mean(0);
    for (std::size_t i = 0; i < groom.strands(); ++i)
        mean += glm::dvec3(groom.strand(i).front()) / static_cast<double>(groom.strands());
    double spread = 1e-3;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        spread = std::max(spread, glm::distance(glm::dvec3(groom.strand(i).front()), mean));
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) { // of an octahedron
            glm::dvec3 n(0);
            n[axis] = side;
            mesh.positions.emplace_back(mean + 1e-4 * spread * n);
            mesh.normals.emplace_back(n);
        }
    mesh.indices = {1, 3, 5, 3, 0, 5, 0, 2, 5, 2, 1, 5, 3, 1, 4, 0, 3, 4, 2, 0, 4, 1, 2, 4};
    mesh.parts = {{.name = "skin", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
}

/// Of each strand, where it stands and how it runs from there.
struct Bound {
    glm::vec3 root{0};
    glm::vec3 normal{0, 1, 0};
    float moved = 0;   // mm
    double radius = 0; // mm
    bool off = false;
};

class Skin {
public:
    explicit Skin(const Mesh& mesh) : mesh_(mesh), near_(unit(mesh, low_, side_), mesh.indices) {}

    [[nodiscard]] Bound at(const glm::vec3& place, double snap) const {
        const glm::dvec3 p = (glm::dvec3(place) - low_) / side_;
        const prep::NearestTriangle found = near_.nearest(p);
        const auto corners = near_.triangle(found.triangle);
        const glm::dvec3 on = prep::nearestOnTriangle(p, corners[0], corners[1], corners[2]);
        const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], n = glm::cross(u, v);
        const double area = std::max(glm::dot(n, n), 1e-300);
        const double second = glm::dot(glm::cross(on - corners[0], v), n) / area,
                     third = glm::dot(glm::cross(u, on - corners[0]), n) / area;
        const std::uint32_t* corner = &mesh_.indices[3 * std::size_t{found.triangle}];
        const glm::dvec3 normal = (1 - second - third) * glm::dvec3(mesh_.normals[corner[0]]) +
                                  second * glm::dvec3(mesh_.normals[corner[1]]) + third * glm::dvec3(mesh_.normals[corner[2]]);
        Bound bound{.moved = static_cast<float>(found.distance * side_)};
        bound.off = !(found.distance * side_ <= snap);
        bound.root = bound.off ? place : glm::vec3(low_ + side_ * on);
        if (glm::length(normal) > 0) bound.normal = glm::vec3(glm::normalize(normal));
        return bound;
    }
    [[nodiscard]] double distance(const glm::vec3& place) const {
        return side_ * near_.nearest((glm::dvec3(place) - low_) / side_).distance;
    }
    [[nodiscard]] double area() const {
        double sum = 0;
        for (std::size_t i = 0; i < near_.size(); ++i) {
            const auto [a, b, c] = near_.triangle(i);
            sum += 0.5 * glm::length(glm::cross(b - a, c - a)) * side_ * side_;
        }
        return sum;
    }

private:
    const std::vector<glm::dvec3>& unit(const Mesh& mesh, glm::dvec3& low, double& side) {
        low = mesh.bounds.minimum;
        const glm::dvec3 size = glm::dvec3(mesh.bounds.maximum) - low;
        side = std::max({size.x, size.y, size.z, 1e-30});
        for (const glm::vec3& p : mesh.positions)
            points_.push_back((glm::dvec3(p) - low) / side);
        return points_;
    }

    const Mesh& mesh_;
    std::vector<glm::dvec3> points_;
    glm::dvec3 low_{0};
    double side_ = 1;
    prep::NearSurface near_;
};

class Texture {
public:
    explicit Texture(std::size_t texels) {
        image_.width = kRootColumns;
        image_.channels = 4;
        image_.height = static_cast<int>((texels + kRootColumns - 1) / kRootColumns);
        image_.pixels.resize(std::size_t{4} * kRootColumns * static_cast<std::size_t>(image_.height));
    }
    void put(std::size_t texel, const glm::vec3& xyz, double w) {
        const float values[] = {xyz.x, xyz.y, xyz.z, static_cast<float>(w)};
        std::copy_n(values, 4, &image_.pixels[4 * texel]);
    }
    [[nodiscard]] Image take() { return std::move(image_); }

private:
    Image image_;
};

/// How far the chain through some places of another leaves what lies between these.
double leftBehind(std::span<const glm::vec3> chain, std::span<const float> places) {
    double most = 0;
    for (std::size_t i = 0, at = 0; i < chain.size(); ++i) {
        while (at + 2 < places.size() && places[at + 1] < static_cast<float>(i))
            ++at;
        const glm::vec3 a = atPlace(chain, places[at]), b = atPlace(chain, places[at + 1]);
        const float square = glm::dot(b - a, b - a);
        const float t = square > 0 ? std::clamp(glm::dot(chain[i] - a, b - a) / square, 0.0F, 1.0F) : 0.0F;
        most = std::max(most, static_cast<double>(glm::distance(chain[i], glm::mix(a, b, t))));
    }
    return most;
}

/// A number in [0, 1) for each strand, a multiple of 2^-24.
double noise(std::uint32_t i) {
    std::uint32_t v = i * 747796405U + 2891336453U; // pcg (M. O'Neill, 2014)
    v = ((v >> ((v >> 28U) + 4U)) ^ v) * 277803737U;
    return static_cast<double>((v >> 22U ^ v) >> 8U) / 16777216.0;
}

} // namespace

Result<Image> bindGroom(Mesh& mesh, Groom groom, const BindOptions& options, BoundFigures& figures) {
    groom = inMillimetres(evaluated(std::move(groom)));
    if (const auto guides = static_cast<std::size_t>(std::ranges::count(groom.guides, 1)); guides > 0 && guides < groom.strands()) {
        figures.guides = guides;
        groom = strandsOf(groom, [guide = groom.guides](std::size_t i) { return guide[i] != 1; });
    }
    removeRibbons(mesh);
    figures.madeSkin = mesh.indices.empty();
    if (figures.madeSkin) {
        makeSkin(groom, mesh);
        computeBounds(mesh);
    }
    const std::size_t strands = groom.strands();
    figures.strands = strands;
    std::size_t most = 2;
    for (std::size_t i = 0; i < strands; ++i)
        most = std::max(most, groom.length(i));
    const std::size_t firstPoint = kRootColumns * (1 + (strands + kRootsOfRow - 1) / kRootsOfRow);
    const std::size_t room = firstPoint < kTexels ? (kTexels - firstPoint) / strands : 0;
    if (room < 2)
        return usageError(7110, fmt::format("{} strands do not fit into a texture of 4096 x 4096", strands), "draw fewer: --share 0.1");
    const std::size_t points = std::min({most, kMostCurvePoints, room});
    figures.points = points;

    const Skin skin(mesh);
    const double snap = options.snap.value_or(kUsualSnap * static_cast<double>(mesh.bounds.radius));
    Texture texture(firstPoint + strands * points);
    std::vector<Bound> bound(strands);
    RibbonCurves curves{.points = points};
    curves.direction.resize(strands);
    curves.color.resize(strands, glm::vec3(1));
    struct Found {
        double error = 0, left = 0, farthest = 0, widest = 0;
        std::size_t off = 0, resampled = 0;
    };
    std::vector<Found> found(chunkCount(strands));
    std::vector<float> lengths(strands);
    inChunks(strands, options.threads, [&](std::size_t first, std::size_t last, std::size_t chunk) {
        Found& here = found[chunk];
        for (std::size_t i = first; i < last; ++i) {
            const std::span<const glm::vec3> chain = groom.strand(i);
            const bool fewer = chain.size() > points;
            const std::vector<float> places = fewer ? evenPlaces(chain, points) : dividedPlaces(chain, points);
            if (fewer) here.left = std::max(here.left, leftBehind(chain, places));
            here.resampled += fewer;
            Bound& b = bound[i] = skin.at(chain.front(), snap);
            if (b.off)
                here.off += !figures.madeSkin;
            else
                here.error = std::max(here.error, skin.distance(b.root));
            for (std::size_t k = 0; k < points; ++k) {
                const glm::vec3 offset = atPlace(chain, places[k]) - chain.front();
                double radius = 0.5 * options.width.value_or(kUsualWidth);
                if (!options.width && !groom.widths.empty()) {
                    const std::size_t at = groom.first[i] + std::min(static_cast<std::size_t>(places[k]), chain.size() - 2);
                    const float t = places[k] - static_cast<float>(at - groom.first[i]);
                    radius = 0.5 * static_cast<double>(glm::mix(groom.widths[at], groom.widths[at + 1], t));
                }
                texture.put(firstPoint + i * points + k, offset, radius);
                if (k == 0) b.radius = radius;
                here.farthest = std::max(here.farthest, static_cast<double>(glm::length(offset)));
                here.widest = std::max(here.widest, radius);
                if (k > 0) lengths[i] += glm::distance(atPlace(chain, places[k - 1]), atPlace(chain, places[k]));
            }
            const glm::vec3 chord = chain.back() - chain.front();
            const glm::vec3 across = chord - b.normal * glm::dot(chord, b.normal);
            curves.direction[i] = glm::length(chord) > 0 ? across / std::max(glm::length(chord), 1e-20F) : glm::vec3(0);
            if (!groom.colors.empty())
                curves.color[i] =
                    atPlace(std::span(groom.colors).subspan(groom.first[i], chain.size()), 0.5F * static_cast<float>(chain.size() - 1));
        }
    });
    Found all;
    for (const Found& one : found) {
        all.error = std::max(all.error, one.error);
        all.left = std::max(all.left, one.left);
        all.farthest = std::max(all.farthest, one.farthest);
        all.widest = std::max(all.widest, one.widest);
        figures.off += one.off;
        figures.resampled += one.resampled;
    }
    figures.error = all.error;
    figures.resampledError = all.left;
    std::vector<float> moved;
    Mesh ball; // that of the skin and all roots, as whoever reads the mesh again finds it
    ball.positions = mesh.positions;
    for (std::size_t i = 0; i < strands; ++i) {
        const Bound& b = bound[i];
        ball.positions.push_back(b.root);
        if (!b.off) moved.push_back(b.moved);
        const std::size_t texel = kRootColumns + i / kRootsOfRow * kRootColumns + i % kRootsOfRow * kRootTexels;
        const double share = std::clamp(static_cast<double>(lengths[i]) / all.farthest, 0.01, 1.0);
        texture.put(texel, b.root, b.radius);
        texture.put(texel + 1, b.normal * static_cast<float>(share), 1e9);
        texture.put(texel + 2, curves.direction[i], noise(static_cast<std::uint32_t>(i)));
    }
    if (!moved.empty()) {
        std::ranges::nth_element(moved, moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2));
        figures.moved = static_cast<double>(moved[moved.size() / 2]);
    }
    computeBounds(ball);
    mesh.bounds = ball.bounds;
    // Of strands that stand alone: on a thousandth of the ball around them, as if that were their skin.
    const double ballArea = 4 * std::numbers::pi * mesh.bounds.radius * mesh.bounds.radius;
    const double density = static_cast<double>(strands) / std::max(skin.area(), std::max(1e-3 * ballArea, 1e-20));
    Image image = texture.take();
    Texture header(1);
    header.put(2, {static_cast<float>(image.height), 0, static_cast<float>(strands)}, 1);
    header.put(3, {1, static_cast<float>(all.widest), 0}, density);
    header.put(4, mesh.bounds.centre, static_cast<double>(mesh.bounds.radius));
    header.put(5, {0.01F, 0.5F, 1}, 0);
    header.put(6, {kRootColumns, kNodeCells, 0}, 0);
    header.put(8, {static_cast<float>(firstPoint), static_cast<float>(points), static_cast<float>(all.farthest)},
               std::max(all.widest, 1e-6));
    header.put(9, {groom.colors.empty() ? 0.0F : 1.0F, 0, 0}, 0);
    const GroomFigures size = figuresOf(groom);
    header.put(10, size.low, 0);
    header.put(11, size.high, 0);
    const Image row = header.take();
    std::ranges::copy(row.pixels, image.pixels.begin());
    const auto added = addRibbons(mesh, image, {.curves = &curves, .threads = options.threads});
    if (!added) return added.error();
    return image;
}

Result<Groom> groomOfRoots(const Mesh& mesh, const Image& roots, double length) {
    const auto header = rootHeader(roots);
    if (!header) return inputError(7109, {}, "this is no texture of roots", "make one with: tegument fur roots MESH -o FILE.dds");
    constexpr int kPoints = 9; // of a parabola
    Groom groom;
    const double scale = static_cast<double>(mesh.bounds.radius) / header->ballRadius;
    const auto place = [&](const glm::vec3& p) {
        return glm::vec3(glm::dvec3(mesh.bounds.centre) + scale * (glm::dvec3(p) - header->centre));
    };
    for (std::size_t i = 0; i < header->count; ++i) {
        const Root root = rootAt(roots, i);
        if (header->curvePoints == 0) {
            const double high = std::min(static_cast<double>(root.share) * length * header->ballRadius, static_cast<double>(root.limit));
            for (int k = 0; k < kPoints; ++k) {
                const float t = static_cast<float>(k) / (kPoints - 1);
                groom.points.push_back(place(root.position + static_cast<float>(high) * (root.normal * t + root.lean * (t * t))));
                groom.widths.push_back(static_cast<float>(2 * scale) * root.radius * (1 - t));
            }
        } else {
            for (std::size_t k = 0; k < header->curvePoints; ++k) {
                const float* texel = &roots.pixels[4 * (header->firstPoint + i * header->curvePoints + k)];
                groom.points.push_back(place(root.position + glm::vec3(texel[0], texel[1], texel[2])));
                groom.widths.push_back(static_cast<float>(2 * scale) * texel[3]);
            }
        }
        groom.ids.push_back(static_cast<std::int32_t>(i));
        groom.endStrand();
    }
    return groom;
}

} // namespace tegument
