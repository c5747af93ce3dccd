#include "lab/stability/work.h"

#include "generated/setting_names.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::bench::stability {

namespace fs = std::filesystem;

bool Context::wants(std::string_view module) const {
    return options.modules.empty() ||
           std::ranges::any_of(options.modules, [&](const std::string& name) { return equalsIgnoreCase(name, module); });
}

Result<Effect> load(const Context& context, const fs::path& file, const std::string& setting, const Defines& defines) {
    LoadOptions options{.defines = defines};
    const auto missing = [&](const char* name) {
        return std::ranges::none_of(options.defines, [&](const auto& define) { return define.first == name; });
    };
    if (!setting.empty() && missing(kSettingSwitch)) options.setting = setting;
    if (missing("TEGUMENT_MAP_SIZE")) options.defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(context.options.size));
    return loadEffect(file, options);
}

Result<std::vector<std::string>> outerSettings(const Context& context, const fs::path& file) {
    const auto effect = load(context, file, {});
    if (!effect) return effect.error();
    if (!effect->settings) return std::vector<std::string>{{}};
    const std::vector<std::string>& names = effect->settings->names;
    if (names.size() == 1) return names;
    return std::vector{names.front(), names.back()};
}

std::vector<fs::path> effectFiles(const Context& context) {
    std::vector<fs::path> files;
    std::error_code code;
    for (auto entry = fs::recursive_directory_iterator(context.options.effects, code); !code && entry != fs::end(entry);
         entry.increment(code))
        if (entry->path().extension() == ".fx" && context.wants(entry->path().stem().string())) files.push_back(entry->path());
    std::ranges::sort(files);
    return files;
}

RunOptions runOptions(const Context& context, const Effect& effect, const std::string& technique, const HardScene& scene, int size) {
    RunOptions options{.technique = technique, .width = size, .height = size, .compiler = context.options.compiler};
    for (const auto& [name, value] : scene.parameters)
        if (effect.findParameter(name)) options.parameters[name] = value;
    return options;
}

Result<RunResult> draw(const Context& context, const Effect& effect, const std::string& technique, const HardScene& scene, int size,
                       std::vector<std::string> dump) {
    RunOptions options = runOptions(context, effect, technique, scene, size);
    options.dump = std::move(dump);
    return runEffect(context.device, effect, &scene.mesh, scene.workspace, options);
}

PictureError differenceOf(const Image& image, const Image& reference) {
    const int channels = std::min({3, image.channels, reference.channels});
    double sum = 0;
    double squares = 0;
    double squaresOfReference = 0;
    std::size_t beyond = 0;
    PictureError error;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            for (int c = 0; c < channels; ++c)
                sum += static_cast<double>(reference.at(x, y, c));
    double mean = sum / (static_cast<double>(reference.width) * reference.height * channels);
    if (!(mean > 0)) mean = 1; // nothing to relate to
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            double here = 0;
            for (int c = 0; c < channels; ++c) {
                const auto truth = static_cast<double>(reference.at(x, y, c));
                double difference = std::abs(static_cast<double>(image.at(x, y, c)) - truth);
                if (!std::isfinite(difference)) difference = mean;
                here = std::max(here, difference / mean);
                squares += difference * difference;
                squaresOfReference += truth * truth;
            }
            beyond += here > 1e-3 ? 1 : 0;
            if (here > error.largest.value) error.largest = {here, x, y};
        }
    error.relativeL2 = squaresOfReference > 0 ? std::sqrt(squares / squaresOfReference) : std::sqrt(squares);
    error.beyond = static_cast<double>(beyond) / (static_cast<double>(reference.width) * reference.height);
    return error;
}

NotFinite notFinite(const Image& image) {
    NotFinite found;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (std::isfinite(image.pixels[i])) continue;
        if (found.count++ > 0) continue;
        const auto pixel = static_cast<int>(i / static_cast<std::size_t>(image.channels));
        found.x = pixel % image.width;
        found.y = pixel / image.width;
        found.value = static_cast<double>(image.pixels[i]);
    }
    return found;
}

std::string at(const char* what, const Worst& worst) {
    return fmt::format("{} ({}, {})", what, worst.x, worst.y);
}

} // namespace tegument::bench::stability
