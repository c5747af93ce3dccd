#include "lab/reference/fur_strands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace tegument::reference {

namespace {

constexpr double kRho = 0.5;       // how far from the skin a point still grows a strand
constexpr double kSag = 1;         // roots of one sheet are that near its tangent plane
constexpr double kShortest = 0.01; // no strand is shorter, share of the coat
constexpr std::int64_t kPrime = 1019;

using Whole = glm::tvec3<std::int64_t>;

/// The remainders, none negative.
Whole modulo(const Whole& v) {
    return (v % kPrime + kPrime) % kPrime;
}

/// One round of the random numbers of docs/design/modules/FurRoots.md: a linear mixture, then products.
Whole mixed(const Whole& v) {
    const Whole m = modulo(Whole(431 * v.x + 577 * v.y + 101, 797 * v.y + 281 * v.z + 389, 163 * v.z + 907 * v.x + 733));
    return modulo(Whole(m.y * m.z, m.z * m.x, m.x * m.y) + m * std::int64_t{613});
}

/// In (0, 1).
glm::dvec3 share(const Whole& residues) {
    return (glm::dvec3(residues) + 0.5) / static_cast<double>(kPrime);
}

/// Full within three quarters of rho, none at rho.
double nearness(double distance) {
    return std::clamp(4 * (1 - distance / kRho), 0.0, 1.0);
}

/// Roots by cubes of side 1.
class Roots {
public:
    explicit Roots(std::vector<FurRoot> roots) : roots_(std::move(roots)) {
        for (std::uint32_t i = 0; i < roots_.size(); ++i)
            cubes_[key(Whole(glm::floor(roots_[i].strand.root)))].push_back(i);
    }

    void near(const FurPlace& place, std::vector<FurStand>& strands) const {
        std::vector<std::uint32_t> found;
        const double reach = std::hypot(place.reach, kSag);
        const Whole low(glm::floor(place.middle - reach));
        const Whole high(glm::floor(place.middle + reach));
        for (std::int64_t z = low.z; z <= high.z; ++z)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                for (std::int64_t x = low.x; x <= high.x; ++x)
                    if (const auto cube = cubes_.find(key({x, y, z})); cube != cubes_.end())
                        found.insert(found.end(), cube->second.begin(), cube->second.end());
        std::ranges::sort(found);
        strands.clear();
        for (const std::uint32_t i : found) {
            FurStand strand = roots_[i].strand;
            strand.length = std::max(std::min(strand.length * glm::dot(roots_[i].normal, place.normal), roots_[i].limit), kShortest);
            strand.stray = glm::dot(roots_[i].straying, place.normal);
            strands.push_back(strand);
        }
    }

private:
    static std::int64_t key(const Whole& cube) { return cube.x + (cube.y + (cube.z << 20)) * (1 << 20); }

    std::vector<FurRoot> roots_;
    std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cubes_;
};

} // namespace

LatticePoint latticePoint(const glm::i64vec3& cube) {
    const Whole random = mixed(mixed(Whole(cube)));
    return {.place = glm::dvec3(cube) + share(random), .random = share(mixed(random))};
}

FurStrandsAt latticeStrands(double radius, double shortest) {
    return [radius, shortest](const FurPlace& place, std::vector<FurStand>& strands) {
        strands.clear();
        const glm::dvec3 reach(std::hypot(place.reach, kRho));
        const Whole low(glm::floor(place.middle - reach));
        const Whole high(glm::floor(place.middle + reach));
        const double beyond = kRho + std::sqrt(0.75); // of a cube's centre, whose point is within half its diagonal
        for (std::int64_t z = low.z; z <= high.z; ++z)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                for (std::int64_t x = low.x; x <= high.x; ++x) {
                    const Whole cube(x, y, z);
                    if (std::abs(glm::dot(glm::dvec3(cube) + 0.5 - place.begin, place.normal)) > beyond) continue;
                    const auto [point, random] = latticePoint(cube);
                    const double distance = std::abs(glm::dot(place.begin - point, place.normal));
                    if (distance >= kRho) continue;
                    FurStand strand{.root = point, .length = 0, .radius = radius, .stray = 1, .random = random};
                    strand.length = std::max((shortest + (1 - shortest) * strand.random.y) * nearness(distance), kShortest);
                    strands.push_back(strand);
                }
    };
}

FurStrandsAt rootedStrands(std::vector<FurRoot> roots) {
    return [all = std::make_shared<const Roots>(std::move(roots))](const FurPlace& place, std::vector<FurStand>& strands) {
        all->near(place, strands);
    };
}

} // namespace tegument::reference
