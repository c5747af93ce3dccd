#include "lab/verify/errata.h"

#include "generated/setting_names.h"
#include "host/image/image.h"
#include "lab/reference/convolution.h"
#include "lab/reference/edge_study.h"
#include "lab/reference/profile.h"
#include "lab/reference/skin.h"
#include "lab/reference/specular.h"
#include "lab/verify/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tegument::verify {
namespace {

/// The six maps of Convolution.fx in the middle row, divided by the light far inside. The edge lies `phase` texels before a texel's centre;
/// `texel` mm.
struct DrawnEdge {
    double texel = 0;
    double phase = 0;
    std::vector<std::vector<double>> maps; // six rows

    /// Weighted by the profile and read back linearly between texels.
    [[nodiscard]] reference::EdgeResponse response() const;
    /// Variance of what has blurred one map, mm^2, its texels' own square included. For phase 1/2, where the edge lies between two texels
    /// and the unblurred map does not show that square.
    [[nodiscard]] double variance(std::size_t map) const;
};

constexpr std::array kMaps = {"gIrradianceMap",  "gIrradiance2Map", "gIrradiance3Map",
                              "gIrradiance4Map", "gIrradiance5Map", "gIrradiance6Map"};

/// Colour that makes the light an edge: black, white, and between them the texel that the edge crosses, by its share. With gMix = 1 all of
/// the colour is taken before diffusion. Floats, which are taken as linear.
Image edgeColour(int size, double phase) {
    Image image = plainImage(size, 1, 4);
    const int middle = size / 2;
    for (int x = 0; x < size; ++x) {
        const double share = std::clamp(x - middle + phase + 0.5, 0.0, 1.0);
        for (int c = 0; c < 3; ++c)
            image.at(x, 0, c) = static_cast<float>(share);
        image.at(x, 0, 3) = 1;
    }
    return image;
}

reference::EdgeResponse DrawnEdge::response() const {
    return [self = *this](double x) {
        const auto size = static_cast<double>(self.maps[0].size());
        const double place = std::clamp(x / self.texel - self.phase + size / 2, 0.0, size - 1);
        const auto left = std::min(static_cast<std::size_t>(place), self.maps[0].size() - 2);
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < self.maps.size(); ++i)
            sum += reference::skinProfile()[i].weight *
                   std::lerp(self.maps[i][left], self.maps[i][left + 1], place - static_cast<double>(left));
        return sum;
    };
}

double DrawnEdge::variance(std::size_t map) const {
    const std::vector<double>& row = maps[map];
    double mean = 0;
    double square = 0;
    double whole = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        const double x = static_cast<double>(i) + 0.5;
        const double w = row[i + 1] - row[i];
        whole += w;
        mean += w * x;
        square += w * x * x;
    }
    mean /= whole;
    return (square / whole - mean * mean + 1.0 / 12) * texel * texel;
}

Result<DrawnEdge> drawEdge(const Context& context, double texel, double phase) {
    const int size = context.options.mapSize;
    Mesh mesh = verify::squareMesh(static_cast<float>(0.5 * texel * size));
    mesh.textures = {{.role = "color", .image = edgeColour(size, phase)}};
    Workspace workspace = worldWorkspace();
    workspace.camera.position = {0, 0, 500};
    workspace.light.direction = glm::vec3(0, 0, -1);
    workspace.light.width = 1e-3F; // the edge is one of colour: no shadow's filter has been over it
    const auto run = render(context,
                            {.effect = "Convolution.fx",
                             .technique = "Convolution",
                             .dump = {kMaps.begin(), kMaps.end()},
                             .parameters = {{"gMix", {1}}, {"gSpecularIntensity", {0}}},
                             .defines = {{"TEGUMENT_MAP_BITS", "32"}}},
                            &mesh, workspace);
    if (!run) return run.error();
    const double light = run->dumped.at("gIrradianceMap").at(size * 7 / 8, size / 2, 0);
    DrawnEdge edge{.texel = texel, .phase = phase};
    for (const char* map : kMaps) {
        std::vector<double> row;
        for (int x = 0; x < size; ++x)
            row.push_back(run->dumped.at(map).at(x, size / 2, 0) / light);
        edge.maps.push_back(std::move(row));
    }
    return edge;
}

} // namespace
} // namespace tegument::verify

namespace tegument {

namespace {

using namespace std::string_literals;
using reference::skinProfile;

constexpr double kFootprint = 0.25; // mm seen by a pixel
constexpr int kPhases = 8;

void addTransmission(Errata& errata) {
    for (double d : {1.0, 2.0, 4.0}) {
        double printed = 0;
        for (const reference::Gaussian& g : skinProfile())
            printed += g.weight.r * std::exp(-d * d / g.variance);
        const double truth = reference::slab(skinProfile(), d).r;
        errata.list.push_back(
            {"Transmission exponent: exp(-d^2/v), right exp(-d^2/(2v))", fmt::format("red light behind {} mm", d), printed, truth, truth});
    }
}

void addUnits(Errata& errata) {
    // One stores exp(-20 t) with 100 mm to the unit, the other reads -5 ln alpha in mm: consistent only at that unit.
    constexpr double kThickness = 3;
    errata.list.push_back({"Units: exp(-20 t) written, -5 ln(alpha) mm read", "3 mm, meshes in millimetres", -5 * -20 * kThickness,
                           -5 * -0.2 * kThickness, kThickness});
    errata.list.push_back({"Units: exp(-20 t) written, -5 ln(alpha) mm read", "3 mm, meshes in metres", -5 * -20 * kThickness / 1000,
                           -5 * -0.2 * kThickness, kThickness});
}

/// Millimetres by which a surface may lie behind another and still count as lit: 0.005 of z/w between these planes.
double toleranceAt(double distance, double nearPlane, double farPlane) {
    return 0.005 * (farPlane - nearPlane) * distance * distance / (farPlane * nearPlane);
}

void addShadow(Errata& errata) {
    const std::string finding = "Shadow tolerance 0.005 of z/w (seed)";
    errata.list.push_back({finding, "mm at 600 mm, planes 400 and 800", toleranceAt(600, 400, 800), 0.3, 0});
    errata.list.push_back({finding, "mm at 600 mm, planes 100 and 1000", toleranceAt(600, 100, 1000), 0.3, 0});
}

void addDisc(Errata& errata) {
    glm::dvec2 mean(0);
    for (const auto& p : reference::kPrintedDisc)
        mean += glm::dvec2(p[0], p[1]) / 13.0;
    errata.list.push_back({"Poisson disc not centred", "shift of the light per blur, of the radius", glm::length(mean), 0, 0});
}

/// The call that fills the printed table, KS_Skin_Specular(V, N, L, m, 0.0277778), taken by the listed signature (N, L, V, m, rho_s): the
/// eye becomes the normal, the normal the light, the light the eye, and the reflectance at normal incidence the intensity.
double albedoOfLiteralCall(double cosine, double m, double f0) {
    constexpr int kNodes = 80;
    const glm::dvec3 normal{0, 0, 1};
    const glm::dvec3 toEye{std::sqrt(1 - cosine * cosine), 0, cosine};
    double sum = 0;
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kNodes; ++j) {
            const double phi = 2 * std::numbers::pi * i / (kNodes - 1);
            const double theta = 0.5 * std::numbers::pi * j / (kNodes - 1);
            const glm::dvec3 toLight{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
            sum += std::sin(theta) * glm::dot(toEye, normal) *
                   reference::kelemenBrdf(toEye, normal, toLight, {.m = m, .f0 = f0, .rhoS = 0.0277778});
        }
    return sum * std::numbers::pi * std::numbers::pi / (kNodes * kNodes);
}

void addLiteralCall(Errata& errata) {
    const double f0 = reference::skinSettings(kSettingDeon2007).fresnel0;
    for (double cosine : {0.2, 0.8}) {
        const double truth = reference::directionalAlbedo(cosine, 0.3, f0) / std::numbers::pi;
        errata.list.push_back({"Order of arguments in the table's call", fmt::format("albedo, m = 0.3, cos = {}, divided by pi", cosine),
                               albedoOfLiteralCall(cosine, 0.3, f0) / std::numbers::pi, truth, truth});
    }
}

void addClamp(Errata& errata) {
    const double printed = reference::directionalAlbedo(0.05, 0.1, reference::skinSettings(kSettingDeon2007).fresnel0);
    const double truth = 1 - printed / std::numbers::pi;
    errata.list.push_back({"Diffuse light turns negative (rho_s = 1, table not divided by pi)",
                           "share left to diffusion, m = 0.1, cos = 0.05", 1 - printed, truth, truth});
}

double tableAt(const Image& table, double cosine, double m) {
    const int x = static_cast<int>(cosine * table.width);
    const int y = static_cast<int>(m * table.height);
    const int column = std::min(x, table.width - 1);
    const int row = std::min(y, table.height - 1);
    return static_cast<double>(table.at(column, row, 0)) + static_cast<double>(table.at(column, row, 1)); // two halves
}

/// The printed and the corrected table as the device draws them, at the centres of texels near the usual places.
Result<void> addAlbedo(Errata& errata, gpu::Device& device, VerifyOptions options) {
    std::vector<Image> tables;
    for (const char* setting : {kSettingDeon2007, kSettingCorrected}) {
        options.setting = setting;
        const auto run = verify::render({device, options}, {.effect = "EnergyAttenuation.fx", .dump = {"gEnergyAttenuationMap"}});
        if (!run) return run.error();
        tables.push_back(run->dumped.at("gEnergyAttenuationMap"));
    }
    const double printedF0 = reference::skinSettings(kSettingDeon2007).fresnel0;
    const double correctedF0 = reference::skinSettings(kSettingCorrected).fresnel0;
    const double texel = 1.0 / tables[0].width;
    const auto centre = [&](double x) { return (std::floor(x / texel) + 0.5) * texel; };
    for (double m : {0.1, 0.2, 0.3})
        for (double cosine : {0.05, 0.5, 0.99}) {
            const double c = centre(cosine);
            const double r = centre(m);
            const double truth = reference::directionalAlbedo(c, r, printedF0) / std::numbers::pi;
            const double correctedTruth = reference::directionalAlbedo(c, r, correctedF0) / std::numbers::pi;
            const double corrected = tableAt(tables[1], cosine, m);
            const std::string place = fmt::format("albedo, m = {:.3f}, cos = {:.3f}", r, c);
            errata.list.push_back({"Energy table pi too large", place + ", printed integral exact", truth * std::numbers::pi, corrected,
                                   truth, correctedTruth});
            errata.list.push_back({"Energy table, 80 x 80 end-point rule", place + ", divided by pi",
                                   reference::directionalAlbedoPrinted(c, r, printedF0, 80) / std::numbers::pi, corrected, truth,
                                   correctedTruth});
            errata.list.push_back({"Energy table, 32 x 32 end-point rule (what shader model 3 can do)", place + ", divided by pi",
                                   tableAt(tables[0], cosine, m) / std::numbers::pi, corrected, truth, correctedTruth});
        }
    return {};
}

/// Sum after ten passes, from technique White; widths, from the edge.
Result<void> addKernel(Errata& errata, gpu::Device& device, VerifyOptions options) {
    std::vector<double> gains;
    std::vector<verify::DrawnEdge> edges;
    options.mapSize = 512;
    for (const char* setting : kSettingNames) {
        options.setting = setting;
        auto edge = verify::drawEdge({device, options}, 0.15, 0.5);
        if (!edge) return edge.error();
        gains.push_back(edge->maps[5][static_cast<std::size_t>(options.mapSize) * 7 / 8]);
        edges.push_back(std::move(*edge));
    }
    errata.list.push_back({"Kernel sums to 1.001", "constant light after ten passes", gains[1], gains[2], 1});
    // What the maps should be as wide as: the Gaussian's variance, and never less than that of a texel.
    for (std::size_t map : {1U, 3U, 5U}) {
        const double truth = std::sqrt(skinProfile()[map].variance);
        errata.list.push_back({"Kernel variance 1.0789, variance of interpolated taps",
                               fmt::format("width of Gaussian {} at 0.15 mm/texel, mm", map + 1), std::sqrt(edges[1].variance(map)),
                               std::sqrt(edges[2].variance(map)), truth});
        errata.list.push_back({"Each pass its own sigma (seed)", fmt::format("width of Gaussian {} at 0.15 mm/texel, mm", map + 1),
                               std::sqrt(edges[0].variance(map)), std::sqrt(edges[2].variance(map)), truth});
    }
    return {};
}

EdgeRow rowOf(std::string name, double texel, const reference::EdgeError& error) {
    EdgeRow row{.name = std::move(name), .texel = texel};
    for (int c = 0; c < 3; ++c) {
        row.largest[c] = error.largest[c];
        row.rms[c] = error.rms[c];
    }
    return row;
}

Result<reference::EdgeError> drawnError(gpu::Device& device, VerifyOptions options, double texel, const char* setting) {
    options.setting = setting;
    options.mapSize = 256;
    std::vector<verify::DrawnEdge> edges;
    for (int phase = 0; phase < kPhases; ++phase) {
        auto edge = verify::drawEdge({device, options}, texel, static_cast<double>(phase) / kPhases);
        if (!edge) return edge.error();
        edges.push_back(std::move(*edge));
    }
    const auto response = [&](double phase) { return edges[static_cast<std::size_t>(std::lround(phase * kPhases))].response(); };
    return reference::edgeError(response, kFootprint, kPhases);
}

Result<void> addEdges(Errata& errata, gpu::Device& device, const VerifyOptions& options) {
    const auto study = [&](const char* name, const reference::EdgePipeline& pipeline) {
        const auto error = reference::edgeError([&](double phase) { return reference::edgeOf(pipeline, phase); }, kFootprint, kPhases);
        errata.edges.push_back(rowOf(name, pipeline.texel, error));
    };
    errata.edges.push_back(rowOf("not diffused", 0, reference::edgeError([](double) { return reference::sharpEdge(); }, kFootprint, 1)));
    for (double texel : {0.15, 0.30}) {
        study("A: as printed, float64", {.texel = texel});
        study("A': as printed, first blur by the increment, float64", {.texel = texel, .countedFirst = skinProfile()[0].variance});
        study("B: normalised, right variance, float64", {.texel = texel, .normalised = true});
        study("C: B, first Gaussian sharp per pixel, float64", {.texel = texel, .normalised = true, .sharpFirst = true});
        study("D: B, first two Gaussians exact per pixel, float64", {.texel = texel, .normalised = true, .exact = 2});
        for (const char* setting : kSettingNames) {
            const auto error = drawnError(device, options, texel, setting);
            if (!error) return error.error();
            errata.edges.push_back(rowOf("drawn, setting "s + setting, texel, *error));
        }
    }
    return {};
}

} // namespace

Result<Errata> measureErrata(gpu::Device& device, const VerifyOptions& options) {
    Errata errata;
    addTransmission(errata);
    if (const auto done = addAlbedo(errata, device, options); !done) return done.error();
    if (const auto done = addKernel(errata, device, options); !done) return done.error();
    addLiteralCall(errata);
    addClamp(errata);
    addUnits(errata);
    addShadow(errata);
    addDisc(errata);
    if (const auto done = addEdges(errata, device, options); !done) return done.error();
    return errata;
}

std::string errataMarkdown(const Errata& errata) {
    std::string text = "| finding | quantity | exact | printed | error | corrected | error |\n|---|---|---|---|---|---|---|\n";
    for (const Erratum& e : errata.list)
        text += fmt::format("| {} | {} | {:.4f} | {:.4f} | {:+.4f} | {:.4f} | {:+.4f} |\n", e.finding, e.quantity, e.truth, e.printed,
                            e.printedError(), e.corrected, e.correctedError());
    text += "\n| edge of light on a plane | mm/texel | largest error R / G / B | rms R / G / B |\n|---|---|---|---|\n";
    for (const EdgeRow& row : errata.edges)
        text += fmt::format("| {} | {} | {:.4f} / {:.4f} / {:.4f} | {:.4f} / {:.4f} / {:.4f} |\n", row.name,
                            row.texel > 0 ? fmt::format("{:.2f}", row.texel) : "-", row.largest[0], row.largest[1], row.largest[2],
                            row.rms[0], row.rms[1], row.rms[2]);
    return text;
}

} // namespace tegument
