// The same picture made in two ways: half and float targets, two compilers, two devices.

#include "generated/setting_names.h"
#include "lab/stability/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

namespace tegument::bench::stability {

namespace {

struct Way {
    Compiler compiler = Compiler::Dxc;
    Defines defines;
};

Result<Image> drawWay(gpu::Device& device, const Context& context, const std::filesystem::path& file, const std::string& technique,
                      const std::string& setting, const Way& way) {
    const auto effect = load(context, file, setting, way.defines);
    if (!effect) return effect.error();
    static const HardScene scene = bodyScene();
    RunOptions options = runOptions(context, *effect, technique, scene, context.options.size);
    options.compiler = way.compiler;
    auto run = runEffect(device, *effect, &scene.mesh, scene.workspace, options);
    if (!run) return run.error();
    return std::move(run->image);
}

std::string moduleName(const std::filesystem::path& file, const std::string& technique, const std::string& setting) {
    return fmt::format("{}, {} [{}]", file.stem().string(), technique, setting);
}

/// All techniques of one effect, each drawn in two ways.
struct Pairs {
    std::size_t pictures = 0;
    PictureError worst; // by its largest difference
    std::string where = "every bit of every picture equal";
    std::size_t notFinite = 0;
};

void add(Pairs& pairs, const std::string& picture, const Image& a, const Image& b) {
    const PictureError error = differenceOf(a, b);
    pairs.pictures += 1;
    pairs.notFinite += notFinite(a).count + notFinite(b).count;
    pairs.worst.relativeL2 = std::max(pairs.worst.relativeL2, error.relativeL2);
    pairs.worst.beyond = std::max(pairs.worst.beyond, error.beyond);
    if (error.largest.value <= pairs.worst.largest.value) return;
    pairs.worst.largest = error.largest;
    pairs.where = fmt::format("{}: {} differs by {:.2g} of the mean", picture, at("pixel", error.largest), error.largest.value);
}

using DrawPair = std::function<Result<std::pair<Image, Image>>(const std::filesystem::path& file, const std::string& technique,
                                                               const std::string& setting)>;

/// Every technique of an effect in the first and the last of its settings.
Result<Pairs> pairsOf(const Context& context, const std::filesystem::path& file, const DrawPair& drawPair) {
    Pairs pairs;
    const auto settings = outerSettings(context, file);
    if (!settings) return settings.error();
    for (const std::string& setting : *settings) {
        const auto effect = load(context, file, setting);
        if (!effect) return effect.error();
        for (const Technique& technique : effect->techniques) {
            context.say(fmt::format("{}, {} [{}], in two ways", file.stem().string(), technique.name, setting));
            const auto both = drawPair(file, technique.name, setting);
            if (!both) return both.error();
            add(pairs, fmt::format("{} [{}]", technique.name, setting), both->first, both->second);
        }
    }
    return pairs;
}

Result<void> everyEffect(const Context& context, const DrawPair& drawPair,
                         const std::function<StabilityRow(const std::string& effect, const Pairs& pairs)>& row) {
    for (const auto& file : effectFiles(context)) {
        const auto pairs = pairsOf(context, file, drawPair);
        if (!pairs) return pairs.error();
        context.report.rows.push_back(row(file.stem().string(), *pairs));
    }
    return {};
}

} // namespace

Result<void> measureFormats(const Context& context) {
    struct Subject {
        const char* file;
        const char* technique;
    };
    constexpr std::array kSubjects = {Subject{"Irradiance.fx", "Irradiance"}, Subject{"Convolution.fx", "Convolution"},
                                      Subject{"Convolution.fx", "Poisson"}, Subject{"Main.fx", "DEonLuebke"},
                                      Subject{"Main.fx", "Gosselin"}};
    for (const Subject& subject : kSubjects)
        for (const char* setting : kSettingNames) {
            const auto file = context.options.effects / subject.file;
            if (!context.wants(file.stem().string())) continue;
            context.say(fmt::format("formats: {} [{}]", subject.technique, setting));
            const auto half = drawWay(context.device, context, file, subject.technique, setting,
                                      {context.options.compiler, {{"TEGUMENT_MAP_BITS", "16"}}});
            if (!half) return half.error();
            const auto full = drawWay(context.device, context, file, subject.technique, setting,
                                      {context.options.compiler, {{"TEGUMENT_MAP_BITS", "32"}}});
            if (!full) return full.error();
            const PictureError error = differenceOf(*half, *full);
            context.report.rows.push_back(
                {.module = moduleName(file, subject.technique, setting),
                 .hardCase = "maps of 16 against 32 bits a channel",
                 .figure = "relative L2",
                 .value = error.relativeL2,
                 .limit = 5.5e-3,
                 .cause = fmt::format("{} differs by {:.2g} of the mean", at("pixel", error.largest), error.largest.value),
                 .notFinite = notFinite(*half).count + notFinite(*full).count,
                 .why = "eleven writes, each shortened by 2^-11 on average where halves are truncated"});
        }
    return {};
}

Result<void> measureCompilers(const Context& context) {
    if (!compilerAvailable(Compiler::Dxc)) {
        context.report.notes.emplace_back("DXC against glslang: not measured, DXC is not installed");
        return {};
    }
    const Defines whole = {{"TEGUMENT_MAP_BITS", "32"}};
    const auto both = [&](const auto& file, const auto& technique, const auto& setting) -> Result<std::pair<Image, Image>> {
        auto dxc = drawWay(context.device, context, file, technique, setting, {Compiler::Dxc, whole});
        if (!dxc) return dxc.error();
        auto glslang = drawWay(context.device, context, file, technique, setting, {Compiler::Glslang, whole});
        if (!glslang) return glslang.error();
        return std::pair(std::move(*dxc), std::move(*glslang));
    };
    return everyEffect(context, both, [](const std::string& effect, const Pairs& pairs) {
        return StabilityRow{.module = effect,
                            .hardCase = fmt::format("DXC against glslang, {} pictures, float maps", pairs.pictures),
                            .figure = "largest share of pixels that differ by more than 1e-3 of the mean",
                            .value = pairs.worst.beyond,
                            .limit = 1e-3,
                            .cause = pairs.where,
                            .notFinite = pairs.notFinite,
                            .why = "the last bit decides single points on the edge of a shadow"};
    });
}

Result<void> measureDevices(const Context& context) {
    std::optional<gpu::Device> software;
    gpu::Device* other = context.options.other;
    if (!other) {
        auto made = gpu::Device::create({.validation = false, .prefer = "llvmpipe"});
        if (made && made->info().name != context.device.info().name) other = &software.emplace(std::move(*made));
    }
    if (!other) {
        context.report.notes.emplace_back("device against device: not measured, this machine has one");
        return {};
    }
    const std::string pair = fmt::format("{} against {}", context.device.info().name, other->info().name);
    const Way way{context.options.compiler, {{"TEGUMENT_MAP_BITS", "32"}}};
    const auto both = [&](const auto& file, const auto& technique, const auto& setting) -> Result<std::pair<Image, Image>> {
        auto here = drawWay(context.device, context, file, technique, setting, way);
        if (!here) return here.error();
        auto there = drawWay(*other, context, file, technique, setting, way);
        if (!there) return there.error();
        return std::pair(std::move(*here), std::move(*there));
    };
    return everyEffect(context, both, [&](const std::string& effect, const Pairs& pairs) {
        return StabilityRow{.module = effect,
                            .hardCase = fmt::format("{}, {} pictures, float maps", pair, pairs.pictures),
                            .figure = "largest relative L2",
                            .value = pairs.worst.relativeL2,
                            .limit = std::nullopt,
                            .cause = pairs.where,
                            .notFinite = pairs.notFinite};
    });
}

} // namespace tegument::bench::stability
