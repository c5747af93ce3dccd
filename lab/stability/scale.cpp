// One scene in many sizes: what is measured in mm is scaled with it, so the exact picture stays the same and every change is rounding, or
// a constant in mm that an effect does not let its caller scale.

#include "generated/setting_names.h"
#include "lab/stability/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::bench::stability {

namespace {

constexpr double kUsualRadius = 100;   // mm, of what the others are held against
constexpr double kSmallestJudged = 1;  // mm
constexpr double kLargestJudged = 1e4; // mm
constexpr double kSamePicture = 5e-4;  // relative L2

/// What the effects measure in mm, and in mm^2.
void scaleLengths(const Effect& effect, const std::string& setting, double factor, HardScene& scene) {
    const auto scaleBy = [&](const char* name, double by, auto&& chosen) {
        const Parameter* parameter = effect.findParameter(name);
        if (!parameter || !parameter->defaultValue) return;
        std::vector<double> values = std::get<std::vector<double>>(*parameter->defaultValue);
        for (std::size_t i = 0; i < values.size(); ++i)
            if (chosen(i)) values[i] *= by;
        scene.parameters[name] = values;
    };
    const auto all = [](std::size_t) { return true; };
    scaleBy("gGaussianWeight", factor * factor, [](std::size_t i) { return i % 4 == 3; }); // variances
    if (setting == kSettingCorrected) {
        scaleBy("gBlurSize", factor, all);
        scaleBy("gShadowTolerance", factor, all);
    }
    scene.parameters["gTransmission"] = {0}; // exp(-0.2 t) per mm is skin's own
}

struct Subject {
    const char* effect;
    const char* technique;
    const char* setting;
};

constexpr Subject kSubjects[] = {
    {"Specular.fx", "Specular", kSettingCorrected},
    {"ShadowMap.fx", "Shadow", kSettingSeed},
    {"ShadowMap.fx", "Shadow", kSettingCorrected},
    {"TSM.fx", "TSM", kSettingCorrected},
    {"Irradiance.fx", "Irradiance", kSettingSeed},
    {"Irradiance.fx", "Irradiance", kSettingCorrected},
    {"Convolution.fx", "Convolution", kSettingCorrected},
    {"Convolution.fx", "Poisson", kSettingCorrected},
    {"Main.fx", "DEonLuebke", kSettingSeed},
    {"Main.fx", "DEonLuebke", kSettingCorrected},
    {"Main.fx", "Gosselin", kSettingSeed},
    {"Main.fx", "Gosselin", kSettingCorrected},
    {"Fur.fx", "CubeCombined", kSettingCorrected},
};

/// Outside the charts the seed's stretch counts as 1 (its Table 7): a length in disguise, which nobody can scale.
bool scalesItself(const Subject& subject) {
    return std::string_view(subject.technique) != "DEonLuebke" || std::string_view(subject.setting) != kSettingSeed;
}

struct Deviation {
    double relativeL2 = 0;
    std::string cause;
};

void raise(Deviation& deviation, const PictureError& error, double radius) {
    if (error.relativeL2 <= deviation.relativeL2) return;
    deviation = {error.relativeL2, fmt::format("radius {:.0e} mm; {} differs by {:.2g} of the mean", radius, at("pixel", error.largest),
                                               error.largest.value)};
}

Result<Image> drawAt(const Context& context, const Effect& effect, const Subject& subject, double radius) {
    HardScene scene = bodyScene();
    const double factor = radius / static_cast<double>(scene.mesh.bounds.radius);
    scene = scaled(std::move(scene), factor);
    scaleLengths(effect, subject.setting, factor * static_cast<double>(bodyScene().mesh.bounds.radius) / kUsualRadius, scene);
    auto run = draw(context, effect, subject.technique, scene, context.options.size);
    if (!run) return run.error();
    return std::move(run->image);
}

struct Sweep {
    Deviation judged;
    Deviation all;
    double smallest = 0; // radii between which the picture is the same
    double largest = 0;
    std::size_t notFinite = 0;
};

void widen(Sweep& sweep, double radius) {
    sweep.smallest = sweep.smallest == 0 ? radius : std::min(sweep.smallest, radius);
    sweep.largest = std::max(sweep.largest, radius);
}

Result<Sweep> sweepOf(const Context& context, const Effect& effect, const Subject& subject) {
    const auto usual = drawAt(context, effect, subject, kUsualRadius);
    if (!usual) return usual.error();
    Sweep sweep;
    for (int decade = -4; decade <= 6; ++decade) {
        const double radius = std::pow(10.0, decade);
        const auto image = drawAt(context, effect, subject, radius);
        if (!image) return image.error();
        sweep.notFinite += notFinite(*image).count;
        const PictureError error = differenceOf(*image, *usual);
        raise(sweep.all, error, radius);
        if (radius >= kSmallestJudged && radius <= kLargestJudged) raise(sweep.judged, error, radius);
        if (error.relativeL2 <= kSamePicture) widen(sweep, radius);
    }
    return sweep;
}

void addRows(const Context& context, const Subject& subject, const Sweep& sweep) {
    const std::string module =
        fmt::format("{}, {} [{}]", std::filesystem::path(subject.effect).stem().string(), subject.technique, subject.setting);
    context.report.rows.push_back({.module = module,
                                   .hardCase = "radius of the scene 1 mm to 10 m",
                                   .figure = "largest relative L2 to the picture at 100 mm",
                                   .value = sweep.judged.relativeL2,
                                   .limit = scalesItself(subject) ? std::optional(kSamePicture) : std::nullopt,
                                   .cause = sweep.judged.cause,
                                   .notFinite = sweep.notFinite,
                                   .why = "single texels on the edge of a shadow tip over with the last bit"});
    context.report.rows.push_back(
        {.module = module,
         .hardCase = "radius of the scene 1e-4 to 1e6 mm",
         .figure = fmt::format("the same; below {:g} from {:.0e} to {:.0e} mm", kSamePicture, sweep.smallest, sweep.largest),
         .value = sweep.all.relativeL2,
         .limit = std::nullopt,
         .cause = sweep.all.cause,
         .notFinite = sweep.notFinite});
}

} // namespace

Result<void> measureScale(const Context& context) {
    for (const Subject& subject : kSubjects) {
        const auto file = context.options.effects / subject.effect;
        if (!std::filesystem::exists(file) || !context.wants(file.stem().string())) continue;
        context.say(fmt::format("scale: {} [{}]", subject.technique, subject.setting));
        const auto effect = load(context, file, subject.setting);
        if (!effect) return effect.error();
        const auto sweep = sweepOf(context, *effect, subject);
        if (!sweep) return sweep.error();
        addRows(context, subject, *sweep);
    }
    return {};
}

} // namespace tegument::bench::stability
