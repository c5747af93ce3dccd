// Lean and density of the coat, as shaders read them at vertices, against what they are there.
// The surface in strata: shares of the roots, and points of them.
// Which mesh roots were made for.

#include "meshprep/fur/roots/fur_surface.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/fur/roots/scatter.h"
#include "meshprep/fur/roots/strata.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

FurMap densityHalves(float left, float right) {
    Image image{.width = 2, .height = 1, .channels = 1, .pixels = {left, right}};
    return FurMap(DdsTexture{.images = {image}});
}

/// A cube map that is white towards +Y and black elsewhere.
FurMap whiteAbove() {
    DdsTexture texture{.faces = 6};
    for (int face = 0; face < 6; ++face)
        texture.images.push_back({.width = 1, .height = 1, .channels = 3, .pixels = std::vector<float>(3, face == 2 ? 1.0F : 0.0F)});
    return FurMap(std::move(texture));
}

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

/// Not symmetric about anything.
Mesh pear(int rows = 48) {
    Mesh mesh = ball(1, rows);
    for (glm::vec3& p : mesh.positions)
        p = {p.x * (1.3F + 0.5F * p.y), p.y * 1.6F, p.z * (1 + 0.3F * p.x)};
    computeBounds(mesh);
    return mesh;
}

template <class Change>
Mesh changed(Mesh mesh, Change change) {
    for (glm::vec3& p : mesh.positions)
        p = change(p);
    computeBounds(mesh);
    return mesh;
}

std::string why(const Mesh& made, const Mesh& drawn) {
    return whyNotSame(surfaceFigures(made), surfaceFigures(drawn)).value_or("");
}

} // namespace

TEST(Coat, leans_at_any_vertex_as_the_comb_does) {
    const Built built = build(ball(50), {.count = 20'000, .lean = 0.5, .comb = {0, -1, 0}});
    double worst = 0;
    for (std::size_t i = 0; i < built.mesh.positions.size(); ++i) {
        const glm::vec3 n = built.mesh.normals[i];
        const glm::vec3 exact = 0.5F * (glm::vec3(0, -1, 0) + n * n.y);
        const glm::vec4 found = built.coat(built.mesh.positions[i]);
        worst = std::max(worst, static_cast<double>(glm::distance(glm::vec3(found), exact)));
        EXPECT_NEAR(found.w, 1, 1e-3);
    }
    // The lean bends by 2 / R^2: between nodes 4 spacings apart, and in a mean over 7, that is a few (4 / 40)^2 of it.
    EXPECT_LT(worst, 0.02);
}

TEST(Coat, has_no_step_where_bricks_meet) {
    const Built built = build(ball(50), {.count = 5000, .lean = 0.5, .comb = {1, 2, 0}});
    const FurSurface surface(built.mesh);
    const float side = static_cast<float>(built.texture.brick * built.set.cell);
    const glm::vec3 origin(built.texture.image.at(0, 0, 0), built.texture.image.at(0, 0, 1), built.texture.image.at(0, 0, 2));
    std::size_t tried = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        glm::vec3 place = surface.toMesh(surface.point(rootNoise(i, 3)).position);
        const auto axis = static_cast<glm::length_t>(i % 3);
        place[axis] = origin[axis] + side * std::round((place[axis] - origin[axis]) / side); // onto the nearest wall
        glm::vec3 before = place;
        glm::vec3 after = place;
        before[axis] -= 1e-3F * side;
        after[axis] += 1e-3F * side;
        const glm::vec4 a = built.coat(before);
        const glm::vec4 b = built.coat(after);
        if (a.w == 0 || b.w == 0) continue; // beside the surface, where there is no brick
        ++tried;
        EXPECT_LT(glm::distance(a, b), 2e-3F * 0.5F * 4) << "as much as a slope makes that turns the whole lean round within a brick";
    }
    EXPECT_GT(tried, 1000u);
}

TEST(Coat, is_as_dense_as_the_map) {
    const Built built = build(plate(), {.count = 8000, .densityMap = densityHalves(1, 0.2F)});
    for (int i = 2; i < 98; ++i)
        for (int j = 2; j < 98; ++j) {
            const double u = 0.01 * i;
            const double ramp = u < 0.25 ? 0.6 + 1.6 * u : u < 0.75 ? 1.4 - 1.6 * u : 1.6 * u - 1; // bilinear, repeating
            // The ramp's corners at 1/4 and 3/4 are rounded off within 7.2 spacings, 8 mm, by less than half of what it rises in that.
            EXPECT_NEAR(built.coat(glm::vec3(i, j, 0)).w, ramp, 0.016 * 8 / 2) << u;
        }
}

TEST(Coat, ends_where_the_density_does_and_keeps_its_lean) {
    const Built built = build(ball(50), {.count = 20'000, .lean = 0.5, .comb = {1, 0, 0}, .densityMap = whiteAbove()});
    EXPECT_NEAR(built.coat({0, 50, 0}).w, 1, 1e-3);
    for (const glm::vec3& bald : {glm::vec3(0, -50, 0), glm::vec3(0, 0, 50), glm::vec3(0, 0, -50)}) {
        EXPECT_NEAR(built.coat(bald).w, 0, 1e-3);
        EXPECT_LT(glm::distance(glm::vec3(built.coat(bald)), glm::vec3(0.5F, 0, 0)), 0.02F) << "where nothing stands, too";
    }
}

TEST(Coat, is_bald_where_the_length_is_0) {
    const Built built = build(ball(50), {.count = 5000, .lengthMap = whiteAbove()});
    EXPECT_NEAR(built.coat({0, 50, 0}).w, 1, 1e-3);
    EXPECT_NEAR(built.coat({0, 0, 50}).w, 0, 1e-3);
}

TEST(Coat, without_maps_and_comb_stands_upright_and_dense) {
    const Built built = build(ball(50), {.count = 2000});
    for (const glm::vec3& place : built.mesh.positions)
        EXPECT_LT(glm::distance(built.coat(place), glm::vec4(0, 0, 0, 1)), 1e-6F);
}

TEST(Coat, is_nothing_far_away) {
    const Built built = build(ball(50), {.count = 1000});
    for (const glm::vec3& place : {glm::vec3(1000, 0, 0), glm::vec3(0, -1000, 0), glm::vec3(0, 0, 1e30F), glm::vec3(0)})
        EXPECT_EQ(built.coat(place), glm::vec4(0));
}

TEST(CoatField, is_exact_for_what_is_linear_on_the_surface) {
    std::vector<CoatSample> samples;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const glm::vec3 p(i, j, 0);
            samples.push_back({.position = p, .lean = {0.01F * p.x, 0.02F * p.y, 0}, .density = 0.02F * p.x});
        }
    const CoatField field(samples, 6);
    for (const glm::vec3& place : {glm::vec3(20.3F, 17.7F, 0), glm::vec3(20.3F, 17.7F, 3), glm::vec3(0.5F, 20, 1)}) {
        const glm::vec4 found = field.at(place);
        // but for the stiffness of slopes, a hundredth of them over the distance to the middle of the samples
        EXPECT_NEAR(found.x, 0.01F * place.x, 0.01);
        EXPECT_NEAR(found.y, 0.02F * place.y, 0.01);
        EXPECT_NEAR(found.w, 0.02F * place.x, 0.01);
    }
    EXPECT_EQ(field.at({20, 20, 6.5F}), glm::vec4(0)) << "nothing is near";
}

TEST(CoatField, of_one_sample_is_that_sample) {
    const std::vector<CoatSample> samples{{.position = {1, 2, 3}, .lean = {0.1F, 0.2F, 0.3F}, .density = 0.5F}};
    const CoatField field(samples, 2);
    EXPECT_LT(glm::distance(field.at({1, 2, 3.5F}), glm::vec4(0.1F, 0.2F, 0.3F, 0.5F)), 0.01F);
}

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

TEST(SurfaceFigures, of_a_ball_are_known) {
    const SurfaceFigures figures = surfaceFigures(ball(50, 128));
    EXPECT_NEAR(figures.area, 4 * std::numbers::pi, 0.004); // 128 rows of flat triangles lie within the ball
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(figures.middle[axis], 0, 1e-4);
        EXPECT_NEAR(figures.spread[axis], 1.0 / 3, 1e-3) << "the mean of x^2 over a unit sphere";
    }
}

TEST(SurfaceFigures, do_not_know_unit_place_order_or_fineness) {
    const Mesh mesh = pear();
    EXPECT_EQ(why(mesh, changed(mesh, [](const glm::vec3& p) { return 25.4F * p + glm::vec3(300, -20, 7); })), "");
    Mesh turned = mesh;
    std::ranges::reverse(turned.indices);
    EXPECT_EQ(why(mesh, turned), "");
    EXPECT_EQ(why(mesh, pear(16)), "") << "a coarser level: a ninth of the triangles";
}

TEST(SurfaceFigures, tell_meshes_apart) {
    const Mesh mesh = pear();
    EXPECT_NE(why(mesh, ball(1)).find("area"), std::string::npos) << why(mesh, ball(1));
    const Mesh mirrored = changed(mesh, [](const glm::vec3& p) { return glm::vec3(p.x, -p.y, p.z); });
    EXPECT_NE(why(mesh, mirrored).find("middle"), std::string::npos) << why(mesh, mirrored);
    const Mesh lying = changed(ball(1), [](const glm::vec3& p) { return glm::vec3(2 * p.x, p.y, p.z); });
    const Mesh standing = changed(ball(1), [](const glm::vec3& p) { return glm::vec3(p.x, 2 * p.y, p.z); });
    EXPECT_NE(why(lying, standing).find("spreads"), std::string::npos) << why(lying, standing);
}

TEST(SurfaceFigures, travel_in_the_texture) {
    const Built built = build(pear(), {.count = 1000});
    const auto read = figuresIn(built.texture.image);
    ASSERT_TRUE(read);
    const SurfaceFigures own = surfaceFigures(built.mesh);
    constexpr double kFloat = 1e-6;
    EXPECT_NEAR(read->area, own.area, kFloat * own.area);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(read->middle[axis], own.middle[axis], kFloat);
        EXPECT_NEAR(read->spread[axis], own.spread[axis], kFloat);
    }
    Image earlier = built.texture.image;
    for (int channel = 0; channel < 4; ++channel)
        earlier.pixels[4 * 7 + static_cast<std::size_t>(channel)] = 0;
    EXPECT_FALSE(figuresIn(earlier)) << "files of earlier versions hold zeros there, and are not judged";
    EXPECT_FALSE(figuresIn(Image{.width = 2, .height = 1, .channels = 4, .pixels = std::vector<float>(8, 1)}));
}
