// What a device's rasteriser makes of effects/FurRoots.fx: pictures of `tegument verify`'s regression check beside the same in double
// precision, with corners as they are and with corners on the device's grid (docs/design/reference.md, "Corners on a grid").

#include "host/image/compare.h"
#include "lab/measure/need.h"
#include "lab/verify/corner_grid.h"
#include "lab/verify/fur_regression.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace tegument;
using namespace tegument::measure;
using verify::StrandsScene;
using verify::SweptPicture;

/// Differences of pixels that count, largest of three channels, over the mean of one of the pictures.
struct Differences {
    std::vector<double> each;

    [[nodiscard]] double percentile(double share) const {
        std::vector<double> sorted = each;
        std::ranges::sort(sorted);
        return sorted.empty() ? 0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    }
};

double meanOf(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels)
        sum += static_cast<double>(value);
    return sum / static_cast<double>(image.pixels.size());
}

Differences differences(const Image& a, const Image& b, const std::vector<std::uint8_t>& counts, double mean) {
    Differences all;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        double largest = 0;
        for (std::size_t c = 0; c < 3; ++c)
            largest = std::max(largest, static_cast<double>(std::abs(a.pixels[3 * i + c] - b.pixels[3 * i + c])) / mean);
        all.each.push_back(largest);
    }
    return all;
}

/// How far `grid - exact` explains `drawn - exact`: their correlation, and how many times the former the latter is. Pixels that differ by
/// more than a twentieth of the mean, where another strand is met, would decide alone and are left out.
struct Explained {
    double correlation = 0;
    double times = 0;
};

Explained explained(const Image& drawn, const SweptPicture& exact, const SweptPicture& grid, const std::vector<std::uint8_t>& counts,
                    double mean) {
    double drawnSquare = 0;
    double gridSquare = 0;
    double both = 0;
    for (std::size_t i = 0; i < 3 * counts.size(); ++i) {
        const double d = static_cast<double>(drawn.pixels[i] - exact.picture.pixels[i]) / mean;
        const double g = static_cast<double>(grid.picture.pixels[i] - exact.picture.pixels[i]) / mean;
        if (counts[i / 3] == 0 || std::max(std::abs(d), std::abs(g)) > 0.05) continue;
        drawnSquare += d * d;
        gridSquare += g * g;
        both += d * g;
    }
    return gridSquare > 0 && drawnSquare > 0 ? Explained{both / std::sqrt(drawnSquare * gridSquare), both / gridSquare} : Explained{};
}

void printRow(const std::string& scene, const char* corners, const Differences& d) {
    fmt::print("| {} | {} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} |\n", scene, corners, d.each.size(), d.percentile(0.5),
               d.percentile(0.9), d.percentile(0.95), d.percentile(0.99), d.percentile(0.999));
    std::fflush(stdout);
}

struct Program {
    const verify::Context& context;
    double step; // of the grid, pixels

    void measure(const StrandsScene& scene) const {
        const Image drawn = need(verify::renderStrands(context, scene));
        const SweptPicture exact = verify::drawSwept(scene, context.options, 0);
        const SweptPicture grid = verify::drawSwept(scene, context.options, step);
        std::vector<std::uint8_t> counts = exact.counts;
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] = counts[i] != 0 && grid.counts[i] != 0 ? 1 : 0;
        const double mean = meanOf(exact.picture);
        const std::string name = scene.technique + ", " + scene.name;
        printRow(name, "drawn - exact corners", differences(drawn, exact.picture, counts, mean));
        printRow(name, "drawn - corners on the grid", differences(drawn, grid.picture, counts, mean));
        printRow(name, "corners on the grid - exact corners", differences(grid.picture, exact.picture, counts, mean));
        const Explained how = explained(drawn, exact, grid, counts, mean);
        rows.push_back(fmt::format("| {} | {:.3f} | {:.3f} |", name, how.correlation, how.times));
    }

    mutable std::vector<std::string> rows;
};

} // namespace

int main(int argc, char** argv) {
    VerifyOptions options;
    std::string wanted;
    double bits = 8;
    CLI::App app{"effects/FurRoots.fx on a device, beside itself in double precision with exact corners and with corners on a grid"};
    app.add_option("--effects", options.effects, "folder of the effect files")->capture_default_str();
    app.add_option("--device", wanted, "part of the device's name");
    app.add_option("--size", options.pictureSize, "pixels along a side")->capture_default_str();
    app.add_option("--map-size", options.mapSize, "texels along a side of the shadow map")->capture_default_str();
    app.add_option("--bits", bits, "of the grid below a pixel, where the device is found to have none")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    options.compiler = defaultCompiler();

    gpu::Device device = need(gpu::Device::create({.validation = false, .prefer = wanted}));
    const verify::Context context{device, options};
    const verify::CornerGrid grid = need(verify::measureCornerGrid(context));
    fmt::print("{}, {}, {}\n", device.info().name, device.info().driver, compilerName(options.compiler));
    fmt::print("places between corners: {:.3g} pixels (RMS) from exact corners; ", grid.exact);
    if (grid.step > 0)
        fmt::print("{:.3g} from corners on a grid of 1/{:.0f} pixel, which explains most\n\n", grid.remaining, 1 / grid.step);
    else
        fmt::print("no grid from 1/4 to 1/4096 pixel explains half of it\n\n");
    fmt::print("| scene | difference / mean | pixels | p50 | p90 | p95 | p99 | p999 |\n|---|---|---|---|---|---|---|---|\n");
    const Program program{.context = context, .step = grid.step > 0 ? grid.step : std::ldexp(1.0, -static_cast<int>(bits)), .rows = {}};
    for (const char* technique : {"Cellular", "Roots"}) {
        program.measure(need(verify::strandsNearBy(options, technique)));
        program.measure(need(verify::strandsFarAway(options, technique)));
    }
    fmt::print("\n| scene | correlation of (drawn - exact) with (grid - exact) | times |\n|---|---|---|\n");
    for (const std::string& row : program.rows)
        fmt::print("{}\n", row);
}
