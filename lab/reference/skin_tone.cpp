#include "lab/reference/skin_tone.h"

#include "host/support/parallel.h"
#include "lab/reference/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

namespace tegument::reference {

namespace {

/// Molar extinction of haemoglobin with and without oxygen, 1/(cm M), 380 to 720 nm (Prahl 1999).
constexpr Spectrum kOxygenated = {109564,  167748,  266232,  466840,  480360, 246072, 102580,  62816, 44480, 33209.2, 26629.2, 23684.4,
                                  20932.8, 20035.2, 24202.4, 39956.8, 53236,  43016,  32613.2, 44496, 50104, 14400.8, 3200,    1506,
                                  942,     610,     442,     368,     319.6,  294,    277.6,   276,   290,   314,     348};
constexpr Spectrum kReduced = {145232, 167780,  223296,  303956,  407560,  528600,  413280,  103292,  23388.8, 16156.4, 14550,   16684,
                               20862,  25773.6, 31589.6, 39036.4, 46592,   53412,   53788,   45072,   37020,   28324.4, 14677.2, 9443.6,
                               6509.6, 5148.8,  4345.2,  3750.12, 3226.56, 2795.12, 2407.92, 2051.96, 1794.28, 1540.48, 1325.88};
/// CIE standard illuminant D65.
constexpr Spectrum kDaylight = {49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811,
                                109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100,     96.3342, 95.788,  88.6856, 90.0062, 89.5991,
                                87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349,  61.604};

constexpr double kFirstWavelength = 380;
constexpr double kWavelengthStep = 10;
/// Wavelengths that photons are followed at: scattering is linear between them within 1 %.
constexpr std::array<double, 9> kWhiteNodes = {380, 420, 460, 500, 540, 580, 620, 660, 720};

double bloodAbsorption(double wavelength, double oxygenation) {
    constexpr double kGramsPerLitre = 150;
    constexpr double kGramsPerMole = 64500;
    const double place = std::clamp((wavelength - kFirstWavelength) / kWavelengthStep, 0.0, kWavelengths - 1.0);
    const auto i = std::min(static_cast<std::size_t>(place), kWavelengths - 2);
    const double part = place - static_cast<double>(i);
    const auto at = [&](const Spectrum& s) { return std::lerp(s.at(i), s.at(i + 1), part); };
    const double perCentimetre =
        std::numbers::ln10 * kGramsPerLitre / kGramsPerMole * std::lerp(at(kReduced), at(kOxygenated), oxygenation);
    return perCentimetre / 10;
}

double bell(double x, double middle, double below, double above) {
    const double t = (x - middle) * (x < middle ? below : above);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 matching(double l) {
    return {1.056 * bell(l, 599.8, .0264, .0323) + .362 * bell(l, 442, .0624, .0374) - .065 * bell(l, 501.1, .0490, .0382),
            .821 * bell(l, 568.8, .0213, .0247) + .286 * bell(l, 530.9, .0613, .0322),
            1.217 * bell(l, 437, .0845, .0278) + .681 * bell(l, 459, .0385, .0725)};
}

/// XYZ, each of white 1.
glm::dvec3 tristimulus(const Spectrum& reflectance) {
    glm::dvec3 sum(0);
    glm::dvec3 white(0);
    for (std::size_t i = 0; i < kWavelengths; ++i) {
        const glm::dvec3 weight = matching(wavelengthOf(i)) * kDaylight.at(i);
        sum += weight * reflectance.at(i);
        white += weight;
    }
    return sum / white;
}

} // namespace

double wavelengthOf(std::size_t i) {
    return kFirstWavelength + kWavelengthStep * static_cast<double>(i);
}

Flesh fleshOf(const SkinTone& tone, double l) {
    const double eumelanin = 6.6e10 * std::pow(l, -3.33);
    const double pheomelanin = 2.9e14 * std::pow(l, -4.75);
    const double base = .0244 + 8.53 * std::exp(-(l - 154) / 66.2);
    Flesh flesh;
    flesh.epidermis = {14.74 * std::pow(l, -.22) + 2.2e11 * std::pow(l, -4),
                       tone.melanin * std::lerp(pheomelanin, eumelanin, tone.eumelanin) + (1 - tone.melanin) * base};
    flesh.dermis = {4.6 * std::pow(l / 500, -1.421), tone.blood * bloodAbsorption(l, tone.oxygenation) + (1 - tone.blood) * base};
    return flesh;
}

double effectiveAttenuation(const SkinTone& tone, double wavelength) {
    const LayerOptics dermis = fleshOf(tone, wavelength).dermis;
    return std::sqrt(3 * dermis.absorption * (dermis.absorption + dermis.scattering));
}

glm::dvec3 fleshFactor(const SkinTone& tone) {
    constexpr double kOfAttenuation = 1.1;
    return kOfAttenuation * glm::dvec3(effectiveAttenuation(tone, kToneColors[0]), effectiveAttenuation(tone, kToneColors[1]),
                                       effectiveAttenuation(tone, kToneColors[2]));
}

glm::dvec3 linearSrgb(const Spectrum& reflectance) {
    const glm::dvec3 xyz = tristimulus(reflectance) * glm::dvec3(.95047, 1, 1.08883);
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - .4985314 * xyz.z, -.9692660 * xyz.x + 1.8760108 * xyz.y + .0415560 * xyz.z,
            .0556434 * xyz.x - .2040259 * xyz.y + 1.0572252 * xyz.z};
}

SkinColor colorOf(const Spectrum& reflectance) {
    const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const glm::dvec3 xyz = tristimulus(reflectance);
    return {116 * root(xyz.y) - 16, 500 * (root(xyz.x) - root(xyz.y)), 200 * (root(xyz.y) - root(xyz.z))};
}

double SkinColor::typologyAngle() const {
    return std::atan2(lightness - 50, b) * 180 / std::numbers::pi;
}

const char* typologyOf(double angle) {
    return angle > 55    ? "very light"
           : angle > 41  ? "light"
           : angle > 28  ? "intermediate"
           : angle > 10  ? "tan"
           : angle > -30 ? "brown"
                         : "dark";
}

WhitePhotons::WhitePhotons(std::size_t photons, std::uint64_t seed) : nodes_(kWhiteNodes.size()), photons_(photons) {
    forEachInParallel(kWhiteNodes.size(), [&](std::size_t node) {
        std::seed_seq seeds{seed, static_cast<std::uint64_t>(node)};
        std::mt19937_64 random(seeds);
        const Uniform uniform = [&] { return std::generate_canonical<double, 53>(random); };
        Flesh flesh = fleshOf({}, kWhiteNodes.at(node));
        flesh.epidermis.absorption = flesh.dermis.absorption = 0;
        const PlateBody body(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < photons;) {
            const double cosine = std::sqrt(1 - uniform());
            const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
            const Entering inside = entering({sine, 0, cosine}, {0, 0, -1}, flesh.index);
            if (uniform() < inside.mirrored) continue; // each that is followed has entered
            ++i;
            followInBody(body, flesh, {0, 0, 1e-6}, inside.direction, 1, uniform, [&](const LeavingPhoton& photon) {
                nodes_[node].push_back({static_cast<std::uint32_t>(RingHistogram::ringOf(std::hypot(photon.place.x, photon.place.y))),
                                        static_cast<float>(photon.inEpidermis), static_cast<float>(photon.inDermis),
                                        static_cast<float>(photon.energy)});
            });
        }
    });
}

ToneResponse WhitePhotons::response(const SkinTone& tone) const {
    std::vector<std::vector<double>> rings(kWavelengths, std::vector<double>(RingHistogram::kRings, 0.0));
    forEachInParallel(kWavelengths, [&](std::size_t i) {
        const double l = wavelengthOf(i);
        const Flesh flesh = fleshOf(tone, l);
        const auto above =
            std::clamp<std::ptrdiff_t>(std::ranges::lower_bound(kWhiteNodes, l) - kWhiteNodes.begin(), 1, std::ssize(kWhiteNodes) - 1);
        for (const auto node : {static_cast<std::size_t>(above - 1), static_cast<std::size_t>(above)}) {
            const auto other = node == static_cast<std::size_t>(above) ? node - 1 : node + 1;
            const double share =
                (kWhiteNodes.at(other) - l) / (kWhiteNodes.at(other) - kWhiteNodes.at(node)) / static_cast<double>(photons_);
            if (share <= 0) continue;
            for (const Leaving& leaving : nodes_[node])
                rings[i][leaving.ring] +=
                    share * leaving.energy *
                    std::exp(-flesh.epidermis.absorption * leaving.inEpidermis - flesh.dermis.absorption * leaving.inDermis);
        }
    });
    ToneResponse response;
    Spectrum column{};
    for (std::size_t ring = 0; ring < RingHistogram::kRings; ++ring) {
        for (std::size_t i = 0; i < kWavelengths; ++i) {
            column.at(i) = rings[i][ring];
            response.spectrum.at(i) += column.at(i);
        }
        const glm::dvec3 color = linearSrgb(column);
        for (int c = 0; c < 3; ++c)
            response.rings.at(static_cast<std::size_t>(c)).add(0.5 * (RingHistogram::edge(ring) + RingHistogram::edge(ring + 1)), color[c]);
    }
    response.albedo = linearSrgb(response.spectrum);
    return response;
}

namespace {

/// What the edge of light and the share within a radius are compared at, mm.
constexpr std::size_t kFitPlaces = 70;
double fitPlace(std::size_t i) {
    constexpr double kNearest = 0.02;
    constexpr double kFarthest = 25;
    return kNearest * std::pow(kFarthest / kNearest, static_cast<double>(i) / (kFitPlaces - 1));
}

/// Both at each place for a Gaussian, of 1; last the sum, which counts as all places of one curve do.
using FitRow = std::array<double, 2 * kFitPlaces + 1>;
constexpr double kSumCounts = 8;
FitRow rowOf(double variance) {
    FitRow row{};
    for (std::size_t i = 0; i < kFitPlaces; ++i) {
        const double x = fitPlace(i);
        row.at(i) = 0.5 * (1 + std::erf(x / std::sqrt(2 * variance)));
        row.at(kFitPlaces + i) = 1 - std::exp(-x * x / (2 * variance));
    }
    row.back() = kSumCounts;
    return row;
}
FitRow rowOf(const RingHistogram& rings) {
    FitRow row{};
    for (std::size_t i = 0; i < kFitPlaces; ++i) {
        row.at(i) = halfPlane(rings, fitPlace(i));
        row.at(kFitPlaces + i) = rings.within(fitPlace(i)) / rings.total();
    }
    row.back() = kSumCounts;
    return row;
}

/// Least squares with no unknown below 0, by the normal equations (Lawson and Hanson 1974, algorithm NNLS): unknowns above 0 solve theirs
/// exactly, and the one by which the error falls fastest joins them, until there is none.
class NonNegative {
public:
    explicit NonNegative(std::size_t unknowns) : unknowns_(unknowns), matrix_(unknowns * unknowns, 0.0), right_(unknowns, 0.0) {}
    void add(const std::vector<double>& row, double target) {
        for (std::size_t i = 0; i < unknowns_; ++i) {
            right_[i] += row[i] * target;
            for (std::size_t j = 0; j < unknowns_; ++j)
                matrix_[i * unknowns_ + j] += row[i] * row[j];
        }
    }
    [[nodiscard]] std::vector<double> solve() const {
        std::vector<double> x(unknowns_, 0.0);
        std::vector<std::size_t> above;
        for (std::size_t round = 0; round < 3 * unknowns_; ++round) {
            std::optional<std::size_t> steepest;
            double most = kLeastSlope * *std::ranges::max_element(right_);
            for (std::size_t i = 0; i < unknowns_; ++i) {
                double slope = right_[i];
                for (const std::size_t j : above)
                    slope -= matrix_[i * unknowns_ + j] * x[j];
                if (slope <= most || std::ranges::find(above, i) != above.end()) continue;
                most = slope;
                steepest = i;
            }
            if (!steepest) break;
            above.push_back(*steepest);
            while (!moveTo(x, solved(above), above)) {
            }
        }
        return x;
    }

private:
    static constexpr double kLeastSlope = 1e-10;
    static constexpr double kRidge = 1e-10; // of the diagonal: neighbouring polynomials are nearly alike

    /// As far as all stay above 0; those that get there leave. Whether the whole way was gone.
    static bool moveTo(std::vector<double>& x, const std::vector<double>& target, std::vector<std::size_t>& above) {
        double part = 1;
        for (std::size_t i = 0; i < above.size(); ++i)
            if (target[i] <= 0) part = std::min(part, x[above[i]] / (x[above[i]] - target[i]));
        for (std::size_t i = 0; i < above.size(); ++i)
            x[above[i]] += part * (target[i] - x[above[i]]);
        if (part == 1) return true;
        std::erase_if(above, [&](std::size_t i) { return x[i] < 1e-14 ? (x[i] = 0, true) : false; });
        return false;
    }

    /// Of the chosen unknowns alone, by Cholesky's factors.
    [[nodiscard]] std::vector<double> solved(const std::vector<std::size_t>& chosen) const {
        const std::size_t n = chosen.size();
        std::vector<double> l(n * n);
        std::vector<double> y(n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = matrix_[chosen[i] * unknowns_ + chosen[j]] * (i == j ? 1 + kRidge : 1);
                for (std::size_t k = 0; k < j; ++k)
                    sum -= l[i * n + k] * l[j * n + k];
                l[i * n + j] = i == j ? std::sqrt(sum) : sum / l[j * n + j];
            }
            y[i] = right_[chosen[i]];
            for (std::size_t k = 0; k < i; ++k)
                y[i] -= l[i * n + k] * y[k];
            y[i] /= l[i * n + i];
        }
        for (std::size_t i = n; i-- > 0;) {
            for (std::size_t k = i + 1; k < n; ++k)
                y[i] -= l[k * n + i] * y[k];
            y[i] /= l[i * n + i];
        }
        return y;
    }

    std::size_t unknowns_;
    std::vector<double> matrix_, right_;
};

double bernstein(int degree, int k, double t) {
    double choose = 1;
    for (int i = 0; i < k; ++i)
        choose = choose * (degree - i) / (i + 1);
    return choose * std::pow(t, k) * std::pow(1 - t, degree - k);
}

} // namespace

Profile fittedProfile(const ToneResponse& response) {
    Profile profile;
    for (const double variance : kToneVariances)
        profile.push_back({variance, glm::dvec3(0)});
    for (int c = 0; c < 3; ++c) {
        const FitRow target = rowOf(response.rings.at(static_cast<std::size_t>(c)));
        NonNegative fit(profile.size());
        std::vector<FitRow> columns;
        for (const Gaussian& gaussian : profile)
            columns.push_back(rowOf(gaussian.variance));
        for (std::size_t i = 0; i < target.size(); ++i) {
            std::vector<double> row;
            for (const FitRow& column : columns)
                row.push_back(column.at(i));
            fit.add(row, target.at(i));
        }
        const std::vector<double> weights = fit.solve();
        const double sum = std::reduce(weights.begin(), weights.end());
        for (std::size_t k = 0; k < profile.size(); ++k)
            profile[k].weight[c] = weights[k] / sum;
    }
    return profile;
}

SkinTone toneOf(double melanin, double blood) {
    return {.melanin = melanin, .blood = blood, .eumelanin = 0.6 + 0.4 * (1 - std::exp(-melanin / 0.13))};
}

std::array<double, kToneTerms> toneTerms(double melanin, double blood) {
    const double u = std::clamp(std::log(melanin / kToneMelanin[0]) / std::log(kToneMelanin[1] / kToneMelanin[0]), 0.0, 1.0);
    const double v = std::clamp(std::log(blood / kToneBlood[0]) / std::log(kToneBlood[1] / kToneBlood[0]), 0.0, 1.0);
    std::array<double, kToneTerms> terms{};
    for (int i = 0; i <= kToneMelaninDegree; ++i)
        for (int j = 0; j <= kToneBloodDegree; ++j)
            terms.at(static_cast<std::size_t>(i * (kToneBloodDegree + 1) + j)) =
                bernstein(kToneMelaninDegree, i, u) * bernstein(kToneBloodDegree, j, v);
    return terms;
}

ToneTable fittedTable(const WhitePhotons& photons) {
    constexpr int kNodes = 16;            // along both
    constexpr double kLeastAlbedo = 0.01; // of darker ones an error counts less
    constexpr std::size_t kUnknowns = kToneVariances.size() * kToneTerms;
    std::array<NonNegative, 3> fits{NonNegative(kUnknowns), NonNegative(kUnknowns), NonNegative(kUnknowns)};
    std::array<FitRow, kToneVariances.size()> columns{};
    std::ranges::transform(kToneVariances, columns.begin(), [](double variance) { return rowOf(variance); });
    const auto place = [](const std::array<double, 2>& range, int i) {
        return range[0] * std::pow(range[1] / range[0], i / (kNodes - 1.0));
    };
    for (int node = 0; node < kNodes * kNodes; ++node) {
        const double melanin = place(kToneMelanin, node / kNodes);
        const double blood = place(kToneBlood, node % kNodes);
        const ToneResponse response = photons.response(toneOf(melanin, blood));
        const auto terms = toneTerms(melanin, blood);
        forEachInParallel(fits.size(), [&](std::size_t c) {
            const double albedo = response.albedo[static_cast<int>(c)];
            const double counts = 1 / std::max(albedo, kLeastAlbedo);
            const FitRow target = rowOf(response.rings.at(c));
            std::vector<double> row(kUnknowns);
            for (std::size_t i = 0; i < target.size(); ++i) {
                for (std::size_t k = 0; k < columns.size(); ++k)
                    for (std::size_t t = 0; t < kToneTerms; ++t)
                        row[k * kToneTerms + t] = counts * columns.at(k).at(i) * terms.at(t);
                fits.at(c).add(row, counts * albedo * target.at(i));
            }
        });
    }
    ToneTable table{};
    forEachInParallel(fits.size(), [&](std::size_t c) {
        const std::vector<double> weights = fits.at(c).solve();
        for (std::size_t k = 0; k < weights.size(); ++k)
            table.at(k / kToneTerms).at(k % kToneTerms)[static_cast<int>(c)] = weights[k];
    });
    return table;
}

Profile profileOf(const ToneTable& table, double melanin, double blood) {
    const auto terms = toneTerms(melanin, blood);
    Profile profile;
    for (std::size_t k = 0; k < kToneVariances.size(); ++k) {
        Gaussian gaussian{.variance = kToneVariances.at(k)};
        for (std::size_t t = 0; t < kToneTerms; ++t)
            gaussian.weight += terms.at(t) * table.at(k).at(t);
        profile.push_back(gaussian);
    }
    return profile;
}

} // namespace tegument::reference
