// The same picture made in two ways: half and float targets, two compilers, two devices.

#include "host/bench/stability_work.h"

#include <fmt/format.h>

#include <array>

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

/// Visits every technique of every effect.
template <class Visit>
Result<void> everyTechnique(const Context& context, const std::vector<std::string>& settings, Visit visit) {
    for (const auto& file : effectFiles(context))
        for (const std::string& setting : settings) {
            const auto effect = load(context, file, setting);
            if (!effect) return effect.error();
            for (const Technique& technique : effect->techniques)
                if (const auto visited = visit(file, technique.name, setting); !visited) return visited;
        }
    return {};
}

void addPair(const Context& context, const std::string& module, const std::string& pair, const Image& a, const Image& b, double limit,
             const char* why) {
    const PictureError error = differenceOf(a, b);
    context.report.rows.push_back(
        {.part = {},
         .module = module,
         .hardCase = pair,
         .figure = "share of pixels that differ by more than 1e-3 of the mean",
         .value = error.beyond,
         .limit = limit,
         .cause = error.largest.value > 0 ? fmt::format("{} differs by {:.2g} of the mean", at("pixel", error.largest), error.largest.value)
                                          : "every bit equal",
         .notFinite = notFinite(a).count + notFinite(b).count,
         .why = why});
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
        for (const char* setting : {"seed", "deon2007", "corrected"}) {
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
                {.part = {},
                 .module = moduleName(file, subject.technique, setting),
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
    return everyTechnique(context, {"seed", "corrected"},
                          [&](const std::filesystem::path& file, const std::string& technique, const std::string& setting) -> Result<void> {
                              context.say(fmt::format("compilers: {}, {} [{}]", file.stem().string(), technique, setting));
                              const Defines whole = {{"TEGUMENT_MAP_BITS", "32"}};
                              const auto dxc = drawWay(context.device, context, file, technique, setting, {Compiler::Dxc, whole});
                              if (!dxc) return dxc.error();
                              const auto other = drawWay(context.device, context, file, technique, setting, {Compiler::Glslang, whole});
                              if (!other) return other.error();
                              addPair(context, moduleName(file, technique, setting), "DXC against glslang", *dxc, *other, 1e-3,
                                      "docs/measurements.md: the last bit decides single points on the edge of a shadow");
                              return {};
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
    return everyTechnique(context, {"seed", "corrected"},
                          [&](const std::filesystem::path& file, const std::string& technique, const std::string& setting) -> Result<void> {
                              context.say(fmt::format("devices: {}, {} [{}]", file.stem().string(), technique, setting));
                              const Way way{context.options.compiler, {{"TEGUMENT_MAP_BITS", "32"}}};
                              const auto here = drawWay(context.device, context, file, technique, setting, way);
                              if (!here) return here.error();
                              const auto there = drawWay(*other, context, file, technique, setting, way);
                              if (!there) return there.error();
                              const PictureError error = differenceOf(*here, *there);
                              context.report.rows.push_back({.part = {},
                                                             .module = moduleName(file, technique, setting),
                                                             .hardCase = pair,
                                                             .figure = "relative L2",
                                                             .value = error.relativeL2,
                                                             .limit = std::nullopt,
                                                             .cause = fmt::format("{} differs by {:.2g} of the mean",
                                                                                  at("pixel", error.largest), error.largest.value),
                                                             .notFinite = notFinite(*here).count + notFinite(*there).count,
                                                             .why = {}});
                              return {};
                          });
}

} // namespace tegument::bench::stability
