// The errata as measured have the sizes that docs/design/skin.md and docs/design/skin-error.md state.

#include "lab/verify/errata.h"
#include "tests/lab/verify/fixture.h"

#include <algorithm>
#include <cmath>

using namespace tegument;
using namespace tegument::test;

namespace {

class ErrataMeasured : public Verify {
protected:
    /// Measured once for all tests.
    static const Errata& errata(gpu::Device& device) {
        static const Result<Errata> kMeasured = measureErrata(device, {.compiler = defaultCompiler()});
        EXPECT_TRUE(kMeasured) << format(kMeasured.error());
        return *kMeasured;
    }

    static const Erratum& find(const Errata& errata, const std::string& finding, const std::string& quantity) {
        const auto found = std::ranges::find_if(errata.list, [&](const Erratum& e) {
            return e.finding.find(finding) != std::string::npos && e.quantity.find(quantity) != std::string::npos;
        });
        if (found == errata.list.end()) throw std::runtime_error("no erratum " + finding + ", " + quantity);
        return *found;
    }

    static const EdgeRow& row(const Errata& errata, const std::string& name, double texel) {
        const auto found = std::ranges::find_if(
            errata.edges, [&](const EdgeRow& r) { return r.name.starts_with(name) && std::abs(r.texel - texel) < 1e-9; });
        if (found == errata.edges.end()) throw std::runtime_error("no row " + name);
        return *found;
    }
};

} // namespace

TEST_F(ErrataMeasured, the_corrected_form_is_never_further_from_the_truth_than_the_printed_one) {
    for (const Erratum& e : errata(*device_).list)
        EXPECT_LE(std::abs(e.correctedError()), std::abs(e.printedError())) << e.finding << ", " << e.quantity;
}

TEST_F(ErrataMeasured, the_printed_exponent_halves_red_light_behind_two_millimetres) {
    const Erratum& e = find(errata(*device_), "Transmission exponent", "2 mm");
    EXPECT_NEAR(e.printed, 0.094, 5e-4);
    EXPECT_NEAR(e.truth, 0.194, 5e-4);
}

TEST_F(ErrataMeasured, ten_passes_of_the_printed_kernel_gain_one_per_cent) {
    const Erratum& e = find(errata(*device_), "Kernel sums", "ten passes");
    EXPECT_NEAR(e.printed, std::pow(1.001, 10), 1e-5); // float targets
    EXPECT_NEAR(e.corrected, 1, 1e-5);
}

TEST_F(ErrataMeasured, the_seed_s_widest_gaussian_is_wider_by_a_sixth_and_more) {
    const Erratum& e = find(errata(*device_), "own sigma", "Gaussian 6");
    // sqrt of the sum of v_2 .. v_6 is 3.19 mm; the kernel's own variance makes it sqrt(1.0789) times that.
    EXPECT_NEAR(e.printed, 3.19 * std::sqrt(1.0789), 0.02);
    EXPECT_NEAR(e.corrected, e.truth, 0.003);
}

TEST_F(ErrataMeasured, what_is_drawn_in_setting_corrected_is_row_b_of_the_study) {
    for (double texel : {0.15, 0.30}) {
        const EdgeRow& drawn = row(errata(*device_), "drawn, setting corrected", texel);
        const EdgeRow& study = row(errata(*device_), "B:", texel);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(drawn.largest[c], study.largest[c], 5e-4) << texel << " mm, channel " << c; // 32-bit floats
            EXPECT_NEAR(drawn.rms[c], study.rms[c], 2e-4) << texel << " mm, channel " << c;
        }
    }
}

TEST_F(ErrataMeasured, halving_the_texel_helps_more_than_correcting_the_kernel) {
    const EdgeRow& coarse = row(errata(*device_), "drawn, setting deon2007", 0.30);
    const EdgeRow& corrected = row(errata(*device_), "drawn, setting corrected", 0.30);
    const EdgeRow& fine = row(errata(*device_), "drawn, setting deon2007", 0.15);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(fine.largest[c], 0.5 * coarse.largest[c]);
        EXPECT_GT(corrected.largest[c], 0.8 * coarse.largest[c]);
    }
}

TEST_F(ErrataMeasured, the_tables_name_every_finding) {
    const std::string text = errataMarkdown(errata(*device_));
    for (const Erratum& e : errata(*device_).list)
        EXPECT_NE(text.find(e.finding), std::string::npos);
}
