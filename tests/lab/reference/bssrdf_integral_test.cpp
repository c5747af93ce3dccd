// The surface integral against closed forms on a plane and a sphere, and against itself divided more finely.

#include "lab/reference/bssrdf.h"
#include "tests/lab/reference/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tegument;
using namespace tegument::reference;

namespace {

const Quadrature kDefault;
const glm::dvec3 kBurley(.451, .104, .070); // mm

/// 60 mm wide: 20 mm more than the widest profile reaches from the places that are asked for. Cells of 1.5 mm.
const Mesh& wide() {
    static const Mesh kMesh = plane(30, 40);
    return kMesh;
}

double largest(const glm::dvec3& difference) {
    const glm::dvec3 size = glm::abs(difference);
    return std::max({size.x, size.y, size.z});
}

/// Of light on x > 0, at 41 places across its edge.
template <class Truth>
double errorAcrossEdge(const RayScene& surface, const RadialProfile& profile, const Quadrature& quadrature, Truth truth) {
    double worst = 0;
    for (int i = -20; i <= 20; ++i) {
        const double x = 0.003 + 0.1 * i;
        const auto light = [](const SurfacePoint& p) { return glm::dvec3(p.position.x > 0 ? 1 : 0); };
        worst = std::max(worst, largest(diffuse(surface, light, profile, {x, 0.3, 0}, quadrature).light - truth(x)));
    }
    return worst;
}

Quadrature finer(int times) {
    Quadrature quadrature;
    for (int i = 0; i < times; ++i)
        quadrature = halved(quadrature);
    return quadrature;
}

/// Under directional light along z, seen at the vertices of a sphere of 5 mm nearest to the given cosines.
double sphereError(int levels, const glm::dvec3& flesh = glm::dvec3(0)) {
    const Mesh mesh = sphereMesh(5, levels);
    const RayScene surface(mesh);
    double worst = 0;
    for (const double cosine : {1.0, 0.7, 0.3, 0.0, -0.3}) {
        const auto at = std::ranges::min_element(mesh.positions, {}, [&](const glm::vec3& p) { return std::abs(p.z / 5 - cosine); });
        const auto light = [](const SurfacePoint& p) { return glm::dvec3(std::max(0.0, glm::normalize(p.position).z)); };
        const Diffused found =
            diffuse(surface, light, radial(skinProfile(), flesh), glm::dvec3(*at), halved(kDefault), glm::normalize(glm::dvec3(*at)));
        worst = std::max(worst, largest(found.light - sphere(skinProfile(), 5, static_cast<double>(at->z) / 5, flesh)));
    }
    return worst;
}

} // namespace

TEST(SurfaceIntegral, of_a_constant_on_a_plane_is_one) {
    const RayScene surface(wide());
    const auto light = [](const SurfacePoint&) { return glm::dvec3(0.7); };
    const Diffused found = diffuse(surface, light, radial(skinProfile()), {0.31, -0.77, 0}, halved(kDefault));
    EXPECT_LT(largest(found.share - 1.0), 1e-7) << "nodes on pieces of a quarter of their distance";
    EXPECT_LT(largest(found.light - 0.7), 1e-7);
}

TEST(SurfaceIntegral, of_a_sinusoid_on_a_plane_is_damped_as_the_closed_form_says) {
    const RayScene surface(wide());
    for (const double wavenumber : {0.5, 1.5}) // radians per mm: waves of 12 and 4 mm
        for (const double x : {0.0, 0.3, 1.1}) {
            const auto light = [&](const SurfacePoint& p) { return glm::dvec3(1 + std::cos(wavenumber * p.position.x)); };
            const glm::dvec3 truth = 1.0 + std::cos(wavenumber * x) * sinusoid(skinProfile(), wavenumber);
            const Diffused found = diffuse(surface, light, radial(skinProfile()), {x, 0.2, 0}, halved(kDefault));
            EXPECT_LT(largest(found.light - truth), 1e-6) << wavenumber << " at " << x;
        }
}

TEST(SurfaceIntegral, of_an_edge_of_light_is_the_closed_form_within_a_thousandth) {
    const RayScene surface(wide());
    const auto truth = [](double x) { return halfPlane(skinProfile(), x); };
    EXPECT_LT(errorAcrossEdge(surface, radial(skinProfile()), kDefault, truth), 1e-3);
}

/// The edge crosses pieces of the surface; where in them it lies is known to the spacing of their nodes, so the error falls with it.
TEST(SurfaceIntegral, of_an_edge_of_light_is_ten_times_closer_with_a_quarter_of_the_spacing) {
    const RayScene surface(wide());
    const auto truth = [](double x) { return halfPlane(skinProfile(), x); };
    EXPECT_LT(errorAcrossEdge(surface, radial(skinProfile()), finer(2), truth), 1e-4);
}

TEST(SurfaceIntegral, of_a_disc_of_light_is_the_closed_form) {
    const RayScene surface(wide());
    for (const double radius : {0.3, 1.5}) {
        const auto light = [&](const SurfacePoint& p) { return glm::dvec3(glm::length(p.position) < radius ? 1 : 0); };
        const Diffused found = diffuse(surface, light, radial(skinProfile()), glm::dvec3(0), halved(kDefault));
        EXPECT_LT(largest(found.light - discCentre(skinProfile(), radius)), 1e-3) << radius << ": as at an edge";
    }
}

TEST(SurfaceIntegral, takes_a_profile_that_grows_without_bound_at_its_centre) {
    const RayScene surface(wide());
    const auto truth = [](double x) { return burleyHalfPlane(kBurley, x); };
    EXPECT_LT(errorAcrossEdge(surface, burley(kBurley), kDefault, truth), 1e-3);
    const auto light = [](const SurfacePoint& p) { return glm::dvec3(glm::length(p.position) < 1.5 ? 1 : 0); };
    const Diffused found = diffuse(surface, light, burley(kBurley), glm::dvec3(0), kDefault);
    EXPECT_LT(largest(found.light - burleyWithin(kBurley, 1.5)), 1e-3);
}

TEST(SurfaceIntegral, does_not_depend_on_how_the_plane_is_cut_into_triangles) {
    const Mesh coarse = plane(30, 7);
    const Mesh fine = plane(30, 333); // triangles much smaller than the pieces: one node each
    const auto light = [](const SurfacePoint& p) { return glm::dvec3(1 + std::cos(p.position.x)); };
    const auto at = [&](const Mesh& mesh) { return diffuse(RayScene(mesh), light, radial(skinProfile()), {0.3, 0.2, 0}, kDefault).light; };
    EXPECT_LT(largest(at(coarse) - at(fine)), 2e-4) << "the rule of one node, whose error is of second order";
}

/// Chords and flat faces leave out area in proportion to the square of their edges.
TEST(SurfaceIntegral, on_a_sphere_comes_four_times_closer_with_each_halving_of_the_edges) {
    const double coarse = sphereError(4); // edges of 0.5 mm
    const double middle = sphereError(5);
    const double fine = sphereError(6);
    EXPECT_LT(fine, 2e-4);
    EXPECT_NEAR(coarse / middle, 4, 0.6);
    EXPECT_NEAR(middle / fine, 4, 0.6);
}

/// With the factor 1 + c h, h = r^2 / (2 a).
TEST(SurfaceIntegral, on_a_sphere_with_flesh_is_the_closed_form) {
    const glm::dvec3 flesh(0.7, 1.8, 2.5);
    EXPECT_LT(sphereError(6, flesh), 3e-4);
    EXPECT_GT(largest(sphere(skinProfile(), 5, 0, flesh) - sphere(skinProfile(), 5, 0)), 0.01) << "which is felt";
}

TEST(SurfaceIntegral, on_a_sphere_counts_the_share_that_the_closed_form_does) {
    const Mesh mesh = sphereMesh(5, 6);
    const Diffused found = diffuse(
        RayScene(mesh), [](const SurfacePoint&) { return glm::dvec3(1); }, radial(skinProfile()), {0, 0, 5}, kDefault);
    glm::dvec3 truth(0);
    for (const Gaussian& g : skinProfile())
        truth += g.weight * (1 - std::exp(-2 * 25 / g.variance));
    EXPECT_LT(largest(found.share - truth), 5e-4) << "area left out by faces with edges of 0.12 mm";
}

/// A result counts as converged when twice the fineness changes it by less than a tenth of the smallest error that is reported with it;
/// those of the techniques are above 5e-3. A surface with an edge of light near every point is the worst case.
TEST(SurfaceIntegral, changes_by_less_than_half_a_thousandth_when_divided_twice_as_finely) {
    const RayScene surface(wide());
    double squares = 0;
    double all = 0;
    for (int i = -20; i <= 20; ++i) {
        const glm::dvec3 at(0.003 + 0.1 * i, 0.3, 0);
        const auto light = [](const SurfacePoint& p) { return glm::dvec3(p.position.x > 0 ? 0.5 + 0.2 * std::sin(9 * p.position.y) : 0); };
        const glm::dvec3 once = diffuse(surface, light, radial(skinProfile()), at, kDefault).light;
        const glm::dvec3 twice = diffuse(surface, light, radial(skinProfile()), at, halved(kDefault)).light;
        squares += glm::dot(once - twice, once - twice);
        all += glm::dot(twice, twice);
    }
    EXPECT_LT(std::sqrt(squares / all), 5e-4);
}

TEST(SurfaceIntegral, of_no_light_is_zero) {
    const Diffused found = diffuse(
        RayScene(wide()), [](const SurfacePoint&) { return glm::dvec3(0); }, radial(skinProfile()), glm::dvec3(0), kDefault);
    EXPECT_EQ(found.light, glm::dvec3(0));
}

TEST(SurfaceIntegral, of_a_surface_out_of_reach_is_zero) {
    const Diffused found = diffuse(
        RayScene(wide()), [](const SurfacePoint&) { return glm::dvec3(1); }, radial(skinProfile()), {0, 0, 17}, kDefault);
    EXPECT_EQ(found.share, glm::dvec3(0)) << "six sigma of the widest are 16.3 mm";
}

TEST(SurfaceIntegral, above_a_plane_is_the_slab_of_the_closed_form) {
    const RayScene surface(wide());
    for (const double height : {1.0, 4.0}) {
        const Diffused found = diffuse(
            surface, [](const SurfacePoint&) { return glm::dvec3(1); }, radial(skinProfile()), {0.1, 0.2, height}, halved(kDefault));
        EXPECT_LT(largest(found.light - slab(skinProfile(), height)), 1e-6) << height << " mm";
    }
}

/// Through it h is the thickness, whatever the way.
TEST(SurfaceIntegral, behind_a_slab_of_flesh_grows_with_the_thickness) {
    const glm::dvec3 flesh(0.7, 1.8, 2.5);
    const RayScene surface(wide());
    for (const double thickness : {1.0, 4.0}) {
        const Diffused found = diffuse(surface, [](const SurfacePoint&) { return glm::dvec3(1); }, radial(skinProfile(), flesh),
                                       {0.1, 0.2, -thickness}, halved(kDefault), {0, 0, -1});
        EXPECT_LT(largest(found.light - slab(skinProfile(), thickness) * (1.0 + flesh * thickness)), 1e-6) << thickness << " mm";
    }
}

TEST(RayScene, distance_is_that_of_the_nearest_triangle) {
    const Mesh mesh = sphereMesh(5, 6);
    const RayScene surface(mesh);
    EXPECT_NEAR(surface.distance({1, 2, -2}, 9), 2, 3e-3) << "facets of 0.12 mm";
    EXPECT_EQ(surface.distance({1, 2, -2}, 1.5), 1.5);
    const Mesh flat = plane(1, 1);
    EXPECT_NEAR(RayScene(flat).distance({3, 0.5, 2}, 9), std::sqrt(8.0), 1e-12) << "beside an edge";
}

TEST(RayScene, around_finds_every_triangle_within_the_radius) {
    const Mesh mesh = sphereMesh(5, 4);
    const glm::dvec3 centre(3, 0, 4);
    const auto found = RayScene(mesh).around(centre, 2);
    EXPECT_TRUE(std::ranges::is_sorted(found));
    for (std::uint32_t t = 0; 3 * t < mesh.indices.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c)
            if (glm::length(glm::dvec3(mesh.positions[mesh.indices[3 * t + c]]) - centre) < 2) {
                EXPECT_TRUE(std::ranges::binary_search(found, t)) << t;
            }
    EXPECT_LT(found.size(), mesh.indices.size() / 3 / 5) << "a disc of 2 mm is a twenty-fifth of the sphere";
}
