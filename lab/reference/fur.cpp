#include "lab/reference/fur.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace tegument::reference {

namespace {

constexpr double kPi = std::numbers::pi;

/// Zero stays zero.
glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}

/// Of unit vectors.
double sine(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(a, b));
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(sine(a, b), glm::dot(a, b));
}

const glm::dvec3 kDown(0, -1, 0);

constexpr double kAsideBy = 1.0 / 128; // pixels
constexpr double kKernel = 1.7;        // a trilinear look-up is a mean over that many pixels
constexpr double kFaint = 0.002;       // coverage that is left out where only the mean is drawn
constexpr double kLeastFall = 0.02;    // cosine of rays that graze, or rise by an interpolated normal

/// Of a triangle in either order.
bool isInside(const std::array<glm::dvec2, 3>& points, const glm::dvec2& at) {
    int positive = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 along = points[(i + 1) % 3] - points[i];
        const glm::dvec2 to = at - points[i];
        positive += along.x * to.y - along.y * to.x > 0 ? 1 : 0;
    }
    return positive == 0 || positive == 3;
}

/// A white strand without reflection, lit by light of colour 1.
double diffuse(const FurCoat& coat, const glm::dvec3& strand, const glm::dvec3& toLight) {
    const double once = 1 / kPi;
    return sine(strand, toLight) * (once + coat.multiple * (1 - once));
}

/// The cone of mirror directions makes with the strand the angle pi less that of the light.
double mirrored(const FurCoat& coat, const glm::dvec3& strand, const glm::dvec3& toLight, const glm::dvec3& toEye) {
    const double off = angle(strand, toEye) - (kPi - angle(strand, toLight));
    const double lobe = std::pow(std::max(std::cos(off), 1e-6), coat.exponent);
    return sine(strand, toLight) * lobe * std::sqrt((coat.exponent + 2.0 / 3) / (2 * kPi)) / 2;
}

} // namespace

FurShells::FurShells(const Mesh& mesh, const FurCoat& coat, const Pinhole& view, std::vector<glm::dvec4> grown, double grid)
    : mesh_(mesh), coat_(coat), view_(view), grown_(std::move(grown)), grid_(grid) {
    pixels_.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
    aside_.resize(pixels_.size());
    draw(0, 0);
    for (int i = 1; i <= coat.layers; ++i) {
        const int layer = coat.outerFirst ? coat.layers + 1 - i : i;
        draw(layer, std::pow(static_cast<double>(layer) / coat.layers, coat.spread));
    }
    ends_.resize(pixels_.size());
    if (coat.fringes) drawBehindFirst();
}

/// Behind: beyond the nearest place at which the outermost layer is turned away from the eye.
void FurShells::drawBehindFirst() {
    std::vector<double> ends(pixels_.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t triangle = 0; triangle < mesh_.indices.size() / 3; ++triangle)
        findEnd(triangle, ends);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const auto coat = std::ranges::find_if(pixels_[i], [](const FurFragment& fragment) { return fragment.layer > 0; });
        std::stable_partition(coat, pixels_[i].end(), [&](const FurFragment& fragment) { return fragment.depth > ends[i]; });
    }
}

void FurShells::findEnd(std::uint32_t triangle, std::vector<double>& ends) {
    const std::array<glm::dvec3, 3> t = corners(triangle, 1);
    if (glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), t[0] - view_.eye) <= 0) return;
    cover(t, [&](int x, int y) {
        glm::dvec3 weights;
        const FurFragment end = meet(coat_.layers, triangle, 1, view_.ray(x, y), weights);
        if (std::min({weights.x, weights.y, weights.z}) < 0) return;
        ends[index(x, y)] = std::min(ends[index(x, y)], end.depth);
        ++ends_[index(x, y)];
    });
}

template <class Visit>
void FurShells::cover(const std::array<glm::dvec3, 3>& t, Visit visit) {
    const glm::dvec2 size(view_.width, view_.height);
    const std::array<glm::dvec2, 3> points{view_.project(t[0]) * size - 0.5, view_.project(t[1]) * size - 0.5,
                                           view_.project(t[2]) * size - 0.5};
    const glm::dvec2 low = glm::ceil(glm::max(glm::min(points[0], glm::min(points[1], points[2])) - kAsideBy, glm::dvec2(0)));
    const glm::dvec2 high = glm::floor(glm::min(glm::max(points[0], glm::max(points[1], points[2])) + kAsideBy, size - 1.0));
    for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y)
        for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
            for (std::size_t i = 0; i < kAside.size(); ++i)
                if (isInside(points, glm::dvec2(x, y) + kAsideBy * kAside[i])) ++aside_[index(x, y)][i];
            visit(x, y);
        }
}

glm::dvec3 FurShells::extruded(std::uint32_t vertex, double height) const {
    const glm::dvec3 lean = coat_.lean * kDown + (grown_.empty() ? glm::dvec3(0) : glm::dvec3(grown_[vertex]));
    const glm::dvec3 up = unit(glm::dvec3(mesh_.normals[vertex])) + height * lean;
    return glm::dvec3(mesh_.positions[vertex]) + up * (coat_.length * static_cast<double>(mesh_.bounds.radius) * height);
}

std::array<glm::dvec3, 3> FurShells::corners(std::uint32_t triangle, double height) const {
    std::array<glm::dvec3, 3> points;
    for (std::size_t c = 0; c < 3; ++c)
        points[c] = extruded(mesh_.indices[3 * std::size_t{triangle} + c], height);
    return points;
}

/// Where the device has them: each at its own depth, on the grid.
std::array<glm::dvec3, 3> FurShells::placed(std::array<glm::dvec3, 3> points) const {
    if (grid_ > 0)
        for (glm::dvec3& point : points)
            point = view_.onGrid(point, grid_);
    return points;
}

FurFragment FurShells::meet(int layer, std::uint32_t triangle, double height, const glm::dvec3& direction, glm::dvec3& weights) const {
    const std::array<glm::dvec3, 3> exact = corners(triangle, height);
    const auto [a, b, c] = placed(exact);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double distance = glm::dot(a - view_.eye, normal) / glm::dot(direction, normal);
    const glm::dvec3 within = view_.eye + distance * direction - a;
    const double square = glm::dot(normal, normal);
    weights.y = glm::dot(glm::cross(within, c - a), normal) / square;
    weights.z = glm::dot(glm::cross(b - a, within), normal) / square;
    weights.x = 1 - weights.y - weights.z;
    const SurfacePoint skin = interpolate(mesh_, {triangle, weights});
    glm::dvec4 grown(0);
    for (int i = 0; i < 3; ++i)
        grown += weights[i] *
                 (grown_.empty() ? glm::dvec4(0, 0, 0, 1) : grown_[mesh_.indices[3 * std::size_t{triangle} + static_cast<std::size_t>(i)]]);
    return {.layer = layer,
            .triangle = triangle,
            .height = height,
            .depth = distance * glm::dot(direction, view_.forward),
            .rest = skin.position - glm::dvec3(mesh_.bounds.centre),
            .normal = skin.normal,
            .position = weights.x * exact[0] + weights.y * exact[1] + weights.z * exact[2],
            .lean = glm::dvec3(grown),
            .share = grown.w,
            .weights = weights};
}

void FurShells::draw(int layer, double height) {
    for (std::uint32_t triangle = 0; triangle < mesh_.indices.size() / 3; ++triangle)
        draw(layer, triangle, height);
}

void FurShells::draw(int layer, std::uint32_t triangle, double height) {
    const std::array<glm::dvec3, 3> t = placed(corners(triangle, height));
    if (glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), t[0] - view_.eye) >= 0) return; // turned away
    cover(t, [&](int x, int y) {
        glm::dvec3 weights;
        const FurFragment fragment = meet(layer, triangle, height, view_.ray(x, y), weights);
        if (std::min({weights.x, weights.y, weights.z}) >= 0) pixels_[index(x, y)].push_back(fragment);
    });
}

bool FurShells::isClear(int x, int y) const {
    const std::size_t pixel = index(x, y);
    return std::ranges::all_of(aside_[pixel], [&](std::uint16_t count) { return count == pixels_[pixel].size() + ends_[pixel]; });
}

FurFacet FurShells::facet(const FurFragment& fragment) const {
    FurFacet facet{.positions = corners(fragment.triangle, fragment.height)};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh_.indices[3 * std::size_t{fragment.triangle} + c];
        facet.rest[c] = glm::dvec3(mesh_.positions[vertex]) - glm::dvec3(mesh_.bounds.centre);
        facet.normals[c] = glm::dvec3(mesh_.normals[vertex]);
    }
    return facet;
}

FurFragment FurShells::onItsPlane(const FurFragment& fragment, int x, int y) const {
    glm::dvec3 weights;
    return meet(fragment.layer, fragment.triangle, fragment.height, view_.ray(x, y), weights);
}

FurFootprint FurShells::footprint(FurVector kind, const FurFragment& fragment, int x, int y) const {
    const auto apart = [&](const FurFragment& from, const FurFragment& to) {
        return glm::dvec2(glm::length(furVector(kind, to) - furVector(kind, from)), glm::length(to.rest - from.rest));
    };
    const int left = x & ~1;
    const int top = y & ~1;
    const glm::dvec2 aside = apart(onItsPlane(fragment, left, y), onItsPlane(fragment, left + 1, y));
    const glm::dvec2 below = apart(onItsPlane(fragment, x, top), onItsPlane(fragment, x, top + 1));
    const glm::dvec2 longer = glm::max(aside, below);

    // While the ray goes its way, the point of the coat that it is at moves along the strand there and, over the skin, along the surface.
    const glm::dvec3 normal = unit(fragment.normal);
    const glm::dvec3 view = unit(fragment.position - view_.eye);
    const glm::dvec3 strand = normal + 2 * coat_.lean * fragment.height * kDown;
    const double fall = std::max(-glm::dot(view, normal), kLeastFall);
    const glm::dvec3 across = view - normal * glm::dot(view, normal);
    const glm::dvec3 way = across * (glm::dot(strand, normal) / fall) + (strand - normal * glm::dot(strand, normal));
    const double mm = glm::length(way) * coat_.length * static_cast<double>(mesh_.bounds.radius);
    return {.angle = std::clamp(std::min(aside.x, below.x), longer.x / 100, longer.x),
            .sweep = longer.y > 0 ? mm * longer.x / longer.y : 0};
}

glm::dvec3 furVector(FurVector kind, const FurFragment& fragment) {
    const glm::dvec3 position = unit(fragment.rest);
    const glm::dvec3 normal = unit(fragment.normal);
    const glm::dvec3 sum = position + normal;
    glm::dvec3 v = kind == FurVector::Position ? position : kind == FurVector::Normal ? normal : sum;
    if (kind == FurVector::Combined && glm::length(sum) < 1e-4) v = normal;
    return v == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : unit(v);
}

glm::dvec2 onSphereMap(const glm::dvec3& direction) {
    // The mirror ball's normal halves the angle between the direction and the view's reverse, +z.
    const glm::dvec3 normal = unit(direction + glm::dvec3(0, 0, 1));
    return {(1 + normal.x) / 2, (1 - normal.y) / 2};
}

namespace {

struct Face {
    glm::dvec3 ahead, right, down;
};
constexpr std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                         {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

} // namespace

OnCube onCubeMap(const glm::dvec3& direction) {
    const auto nearest = std::ranges::max_element(kFaces, {}, [&](const Face& face) { return glm::dot(face.ahead, direction); });
    const int face = static_cast<int>(nearest - kFaces.begin());
    return {face, onCubeFace(face, direction)};
}

glm::dvec2 onCubeFace(int face, const glm::dvec3& direction) {
    const Face& on = kFaces.at(static_cast<std::size_t>(face));
    const glm::dvec3 onPlane = direction / glm::dot(on.ahead, direction);
    return {(1 + glm::dot(on.right, onPlane)) / 2, (1 + glm::dot(on.down, onPlane)) / 2};
}

glm::dvec3 fromCubeMap(const OnCube& place) {
    const Face& on = kFaces.at(static_cast<std::size_t>(place.face));
    return on.ahead + (2 * place.uv.x - 1) * on.right + (2 * place.uv.y - 1) * on.down;
}

double furCovered(const FurCoat& coat, double alpha, double height) {
    const double standing = alpha <= 0 ? 0 : std::clamp((alpha - height) / coat.softness + 0.5, 0.0, 1.0);
    return (1 - coat.taper) * alpha + coat.taper * standing;
}

double furOpen(const FurCoat& coat, double height, double cosine) {
    // A ray in the plane of a ball of radius 1 with a coat around it: from (0, from) to where it leaves the coat.
    const double thickness = std::max(coat.length, 1e-3);
    const double from = 1 + height * thickness;
    const double out = 1 + thickness;
    const double across = std::sqrt(1 - cosine * cosine);
    const double way = std::sqrt(out * out - from * from * across * across) - from * cosine;
    return std::exp(-coat.density * across * way / thickness);
}

glm::dvec3 furAlbedo(const FurCoat& coat, double height) {
    return coat.root + height * (coat.tip - coat.root);
}

glm::dvec3 furRadiance(const FurCoat& coat, const FurFragment& fragment, const FurLight& light, const glm::dvec3& eye, bool lit) {
    return furRadiance(coat, fragment, furAlbedo(coat, fragment.height), light, eye, lit);
}

glm::dvec3 furRadiance(const FurCoat& coat, const FurFragment& fragment, const glm::dvec3& albedo, const FurLight& light,
                       const glm::dvec3& eye, bool lit) {
    const glm::dvec3 normal = unit(fragment.normal);
    const glm::dvec3 toLight = unit(light.position - fragment.position);
    const glm::dvec3 toEye = unit(eye - fragment.position);
    const glm::dvec3 strand = unit(normal + 2 * fragment.height * (coat.lean * kDown + fragment.lean));
    const double cosine = std::clamp(glm::dot(normal, toLight), -1.0, 1.0);
    const glm::dvec3 dull = albedo * std::max(cosine, 0.0);
    const glm::dvec3 hair =
        albedo * (1 - coat.specular) * diffuse(coat, strand, toLight) + coat.specular * mirrored(coat, strand, toLight, toEye);
    const double strands = fragment.layer > 0 ? coat.kajiyaKay : 0;
    const double open = 1 + coat.kajiyaKay * (furOpen(coat, fragment.height, cosine) - 1);
    const glm::dvec3 direct = (dull + strands * (hair - dull)) * light.colour * open * (lit ? 1.0 : 0.0);
    const double sky = std::exp(-coat.density * (1 - fragment.height)) * (1 + coat.multiple) / 2;
    return direct + albedo * coat.fill * sky;
}

FurMean furMean(const FurCoat& coat, const FurTexel& texel, int layer) {
    const double share = 1 / (1 + std::pow(coat.grain / (kKernel * texel.footprint.angle), 2));
    const double deviation = std::min(coat.deviation * std::sqrt(share), texel.alpha);
    if (deviation <= 0) return {};
    // Half of the light has gone where strands whose ends are soft have sunk this far below the layer.
    const double tip = texel.alpha + coat.softness / 2 - std::min(0.2 * std::sqrt(coat.softness), coat.softness);
    const auto above = [&](int at) { // of a logistic distribution, in its scale
        return (tip - std::pow(static_cast<double>(at) / coat.layers, coat.spread)) * kPi / (std::sqrt(3.0) * deviation);
    };
    const auto lowerLog = [](double x) { return -std::max(x, 0.0) - std::log1p(std::exp(-std::abs(x))); }; // of the share that is lower
    const double taller = std::abs(std::expm1(lowerLog(above(layer))));                                    // never -0
    const double passedLog = lowerLog(above(layer)) - lowerLog(above(layer + 1));
    const double slope = 2.8 * coat.deviation / coat.grain * texel.footprint.sweep;
    const double entered = std::abs(std::expm1(passedLog * (0.5 + std::hypot(0.5, slope / kPi))));
    const double end = 0.6 * coat.softness / (std::sqrt(12.0) * deviation);
    return {.covered = 1 / std::cbrt(std::pow(entered, -3) + std::pow(taller, -3)), .afar = coat.taper / (1 + end * end)};
}

namespace {

/// Share of what is behind that a layer hides; none where it writes nothing.
std::optional<double> drawnCoverage(const FurCoat& coat, const FurTexel& texel, const FurFragment& fragment) {
    if (fragment.layer == 0) return 1;
    const double covered = furCovered(coat, texel.alpha, fragment.height);
    const FurMean mean = coat.outerFirst ? FurMean{} : furMean(coat, texel, fragment.layer);
    const double least = std::max(coat.alphaTest, coat.outerFirst ? 0.5 : 0.0);
    if (std::lerp(covered - least, mean.covered - kFaint, mean.afar) < 0) return {};
    if (coat.outerFirst) return 1;
    // n layers let through what 32 layers would.
    const double one = 1 - std::exp(32.0 / coat.layers * std::log1p(-std::min(covered, 1.0)));
    return std::lerp(one, mean.covered, mean.afar);
}

} // namespace

std::vector<FurShare> blendFur(const FurCoat& coat, const std::vector<FurFragment>& fragments,
                               const std::function<FurTexel(const FurFragment&)>& lookUp) {
    std::vector<FurShare> shares;
    double nearest = std::numeric_limits<double>::infinity();
    for (const FurFragment& fragment : fragments) {
        if (fragment.depth > nearest) continue;
        const auto covered = drawnCoverage(coat, fragment.layer > 0 ? lookUp(fragment) : FurTexel{}, fragment);
        if (!covered) continue;
        for (FurShare& share : shares)
            share.weight *= 1 - *covered;
        shares.push_back({&fragment, *covered});
        nearest = fragment.depth;
    }
    return shares;
}

} // namespace tegument::reference
