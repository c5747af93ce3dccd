// The two precomputed tables: Beckmann's distribution and the directional albedo.

#include "generated/setting_names.h"
#include "lab/reference/skin.h"
#include "lab/reference/specular.h"
#include "lab/verify/work.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace tegument::verify {

namespace {

/// f(x, y) at the texel centres of a table over the unit square.
Image tabulate(int width, int height, const std::function<double(double, double)>& f) {
    Image image = plainImage(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y, 0) = static_cast<float>(f((x + 0.5) / width, (y + 0.5) / height));
    return image;
}

/// hlsl/surface/halves.fxh.
Image sumOfHalves(const Image& image) {
    Image sum = plainImage(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum.at(x, y, 0) = image.at(x, y, 0) + image.at(x, y, 1);
    return sum;
}

Image firstChannel(const Image& image) {
    Image first = plainImage(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            first.at(x, y, 0) = image.at(x, y, 0);
    return first;
}

double bilinear(const Image& image, double u, double v) {
    const auto clampTo = [](double value, int size) { return std::clamp(value, 0.0, size - 1.0); };
    const double x = clampTo(u * image.width - 0.5, image.width);
    const double y = clampTo(v * image.height - 0.5, image.height);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, image.width - 1);
    const int y1 = std::min(y0 + 1, image.height - 1);
    const double top = std::lerp(double{image.at(x0, y0, 0)}, double{image.at(x1, y0, 0)}, x - x0);
    const double bottom = std::lerp(double{image.at(x0, y1, 0)}, double{image.at(x1, y1, 0)}, x - x0);
    return std::lerp(top, bottom, y - y0);
}

/// Largest relative error of the distribution read back from the texture as an engine would, where it exceeds 5 % of its peak.
double decodedError(const Image& table, double m, double lastCosine) {
    double largest = 0;
    const double peak = reference::beckmannPH(1, m);
    for (int i = 0; i <= 4000; ++i) {
        const double cosine = lastCosine * i / 4000;
        const double exact = reference::beckmannPH(cosine, m);
        if (exact < 0.05 * peak) continue;
        largest = std::max(largest, std::abs(std::pow(2 * bilinear(table, cosine, m), 10) / exact - 1));
    }
    return largest;
}

/// The most that both layers send out of white light from one direction: rho_s rho + (1 - rho_s rho) times what the diffuse light keeps on
/// leaving, the mean of 1 - rho_s rho over the cosine. rho_s = 1.
double largestReflectance(const Image& albedo) {
    double largest = 0;
    for (int y = 0; y < albedo.height; ++y) {
        double kept = 0;
        for (int x = 0; x < albedo.width; ++x)
            kept += 2 * (1 - albedo.at(x, y, 0)) * (x + 0.5) / albedo.width / albedo.width;
        for (int x = 0; x < albedo.width; ++x) {
            const double reflected = albedo.at(x, y, 0);
            largest = std::max(largest, reflected + (1 - reflected) * kept);
        }
    }
    return largest;
}

} // namespace

Result<ModuleReport> verifyBeckmann(const Context& context) {
    ModuleReport report{.module = "Beckmann",
                        .summary =
                            "The texture, 0.5 PH^0.1, against the formula at its texels; and PH as an engine reads it back, bilinearly"};
    const auto run = render(context, {.effect = "Beckmann.fx", .dump = {"gBeckmannMap"}});
    if (!run) return run.error();
    const Image table = firstChannel(run->dumped.at("gBeckmannMap"));
    const Image exact =
        tabulate(table.width, table.height, [](double c, double m) { return 0.5 * std::pow(reference::beckmannPH(c, m), 0.1); });
    // A PH below 1e-30 is stored as 0.5e-3; the mean of the table is 0.22.
    const auto compared = compare(report, context, {"gBeckmannMap", table, exact, {}},
                                  {.relativeL2 = 1.5e-3,
                                   .p99 = 2.5e-3,
                                   .largest = 2.5e-3,
                                   .bias = kHalfStep,
                                   .why = "a half truncated to 10 bits; PH below 1e-30 is stored as 5e-4, 0.0023 of the mean"});
    if (!compared) return compared.error();
    for (double m : {0.1, 0.2, 0.3, 0.5}) {
        const double step = 1.0 / table.width;
        addMetric(report, context, "PH read back, m = " + std::to_string(m).substr(0, 3) + ": largest relative",
                  decodedError(table, m, 1 - step / 2), 10 * kHalfStep + step * step / (m * m * m * m),
                  "ten times a half's step, and the bend of the lobe between texels, which goes with (step / m^2)^2");
    }
    report.notes.emplace_back(
        "cosines within half a texel of 1 are left out of the read-back: the look-up clamps there (docs/design/modules/Beckmann.md)");
    return report;
}

Result<ModuleReport> verifyEnergyAttenuation(const Context& context) {
    const bool corrected = context.options.setting == kSettingCorrected;
    ModuleReport report{.module = "EnergyAttenuation",
                        .summary = corrected ? "The albedo texture against Gauss-Legendre quadrature of the reflectance"
                                             : "The texture of the printed rule with 32 x 32 nodes against that rule in double precision"};
    const auto run = render(context, {.effect = "EnergyAttenuation.fx", .dump = {"gEnergyAttenuationMap"}});
    if (!run) return run.error();
    const Image table = sumOfHalves(run->dumped.at("gEnergyAttenuationMap"));
    constexpr int kNodes = 32; // of the shader: what shader model 3 is sure to execute
    const double f0 = reference::skinSettings(context.options.setting).fresnel0;
    const Image exact = tabulate(table.width, table.height, [&](double c, double m) {
        return corrected ? reference::directionalAlbedo(c, m, f0) / std::numbers::pi
                         : reference::directionalAlbedoPrinted(c, m, f0, kNodes);
    });
    const Limits quadrature{.relativeL2 = 3e-3,
                            .p99 = 3e-2,
                            .largest = 0.1,
                            .bias = 1e-3,
                            .why = "1024 midpoints; the largest errors stand where the horizon cuts the lobe, at cosines below 0.05"};
    const Limits rounding{
        .relativeL2 = 1e-5,
        .p99 = 1e-4,
        .largest = 1e-3,
        .bias = 1e-5,
        .why = "1024 terms summed in 32-bit floats; at m < 0.02 the lobe falls between nodes and PH amplifies the rounding of N.H"};
    const auto compared = compare(report, context, {"gEnergyAttenuationMap", table, exact, {}}, corrected ? quadrature : rounding);
    if (!compared) return compared.error();
    if (corrected) // the printed table is pi times an albedo: docs/design/skin-error.md
        addMetric(report, context, "white furnace: largest reflectance of both layers, rho_s = 1", largestReflectance(table), 1,
                  "no more comes out than went in");
    return report;
}

} // namespace tegument::verify
