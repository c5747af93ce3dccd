#include "host/run/execute.h"

#include "host/run/frame.h"
#include "host/run/pixels.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument::run {

namespace {

using Sections = std::vector<gpu::TimedSection>;

bool isPicture(const std::string& name) {
    return name == kPicture || name == kPictureDepth;
}

/// The named targets, or all of the effect's own.
Result<std::vector<std::string>> targetsToDump(const RunInput& input, const Prepared& prepared) {
    std::set<std::string> names;
    std::vector<std::string> own;
    for (const auto& target : prepared.targets)
        if (!isPicture(target.first)) own.push_back(target.first);
    for (const std::string& name : input.options.dump) {
        if (equalsIgnoreCase(name, "all")) {
            names.insert(own.begin(), own.end());
            continue;
        }
        if (std::ranges::find(own, name) == own.end())
            return inputError(4029, {.file = input.effect.file.string(), .byte = {}},
                              fmt::format("technique {} uses no target '{}'", prepared.plan.technique->name, name), didYouMean(name, own));
        names.insert(name);
    }
    return std::vector<std::string>(names.begin(), names.end());
}

Result<Image> readBack(gpu::Device& device, gpu::Texture& texture) {
    const auto bytes = device.readback(texture);
    if (!bytes) return bytes.error();
    const gpu::TextureDesc& desc = texture.desc();
    return imageFrom(*bytes, static_cast<int>(desc.width), static_cast<int>(desc.height), desc.format);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<PassReport> medians(const std::vector<Sections>& frames) {
    std::vector<PassReport> reports;
    for (std::size_t i = 0; i < frames.front().size(); ++i) {
        std::vector<double> times;
        for (const Sections& sections : frames)
            times.push_back(sections[i].milliseconds);
        reports.push_back({.name = frames.front()[i].name, .milliseconds = median(std::move(times))});
    }
    return reports;
}

Result<std::vector<PassReport>> runFrames(const RunInput& input, const Frame& frame) {
    std::vector<Sections> timed;
    const int measured = std::max(1, input.options.frames);
    for (int i = 0; i < input.options.warmUpFrames + measured; ++i) {
        auto sections = input.device.run([&](gpu::Recorder& recorder) { return record(frame, recorder); });
        if (!sections) return sections.error();
        if (i >= input.options.warmUpFrames) timed.push_back(std::move(*sections));
    }
    return medians(timed);
}

std::string defined(const Effect& effect, std::string_view name, std::string_view otherwise) {
    std::string value(otherwise);
    for (const auto& define : effect.defines)
        if (define.first == name) value = define.second;
    return value;
}

std::string settingName(const std::string& number) {
    if (number == "0") return "seed";
    if (number == "1") return "deon2007";
    return number == "2" ? "corrected" : number;
}

/// What a picture must say about its making (docs/running.md, "Metadata").
std::map<std::string, std::string> metadata(const RunInput& input, const Prepared& prepared) {
    std::map<std::string, std::string> entries{{"effect", input.effect.file.filename().string()},
                                               {"technique", prepared.plan.technique->name},
                                               {"setting", settingName(defined(input.effect, "TEGUMENT_SETTING", "2"))},
                                               {"map_size", defined(input.effect, "TEGUMENT_MAP_SIZE", "1024")},
                                               {"compiler", compilerName(input.options.compiler)},
                                               {"device", input.device.info().name},
                                               {"driver", input.device.info().driver}};
    if (const Numbers* seed = prepared.values.find("gSeed"); seed && !seed->empty()) entries["seed"] = fmt::format("{}", seed->front());
    if (!input.mesh || !prepared.drawsMesh) return entries;
    entries["mesh"] = input.mesh->name;
    entries["unit_mm"] = fmt::format("{}", input.mesh->unitMm);
    if (!input.mesh->attribution.empty()) entries["attribution"] = input.mesh->attribution;
    return entries;
}

void reportTargets(const Resources& resources, RunResult& result) {
    for (const auto& [name, texture] : resources.targets) {
        const gpu::TextureDesc& desc = texture.desc();
        result.bytes += texture.bytes();
        result.targets.push_back({.name = name,
                                  .width = static_cast<int>(desc.width),
                                  .height = static_cast<int>(desc.height),
                                  .format = std::string(d3dName(desc.format)),
                                  .bytes = texture.bytes()});
    }
}

Result<void> readTargets(const RunInput& input, const std::vector<std::string>& dump, Resources& resources, RunResult& result) {
    auto image = readBack(input.device, resources.targets.at(kPicture));
    if (!image) return image.error();
    result.image = std::move(*image);
    for (const std::string& name : dump) {
        auto target = readBack(input.device, resources.targets.at(name));
        if (!target) return target.error();
        result.dumped.emplace(name, std::move(*target));
    }
    return {};
}

} // namespace

Result<RunResult> execute(const RunInput& input, Prepared& prepared) {
    const auto dump = targetsToDump(input, prepared);
    if (!dump) return dump.error();
    auto resources = allocate(input, prepared);
    if (!resources) return resources.error();
    const auto frame = buildFrame(input, prepared, *resources);
    if (!frame) return frame.error();
    auto passes = runFrames(input, *frame);
    if (!passes) return passes.error();
    RunResult result;
    result.passes = std::move(*passes);
    result.technique = prepared.plan.technique->name;
    if (const auto read = readTargets(input, *dump, *resources, result); !read) return read.error();
    result.image.metadata = metadata(input, prepared);
    for (auto& dumped : result.dumped) {
        dumped.second.metadata = result.image.metadata;
        dumped.second.metadata["target"] = dumped.first;
    }
    reportTargets(*resources, result);
    result.warnings = std::move(prepared.warnings);
    return result;
}

} // namespace tegument::run
