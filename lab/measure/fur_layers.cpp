// Tables of docs/design/fur-layers.md: what layers of fur lose of a patch of strands whose picture is known, however many there are and
// however they are spread; how many are needed; what the adaptive count chooses. --plot FILE.svg draws the errors.

#include "lab/reference/fur_patch.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace tegument::reference;

constexpr std::array kTilts = {0.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0};
constexpr std::array kCoats = {2.0, 4.0, 8.0, 12.0};
constexpr std::array kExponents = {0.5, 0.7, 1.0, 1.4, 2.0};
constexpr double kPixel = 0.5; // spacings
constexpr int kMost = 1024;    // layers that are tried
constexpr int kCells = 11;     // of a sweep: eight steps of one spacing, and those beside
constexpr double kSegment = 3; // gFurSegment and gFurFewest of effects/FurRoots.fx
constexpr int kFewest = 4;
constexpr int kLayers = 32;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

FurMethod shells(int layers, double exponent = 1) {
    return {.kind = FurMethod::Kind::Shells, .layers = layers, .cells = 0, .exponent = exponent};
}

FurMethod swept(int layers, double exponent = 1) {
    return {.kind = FurMethod::Kind::Swept, .layers = layers, .cells = kCells, .exponent = exponent};
}

/// One view of one coat, and its true picture.
class Scene {
public:
    Scene(double coat, double tilt) : patch_{.coat = coat}, view_{.tilt = radians(tilt), .pixel = kPixel, .size = 28, .samples = 3} {
        truth_ = drawPatch(patch_, view_, {});
    }
    [[nodiscard]] double error(const FurMethod& method) const { return furError(drawPatch(patch_, view_, method), truth_).rms; }
    [[nodiscard]] double gap(const FurMethod& method) const { return coverageGap(patch_, view_, method); }
    [[nodiscard]] const FurPatch& patch() const { return patch_; }
    [[nodiscard]] double tilt() const { return view_.tilt; }

private:
    FurPatch patch_;
    FurView view_;
    std::vector<double> truth_;
};

/// The largest shift on the screen, in pixels, between the pictures of one strand on two neighbouring layers.
double visibleStep(const Scene& scene, int layers, double exponent) {
    double largest = 0;
    for (int l = 1; l <= layers; ++l)
        largest = std::max(largest, layerHeight(static_cast<double>(l) / layers, exponent) - layerHeight((l - 1.0) / layers, exponent));
    return scene.patch().coat * largest * std::sin(scene.tilt()) / kPixel;
}

/// The fewest layers whose error is at most `most`, by halving; kMost + 1 where none is.
template <class Method>
int needed(const Scene& scene, double most, Method method) {
    if (scene.error(method(kMost)) > most) return kMost + 1;
    int low = 0;
    int high = 1;
    while (scene.error(method(high)) > most) {
        low = high;
        high *= 2;
    }
    while (high - low > std::max(1, high / 50)) {
        const int middle = (low + high) / 2;
        (scene.error(method(middle)) > most ? low : high) = middle;
    }
    return high;
}

std::string count(int layers) {
    return layers > kMost ? fmt::format("> {}", kMost) : fmt::format("{}", layers);
}

void spreadTable() {
    fmt::print("## Spread: layers at L (l / n)^p\n\nCoat of 8 spacings, pixel of half a spacing, point-sampled shells.\n\n"
               "| n | tilt | quantity |");
    for (const double p : kExponents)
        fmt::print(" p = {} |", p);
    fmt::print("\n|---|---|---|---|---|---|---|---|\n");
    for (const double tilt : {0.0, 45.0, 70.0, 85.0}) {
        const Scene scene(8, tilt);
        for (const int n : {16, 64}) {
            const auto row = [&](const char* name, const char* form, auto value) {
                fmt::print("| {} | {} | {} |", n, tilt, name);
                for (const double p : kExponents)
                    fmt::print(" {} |", fmt::format(fmt::runtime(form), value(p)));
                fmt::print("\n");
            };
            row("error, RMS", "{:.4f}", [&](double p) { return scene.error(shells(n, p)); });
            row("coverage gap, %", "{:.1f}", [&](double p) { return 100 * scene.gap(shells(n, p)); });
            row("visible step, px", "{:.2f}", [&](double p) { return visibleStep(scene, n, p); });
            row("outline, px", "{:.2f}", [&](double p) { return outlineGap(scene.patch(), n, p) * std::sin(scene.tilt()) / kPixel; });
        }
    }
}

int adaptive(const Scene& scene) {
    const double travel = scene.patch().coat * std::tan(scene.tilt());
    const double needed = std::max(travel / kSegment, static_cast<double>(kFewest));
    return kLayers >> static_cast<int>(std::max(std::floor(std::log2(kLayers / needed)), 0.0));
}

void neededTable() {
    fmt::print(
        "\n## Needed\n\nLayers for an error of 0.01 and of 0.03; pixel of half a spacing.\n\n"
        "| coat, spacings | tilt | shells 0.03 | shells 0.01 | swept 0.03 | swept 0.01 | law, 0.01 | adaptive | its error | its gap, % |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
    for (const double coat : kCoats)
        for (const double tilt : kTilts) {
            const Scene scene(coat, tilt);
            const auto points = [](int n) { return shells(n); };
            const auto sweeps = [](int n) { return swept(n); };
            const int chosen = adaptive(scene);
            fmt::print("| {} | {} | {} | {} | {} | {} | {:.0f} | {} | {:.4f} | {:.1f} |\n", coat, tilt, count(needed(scene, 0.03, points)),
                       count(needed(scene, 0.01, points)), count(needed(scene, 0.03, sweeps)), count(needed(scene, 0.01, sweeps)),
                       std::ceil(0.27 * coat * std::tan(scene.tilt()) / 0.01), chosen, scene.error(swept(chosen)),
                       100 * scene.gap(swept(chosen)));
            std::fflush(stdout);
        }
}

/// Errors against layers, both axes logarithmic: 1 to 512 layers, 1e-4 to 1.
class Plot {
public:
    void line(const std::string& name, const std::string& colour, bool dashed, const std::vector<std::pair<int, double>>& points) {
        std::string path;
        for (const auto& [n, e] : points)
            path += fmt::format("{:.1f},{:.1f} ", x(n), y(e));
        body_ += fmt::format("<polyline fill='none' stroke='{}' stroke-width='2'{} points='{}'/>\n", colour,
                             dashed ? " stroke-dasharray='6 4'" : "", path);
        body_ +=
            fmt::format("<text x='590' y='{}' fill='{}'>{}{}</text>\n", 50 + 20 * lines_++, colour, dashed ? "- - " : "&#8212; ", name);
    }

    [[nodiscard]] bool write(const std::string& file) const {
        std::ofstream out(file);
        out << "<svg xmlns='http://www.w3.org/2000/svg' width='820' height='440' font-family='sans-serif' font-size='13'>\n"
               "<rect width='820' height='440' fill='white'/>\n";
        for (int n = 1; n <= 512; n *= 2)
            out << fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y1='40' y2='390' stroke='#ddd'/><text x='{0:.1f}' y='408' "
                               "text-anchor='middle'>{1}</text>\n",
                               x(n), n);
        for (int decade = -4; decade <= 0; ++decade)
            out << fmt::format("<line x1='70' x2='570' y1='{0:.1f}' y2='{0:.1f}' stroke='#ddd'/><text x='62' y='{0:.1f}' dy='4' "
                               "text-anchor='end'>{1:g}</text>\n",
                               y(std::pow(10, decade)), std::pow(10, decade));
        out << "<text x='320' y='428' text-anchor='middle'>layers</text><text x='70' y='26'>RMS error of the picture (range 0.05 to 1), "
               "coat of 8 spacings</text>\n"
            << body_ << "</svg>\n";
        return out.good();
    }

private:
    static double x(double n) { return 70 + 500 * std::log2(n) / 9; }
    static double y(double e) { return 390 + 350 * std::log10(std::clamp(e, 1e-4, 1.0)) / -4 - 350; }
    std::string body_;
    int lines_ = 0;
};

bool plot(const std::string& file) {
    const std::array<std::pair<double, const char*>, 4> views = {{{0, "#888"}, {45, "#1b9e77"}, {70, "#7570b3"}, {85, "#d95f02"}}};
    Plot drawn;
    for (const auto& [tilt, colour] : views) {
        const Scene scene(8, tilt);
        std::vector<std::pair<int, double>> points;
        std::vector<std::pair<int, double>> sweeps;
        for (int n = 1; n <= 512; n *= 2) {
            points.emplace_back(n, scene.error(shells(n)));
            sweeps.emplace_back(n, scene.error(swept(n)));
        }
        drawn.line(fmt::format("point-sampled, {:.0f} degrees", tilt), colour, true, points);
        drawn.line(fmt::format("swept, {:.0f} degrees", tilt), colour, false, sweeps);
    }
    return drawn.write(file);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Print the tables of docs/design/fur-layers.md");
    std::string file;
    app.add_option("--plot", file, "Draw errors against layers into this SVG instead");
    CLI11_PARSE(app, argc, argv);
    if (!file.empty()) {
        if (plot(file)) return 0;
        fmt::print(stderr, "{} cannot be written\n", file);
        return 1;
    }
    spreadTable();
    neededTable();
    return 0;
}
