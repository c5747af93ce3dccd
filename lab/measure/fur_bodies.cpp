// Table of docs/design/fur-layers.md, "Against exact strands": straight strands on a ball and a torus, drawn by effects/FurRoots.fx with
// few and many layers, beside exact rays against every strand.

#include "lab/measure/body_fur.h"
#include "lab/measure/need.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>
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

struct Count {
    int layers;
    int fewest;
};
constexpr std::array kCounts = {Count{4, 4}, Count{8, 8}, Count{16, 16}, Count{32, 32}, Count{32, 4}};

/// One row: what sections carried by the skin alone are off by, then what each number of layers is.
void measurePlace(const BodyFur& fur, const Place& place, const BodyView& view) {
    const BodyPicture cones = fur.truth(view, reference::FurShape::Cones);
    std::vector<BodyError> errors = {bodyError(fur.truth(view, reference::FurShape::Carried), cones, view)};
    for (const Count& count : kCounts)
        errors.push_back(bodyError(need(fur.draw(view, count.layers, count.fewest)), cones, view));
    const double degrees = view.tilt * 180 / std::numbers::pi;
    fmt::print("| {} | {:.0f} |", place.name, degrees);
    for (const BodyError& error : errors)
        fmt::print(" {:.3f}, {:+.1f} % |", error.rms, 100 * error.bias);
    if (degrees > 89) {
        fmt::print("\n| {}, outline | {:.0f} |", place.name, degrees);
        for (const BodyError& error : errors)
            fmt::print(" {:.2f}, {:+.2f} |", error.outline * view.pixel, error.outside * view.pixel);
    }
    fmt::print("\n");
    std::fflush(stdout);
}

struct Changed {
    double share = 0; // of the pixels
    std::array<double, 2> rms{};
};

/// Of the pixels in which two pictures differ: how far each is off there.
Changed changed(const BodyPicture& one, const BodyPicture& two, const BodyPicture& truth) {
    constexpr double kSeen = 0.004; // of the brightness of a tip: what 8 bits show
    double count = 0;
    glm::dvec2 squares(0);
    for (std::size_t i = 0; i < truth.shade.size(); ++i) {
        if (std::abs(one.shade[i] - two.shade[i]) < kSeen) continue;
        const glm::dvec2 off(one.shade[i] - truth.shade[i], two.shade[i] - truth.shade[i]);
        squares += off * off;
        ++count;
    }
    const glm::dvec2 rms = glm::sqrt(squares / std::max(count, 1.0));
    return {count / static_cast<double>(truth.shade.size()), {rms.x, rms.y}};
}

/// Rows of a fringe before the far side's coat: in one round and in two, and of the pixels that differ.
void measureFringes(gpu::Device& device, const BodyCoat& coat, BodyView view) {
    fmt::print(
        "\n| pixel, spacings | in one round | in two | pixels that differ | there: in one round | in two |\n|---|---|---|---|---|---|\n");
    const BodyFur fur = need(BodyFur::create(device, {.ring = 2, .radius = 1}, coat));
    view.tilt = radians(90);
    view.around = radians(110);
    view.across = true;
    for (const double pixel : {0.125, 0.25, 0.5, 1.0, 2.0}) {
        view.pixel = pixel;
        const BodyPicture truth = fur.truth(view, reference::FurShape::Cones);
        fmt::print("| {} |", pixel);
        const std::array pictures = {need(fur.draw(view, 32, 4, false)), need(fur.draw(view, 32, 4, true))};
        for (const BodyPicture& picture : pictures) {
            const BodyError error = bodyError(picture, truth, view);
            fmt::print(" {:.4f}, {:+.2f} % |", error.rms, 100 * error.bias);
        }
        const Changed differing = changed(pictures[0], pictures[1], truth);
        fmt::print(" {:.1f} % | {:.4f} | {:.4f} |\n", 100 * differing.share, differing.rms[0], differing.rms[1]);
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv) {
    BodyCoat coat;
    BodyView view;
    std::string only;
    CLI::App app{"Straight strands on a ball and a torus: effects/FurRoots.fx beside exact rays"};
    app.add_option("--length", coat.length, "of the coat, share of the body's radius")->capture_default_str();
    app.add_option("--spacing", coat.spacing, "of the strands, share of the body's radius")->capture_default_str();
    app.add_option("--pixel", view.pixel, "spacings")->capture_default_str();
    app.add_option("--size", view.size, "pixels along a side")->capture_default_str();
    app.add_option("--samples", view.samples, "of the truth, along a side of a pixel")->capture_default_str();
    app.add_option("--only", only, "ball, or one of the others, or fringes");
    std::optional<double> tilt;
    app.add_option("--tilt", tilt, "degrees; else several");
    CLI11_PARSE(app, argc, argv);

    gpu::Device device = need(gpu::Device::create());
    fmt::print("{}: coat of {:.3g} spacings, {} of the radius; pixels of {} spacings, {} x {}\n\n", device.info().name,
               coat.length / coat.spacing, coat.length, view.pixel, view.size, view.size);
    if (only.empty() || only == "fringes") measureFringes(device, coat, view);
    if (only == "fringes") return 0;
    fmt::print(
        "\n| body | tilt | sections carried by the skin | 4 layers | 8 | 16 | 32 | by the view |\n|---|---|---|---|---|---|---|---|\n");
    for (const Place& place : kPlaces) {
        if (!only.empty() && only != place.name) continue;
        const BodyFur fur = need(BodyFur::create(device, place.body, coat));
        view.around = radians(place.around);
        for (const double degrees : tilt ? std::vector{*tilt} : place.tilts) {
            view.tilt = radians(degrees);
            measurePlace(fur, place, view);
        }
    }
}
