#include "meshprep/fur/strands.h"

#include "meshprep/base/noise.h"
#include "meshprep/fur/root_grid.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace tegument {

namespace {

constexpr double kMostStrands = 16e6;
// Random placement alone stops finding room near 0.547 of the area covered by discs of half the spacing (M. Tanemura, 1979). Up to nine
// tenths of that, a few dozen tries a strand are enough.
constexpr std::size_t kTriesPerStrand = 64;

constexpr float kWord = 1.0F / 4294967296.0F;

glm::dvec3 uniform(std::size_t candidate, std::uint32_t seed) {
    const glm::ivec3 lattice(static_cast<int>(candidate & 0x7fffffffU), static_cast<int>(candidate >> 31U), 0);
    return glm::dvec3(hashLattice(lattice, seed)) * static_cast<double>(kWord);
}

Result<void> checkOptions(const FurOptions& options, double texels) {
    const auto wrong = [](const char* what, double value, const char* range) {
        return usageError(7101, fmt::format("the fur's {} is {}", what, value), fmt::format("use a value {}", range));
    };
    if (!(options.density > 0 && options.density <= 1)) return wrong("density", options.density, "above 0, at most 1 strand per texel");
    if (!(options.spacing >= 0 && options.spacing <= 1024)) return wrong("spacing", options.spacing, "between 0 and 1024 texels");
    if (!(options.radius >= 0.5 && options.radius <= 256)) return wrong("radius", options.radius, "between 0.5 and 256 texels");
    if (!(options.shortest > 0 && options.shortest <= 1)) return wrong("shortest length", options.shortest, "above 0, at most 1");
    if (options.density * texels > kMostStrands)
        return usageError(7102, fmt::format("{:.0f} strands are more than {:.0f}", options.density * texels, kMostStrands),
                          "take a smaller map or a lower density");
    return {};
}

template <class Space>
StrandSet throwDarts(const Space& space, double spacing, std::size_t wanted, const FurOptions& options) {
    StrandSet set{.wanted = wanted};
    set.strands.reserve(wanted);
    RootGrid<Space> grid(space, spacing, wanted);
    for (std::size_t candidate = 0; candidate < wanted * kTriesPerStrand && set.strands.size() < wanted; ++candidate) {
        const glm::dvec3 random = uniform(candidate, options.seed);
        const glm::dvec3 root = space.point(glm::dvec2(random));
        bool free = true;
        if (spacing > 0) grid.visit(root, [&](std::uint32_t, double distance) { free = free && distance >= spacing; });
        if (!free) continue;
        grid.add(root, static_cast<std::uint32_t>(set.strands.size()));
        set.strands.push_back({root, options.shortest + (1 - options.shortest) * random.z});
    }
    return set;
}

} // namespace

double texelAngle(std::size_t texels) {
    return std::sqrt(4 * std::numbers::pi / static_cast<double>(texels));
}

Result<StrandSet> strandsOnTexture(int width, int height, const FurOptions& options) {
    const double texels = static_cast<double>(width) * static_cast<double>(height);
    if (const auto checked = checkOptions(options, texels); !checked) return checked.error();
    return throwDarts(TorusSpace(width, height), options.spacing, static_cast<std::size_t>(std::llround(options.density * texels)),
                      options);
}

Result<StrandSet> strandsOnSphere(std::size_t texels, const FurOptions& options) {
    const auto count = static_cast<double>(texels);
    if (const auto checked = checkOptions(options, count); !checked) return checked.error();
    return throwDarts(SphereSpace{}, options.spacing * texelAngle(texels), static_cast<std::size_t>(std::llround(options.density * count)),
                      options);
}

} // namespace tegument
