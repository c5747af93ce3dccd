#include "meshprep/prepare/mapping.h"

#include "host/mesh/normals.h"
#include "host/support/parallel.h"
#include "meshprep/base/noise.h"
#include "meshprep/fur/roots/point_grid.h"
#include "meshprep/fur/roots/roots.h"
#include "meshprep/fur/roots/scatter.h"
#include "meshprep/prepare/edges.h"
#include "meshprep/prepare/near_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace tegument::prep {

namespace {

/// A triangle on the texture.
struct Flat {
    std::array<glm::dvec2, 3> uv{};
    int chart = 0;
};
using Mapping = std::function<Flat(std::size_t triangle)>;
using Directions = std::vector<glm::dvec3>; // by vertex

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0, 0, 1);
}

int cubeFace(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x > 0 ? 0 : 1;
    if (a.y >= a.z) return d.y > 0 ? 2 : 3;
    return d.z > 0 ? 4 : 5;
}

/// Onto the plane of one face of the cube, turned so that none mirrors. Directions beside the face's half space are held at its horizon.
glm::dvec2 onCubeFace(const glm::dvec3& d, int face) {
    const glm::length_t axis = face / 2;
    const double sign = face % 2 == 0 ? 1 : -1;
    const double along = std::max(d[axis] * sign, 1e-3);
    const glm::dvec2 across = {d[(axis + 1) % 3], d[(axis + 2) % 3]};
    return 0.5 + 0.5 * (sign > 0 ? across : glm::dvec2(across.y, across.x)) / along;
}

/// The sphere map of environment mapping: one chart, whose rim is the direction -z.
glm::dvec2 onSphereMap(const glm::dvec3& d) {
    return 0.5 + glm::dvec2(d) / std::max(2 * std::sqrt(d.x * d.x + d.y * d.y + (d.z + 1) * (d.z + 1)), 1e-9);
}

/// J. H. Lambert's azimuthal projection of a hemisphere, which keeps areas; beyond it as far as it goes.
glm::dvec2 onDisc(const glm::dvec3& d, int chart) {
    const double height = std::max(chart == 0 ? d.z : -d.z, -0.99);
    const glm::dvec2 across = chart == 0 ? glm::dvec2(d.x, d.y) : glm::dvec2(d.y, d.x);
    return 0.5 + 0.25 * across * std::sqrt(2 / (1 + height));
}

enum class Projection { SphereMap, CubeMap, EqualArea };

Mapping byDirection(const Mesh& mesh, const Directions& directions, Projection projection) {
    return [&mesh, &directions, projection](std::size_t triangle) {
        const std::uint32_t* t = &mesh.indices[3 * triangle];
        const glm::dvec3 middle = directions[t[0]] + directions[t[1]] + directions[t[2]];
        Flat flat;
        if (projection == Projection::CubeMap) flat.chart = cubeFace(middle);
        if (projection == Projection::EqualArea) flat.chart = middle.z >= 0 ? 0 : 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& d = directions[t[i]];
            switch (projection) {
            case Projection::SphereMap: flat.uv[i] = onSphereMap(d); break;
            case Projection::CubeMap: flat.uv[i] = onCubeFace(d, flat.chart); break;
            case Projection::EqualArea: flat.uv[i] = onDisc(d, flat.chart); break;
            }
        }
        return flat;
    };
}

Mapping byCoordinates(const Mesh& mesh) {
    return [&mesh](std::size_t triangle) {
        Flat flat;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2 uv(mesh.uvs[mesh.indices[3 * triangle + i]]);
            flat.uv[i] = {uv.x, -uv.y}; // v up, so that unmirrored charts turn as the triangles do
        }
        return flat;
    };
}

/// The linear map of a triangle onto the texture: its determinant and its two stretches.
struct Stretch {
    double determinant = 0; // texels per area, with sign
    double most = 0;
    double least = 0;
};

Stretch stretchOf(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec2, 3>& uv) {
    const glm::dvec3 e1 = p[1] - p[0];
    const glm::dvec3 e2 = p[2] - p[0];
    const double length = glm::length(e1);
    if (!(length > 0)) return {};
    const double x2 = glm::dot(e2, e1) / length;
    const double y2 = glm::length(glm::cross(e1, e2)) / length;
    if (!(y2 > 0)) return {};
    const glm::dvec2 alongX = (uv[1] - uv[0]) * static_cast<double>(kMappingTexels) / length;
    const glm::dvec2 alongY = ((uv[2] - uv[0]) * static_cast<double>(kMappingTexels) - alongX * x2) / y2;
    Stretch s;
    s.determinant = alongX.x * alongY.y - alongX.y * alongY.x;
    const double squares = glm::dot(alongX, alongX) + glm::dot(alongY, alongY);
    const double root = std::sqrt(std::max(0.0, squares * squares - 4 * s.determinant * s.determinant));
    s.most = std::sqrt((squares + root) / 2);
    s.least = s.most > 0 ? std::abs(s.determinant) / s.most : 0;
    return s;
}

/// The value below which `share` of the weight lies.
double percentile(const std::vector<double>& values, const std::vector<double>& weights, double share) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    const double wanted = share * std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0;
    for (const std::size_t i : order)
        if ((sum += weights[i]) >= wanted) return values[i];
    return order.empty() ? 0 : values[order.back()];
}

class Examiner {
public:
    explicit Examiner(const Surface& surface) : surface_(surface) {
        // unit size, so that areas are neither 0 nor infinite; all figures are ratios
        const glm::dvec3 size = glm::dvec3(surface.mesh.bounds.maximum) - glm::dvec3(surface.mesh.bounds.minimum);
        const double scale = std::max({size.x, size.y, size.z});
        for (std::size_t i = 0; i < surface.triangles(); ++i) {
            corners_.push_back(cornersOf(surface.mesh, i));
            for (glm::dvec3& p : corners_.back())
                p = scale > 0 ? p / scale : p;
            const auto& p = corners_.back();
            area_.push_back(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2);
            total_ += area_.back();
        }
        patches_ = divideIntoPatches(corners_, area_);
        findEdges();
    }

    MappingFigures examine(std::string name, const Mapping& mapping, bool coordinates) const {
        MappingFigures figures{.name = std::move(name)};
        std::vector<Flat> flat;
        std::vector<double> density;
        std::vector<double> anisotropy;
        double positive = 0;
        double negative = 0;
        for (std::size_t i = 0; i < area_.size(); ++i) {
            flat.push_back(mapping(i));
            const Stretch s = stretchOf(corners_[i], flat.back().uv);
            density.push_back(std::abs(s.determinant));
            anisotropy.push_back(s.least > 0 ? std::min(s.most / s.least, kMostAnisotropy) : kMostAnisotropy);
            (s.determinant < 0 ? negative : positive) += area_[i];
            if (inOneTexel(flat.back())) figures.oneTexel += area_[i] / total_;
        }
        figures.mirrored = std::min(positive, negative) / total_;
        describeDensity(figures, density);
        figures.anisotropy50 = percentile(anisotropy, area_, 0.5);
        figures.anisotropy95 = percentile(anisotropy, area_, 0.95);
        describeSeams(figures, flat, coordinates);
        return figures;
    }

private:
    static constexpr double kMostAnisotropy = 1e9; // a triangle that the texture shows as a line
    static constexpr double kMostDensity = 1e3;    // times the mean: single triangles at a pole would decide alone

    struct SharedEdge {
        std::uint32_t a = 0; // corners at which its two sides start
        std::uint32_t b = 0;
    };

    void findEdges() {
        EdgeTable(surface_).forEach([&](std::span<const HalfEdge> sides) {
            for (std::size_t i = 1; i < sides.size(); ++i)
                if (sides[0].forwards != sides[i].forwards) edges_.push_back({.a = sides[0].corner, .b = sides[i].corner});
        });
    }

    static bool inOneTexel(const Flat& flat) {
        const auto texel = [](const glm::dvec2& uv) { return glm::floor(uv * static_cast<double>(kMappingTexels)); };
        return texel(flat.uv[0]) == texel(flat.uv[1]) && texel(flat.uv[1]) == texel(flat.uv[2]);
    }

    void describeDensity(MappingFigures& figures, std::vector<double>& density) const {
        double mean = 0;
        for (std::size_t i = 0; i < density.size(); ++i)
            mean += density[i] * area_[i] / total_;
        if (!(mean > 0)) return;
        std::vector<double> patches(kPatches, 0);
        for (std::size_t i = 0; i < density.size(); ++i) {
            if (patches_.area[patches_.ofTriangle[i]] > 0)
                patches[patches_.ofTriangle[i]] += density[i] * area_[i] / patches_.area[patches_.ofTriangle[i]];
            density[i] = std::min(density[i] / mean, kMostDensity);
            if (density[i] < 0.05) figures.starved += area_[i] / total_;
        }
        figures.cvPatch = variation(patches, patches_.area);
        double squares = 0; // about the mean before single densities were held down
        for (std::size_t i = 0; i < density.size(); ++i)
            squares += area_[i] / total_ * (density[i] - 1) * (density[i] - 1);
        figures.cvFace = std::sqrt(squares);
        figures.density1 = percentile(density, area_, 0.01);
        figures.density50 = percentile(density, area_, 0.5);
        figures.density99 = percentile(density, area_, 0.99);
    }

    void describeSeams(MappingFigures& figures, const std::vector<Flat>& flat, bool coordinates) const {
        double length = 0;
        double jump = 0;
        for (const SharedEdge& edge : edges_) {
            const auto uv = [&](std::uint32_t corner) { return flat[corner / 3].uv[corner % 3]; };
            const double apart =
                (glm::distance(uv(edge.a), uv(nextCorner(edge.b))) + glm::distance(uv(nextCorner(edge.a)), uv(edge.b))) / 2;
            const bool seam = coordinates ? apart > 0 : flat[edge.a / 3].chart != flat[edge.b / 3].chart;
            if (!seam) continue;
            const double own = glm::distance(corners_[edge.a / 3][edge.a % 3], corners_[edge.a / 3][nextCorner(edge.a) % 3]);
            length += own;
            jump += own * apart * kMappingTexels;
        }
        figures.seamLength = total_ > 0 ? length / std::sqrt(total_) : 0;
        if (coordinates) figures.seamJumpTexels = length > 0 ? jump / length : 0;
    }

    const Surface& surface_;
    std::vector<std::array<glm::dvec3, 3>> corners_;
    std::vector<double> area_;
    Patches patches_;
    std::vector<SharedEdge> edges_;
    double total_ = 0;
};

/// A strand where the surface is nearest to it.
struct Strand {
    glm::dvec3 place{0}; // unit space
    std::uint32_t triangle = 0;
};

class RootExaminer {
public:
    explicit RootExaminer(const Surface& mesh) : mesh_(mesh), surface_(mesh.mesh) {
        std::vector<double> area;
        for (std::size_t i = 0; i < mesh.triangles(); ++i) {
            const std::uint32_t* t = &mesh.mesh.indices[3 * i];
            const auto& p = surface_.positions();
            corners_.push_back({glm::dvec3(p[t[0]]), glm::dvec3(p[t[1]]), glm::dvec3(p[t[2]])});
            const auto& c = corners_.back();
            area.push_back(glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / 2);
        }
        patches_ = divideIntoPatches(corners_, area);
    }

    [[nodiscard]] double area() const { return surface_.area(); }

    /// Poisson discs on the surface.
    [[nodiscard]] std::vector<Strand> roots(std::size_t count) const {
        const RootOptions defaults;
        const double spacing = std::sqrt(area() / static_cast<double>(count));
        std::vector<Strand> strands;
        const ScatterOptions options{.wanted = count, .distance = static_cast<float>(defaults.spacing * spacing), .density = {}};
        strands.reserve(count);
        for (const SurfacePoint& root : scatterRoots(surface_, options).points)
            strands.push_back({.place = glm::dvec3(root.position), .triangle = root.triangle});
        return strands;
    }

    /// One ball of radius h / 2 at a random place in each cell of side h: a surface cuts 2 (h / 2) / h^3 of them per area, whichever way it
    /// lies. Each counts once, where the surface is nearest to its centre.
    [[nodiscard]] std::vector<Strand> balls(std::size_t count) const {
        const double h = std::sqrt(area() / static_cast<double>(count));
        std::unordered_map<std::uint64_t, std::pair<double, Strand>> cut;
        for (std::uint32_t i = 0; i < corners_.size(); ++i)
            forBallsAround(corners_[i], h, [&](std::uint64_t cell, const glm::dvec3& centre) {
                const glm::dvec3 place = nearestOnTriangle(centre, corners_[i][0], corners_[i][1], corners_[i][2]);
                const double distance = glm::distance(place, centre);
                if (distance > h / 2) return;
                auto& [least, strand] = cut.try_emplace(cell, std::numeric_limits<double>::infinity(), Strand{}).first->second;
                if (distance >= least) return;
                least = distance;
                strand = {.place = place, .triangle = i};
            });
        std::vector<Strand> strands;
        for (const auto& [cell, found] : cut)
            strands.push_back(found.second);
        return strands;
    }

    [[nodiscard]] RootMapping examine(std::string name, const std::vector<Strand>& strands) const {
        RootMapping mapping{.name = std::move(name), .count = strands.size()};
        std::vector<double> density(kPatches, 0);
        for (const Strand& strand : strands)
            density[patches_.ofTriangle[strand.triangle]] += 1;
        for (std::size_t i = 0; i < density.size(); ++i)
            if (patches_.area[i] > 0) density[i] /= patches_.area[i];
        mapping.cvPatch = variation(density, patches_.area);
        const auto patches = std::ranges::count_if(patches_.area, [](double area) { return area > 0; });
        mapping.poissonCv = std::sqrt(static_cast<double>(patches) / std::max(1.0, static_cast<double>(strands.size())));
        findGaps(mapping, strands);
        findSeams(mapping);
        return mapping;
    }

private:
    template <class Visit>
    static void forBallsAround(const std::array<glm::dvec3, 3>& t, double h, Visit&& visit) {
        const glm::ivec3 low(glm::floor((glm::min(glm::min(t[0], t[1]), t[2]) - h / 2) / h));
        const glm::ivec3 high(glm::floor((glm::max(glm::max(t[0], t[1]), t[2]) + h / 2) / h));
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    constexpr std::uint64_t kSide = 1 << 21;
                    const auto word = [](int i) { return static_cast<std::uint64_t>(std::int64_t{i} + (1 << 20)); };
                    visit((word(z) * kSide + word(y)) * kSide + word(x), (glm::dvec3(x, y, z) + glm::dvec3(unitRandom({x, y, z}, 1))) * h);
                }
    }

    void findGaps(RootMapping& mapping, const std::vector<Strand>& strands) const {
        const double spacing = std::sqrt(area() / std::max(1.0, static_cast<double>(strands.size())));
        const double starving = std::sqrt(1 / (0.05 * std::numbers::pi)) * spacing;
        PointGrid grid(static_cast<float>(2 * spacing), strands.size());
        for (const Strand& strand : strands)
            grid.add(glm::vec3(strand.place), glm::vec3(0), 0);
        constexpr std::size_t kSamples = 100'000;
        std::vector<double> gap(kSamples, std::numeric_limits<double>::infinity());
        inChunks(kSamples, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i)
                for (double reach = spacing; reach < 4 && !std::isfinite(gap[i]); reach *= 2) {
                    float least = std::numeric_limits<float>::infinity();
                    grid.visit(surface_.point(rootNoise(i, 0x51ed270bU)).position, static_cast<float>(reach),
                               [&](std::uint32_t, float squared) {
                                   least = std::min(least, squared);
                                   return true;
                               });
                    gap[i] = std::sqrt(static_cast<double>(least));
                }
        });
        mapping.starved =
            static_cast<double>(std::ranges::count_if(gap, [&](double d) { return d > starving; })) / static_cast<double>(kSamples);
        mapping.largestGap = *std::ranges::max_element(gap) / spacing;
    }

    /// The look-up vector is the rest position: it jumps only where places were joined that lie apart.
    void findSeams(RootMapping& mapping) const {
        EdgeTable(mesh_).forEach([&](std::span<const HalfEdge> sides) {
            for (std::size_t i = 1; i < sides.size(); ++i) {
                const auto at = [&](std::uint32_t corner) { return corners_[corner / 3][corner % 3]; };
                const bool opposite = sides[0].forwards != sides[i].forwards;
                const std::uint32_t other = opposite ? nextCorner(sides[i].corner) : sides[i].corner;
                if (at(sides[0].corner) != at(other))
                    mapping.seamLength += glm::distance(at(sides[0].corner), at(nextCorner(sides[0].corner)));
            }
        });
        mapping.seamLength /= std::sqrt(area());
    }

    const Surface& mesh_;
    FurSurface surface_;
    std::vector<std::array<glm::dvec3, 3>> corners_;
    Patches patches_;
};

} // namespace

std::vector<MappingFigures> examineMapping(const Surface& surface) {
    const Mesh& mesh = surface.mesh;
    if (mesh.indices.empty()) return {};
    const Examiner examiner(surface);
    std::vector<MappingFigures> list;
    if (!mesh.uvs.empty()) list.push_back(examiner.examine("texture coordinates", byCoordinates(mesh), true));
    std::array<std::pair<const char*, Directions>, 3> ways = {{{"position", {}}, {"normal", {}}, {"position + normal", {}}}};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 position = unit(glm::dvec3(mesh.positions[i]));
        const glm::dvec3 normal(mesh.normals[i]);
        ways[0].second.push_back(position);
        ways[1].second.push_back(normal);
        ways[2].second.push_back(unit(position + normal));
    }
    constexpr std::array<std::pair<const char*, Projection>, 3> kProjections = {
        {{"sphere map", Projection::SphereMap}, {"cube map", Projection::CubeMap}, {"equal area", Projection::EqualArea}}};
    for (const auto& way : ways)
        for (const auto& projection : kProjections)
            list.push_back(examiner.examine(fmt::format("{}, {}", way.first, projection.first),
                                            byDirection(mesh, way.second, projection.second), false));
    return list;
}

std::vector<RootMapping> examineRoots(const Surface& surface, std::size_t count) {
    if (surface.mesh.indices.empty()) return {};
    const RootExaminer examiner(surface);
    if (!(examiner.area() > 0)) return {};
    return {examiner.examine("T3, roots on the surface", examiner.roots(count)),
            examiner.examine("T2, balls in space", examiner.balls(count))};
}

} // namespace tegument::prep
