// How evenly strands lie that are looked up by the rest position, on shapes that are hard for maps.
#include "meshprep/prepare/root_mapping.h"
#include "tests/meshprep/prepare/meshes.h"
#include "tests/meshprep/scan_files.h"

using namespace tegument;
using namespace tegument::prep;
using namespace tegument::testing_prep;

namespace {

constexpr double kMostOfRoots = 0.02; // patch CV of roots (0.03 is wanted; random discs without strata would have 0.023), of balls
constexpr double kMostOfBalls = 0.05;

Surface prepared(Mesh mesh) {
    Surface surface = surfaceOf(std::move(mesh));
    makeNormals(surface, {});
    computeBounds(surface.mesh);
    return surface;
}

void expectEven(const std::vector<RootMapping>& ways) {
    ASSERT_EQ(ways.size(), 2u);
    EXPECT_LE(ways[0].cvPatch, kMostOfRoots);
    EXPECT_LE(ways[1].cvPatch, kMostOfBalls);
    for (const RootMapping& way : ways) {
        EXPECT_EQ(way.starved, 0) << way.name;
        EXPECT_EQ(way.seamLength, 0) << way.name;
        EXPECT_LT(way.cvPatch, way.poissonCv) << "independent places are less even";
    }
}

} // namespace

TEST(RootMappings, are_even_on_rough_shapes) {
    expectEven(examineRoots(prepared(makeShape(Shape::Sphere, 60))));
    expectEven(examineRoots(prepared(makeShape(Shape::Terrain, 120))));
}

TEST(RootMappings, count_as_many_balls_as_the_formula_says) {
    // 2 rho / h^3 per area with rho = h / 2 and h = 1 / sqrt(density): the density, whichever way the surface looks. A curved surface cuts
    // a few balls twice, which count once; five sigma of the patches' own variation.
    const auto ways = examineRoots(prepared(makeShape(Shape::Sphere, 60)), 20'000);
    EXPECT_NEAR(static_cast<double>(ways[1].count), 20'000, 5 * 0.05 * 20'000 / std::sqrt(300.0));
}

TEST(RootMappings, see_a_seam_where_places_were_joined_that_lie_apart) {
    Surface surface = surfaceOf(meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0.1f}, {0, 1, 0.1f}, {1, 1, 0}}, {0, 1, 2, 3, 5, 4}));
    surface.point[3] = surface.point[1];
    surface.point[4] = surface.point[2];
    makeNormals(surface, {});
    computeBounds(surface.mesh);
    const auto ways = examineRoots(surface, 1000);
    EXPECT_GT(ways[0].seamLength, 0.5) << "an edge of 1.4 on an area of 1";
}

class ScanRoots : public PrepFolder {};

TEST_F(ScanRoots, are_even_on_the_bunny_and_the_dragon) {
    for (const char* name : {"bun_zipper.ply", "dragon_vrip_res2.ply"}) {
        const auto path = findScan(name, folder_);
        if (path.empty()) GTEST_SKIP() << "no " << name << " (docs/meshprep.md says where it comes from)";
        const auto result = prepareMesh(path, {.order = std::nullopt, .levels = 1, .mappingReport = true});
        ASSERT_TRUE(result) << format(result.error());
        expectEven(result->report.rootMapping);
    }
}
