// Units of light: what the conventions promise about the light's colour and about the directional albedo.
// Skin that is lit from behind: light must not come through a thin part, as an ear is, that stands between the lamp and skin.

#include "host/image/image.h"
#include "tests/cli/picture.h"
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
using ::tegument::Image;

namespace {

/// A square of 400 mm facing +z, UVs over the whole map.
std::string planeObj() {
    return "v -200 -200 0\nv 200 -200 0\nv 200 200 0\nv -200 200 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
           "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
}

/// Lit head-on from `distance` mm by a light of colour (0.7, 0.5, 0.3).
std::string planeWorkspace(double distance) {
    const Image white{.width = 4, .height = 4, .channels = 3, .pixels = std::vector<float>(48, 1.0F)};
    EXPECT_TRUE(writePng(scratch() / "white.png", white, ::tegument::PngEncoding::Raw));
    return write(fmt::format("plane-{:g}.json", distance),
                 fmt::format(R"({{"mesh": "{}", "unit_mm": 1, "head": false, "textures": {{"DIFFUSE": "white.png"}},
 "camera": {{"frame": "world", "position": [0, 0, 600]}},
 "light": {{"frame": "world", "position": [0, 0, {}], "color": [0.7, 0.5, 0.3]}}}})",
                             write("plane.obj", planeObj()), distance));
}

void expectColourAtCentre(const Image& image) {
    const float expected[3] = {0.7F, 0.5F, 0.3F};
    // Half targets hold 11 bits; a light at 1 m meets the centre pixel's neighbours at a cosine of 0.9999.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.at(image.width / 2, image.height / 2, c), expected[c], 2e-3) << "channel " << c;
}

/// Directional albedo of the Kelemen and Szirmay-Kalos lobe with Beckmann's distribution, rho_s = 1, by the midpoint rule over the sphere
/// of light directions, in double precision. m >= 0.2 and cosine >= 0.3 are smooth enough for 600 x 600 nodes (halving changes it by <
/// 1e-5).
double directionalAlbedo(double cosine, double m, double f0) {
    constexpr int kNodes = 600;
    constexpr double kPi = std::numbers::pi;
    const double sine = std::sqrt(1 - cosine * cosine);
    double sum = 0;
    for (int i = 0; i < kNodes; ++i) {
        const double theta = kPi / 2 * (i + 0.5) / kNodes;
        for (int j = 0; j < kNodes; ++j) {
            const double phi = kPi * (j + 0.5) / kNodes; // the other half turn is its mirror image
            const double l[3] = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
            const double h[3] = {l[0] + sine, l[1], l[2] + cosine};
            const double hh = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
            const double nh = h[2] / std::sqrt(hh);
            const double vh = (h[0] * sine + h[2] * cosine) / std::sqrt(hh);
            const double beckmann = std::exp((1 - 1 / (nh * nh)) / (m * m)) / (m * m * std::pow(nh, 4)) / kPi;
            const double fresnel = f0 + (1 - f0) * std::pow(1 - vh, 5);
            sum += beckmann * fresnel / hh * l[2] * std::sin(theta);
        }
    }
    return 2 * sum * (kPi / 2 / kNodes) * (kPi / kNodes);
}

Image energyMap(const std::string& setting) {
    const auto picture =
        render("energy-" + setting, {"effects/EnergyAttenuation.fx", "--setting", setting, "--dump", "gEnergyAttenuationMap"});
    const auto image = ::tegument::loadImage(scratch() / ("energy-" + setting + ".gEnergyAttenuationMap.exr"));
    EXPECT_TRUE(image);
    return image ? *image : Image{};
}

struct Texel {
    int x;
    int y;
};

/// Cosine and roughness at the texel's centre.
double centre(int texel, int size) {
    return (texel + 0.5) / size;
}

/// Two halves.
double albedoAt(const Image& map, const Texel& texel) {
    return static_cast<double>(map.at(texel.x, texel.y, 0)) + static_cast<double>(map.at(texel.x, texel.y, 1));
}

constexpr Texel kSmooth[] = {{40, 26}, {64, 38}, {102, 38}, {127, 38}, {64, 64}, {110, 100}};

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

TEST(Pictures, a_white_plane_facing_the_light_has_its_colour) {
    for (const double distance : {1000.0, 4000.0})
        for (const char* technique : {"Lambert", "DEonLuebke"})
            expectColourAtCentre(render(fmt::format("plane-{}-{}", technique, distance),
                                        {"effects/Main.fx", "-w", planeWorkspace(distance), "--technique", technique, "--set",
                                         "gSpecularIntensity=0", "--size", "65x65", "--map-size", "256"})
                                     .image);
}

TEST(EnergyAttenuation, is_an_albedo_in_setting_corrected_and_pi_times_that_as_printed) {
    const Image corrected = energyMap("corrected");
    const Image printed = energyMap("deon2007");
    for (const Texel& texel : kSmooth) {
        const double cosine = centre(texel.x, corrected.width);
        const double m = centre(texel.y, corrected.height);
        // 32 x 32 midpoints of the importance-sampled integrand.
        EXPECT_NEAR(albedoAt(corrected, texel) / directionalAlbedo(cosine, m, 0.04), 1.0, 5e-3) << "cosine " << cosine << ", m " << m;
        // The printed end-point rule with 32 nodes loses up to a seventh here; the missing 1/pi is a factor of 3.14.
        EXPECT_NEAR(albedoAt(printed, texel) / directionalAlbedo(cosine, m, 0.028), std::numbers::pi, 0.5)
            << "cosine " << cosine << ", m " << m;
    }
}

TEST(Beckmann, the_texture_decodes_to_the_distribution) {
    ASSERT_EQ(render("beckmann", {"effects/Beckmann.fx", "--dump", "gBeckmannMap"}).report["technique"], "Beckmann");
    const auto map = ::tegument::loadImage(scratch() / "beckmann.gBeckmannMap.exr");
    ASSERT_TRUE(map);
    for (const Texel& texel :
         {Texel{300, 153}, Texel{400, 153}, Texel{450, 153}, Texel{500, 153}, Texel{505, 60}, Texel{256, 256}, Texel{480, 500}}) {
        const double tangent = std::tan(std::acos(centre(texel.x, map->width)));
        const double m = centre(texel.y, map->height);
        const double expected = std::exp(-tangent * tangent / (m * m)) / (m * m * std::pow(centre(texel.x, map->width), 4));
        // Lavapipe truncates to half: at most 2^-10 of the stored tenth power, ten times that after decoding.
        EXPECT_NEAR(std::pow(2.0 * map->at(texel.x, texel.y, 0), 10.0) / expected, 1.0, 10.0 / 1024)
            << "cosine texel " << texel.x << ", m " << m;
    }
}

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
