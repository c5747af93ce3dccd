#include "host/reference/fur.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

FurShells::FurShells(const Mesh& mesh, const FurCoat& coat, const Pinhole& view) : mesh_(mesh), coat_(coat), view_(view) {
    pixels_.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
    draw(0, 0);
    for (int i = 1; i <= coat.layers; ++i) {
        const int layer = coat.outerFirst ? coat.layers + 1 - i : i;
        draw(layer, std::pow(static_cast<double>(layer) / coat.layers, coat.spread));
    }
}

glm::dvec3 FurShells::extruded(std::uint32_t vertex, double height) const {
    const glm::dvec3 up = unit(glm::dvec3(mesh_.normals[vertex])) + coat_.lean * height * kDown;
    return glm::dvec3(mesh_.positions[vertex]) + up * (coat_.length * static_cast<double>(mesh_.bounds.radius) * height);
}

std::array<glm::dvec3, 3> FurShells::corners(std::uint32_t triangle, double height) const {
    std::array<glm::dvec3, 3> points;
    for (std::size_t c = 0; c < 3; ++c)
        points[c] = extruded(mesh_.indices[3 * std::size_t{triangle} + c], height);
    return points;
}

FurFragment FurShells::meet(int layer, std::uint32_t triangle, double height, const glm::dvec3& direction, glm::dvec3& weights) const {
    const auto [a, b, c] = corners(triangle, height);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double distance = glm::dot(a - view_.eye, normal) / glm::dot(direction, normal);
    const glm::dvec3 within = view_.eye + distance * direction - a;
    const double square = glm::dot(normal, normal);
    weights.y = glm::dot(glm::cross(within, c - a), normal) / square;
    weights.z = glm::dot(glm::cross(b - a, within), normal) / square;
    weights.x = 1 - weights.y - weights.z;
    const SurfacePoint skin = interpolate(mesh_, {triangle, weights});
    return {.layer = layer,
            .triangle = triangle,
            .height = height,
            .depth = distance * glm::dot(direction, view_.forward),
            .rest = skin.position - glm::dvec3(mesh_.bounds.centre),
            .normal = skin.normal,
            .position = weights.x * a + weights.y * b + weights.z * c};
}

void FurShells::draw(int layer, double height) {
    for (std::uint32_t triangle = 0; triangle < mesh_.indices.size() / 3; ++triangle)
        draw(layer, triangle, height);
}

void FurShells::draw(int layer, std::uint32_t triangle, double height) {
    const auto [a, b, c] = corners(triangle, height);
    if (glm::dot(glm::cross(b - a, c - a), a - view_.eye) >= 0) return; // turned away
    const glm::dvec2 size(view_.width, view_.height);
    const glm::dvec2 pa = view_.project(a) * size - 0.5;
    const glm::dvec2 pb = view_.project(b) * size - 0.5;
    const glm::dvec2 pc = view_.project(c) * size - 0.5;
    const glm::dvec2 low = glm::ceil(glm::max(glm::min(pa, glm::min(pb, pc)), glm::dvec2(0)));
    const glm::dvec2 high = glm::floor(glm::min(glm::max(pa, glm::max(pb, pc)), size - 1.0));
    for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y)
        for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
            glm::dvec3 weights;
            const FurFragment fragment = meet(layer, triangle, height, view_.ray(x, y), weights);
            if (std::min({weights.x, weights.y, weights.z}) >= 0) pixels_[index(x, y)].push_back(fragment);
        }
}

FurFragment FurShells::onItsPlane(const FurFragment& fragment, int x, int y) const {
    glm::dvec3 weights;
    return meet(fragment.layer, fragment.triangle, fragment.height, view_.ray(x, y), weights);
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

OnCube onCubeMap(const glm::dvec3& direction) {
    struct Face {
        glm::dvec3 ahead, right, down;
    };
    static const std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                                {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                                {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                                {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                                {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                                {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};
    const auto nearest = std::ranges::max_element(kFaces, {}, [&](const Face& face) { return glm::dot(face.ahead, direction); });
    const glm::dvec3 onFace = direction / glm::dot(nearest->ahead, direction);
    return {static_cast<int>(nearest - kFaces.begin()),
            {(1 + glm::dot(nearest->right, onFace)) / 2, (1 + glm::dot(nearest->down, onFace)) / 2}};
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

glm::dvec3 furRadiance(const FurCoat& coat, const FurFragment& fragment, const FurLight& light, const glm::dvec3& eye, bool lit) {
    const glm::dvec3 normal = unit(fragment.normal);
    const glm::dvec3 toLight = unit(light.position - fragment.position);
    const glm::dvec3 toEye = unit(eye - fragment.position);
    const glm::dvec3 strand = unit(normal + 2 * coat.lean * fragment.height * kDown);
    const double cosine = std::clamp(glm::dot(normal, toLight), -1.0, 1.0);
    const glm::dvec3 albedo = coat.root + fragment.height * (coat.tip - coat.root);
    const glm::dvec3 dull = albedo * std::max(cosine, 0.0);
    const glm::dvec3 hair =
        albedo * (1 - coat.specular) * diffuse(coat, strand, toLight) + coat.specular * mirrored(coat, strand, toLight, toEye);
    const double strands = fragment.layer > 0 ? coat.kajiyaKay : 0;
    const double open = 1 + coat.kajiyaKay * (furOpen(coat, fragment.height, cosine) - 1);
    const glm::dvec3 direct = (dull + strands * (hair - dull)) * light.colour * open * (lit ? 1.0 : 0.0);
    const double sky = std::exp(-coat.density * (1 - fragment.height)) * (1 + coat.multiple) / 2;
    return direct + albedo * coat.fill * sky;
}

std::vector<FurShare> blendFur(const FurCoat& coat, const std::vector<FurFragment>& fragments,
                               const std::function<double(const FurFragment&)>& alpha) {
    std::vector<FurShare> shares;
    double nearest = std::numeric_limits<double>::infinity();
    const double least = std::max(coat.alphaTest, coat.outerFirst ? 0.5 : 0.0);
    for (const FurFragment& fragment : fragments) {
        if (fragment.depth > nearest) continue;
        double covered = 1;
        if (fragment.layer > 0) {
            covered = furCovered(coat, alpha(fragment), fragment.height);
            if (covered < least) continue;
            // n layers let through what 32 layers would.
            covered = coat.outerFirst ? 1 : 1 - std::exp(32.0 / coat.layers * std::log1p(-std::min(covered, 1.0)));
        }
        for (FurShare& share : shares)
            share.weight *= 1 - covered;
        shares.push_back({&fragment, covered});
        nearest = fragment.depth;
    }
    return shares;
}

} // namespace tegument::reference
