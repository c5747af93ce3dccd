// Which mesh roots were made for.
#include "meshprep/fur/roots/surface_figures.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <algorithm>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

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
    EXPECT_FALSE(figuresIn(Image{.width = 2, .height = 1, .channels = 4, .pixels = std::vector<float>(8, 1), .metadata = {}}));
}
