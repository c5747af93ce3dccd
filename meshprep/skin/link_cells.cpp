#include "meshprep/skin/link_cells.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

constexpr int kSamples = kLinkSamples;
constexpr float kSkin = 0.5F; // alpha from which the effects take a texel for skin

struct Sample {
    glm::vec3 place{0};
    float area = 0;
    std::uint32_t corner = kNoSkin;
};

std::size_t index(int x, int y, int side) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Samples whose centres the triangle covers.
void draw(const Mesh& mesh, std::size_t corner, std::vector<Sample>& samples) {
    std::array<glm::dvec3, 3> place;
    std::array<glm::dvec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
        place[i] = glm::dvec3(mesh.positions[mesh.indices[corner + i]]);
        uv[i] = glm::dvec2(mesh.uvs[mesh.indices[corner + i]]) * static_cast<double>(kSamples) - 0.5;
    }
    const double twice = cross(uv[1] - uv[0], uv[2] - uv[0]);
    const double area = glm::length(glm::cross(place[1] - place[0], place[2] - place[0])) / std::abs(twice);
    if (!std::isfinite(area)) return;
    const glm::dvec2 low = glm::clamp(glm::ceil(glm::min(uv[0], glm::min(uv[1], uv[2]))), 0.0, kSamples - 1.0);
    const glm::dvec2 high = glm::clamp(glm::floor(glm::max(uv[0], glm::max(uv[1], uv[2]))), 0.0, kSamples - 1.0);
    for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y)
        for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
            const glm::dvec2 p(x, y);
            const double b = cross(p - uv[0], uv[2] - uv[0]) / twice;
            const double c = cross(uv[1] - uv[0], p - uv[0]) / twice;
            Sample& sample = samples[index(x, y, kSamples)];
            if (b < 0 || c < 0 || b + c > 1 || sample.area > 0) continue;
            sample = {.place = glm::vec3((1 - b - c) * place[0] + b * place[1] + c * place[2]),
                      .area = static_cast<float>(area),
                      .corner = static_cast<std::uint32_t>(corner)};
        }
}

/// One cell of four parts of it, which know their place, area and radius.
LinkCell joined(const std::array<LinkCell, 4>& parts) {
    LinkCell cell;
    glm::vec3 sum(0);
    glm::vec2 uv(0);
    for (const LinkCell& part : parts) {
        cell.area += part.area;
        cell.covered += part.covered / 4;
        sum += part.area * part.place;
        uv += part.area * part.uv;
    }
    if (!(cell.area > 0)) return {};
    cell.place = sum / cell.area;
    cell.uv = uv / cell.area;
    for (const LinkCell& part : parts)
        if (part.area > 0) cell.radius = std::max(cell.radius, glm::length(part.place - cell.place) + part.radius);
    return cell;
}

/// `part(x, y)` of twice as many along each side.
template <class Part>
std::vector<LinkCell> joinedCells(int side, const Part& part) {
    std::vector<LinkCell> cells(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            cells[index(x, y, side)] =
                joined({part(2 * x, 2 * y), part(2 * x + 1, 2 * y), part(2 * x, 2 * y + 1), part(2 * x + 1, 2 * y + 1)});
    return cells;
}

/// Half of the diagonal of a square of this area.
float halfDiagonal(float area) {
    return std::sqrt(area / 2);
}

float medianSide(std::vector<float> areas) {
    if (areas.empty()) return 0;
    const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
    std::nth_element(areas.begin(), middle, areas.end());
    return std::sqrt(*middle);
}

} // namespace

std::vector<std::uint8_t> skinMask(const Mesh& mesh) {
    const auto color = std::ranges::find(mesh.textures, "color", &EmbeddedTexture::role);
    if (color == mesh.textures.end() || color->image.channels < 4) return {};
    const Image& image = color->image;
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(kSamples) * kSamples);
    for (int y = 0; y < kSamples; ++y)
        for (int x = 0; x < kSamples; ++x) {
            const int u = (2 * x + 1) * image.width / (2 * kSamples);
            const int v = (2 * y + 1) * image.height / (2 * kSamples);
            mask[index(x, y, kSamples)] = image.at(u, v, 3) >= kSkin ? 1 : 0;
        }
    return mask;
}

LinkCells::LinkCells(const Mesh& mesh, const std::vector<std::uint8_t>& skin) {
    std::vector<Sample> samples(static_cast<std::size_t>(kSamples) * kSamples);
    for (std::size_t corner = 0; !mesh.uvs.empty() && corner + 2 < mesh.indices.size(); corner += 3)
        draw(mesh, corner, samples);
    for (std::size_t i = 0; i < skin.size(); ++i)
        if (skin[i] == 0) samples[i] = {};
    corners_.reserve(samples.size());
    for (const Sample& sample : samples)
        corners_.push_back(sample.corner);
    static_assert(kSamplesAlongCell == 2);
    levels_[0] = joinedCells(side(0), [&](int x, int y) {
        const Sample& sample = samples[index(x, y, kSamples)];
        return LinkCell{.place = sample.place,
                        .uv = {x, y},
                        .area = sample.area,
                        .radius = halfDiagonal(sample.area),
                        .covered = sample.area > 0 ? 1.0F : 0.0F};
    });
    for (int level = 1; level < kLinkLevels; ++level)
        levels_[static_cast<std::size_t>(level)] = joinedCells(side(level), [&](int x, int y) { return at(level - 1, x, y); });
    std::vector<float> areas;
    for (int y = 0; y < side(0); ++y)
        for (int x = 0; x < side(0); ++x) {
            bool whole = true;
            for (int i = 0; i < 4; ++i)
                whole = whole && samples[index(2 * x + i % 2, 2 * y + i / 2, kSamples)].area > 0;
            if (whole) areas.push_back(at(0, x, y).area);
        }
    const float finest = medianSide(std::move(areas));
    for (int level = 0; level < kLinkLevels; ++level)
        usual_[static_cast<std::size_t>(level)] = finest * static_cast<float>(1 << level);
}

namespace {

/// The plane of a triangle over its texture coordinates, counted in samples.
struct Plane {
    glm::dvec2 uv{0};
    glm::dvec3 place{0};
    glm::dvec3 alongU{0};
    glm::dvec3 alongV{0};
};

Plane planeOf(const Mesh& mesh, std::uint32_t corner) {
    std::array<glm::dvec3, 3> place;
    std::array<glm::dvec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
        place[i] = glm::dvec3(mesh.positions[mesh.indices[corner + i]]);
        uv[i] = glm::dvec2(mesh.uvs[mesh.indices[corner + i]]) * static_cast<double>(kSamples) - 0.5;
    }
    const glm::dvec2 a = uv[1] - uv[0];
    const glm::dvec2 b = uv[2] - uv[0];
    const double twice = cross(a, b);
    return {.uv = uv[0],
            .place = place[0],
            .alongU = ((place[1] - place[0]) * b.y - (place[2] - place[0]) * a.y) / twice,
            .alongV = ((place[2] - place[0]) * a.x - (place[1] - place[0]) * b.x) / twice};
}

} // namespace

std::optional<LinkCells::Middle> LinkCells::middle(const Mesh& mesh, int level, int x, int y, int beside) const {
    const int samples = kSamplesAlongCell << level; // along the cell
    const glm::dvec2 centre((x + 0.5) * samples - 0.5, (y + 0.5) * samples - 0.5);
    const double farthest = (beside + 0.5) * samples;
    double best = farthest * farthest;
    std::uint32_t corner = kNoSkin;
    const auto look = [&](double reach) {
        const auto within = [](double at) { return static_cast<int>(std::clamp(at, 0.0, kSamples - 1.0)); };
        for (int v = within(centre.y - reach); v <= within(centre.y + reach); ++v)
            for (int u = within(centre.x - reach); u <= within(centre.x + reach); ++u) {
                const std::uint32_t here = corners_[index(u, v, kSamples)];
                const glm::dvec2 offset = glm::dvec2(u, v) - centre;
                if (here == kNoSkin || glm::dot(offset, offset) >= best) continue;
                best = glm::dot(offset, offset);
                corner = here;
            }
    };
    look(1); // most cells have skin in their middle
    if (corner == kNoSkin) look(farthest);
    if (corner == kNoSkin) return std::nullopt;
    const Plane plane = planeOf(mesh, corner);
    const glm::dvec2 way = centre - plane.uv;
    return Middle{.place = glm::vec3(plane.place + way.x * plane.alongU + way.y * plane.alongV),
                  .side = static_cast<float>(samples * std::sqrt(glm::length(glm::cross(plane.alongU, plane.alongV)))),
                  .uv = centre,
                  .alongU = plane.alongU,
                  .alongV = plane.alongV};
}

} // namespace tegument
