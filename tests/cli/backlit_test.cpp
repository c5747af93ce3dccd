// Skin that is lit from behind: light must not come through a thin part, as an ear is, that stands between the lamp and skin.

#include "host/image/image.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

using namespace tegument::test;

namespace {

constexpr double kBall = 30;    // mm, its radius
constexpr double kShield = 60;  // mm, half of its side: larger than the picture
constexpr double kDark = 0.012; // lit skin has .1 to 1 here, the brightest that is in shadow, some way from the light, .008

/// A mesh as OBJ text, lengths in units of so many mm.
class Obj {
public:
    explicit Obj(double unit) : unit_(unit) {}

    /// (columns + 1) x (rows + 1) points; triangles are counter-clockwise seen from where s x t points to.
    void patch(int columns, int rows, const std::function<glm::dvec3(double, double)>& place, const glm::dvec2& corner,
               const glm::dvec2& size) {
        const int first = points_ + 1;
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i, ++points_) {
                const glm::dvec2 at(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
                const glm::dvec3 p = place(at.x, at.y) / unit_;
                const glm::dvec2 uv = corner + size * at;
                text_ += fmt::format("v {:.9g} {:.9g} {:.9g}\nvt {:.9g} {:.9g}\n", p.x, p.y, p.z, uv.x, uv.y);
            }
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const int a = first + j * (columns + 1) + i;
                const int c = a + columns + 1;
                triangle(a, a + 1, c + 1);
                triangle(a, c + 1, c);
            }
    }

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void triangle(int a, int b, int c) { text_ += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", a, b, c); }

    double unit_;
    int points_ = 0;
    std::string text_;
};

struct Wall {
    double thickness = 2; // mm
    int shadowSize = 512; // a texel has 0.33 mm of the scene there
    int facets = 96;      // around the ball
    double tilt = 0;      // of the light from the shield's normal, degrees
    double unit = 1;      // mm
    double embedded = 9;  // mm from the ball's middle to the back of the shield that it sticks in
};

/// What of the ball stands out behind the shield, from its pole on the axis z; the light comes along +z. Its skin turns to the light more
/// and more up to where it meets the shield, as a head's does behind an ear.
std::string ballBehindShield(const Wall& wall) {
    Obj obj(wall.unit);
    const double last = std::acos(-wall.embedded / kBall);
    const auto ball = [&](double s, double t) {
        const double around = -2 * std::numbers::pi * s;
        const double down = std::max(last * t, 1e-3); // no triangle without area at the pole
        return kBall * glm::dvec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down));
    };
    obj.patch(wall.facets, wall.facets, ball, {0.02, 0.02}, {0.44, 0.96});
    const double front = -wall.embedded - wall.thickness;
    const auto face = [](double z, double turn) {
        return [=](double s, double t) { return glm::dvec3(turn * kShield * (2 * s - 1), kShield * (2 * t - 1), z); };
    };
    obj.patch(8, 8, face(front, -1), {0.56, 0.05}, {0.4, 0.4});
    obj.patch(8, 8, face(-wall.embedded, 1), {0.56, 0.55}, {0.4, 0.4});
    const std::array<glm::dvec2, 5> corners = {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (std::size_t side = 0; side < 4; ++side)
        obj.patch(8, 1,
                  [&](double s, double t) {
                      return glm::dvec3(kShield * glm::mix(corners[side], corners[side + 1], s), glm::mix(front, -wall.embedded, t));
                  },
                  {0.56, 0.462 + 0.02 * static_cast<double>(side)}, {0.4, 0.005});
    return obj.text();
}

/// The largest value of a picture in which all is in shadow.
float brightest(const Wall& wall) {
    const std::string mesh = write("shield.obj", ballBehindShield(wall));
    const double tilt = wall.tilt * std::numbers::pi / 180;
    const std::string workspace = write("shield.json", fmt::format(R"({{"mesh": "{}", "unit_mm": {}, "head": false, 
               "camera": {{"frame": "world", "position": [246, 30, 171], "target": [20, 0, -6], "horizontal_fov": 8}},
               "light": {{"frame": "world", "position": [{}, 10, {}], "color": [10, 10, 10]}}}})",
                                                                   mesh, wall.unit, 600 * std::sin(tilt), -600 * std::cos(tilt)));
    const std::string file = (scratch() / "shield.exr").string();
    const Ran ran =
        tegument::test::tegument({"render", "effects/Pyramid.fx", "-t", "Pyramid", "-w", workspace, "--size", "320", "--samples", "1",
                                  "--map-size", "512", "--shadow-size", std::to_string(wall.shadowSize), "-o", file});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto image = tegument::loadImage(file);
    if (!image || image->channels != 4) return 1e9F;
    float largest = 0;
    for (std::size_t i = 0; i < image->pixels.size(); ++i)
        if (i % 4 != 3) largest = std::max(largest, image->pixels[i]);
    return largest;
}

} // namespace

// What a texel of the shadow map cannot tell apart is its tolerance, 0.3 mm, and what the skin rises within a texel: where it meets the
// wall, N.L is .3, so at most 1.25 * sqrt(2) * 3.2 texels of 0.65, 0.33, 0.16 or 0.08 mm.
TEST(Backlit, no_light_comes_through_thin_walls) {
    for (const auto& [thickness, shadowSize] : {std::pair{5.0, 256}, {3.0, 512}, {1.5, 1024}, {1.0, 2048}})
        EXPECT_LT(brightest({.thickness = thickness, .shadowSize = shadowSize}), kDark) << thickness << " mm, " << shadowSize << " texels";
}

TEST(Backlit, no_light_comes_through_a_wall_on_skin_that_turns_along_the_light) {
    for (const auto& [thickness, shadowSize] : {std::pair{4.0, 512}, {3.0, 512}, {2.0, 1024}, {1.0, 2048}})
        EXPECT_LT(brightest({.thickness = thickness, .shadowSize = shadowSize, .embedded = 3.6}), kDark)
            << thickness << " mm, " << shadowSize << " texels";
}

TEST(Backlit, no_light_comes_through_whatever_the_tilt_the_unit_and_the_facets) {
    EXPECT_LT(brightest({.thickness = 3, .tilt = 20}), kDark);
    EXPECT_LT(brightest({.thickness = 3, .tilt = -20}), kDark);
    EXPECT_LT(brightest({.thickness = 3, .unit = 1000}), kDark);
    EXPECT_LT(brightest({.thickness = 3, .facets = 32}), kDark);
}
