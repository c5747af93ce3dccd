// Texture coordinates for meshes without: every triangle has its own place in the square.
// How evenly strands lie that are looked up by the rest position, on shapes that are hard for maps.

#include "meshprep/prepare/carry_textures.h"
#include "meshprep/prepare/charts.h"
#include "meshprep/prepare/clean.h"
#include "meshprep/prepare/mapping.h"
#include "meshprep/prepare/unwrap.h"
#include "tests/meshprep/prepare/meshes.h"
#include "tests/meshprep/scan_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace tegument;
using namespace tegument::prep;
using namespace tegument::testing_prep;

namespace {

/// A torus, closed, of two parts.
Surface torus() {
    constexpr std::uint32_t kRound = 48, kAround = 24;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < kRound; ++i)
        for (std::uint32_t j = 0; j < kAround; ++j) {
            const double a = 2 * std::numbers::pi * i / kRound, b = 2 * std::numbers::pi * j / kAround;
            const double r = 60 + 25 * std::cos(b);
            positions.emplace_back(r * std::cos(a), r * std::sin(a), 25 * std::sin(b));
            const auto at = [&](std::uint32_t x, std::uint32_t y) { return x % kRound * kAround + y % kAround; };
            indices.insert(indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    Surface surface{.mesh = meshOf(std::move(positions), std::move(indices))};
    const auto half = static_cast<std::uint32_t>(surface.mesh.indices.size() / 2);
    surface.mesh.parts = {{.name = "a", .firstIndex = 0, .indexCount = half}, {.name = "b", .firstIndex = half, .indexCount = half}};
    findPlaces(surface, {});
    return surface;
}

/// Square root of what a triangle covers of the map over its area: texels per mm.
double fineness(const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* t = &mesh.indices[3 * triangle];
    const auto p = [&](int i) { return glm::dvec3(mesh.positions[t[i]]); };
    const auto uv = [&](int i) { return glm::dvec2(mesh.uvs[t[i]]); };
    const glm::dvec2 a = uv(1) - uv(0), b = uv(2) - uv(0);
    return std::sqrt(std::abs(a.x * b.y - a.y * b.x) / glm::length(glm::cross(p(1) - p(0), p(2) - p(0))));
}

/// Corners (i, j) of a sheet, or of a tube where it is closed around.
template <class Place>
Surface sheet(std::uint32_t around, std::uint32_t along, bool closed, Place place) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    const std::uint32_t columns = closed ? around : around + 1;
    for (std::uint32_t j = 0; j <= along; ++j)
        for (std::uint32_t i = 0; i < columns; ++i)
            positions.push_back(place(static_cast<double>(i) / around, static_cast<double>(j) / along));
    for (std::uint32_t j = 0; j < along; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = j * columns + i, b = j * columns + (i + 1) % columns;
            indices.insert(indices.end(), {a, b, b + columns, a, b + columns, a + columns});
        }
    return surfaceOf(meshOf(std::move(positions), std::move(indices)));
}

constexpr double kRound = 2 * std::numbers::pi;

/// Neighbours turn by half a degree, all of them by a whole turn.
Surface cone() {
    return sheet(720, 2, true, [](double u, double v) {
        const double radius = 30 + 40 * v;
        return glm::vec3(radius * std::cos(kRound * u), 80 * v, radius * std::sin(kRound * u));
    });
}

/// A ramp of three turns: no normal is far from any other, and it lies over itself.
Surface ramp() {
    return sheet(900, 1, false, [](double u, double v) {
        const double radius = 20 + 10 * v;
        return glm::vec3(radius * std::cos(3 * kRound * u), 6 * u, radius * std::sin(3 * kRound * u));
    });
}

/// Closed, without an edge to begin at.
Surface ring() {
    Surface surface = sheet(500, 12, true, [](double u, double v) {
        const double radius = 60 + 5 * std::cos(kRound * v);
        return glm::vec3(radius * std::cos(kRound * u), 5 * std::sin(kRound * v), radius * std::sin(kRound * u));
    });
    for (glm::vec3& p : surface.mesh.positions) // both ends of v are one place to the last bit
        p = glm::round(p * 1024.0F) / 1024.0F;
    return surfaceOf(std::move(surface.mesh));
}

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

class Unwrap : public testing::Test {
protected:
    void SetUp() override {
#ifdef TEGUMENT_WITHOUT_XATLAS
        GTEST_SKIP() << "built without xatlas: ./bootstrap build brings it";
#endif
        surface_ = torus();
        before_ = surface_.mesh;
        const auto made = unwrap(surface_);
        ASSERT_TRUE(made) << format(made.error());
        made_ = *made;
    }
    Surface surface_;
    Mesh before_;
    Unwrapping made_;
};

namespace {

/// What the texture holds at a place, between texels.
glm::dvec3 texelAt(const Image& image, const glm::dvec2& uv) {
    const glm::dvec2 at = uv * glm::dvec2(image.width, image.height) - 0.5;
    const glm::dvec2 low = glm::floor(at), share = at - low;
    const auto texel = [&](int i, int j) {
        const int x = std::clamp(static_cast<int>(low.x) + i, 0, image.width - 1),
                  y = std::clamp(static_cast<int>(low.y) + j, 0, image.height - 1);
        return glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x), glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

/// The middle of a triangle: what a texture says there, and which way a normal map points.
std::pair<glm::dvec3, glm::dvec3> shownAt(const Mesh& mesh, std::size_t triangle) {
    glm::dvec2 uv(0);
    glm::dvec3 normal(0), tangent(0);
    const std::uint32_t* corners = &mesh.indices[3 * triangle];
    for (int i = 0; i < 3; ++i) {
        uv += glm::dvec2(mesh.uvs[corners[i]]) / 3.0;
        normal += glm::dvec3(mesh.normals[corners[i]]) / 3.0;
        tangent += glm::dvec3(mesh.tangents[corners[i]]) / 3.0;
    }
    const glm::dvec3 bump = texelAt(mesh.textures.at(1).image, uv) * 2.0 - 1.0;
    const glm::dvec3 across = glm::cross(normal, tangent) * static_cast<double>(mesh.tangents[corners[0]].w);
    return {texelAt(mesh.textures.at(0).image, uv), bump.x * tangent + bump.y * across + bump.z * normal};
}

} // namespace

TEST_F(Unwrap, textures_are_drawn_anew_where_they_were) {
    constexpr int kSide = 256;
    const auto picture = [](auto value) {
        Image image = plainImage(kSide, kSide, 3);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) = static_cast<float>(value(0.04 * x, 0.05 * y, c));
        return image;
    };
    before_.uvs.clear(); // from above: both sides of the torus lie on each other
    for (const glm::vec3& p : before_.positions)
        before_.uvs.emplace_back(0.5F + p.x / 200, 0.5F + (p.y + 0.3F * p.z) / 220);
    computeNormals(before_);
    computeTangents(before_);
    before_.textures = {{.role = "color", .image = picture([](double x, double y, int c) { return 0.5 + 0.4 * std::sin(x + c * y); })},
                        {.role = "normal", .image = picture([](double x, double y, int c) {
                                               return c == 2 ? 0.95 : 0.5 + 0.2 * std::sin(c == 0 ? x : y); // as stored
                                           })}};
    Mesh mesh = surface_.mesh;
    computeNormals(mesh);
    computeTangents(mesh);
    EXPECT_EQ(carryTextures(before_, mesh), 512);
    ASSERT_EQ(mesh.textures.size(), 2u);
    double off = 0, all = 0;
    std::vector<double> turns;
    for (std::size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        const auto [colour, bump] = shownAt(before_, triangle);
        const auto [colourNow, bumpNow] = shownAt(mesh, triangle);
        off += glm::dot(colour - colourNow, colour - colourNow);
        all += glm::dot(colour, colour);
        turns.push_back(degreesBetween(bump, bumpNow));
    }
    std::ranges::sort(turns);
    EXPECT_LE(std::sqrt(off / all), 0.01);
    EXPECT_LE(turns[turns.size() / 2], 0.5);
    EXPECT_LE(turns[turns.size() * 95 / 100], 3) << "seen edge-on from above the old tangents turn within a triangle";
    EXPECT_EQ(mesh.textures.at(0).role, "color");
}

#ifdef TEGUMENT_WITHOUT_XATLAS
TEST(UnwrapWithoutXatlas, says_what_it_lacks_and_leaves_the_mesh_alone) {
    Surface surface = torus();
    const std::vector<glm::vec2> uvs = surface.mesh.uvs;
    const auto made = unwrap(surface);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().diagnostics.front().code, 7027);
    EXPECT_EQ(surface.mesh.uvs, uvs);
}
#endif

TEST_F(Unwrap, gives_every_triangle_a_place_of_its_own_in_the_square) {
    const UvReport report = examineUvs(surface_.mesh);
    EXPECT_EQ(surface_.mesh.uvs.size(), surface_.mesh.positions.size());
    EXPECT_LT(report.overlapping, 1e-3) << "borders of triangles, as rounding has them";
    EXPECT_EQ(report.outside, 0);
    EXPECT_GT(report.covered, 0.4) << "gutters and gaps take less than what is drawn";
    EXPECT_DOUBLE_EQ(report.covered, made_.covered);
}

TEST_F(Unwrap, leaves_the_surface_as_it_was) {
    const Mesh& mesh = surface_.mesh;
    ASSERT_EQ(mesh.indices.size(), before_.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        ASSERT_EQ(mesh.positions[mesh.indices[i]], before_.positions[before_.indices[i]]) << "corner " << i;
    EXPECT_EQ(mesh.positions.size(), before_.positions.size() + made_.split);
    EXPECT_EQ(surface_.point.size(), mesh.positions.size());
    EXPECT_GT(made_.split, 0U) << "a torus does not lie flat uncut";
}

TEST_F(Unwrap, is_about_as_fine_everywhere) {
    std::vector<double> all;
    for (std::size_t i = 0; i < surface_.triangles(); ++i)
        all.push_back(fineness(surface_.mesh, i));
    std::ranges::sort(all);
    EXPECT_LT(all[all.size() * 95 / 100] / all[all.size() * 5 / 100], 3) << "the Stretch map levels what is within";
}

TEST_F(Unwrap, makes_few_charts_none_of_two_parts) {
    EXPECT_GE(made_.charts, 2U);
    EXPECT_LE(made_.charts, 40U);
    const auto chartsMeet = [&] { // a vertex that triangles of both parts use would join charts of both
        std::vector<bool> first(surface_.mesh.positions.size(), false);
        const std::size_t half = surface_.mesh.indices.size() / 2;
        for (std::size_t i = 0; i < half; ++i)
            first[surface_.mesh.indices[i]] = true;
        return std::any_of(surface_.mesh.indices.begin() + static_cast<std::ptrdiff_t>(half), surface_.mesh.indices.end(),
                           [&](std::uint32_t index) { return first[index]; });
    };
    EXPECT_FALSE(chartsMeet());
}

TEST_F(Unwrap, is_the_same_each_time) {
    Surface again = torus();
    ASSERT_TRUE(unwrap(again));
    EXPECT_EQ(again.mesh.uvs, surface_.mesh.uvs);
}

TEST_F(Unwrap, of_triangles_without_area_is_refused) {
    Surface line{.mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2})};
    findPlaces(line, {});
    const auto made = unwrap(line);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().diagnostics.front().code, 7028);
}

#ifndef TEGUMENT_WITHOUT_XATLAS
TEST(UnwrapOfSmooth, surfaces_of_fine_triangles_never_overlap) {
    for (const auto& [name, make] : {std::pair("cone", &cone), std::pair("ramp", &ramp), std::pair("ring", &ring)}) {
        Surface surface = make();
        const auto made = unwrap(surface);
        ASSERT_TRUE(made) << name << format(made.error());
        const UvReport report = examineUvs(surface.mesh);
        EXPECT_LE(report.overlapping, 1e-3) << name;
        EXPECT_EQ(report.outside, 0) << name;
        EXPECT_LE(made->charts, 32U) << name << ": light ends at the border of a chart";
    }
}

TEST(UnwrapOfSmooth, needles_of_no_width_leave_the_square_to_the_others) {
    Surface capsule = sheet(16, 12, true, [](double u, double v) { // at its ends the sine is rounding: 16 corners 1e-15 mm apart
        const double turn = std::numbers::pi * v;
        return glm::vec3(30 * std::sin(turn) * std::cos(kRound * u), 30 * std::cos(turn), 30 * std::sin(turn) * std::sin(kRound * u));
    });
    const auto made = unwrap(capsule);
    ASSERT_TRUE(made) << format(made.error());
    EXPECT_GT(made->covered, 0.3);
    EXPECT_LE(examineUvs(capsule.mesh).overlapping, 1e-3);
}

TEST(UnwrapOfSmooth, a_strip_is_cut_to_the_length_of_the_square) {
    Surface strip = sheet(200, 1, false, [](double u, double v) { return glm::vec3(1000 * u, 0.1 * v, 0); });
    const auto made = unwrap(strip);
    ASSERT_TRUE(made) << format(made.error());
    EXPECT_GT(made->charts, 20U);
    EXPECT_GT(made->covered, 0.02) << "a ten-thousandth as one chart";
    EXPECT_LE(examineUvs(strip.mesh).overlapping, 1e-3);
}

TEST(UnwrapOfSmooth, pieces_are_bounded_connected_and_whole) {
    const Surface surface = ring();
    const Triangles triangles(surface);
    const std::vector<Faces> pieces = cutIntoPieces(triangles, 1000);
    std::vector<int> times(surface.triangles(), 0);
    for (const Faces& piece : pieces) {
        EXPECT_LE(piece.size(), 1000U);
        for (const std::uint32_t face : piece)
            ++times[face];
    }
    EXPECT_EQ(cutIntoPieces(triangles, surface.triangles()).size(), 1U) << "what fits stays whole";
    EXPECT_GE(pieces.size(), surface.triangles() / 1000);
    EXPECT_LE(pieces.size(), 4 * surface.triangles() / 1000);
    EXPECT_TRUE(std::ranges::all_of(times, [](int count) { return count == 1; }));
}

TEST(UnwrapOfSmooth, bounded_charts_lie_flat_whatever_the_surface) {
    Surface crumpled = sheet(40, 40, false, [](double u, double v) {
        return glm::vec3(50 * u + 6 * std::sin(97 * v), 9 * std::sin(41 * u + 83 * v), 50 * v + 6 * std::sin(89 * u));
    });
    for (const Surface& surface : {cone(), ramp(), std::move(crumpled)}) {
        const Triangles triangles(surface);
        std::size_t placed = 0;
        for (const Faces& piece : cutIntoPieces(triangles, surface.triangles()))
            for (const Chart& chart : boundedCharts(triangles, piece)) {
                EXPECT_TRUE(liesFlat(triangles, chart));
                placed += chart.faces.size();
            }
        EXPECT_EQ(placed, surface.triangles());
    }
}

TEST(UnwrapOfSmooth, a_chart_that_overlaps_or_turns_over_does_not_lie_flat) {
    const Surface surface = ramp();
    const Triangles triangles(surface);
    Chart fromAbove;
    for (std::uint32_t face = 0; face < triangles.count(); ++face) {
        fromAbove.faces.push_back(face);
        auto& places = fromAbove.places.emplace_back();
        for (std::size_t corner = 0; corner < 3; ++corner)
            places[corner] = {triangles.place(face, corner).x, triangles.place(face, corner).z};
    }
    EXPECT_FALSE(liesFlat(triangles, fromAbove)) << "three layers";
    Chart one{.faces = {0, 1}, .places = {fromAbove.places[0], fromAbove.places[1]}};
    EXPECT_TRUE(liesFlat(triangles, one));
    std::swap(one.places[1][0], one.places[1][1]);
    EXPECT_FALSE(liesFlat(triangles, one)) << "turned over";
    one.places[1] = one.places[0];
    one.places[1][2].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(liesFlat(triangles, one)) << "no number";
}
#endif

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
