#include "meshprep/prepare/root_mapping.h"

#include "host/mesh/normals.h"
#include "host/support/parallel.h"
#include "meshprep/base/noise.h"
#include "meshprep/fur/roots/point_grid.h"
#include "meshprep/fur/roots/roots.h"
#include "meshprep/fur/roots/scatter.h"
#include "meshprep/prepare/edges.h"
#include "meshprep/prepare/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace tegument::prep {

namespace {

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

std::vector<RootMapping> examineRoots(const Surface& surface, std::size_t count) {
    if (surface.mesh.indices.empty()) return {};
    const RootExaminer examiner(surface);
    if (!(examiner.area() > 0)) return {};
    return {examiner.examine("T3, roots on the surface", examiner.roots(count)),
            examiner.examine("T2, balls in space", examiner.balls(count))};
}

} // namespace tegument::prep
