// effects/FurRoots.fx beside exact strands in space, through the windows of `tegument verify`: what bends of strands, and how many layers,
// are worth (docs/design/fur-layers.md, "Against exact strands that bend").

#include "lab/verify/fur_exact.h"
#include "host/image/compare.h"
#include "lab/measure/need.h"
#include "lab/verify/fur_regression.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace tegument;
using namespace tegument::measure;
using verify::FurWindow;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Image counted(const Image& image, const std::vector<std::uint8_t>& counts) {
    Image row{.width = 0, .height = 1, .channels = 3, .pixels = {}, .metadata = {}};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        row.pixels.insert(row.pixels.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(3 * i),
                          image.pixels.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
        ++row.width;
    }
    return row;
}

} // namespace

int main(int argc, char** argv) {
    VerifyOptions options;
    std::vector<std::string> names;
    std::vector<std::string> techniques = {"Cellular", "Roots"};
    verify::WindowChange change;
    int samples = 4;
    CLI::App app{"effects/FurRoots.fx beside exact strands in space"};
    app.add_option("names", names, "windows; else all");
    std::string meshFile;
    double unitMm = 1;
    app.add_option("--mesh", meshFile, "file, in place of the windows");
    app.add_option("--unit-mm", unitMm, "of the file")->capture_default_str();
    app.add_option("--technique", techniques, "Cellular, Roots")->capture_default_str();
    app.add_option("--effects", options.effects, "folder of the effect files")->capture_default_str();
    app.add_option("--size", options.pictureSize, "twice the pixels along a side")->capture_default_str();
    app.add_option("--map-size", options.mapSize, "texels along a side of the shadow map")->capture_default_str();
    app.add_option("--samples", samples, "of the truth, along a side of a pixel")->capture_default_str();
    app.add_option("--layers", change.layers, "of the coat");
    app.add_option("--fewest", change.fewest, "layers drawn");
    app.add_option("--scatter", change.scatter, "spacings");
    app.add_option("--curls", change.curls, "spacings");
    app.add_option("--tufts", change.tufts, "spacings");
    app.add_option("--lean", change.lean, "share of the coat");
    app.add_option("--comb", change.comb, "share of the coat");
    app.add_option("--pixel", change.pixel, "spacings");
    app.add_option("--tilt", change.tilt, "degrees");
    app.add_option("--coat", change.coat, "spacings");
    CLI11_PARSE(app, argc, argv);
    options.compiler = defaultCompiler();
    Mesh mesh;
    const Workspace workspace;
    if (!meshFile.empty()) {
        mesh = need(loadMesh(meshFile, {.unitMm = unitMm}));
        options.mesh = &mesh;
        options.workspace = &workspace;
    }
    gpu::Device device = need(gpu::Device::create({.validation = false, .prefer = {}}));
    fmt::print("| window | relative L2 | bias | set apart | seconds of rays |\n|---|---|---|---|---|\n");
    for (const std::string& name : names.empty() ? verify::windowNames(options) : names)
        for (const std::string& technique : techniques) {
            FurWindow window = need(verify::makeWindow(options, technique, name, change));
            window.samples = samples;
            VerifyOptions own = options;
            own.pictureSize = window.size;
            const Image drawn = need(verify::renderStrands({device, own}, window.strands));
            const auto start = std::chrono::steady_clock::now();
            const verify::ExactPicture exact = verify::drawExact(window, options);
            const double seconds = secondsSince(start);
            const Difference difference = need(compareImages(counted(drawn, exact.counts), counted(exact.picture, exact.counts)));
            fmt::print("| {}, {} | {:.4f} | {:+.4f} | {:.3f} | {:.1f} |\n", technique, name, difference.relativeL2, difference.bias,
                       verify::shareApart(exact.counts, exact.covered), seconds);
            std::fflush(stdout);
        }
}
