// Profiles against each other, and against simulated skin.

#include "lab/reference/skin_profiles.h"
#include "tests/lab/reference/near.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tegument::reference;

namespace {

/// Light of a sum of Gaussians, as a simulation without noise would count it.
RingHistogram ringsOf(const Profile& profile, int channel) {
    RingHistogram rings;
    for (std::size_t i = 0; i < RingHistogram::kRings; ++i) {
        const double near = RingHistogram::edge(i);
        const double far = RingHistogram::edge(i + 1);
        rings.add(0.5 * (near + far), discCentre(profile, far)[channel] - discCentre(profile, near)[channel]);
    }
    return rings;
}

SimulatedSkin skinOf(const Profile& profile) {
    SimulatedSkin skin;
    for (int c = 0; c < 3; ++c)
        skin[static_cast<std::size_t>(c)].rings = ringsOf(profile, c);
    return skin;
}

const SimulatedSkin& simulated() {
    static const SimulatedSkin kSkin = simulateSkin(100'000, 3);
    return kSkin;
}

/// 100,000 photons find half of the light within 0.2 % of the light, four standard errors; published with three digits.
constexpr double kNoise = 6e-3;

} // namespace

TEST(SkinProfiles, edge_of_light_from_rings_is_the_closed_form_of_their_profile) {
    for (const double x : {-1.0, 0.0, 0.02, 0.4, 3.0})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(halfPlane(ringsOf(skinProfile(), c), x), halfPlane(skinProfile(), x)[c], 2e-4) << x << ": rings 2 % wide";
}

TEST(SkinProfiles, a_profile_has_no_error_against_itself) {
    const ModelError error = modelError(named("", "", skinProfile()), skinOf(skinProfile()));
    expectNear(error.within, glm::dvec3(0), 3e-4); // energy is spread evenly within a ring
    expectNear(error.halfPlane, glm::dvec3(0), 3e-4);
}

/// To one unit of the last digit that was published; the refits' coefficients are rounded to three digits too.
TEST(SkinProfiles, refits_miss_the_six_gaussians_by_what_is_published_of_them) {
    const auto edgeOf = [](int count) { return modelError(named("", "", refittedProfile(count)), skinOf(skinProfile())).halfPlane; };
    expectNear(edgeOf(5), {.0003, .0003, .0003}, 6e-4);
    expectNear(edgeOf(4), {.0015, .0030, .0045}, 6e-4);
    expectNear(edgeOf(3), {.0069, .0045, .0082}, 6e-4);
    expectNear(edgeOf(2), {.017, .040, .047}, 1.1e-3);
}

TEST(SkinProfiles, the_burley_nearest_to_the_six_gaussians_misses_their_edge_by_what_is_published) {
    const ModelError error = modelError(namedBurley("", "", {.451, .104, .070}), skinOf(skinProfile()));
    expectNear(error.halfPlane, {.029, .044, .059}, 1e-3);
}

/// The tables once more, in the order of the document that prints them: variance, red, green, blue. Three digits: others that round to the
/// same are as good.
TEST(SkinProfiles, hold_what_is_printed) {
    using Rows = std::vector<std::array<double, 4>>;
    const auto expectPrinted = [](const Profile& profile, const Rows& rows) {
        ASSERT_EQ(profile.size(), rows.size());
        glm::dvec3 sum(0);
        for (const auto& [variance, red, green, blue] : rows)
            sum += glm::dvec3(red, green, blue);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_NEAR(profile[i].variance, rows[i][0], 1e-12);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(profile[i].weight[c], rows[i][static_cast<std::size_t>(c) + 1] / sum[c], 1e-12) << i;
        }
    };
    expectPrinted(refittedProfile(2), {{.0178, .418, .917, .994}, {1.8439, .582, .083, .006}});
    expectPrinted(refittedProfile(3), {{.0088, .249, .589, .833}, {.1231, .263, .404, .167}, {2.3929, .488, .007, 0}});
    expectPrinted(refittedProfile(4), {{.0073, .251, .496, .743}, {.0746, .142, .449, .257}, {.6649, .296, .054, 0}, {3.5484, .310, 0, 0}});
    expectPrinted(refittedProfile(5), {{.0064, .237, .455, .654},
                                       {.0496, .091, .353, .338},
                                       {.2115, .170, .188, .005},
                                       {1.5963, .386, .003, .002},
                                       {6.1879, .116, .001, 0}});
    expectPrinted(physicalProfile(), {{.0003, .058, .084, .119},
                                      {.0048, .129, .182, .240},
                                      {.0421, .242, .357, .437},
                                      {.2429, .269, .303, .204},
                                      {5.0122, .137, .068, 0},
                                      {70.33, .164, .006, 0}});
}

TEST(SkinProfiles, every_table_is_white) {
    for (const Profile* profile :
         {&refittedProfile(2), &refittedProfile(3), &refittedProfile(4), &refittedProfile(5), &conferenceProfile(), &physicalProfile()}) {
        expectNear(slab(*profile, 0), glm::dvec3(1), 2.1e-3); // the conference's red, as printed, sums to .998
    }
}

TEST(SkinProfiles, the_burley_that_fits_best_is_found) {
    SimulatedSkin skin;
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < RingHistogram::kRings; ++i) {
            const glm::dvec3 d(0.4, 0.2, 0.1);
            const double near = RingHistogram::edge(i);
            const double far = RingHistogram::edge(i + 1);
            const NamedProfile truth = namedBurley("", "", d);
            skin[static_cast<std::size_t>(c)].rings.add(0.5 * (near + far), (truth.within(far) - truth.within(near))[c]);
        }
    expectNear(fittedBurley(skin), {0.4, 0.2, 0.1}, 2e-3);
}

TEST(SkinProfiles, six_gaussians_misplace_the_energy_that_is_published) {
    const ModelError error = modelError(named("", "", skinProfile()), simulated());
    expectNear(error.within, {.147, .148, .200}, kNoise);
    expectNear(error.halfPlane, {.056, .066, .077}, kNoise);
}

TEST(SkinProfiles, the_physical_fit_is_ten_times_closer_at_an_edge_of_light) {
    const glm::dvec3 table = modelError(named("", "", skinProfile()), simulated()).halfPlane;
    const glm::dvec3 fit = modelError(named("", "", physicalProfile()), simulated()).halfPlane;
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(fit[c], 0.15 * table[c]) << "channel " << c;
}
