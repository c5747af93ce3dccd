// The surface in strata: shares of the roots, and points of them.
#include "meshprep/fur/roots/strata.h"
#include "tests/fur/roots/meshes.h"

#include "meshprep/fur/roots/scatter.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

constexpr std::size_t kWanted = 5000;

struct Share {
    Strata::Run run;
    double points = 0; // of kPoints thrown at the whole surface
};

constexpr std::uint64_t kPoints = 200'000;

std::vector<Share> shares(const Strata& strata, unsigned level, const DensityAt& density) {
    std::vector<Share> result;
    std::vector<std::size_t> ofStratum(strata.count());
    strata.forRuns(level, [&](const Strata::Run& run) {
        std::fill(ofStratum.begin() + run.first, ofStratum.begin() + run.last, result.size());
        result.push_back({.run = run});
    });
    const Strata::Run all{0, static_cast<std::uint32_t>(strata.count())};
    for (std::uint64_t i = 0; i < kPoints; ++i) {
        const Strata::Place place = strata.point(all, rootNoise(i, 5));
        result[ofStratum[place.stratum]].points += density ? density(place.point) : 1;
    }
    return result;
}

/// Quotas against what a shower of points meets of each cube.
void expectShared(const Mesh& mesh, const DensityAt& density) {
    const FurSurface surface(mesh);
    const Strata strata(surface, 0.1, kWanted, density);
    EXPECT_GT(strata.count(), 200u);
    for (unsigned level = 0; level < 6; ++level) {
        std::size_t sum = 0;
        const std::vector<Share> found = shares(strata, level, density);
        double points = 0;
        for (const Share& share : found)
            points += share.points;
        for (const Share& share : found) {
            const double expected = kWanted * share.points / points;
            // one for rounding; five sigma of the points, 40 to a root, which density makes fewer
            EXPECT_NEAR(static_cast<double>(strata.quota(share.run)), expected, 1 + 5 * std::sqrt((expected + 1) * kWanted / points));
            sum += strata.quota(share.run);
        }
        EXPECT_EQ(sum, kWanted) << "at level " << level;
    }
}

} // namespace

TEST(Strata, share_roots_out_in_proportion_to_area) {
    expectShared(ball(50), {});
    expectShared(plate(), {});
}

TEST(Strata, share_roots_out_in_proportion_to_density) {
    const DensityAt ramp = [](const SurfacePoint& point) { return 0.5 + 0.5 * static_cast<double>(point.position.x); };
    expectShared(ball(50), ramp);
    const Mesh mesh = ball(50);
    const FurSurface surface(mesh);
    const Strata strata(surface, 0.1, kWanted, ramp);
    EXPECT_NEAR(strata.density({0, static_cast<std::uint32_t>(strata.count())}), 0.5, 1e-3) << "the ramp's mean over a sphere";
}

TEST(Strata, have_their_points_in_one_cube) {
    const Mesh mesh = plate(); // triangles of up to ten cubes' sides
    const FurSurface surface(mesh);
    constexpr double kSide = 0.05;
    const Strata strata(surface, kSide, kWanted, {});
    for (unsigned level = 0; level < 3; ++level)
        strata.forRuns(level, [&](const Strata::Run& run) {
            glm::vec3 low(10), high(-10);
            for (std::uint64_t i = 0; i < 50; ++i) {
                const glm::vec3 p = strata.point(run, rootNoise(i, 1)).point.position;
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            // a piece, half a side long at most, sticks out of the cube that has its middle by two thirds of that
            const double most = kSide * ((1 << level) + 2.0 / 3);
            EXPECT_LE(std::max({high.x - low.x, high.y - low.y, high.z - low.z}), most * (1 + 1e-5));
        });
}

TEST(Strata, have_no_root_where_there_is_no_density) {
    const Mesh mesh = ball(50);
    const FurSurface surface(mesh);
    const Strata strata(surface, 0.1, kWanted, [](const SurfacePoint& point) { return point.position.y > 0 ? 1.0 : 0.0; });
    strata.forRuns(0, [&](const Strata::Run& run) {
        if (strata.point(run, glm::dvec3(0.5)).point.position.y < -0.2F) {
            EXPECT_EQ(strata.quota(run), 0u);
        }
    });
    const Strata bald(surface, 0.1, kWanted, [](const SurfacePoint&) { return 0.0; });
    EXPECT_EQ(bald.quota({0, static_cast<std::uint32_t>(bald.count() - 1)}), 0u);
}

TEST(Strata, of_needles_do_not_take_the_memory) {
    // Needles so thin that their area has a spacing of a ten-thousandth of their length: cut to it they would be two hundred million.
    Mesh mesh;
    for (int i = 0; i < 20'000; ++i) {
        const double angle = 2 * std::numbers::pi * i / 20'000;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {0, 0, 1e-5F}});
    for (std::uint32_t i = 0; i < 20'000; ++i)
        mesh.indices.insert(mesh.indices.end(), {i, 20'000, 20'001});
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    const Mesh needles = finished(std::move(mesh));
    const FurSurface surface(needles);
    const Strata strata(surface, 4e-4, 1000, {});
    EXPECT_LT(strata.count(), 20'000u + 4 * 1000 + 4096 + 1) << "as many as pieces, at most";
    std::size_t sum = 0;
    strata.forRuns(0, [&](const Strata::Run& run) { sum += strata.quota(run); });
    EXPECT_EQ(sum, 1000u);
}
