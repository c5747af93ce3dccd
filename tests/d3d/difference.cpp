#include "tests/d3d/difference.h"

#include "host/run/target_desc.h"
#include "tools/direct3d9/job.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tegument::test {

namespace fs = std::filesystem;

namespace {

Kind kindOf(const Parameter& parameter) {
    const auto target = run::describeTarget(parameter, {kPictureWidth, kPictureHeight});
    if (!target) return Kind::Float;
    if (isDepth(target->format)) return Kind::Depth;
    if (target->format == PixelFormat::RGBA16) return Kind::Share;
    const bool half = run::d3dName(target->format).ends_with("16F");
    return half ? Kind::Half : Kind::Float;
}

/// Largest over the pixel's channels.
double pixelDistance(const Image& a, const Image& b, std::size_t pixel) {
    double largest = 0;
    for (std::size_t channel = 0; channel < static_cast<std::size_t>(a.channels); ++channel) {
        const std::size_t i = pixel * static_cast<std::size_t>(a.channels) + channel;
        const double difference = std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]));
        if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, difference);
    }
    return largest;
}

double scaleOf(const Image& image) {
    double scale = 1;
    for (const float value : image.pixels)
        scale = std::max(scale, std::abs(static_cast<double>(value)));
    return scale;
}

Distance measure(const Image& image, const Image& reference, double limit, double farther) {
    Distance result{.scale = scaleOf(reference)};
    result.pixels = reference.pixels.size() / static_cast<std::size_t>(reference.channels);
    std::vector<double> all(result.pixels);
    for (std::size_t pixel = 0; pixel < result.pixels; ++pixel) {
        all[pixel] = pixelDistance(image, reference, pixel) / result.scale;
        result.beyond += all[pixel] > limit ? 1 : 0;
        result.farther += all[pixel] > farther ? 1 : 0;
    }
    const auto largest = std::ranges::max_element(all);
    const auto at = static_cast<int>(largest - all.begin());
    result.largest = *largest;
    result.x = at % reference.width;
    result.y = at / reference.width;
    const auto rank = all.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(all.size() - 1));
    std::ranges::nth_element(all, rank);
    result.p999 = *rank;
    return result;
}

} // namespace

double tolerance(Kind kind) {
    switch (kind) {
    case Kind::Half: return 1e-3;    // one step of a half below 1 or above: wined3d and lavapipe round single values differently
    case Kind::Share: return 3.1e-5; // two steps of 16 bits: what is interpolated differs by less than one, and rounds either way
    case Kind::Picture: return 5e-3; // eight bits of a colour map and its filter; one step of the display's 255 is 4e-3
    default: return 1e-5;            // a hundred steps of a float
    }
}

std::vector<DrawnTarget> targetsOf(const Case& drawn) {
    std::vector<DrawnTarget> targets;
    const auto effect = loadCase(drawn);
    if (!effect) return targets;
    std::error_code code;
    for (const Parameter& parameter : effect->parameters)
        if (parameter.isTarget() && fs::exists(drawing(drawn, Engine::Vulkan, parameter.name), code))
            targets.push_back({parameter.name, kindOf(parameter), parameter.annotations.string("Format").value_or("D24S8") != "D32F"});
    targets.push_back({"picture", Kind::Picture});
    return targets;
}

const std::vector<Exception>& exceptions() {
    static const std::string kRounding =
        "each of up to ten passes rounds to half again, and where ps_3_0 adds in another order than SM4 the "
        "last bit falls to the other side; with 32-bit maps the difference is gone";
    static const std::string kThickness =
        "alpha is exp(-0.2 t) of a thickness that is the difference of two depths near 1,300 mm, whose last "
        "bit is 1.2e-4 mm, and t counts in mm";
    static const std::string kSpread = "a depth one step apart turns a comparison at the edge of a shadow: one texel, which blurs carry on";
    static const std::string kBorders =
        "shader model 3 has no slots for planes of facets, nor for the nearest texels of the shadow map, where light "
        "enters the atlas: borders of shadows are another texel there";
    static const std::string kCoverage =
        "Wine's Direct3D 11 draws all of a target of one sample, whatever SV_Coverage says; 12 draws it as Vulkan does";
    static const std::string kHalving = "radii are found by halving, where the last bit of an exponential turns one half: 7e-4; and the "
                                        "table is of halves, whose step is 5e-4 there";
    static const std::string kArea = "z times area from neighbours' depths: 3e-6 of a depth is 1e-4 of a slope";
    static const std::vector<Exception> all = {
        {Engine::Direct3D12, "SkinPost", "gPostAreaDepthMap", 2e-4, 0.02, kArea},
        {Engine::Direct3D9, "SkinPost", "gPostKernels", 1.3e-3, 0.03, kHalving},
        {Engine::Direct3D11, "FurCoat_CoatChance", "picture", 1.1, 0.13, kCoverage},
        {Engine::Direct3D9, "Pyramid_", "gEntry", 0.3, 0.15, kBorders},
        {Engine::Direct3D9, "Pyramid_", "gLight", 0.1, 0.03, kBorders},
        {Engine::Direct3D9, "Pyramid_", "picture", 0.06, 0.025, kBorders},
        {Engine::Direct3D9, "PyramidLamps3Around_", "gEntry", 0.3, 0.15, kBorders},
        {Engine::Direct3D9, "PyramidLamps3Around_", "gLight", 0.1, 0.03, kBorders},
        {Engine::Direct3D9, "PyramidLamps3Around_", "picture", 0.06, 0.025, kBorders},
        {Engine::Direct3D9, "Convolution_", "gIrradiance", 5e-3, 0.25, kRounding},
        {Engine::Direct3D9, "Main_DEonLuebke", "gIrradiance", 5e-3, 0.05, kRounding},
        {Engine::Direct3D9, "MainLamps1_DEonLuebke", "gIrradiance", 5e-3, 0.05, kRounding},
        {Engine::Direct3D9, "MainLamps3Around_DEonLuebke", "gIrradiance", 5e-3, 0.25, kRounding}, // more light above 1
        {Engine::Direct3D12, "Convolution32_", "g", 5e-2, 4e-3, kSpread},
        {Engine::Direct3D9, "Convolution32_", "gIrradiance", 5e-5, 2e-3, kThickness},
        {Engine::Direct3D10, "Convolution32_", "gIrradiance", 5e-5, 2e-3, kThickness},
        {Engine::Direct3D11, "Convolution32_", "gIrradiance", 5e-5, 2e-3, kThickness},
    };
    return all;
}

const Exception* exceptionFor(const Case& drawn, Engine engine, const DrawnTarget& target) {
    for (const Exception& exception : exceptions())
        if (exception.engine == engine && drawn.name().starts_with(exception.cases) && target.name.starts_with(exception.targets))
            return &exception;
    return nullptr;
}

bool readable(Engine engine, const DrawnTarget& target) {
    if (engine == Engine::Direct3D12 && target.kind == Kind::Depth) return !target.stencil;
    return engine != Engine::Direct3D9 || target.kind != Kind::Depth;
}

Result<Distance> distance(const Case& drawn, Engine engine, const DrawnTarget& target) {
    const auto reference = readFloats(drawing(drawn, Engine::Vulkan, target.name));
    if (!reference) return reference.error();
    const fs::path path = drawing(drawn, engine, target.name);
    const auto image = readFloats(path);
    if (!image) return image.error();
    if (image->width != reference->width || image->height != reference->height || image->channels != reference->channels)
        return inputError(5260, {.file = path.string()}, "the target has another size or other channels than Vulkan's");
    const double limit = tolerance(target.kind);
    const Exception* exception = exceptionFor(drawn, engine, target);
    return measure(*image, *reference, limit, exception ? exception->largest : limit);
}

} // namespace tegument::test
