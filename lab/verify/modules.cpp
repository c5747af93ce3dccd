#include "generated/setting_names.h"
#include "host/support/text.h"
#include "lab/verify/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument {

namespace {

struct Module {
    const char* name;
    Result<ModuleReport> (*verify)(const verify::Context&);
    const char* effect = nullptr; // that draws it; none: the one of its name
};

constexpr std::array kModules = {
    Module{"OriginalTexture", verify::verifyOriginalTexture},
    Module{"Beckmann", verify::verifyBeckmann},
    Module{"EnergyAttenuation", verify::verifyEnergyAttenuation},
    Module{"Specular", verify::verifySpecular},
    Module{"ShadowMap", verify::verifyShadowMap},
    Module{"TSM", verify::verifyTsm},
    Module{"Stretch", verify::verifyStretch},
    Module{"Irradiance", verify::verifyIrradiance},
    Module{"Convolution", verify::verifyConvolution},
    Module{"Main", verify::verifyMain},
    Module{"Pyramid", verify::verifyPyramid},
    Module{"Lamps", verify::verifyLamps, "Main"},
    Module{"Surroundings", verify::verifySurroundings, "Main"},
    Module{"Fur", verify::verifyFur},
    Module{"FurRoots", verify::verifyFurRoots},
    Module{"FurCoat", verify::verifyFurCoat},
};

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Module& module : kModules)
        all.emplace_back(module.name);
    return all;
}

// A setting among the modules was meant for --setting, which takes one.
std::string moduleHint(const std::string& module) {
    const std::vector<std::string> all = names();
    if (std::ranges::find(kSettingNames, module) != kSettingNames.end())
        return fmt::format("a setting; each has an option of its own: --setting {}", module);
    return fmt::format("{} known: {}", didYouMean(module, all), fmt::join(all, ", "));
}

std::string effectOf(const Module& module) {
    return std::string(module.effect ? module.effect : module.name) + ".fx";
}

} // namespace

bool ModuleReport::pass() const {
    return !metrics.empty() && std::ranges::all_of(metrics, &Metric::pass);
}

std::vector<std::string> verifiableModules(const std::filesystem::path& effects) {
    std::vector<std::string> there;
    for (const Module& module : kModules)
        if (std::filesystem::exists(effects / effectOf(module))) there.emplace_back(module.name);
    return there;
}

Result<ModuleReport> verifyModule(gpu::Device& device, const std::string& module, const VerifyOptions& options) {
    const auto found = std::ranges::find_if(kModules, [&](const Module& m) { return equalsIgnoreCase(m.name, module); });
    if (found == kModules.end())
        return usageError(4050, fmt::format("there is no reference for a module '{}'", module), moduleHint(module));
    if (std::ranges::find(kSettingNames, options.setting) == kSettingNames.end())
        return usageError(4051, fmt::format("there is no setting '{}'", options.setting),
                          fmt::format("{}", fmt::join(kSettingNames, ", ")));
    return found->verify({device, options});
}

} // namespace tegument
