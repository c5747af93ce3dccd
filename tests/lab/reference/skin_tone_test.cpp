// Colours of skin: closed forms of colorimetry, photons weighed afterwards against photons absorbed on their way, and the six classes.

#include "lab/reference/skin_profiles.h"
#include "lab/reference/skin_tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace tegument::reference;

namespace {

const WhitePhotons& white() {
    static const WhitePhotons kPhotons(20'000, 3);
    return kPhotons;
}

struct Named {
    const char* type;
    SkinTone tone;
};
constexpr std::array<Named, 6> kSkins = {{{"very light", {.006, .004, .6}},
                                          {"light", {.014, .006, .6}},
                                          {"intermediate", {.028, .008, .65}},
                                          {"tan", {.042, .009, .7}},
                                          {"brown", {.10, .010, .8}},
                                          {"dark", {.18, .010, .9}}}};

} // namespace

TEST(SkinTone, of_a_perfect_reflector_is_white) {
    Spectrum even{};
    even.fill(1);
    const glm::dvec3 color = linearSrgb(even);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(color[c], 1, 2e-3);
    even.fill(0.184);
    const SkinColor grey = colorOf(even);
    EXPECT_NEAR(grey.lightness, 50, 0.05); // CIE: the cube root of Y = .184
    EXPECT_NEAR(grey.a, 0, 1e-9);
    EXPECT_NEAR(grey.b, 0, 1e-9);
}

/// Jacques 2013: dermis at 500 nm scatters 46 / cm; oxygenated blood of 150 g/l absorbs 276 / cm at 542 nm.
TEST(SkinTone, has_the_published_coefficients) {
    EXPECT_NEAR(fleshOf({}, 500).dermis.scattering, 4.6, 1e-12);
    const double blood = fleshOf({0, 1, 1, 1}, 540).dermis.absorption;
    EXPECT_NEAR(blood, 2.303 * 150 / 64500 * 53236 / 10, 1e-3 * blood);
    EXPECT_GT(fleshOf({.1, .006}, 400).epidermis.absorption, fleshOf({.1, .006}, 600).epidermis.absorption);
}

/// A weight by the ways afterwards is what absorption takes on the way.
TEST(SkinTone, weighs_as_photons_are_absorbed) {
    const SkinTone tone{.05, .01, .7, .75};
    const ToneResponse response = white().response(tone);
    for (const double wavelength : {460.0, 540.0, 620.0}) {
        const Flesh flesh = fleshOf(tone, wavelength);
        std::mt19937_64 random(9);
        const Uniform uniform = [&] { return std::generate_canonical<double, 53>(random); };
        const PlateBody body(std::numeric_limits<double>::infinity());
        constexpr int kPhotons = 20'000;
        double out = 0;
        for (int i = 0; i < kPhotons;) {
            const double cosine = std::sqrt(1 - uniform());
            const Entering inside = entering({std::sqrt(1 - cosine * cosine), 0, cosine}, {0, 0, -1}, flesh.index);
            if (uniform() < inside.mirrored) continue;
            ++i;
            followInBody(body, flesh, {0, 0, 1e-6}, inside.direction, 1.0 / kPhotons, uniform,
                         [&](const LeavingPhoton& photon) { out += photon.energy; });
        }
        const double weighed = response.spectrum.at(static_cast<std::size_t>((wavelength - 380) / 10));
        EXPECT_NEAR(weighed, out, 0.03 * out + 0.002) << wavelength << " nm";
    }
}

TEST(SkinTone, of_six_skins_falls_into_the_six_classes) {
    for (const Named& skin : kSkins) {
        Spectrum seen = white().response(skin.tone).spectrum;
        for (double& value : seen)
            value *= 0.95; // a spectrophotometer's light enters once more through the surface that mirrors a part
        const SkinColor color = colorOf(seen);
        EXPECT_STREQ(typologyOf(color.typologyAngle()), skin.type) << color.typologyAngle();
        EXPECT_GT(color.a, 3);
        EXPECT_LT(color.a, 16);
    }
}

TEST(SkinTone, six_gaussians_of_all_skins_follow_the_photons) {
    for (const Named& skin : kSkins) {
        const ToneResponse response = white().response(skin.tone);
        const Profile profile = fittedProfile(response);
        glm::dvec3 sum(0);
        for (const Gaussian& gaussian : profile) {
            sum += gaussian.weight;
            EXPECT_GE(std::min({gaussian.weight.x, gaussian.weight.y, gaussian.weight.z}), 0);
        }
        const glm::dvec3 most(.005, .010, .040); // with 20,000 photons; blue of dark skin lies within .02 mm
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c], 1, 1e-9);
            double worst = 0;
            for (double x = 0.02; x < 20; x *= 1.3)
                worst = std::max(worst, std::abs(halfPlane(profile, x)[c] - halfPlane(response.rings.at(static_cast<std::size_t>(c)), x)));
            EXPECT_LT(worst, most[c]) << skin.type << ", channel " << c;
        }
    }
}
