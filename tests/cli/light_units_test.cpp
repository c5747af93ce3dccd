// Units of light: what the conventions promise about the light's colour and about the directional albedo.

#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
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
    const Image white{.width = 4, .height = 4, .channels = 3, .pixels = std::vector<float>(48, 1.0F), .metadata = {}};
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
double directionalAlbedo(double cosine, double m) {
    constexpr int kNodes = 600;
    constexpr double kPi = std::numbers::pi;
    constexpr double kFresnel0 = 0.028;
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
            const double fresnel = kFresnel0 + (1 - kFresnel0) * std::pow(1 - vh, 5);
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
        const double expected = directionalAlbedo(cosine, m);
        // 32 x 32 midpoints of the importance-sampled integrand.
        EXPECT_NEAR(albedoAt(corrected, texel) / expected, 1.0, 5e-3) << "cosine " << cosine << ", m " << m;
        // The printed end-point rule with 32 nodes loses up to a seventh here; the missing 1/pi is a factor of 3.14.
        EXPECT_NEAR(albedoAt(printed, texel) / expected, std::numbers::pi, 0.5) << "cosine " << cosine << ", m " << m;
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
