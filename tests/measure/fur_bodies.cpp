// Table of docs/fur-layers.md, "Against exact strands": straight strands on a ball and a torus, drawn by effects/FurRoots.fx with few and
// many layers, beside exact rays against every strand.

#include "tests/measure/body_fur.h"
#include "tests/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace tegument;
using namespace tegument::measure;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

struct Place {
    const char* name;
    reference::FurBody body;
    double around; // the tube's circle, degrees
    std::vector<double> tilts;
};

const std::array kPlaces = {Place{"ball", {.radius = 1}, 0, {0, 45, 60, 70, 75, 80, 85, 90}},
                            Place{"torus, outside", {.ring = 2, .radius = 1}, 0, {45, 70, 80, 90}},
                            Place{"torus, inside", {.ring = 2, .radius = 1}, 135, {45, 70}}};

struct Row {
    int layers;
    int fewest;
    std::string name;
};

std::vector<Row> rows(int most) {
    std::vector<Row> all;
    for (int n = 4; n <= most; n *= 2)
        all.push_back({n, n, std::to_string(n)});
    all.push_back({32, 4, "by the view"});
    return all;
}

void measurePlace(const BodyFur& fur, const Place& place, const BodyView& view, int most, double degrees) {
    const BodyPicture cones = fur.truth(view, reference::FurShape::Cones);
    const BodyPicture carried = fur.truth(view, reference::FurShape::Carried);
    const BodyError shapes = bodyError(carried, cones, view);
    const bool outline = degrees >= 90;
    const auto print = [&](const std::string& layers, const BodyError& toCones, const std::optional<BodyError>& toCarried) {
        fmt::print("| {} | {:.0f} | {} | {:.3f} | {:+.1f} | {} | {} | {} |\n", place.name, degrees, layers, toCones.rms, 100 * toCones.bias,
                   toCarried ? fmt::format("{:.3f}", toCarried->rms) : "-", outline ? fmt::format("{:.2f}", toCones.outline) : "-",
                   outline ? fmt::format("{:+.2f}", toCones.outside) : "-");
        std::fflush(stdout);
    };
    for (const Row& row : rows(most)) {
        const BodyPicture drawn = need(fur.draw(view, row.layers, row.fewest));
        print(row.name, bodyError(drawn, cones, view), bodyError(drawn, carried, view));
    }
    print("sections carried by the skin", shapes, std::nullopt);
}

} // namespace

int main(int argc, char** argv) {
    BodyCoat coat;
    BodyView view;
    int most = 32;
    std::string only;
    CLI::App app{"Straight strands on a ball and a torus: effects/FurRoots.fx beside exact rays"};
    app.add_option("--length", coat.length, "of the coat, share of the body's radius")->capture_default_str();
    app.add_option("--spacing", coat.spacing, "of the strands, share of the body's radius")->capture_default_str();
    app.add_option("--pixel", view.pixel, "spacings")->capture_default_str();
    app.add_option("--size", view.size, "pixels along a side")->capture_default_str();
    app.add_option("--samples", view.samples, "of the truth, along a side of a pixel")->capture_default_str();
    app.add_option("--most", most, "layers")->capture_default_str();
    app.add_option("--only", only, "ball, or one of the others");
    std::optional<double> tilt;
    app.add_option("--tilt", tilt, "degrees; else several");
    CLI11_PARSE(app, argc, argv);

    gpu::Device device = need(gpu::Device::create());
    fmt::print("{}: coat of {:.3g} spacings, {} of the radius; pixels of {} spacings, {} x {}\n\n", device.info().name,
               coat.length / coat.spacing, coat.length, view.pixel, view.size, view.size);
    fmt::print("| body | tilt | layers | RMS | light, % | RMS, carried | outline, px | outside, px |\n|---|---|---|---|---|---|---|---|\n");
    for (const Place& place : kPlaces) {
        if (!only.empty() && only != place.name) continue;
        const BodyFur fur = need(BodyFur::create(device, place.body, coat));
        view.around = radians(place.around);
        for (const double degrees : tilt ? std::vector{*tilt} : place.tilts) {
            view.tilt = radians(degrees);
            measurePlace(fur, place, view, most, degrees);
        }
    }
}
