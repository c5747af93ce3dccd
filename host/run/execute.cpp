#include "host/run/execute.h"

#include "host/run/pixels.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tegument::run {

namespace {

using Sections = std::vector<gpu::TimedSection>;

/// The named targets, or all of the effect's own.
Result<std::vector<std::string>> targetsToDump(const RunInput& input, const Prepared& prepared) {
    std::set<std::string> names;
    std::vector<std::string> own;
    for (const auto& target : prepared.targets)
        if (!isCallers(target.first)) own.push_back(target.first);
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
        reports.push_back({.name = frames.front()[i].name, .object = 0, .milliseconds = median(std::move(times))});
    }
    return reports;
}

void nameObjects(const Frame& frame, std::vector<PassReport>& reports) {
    std::size_t next = 0;
    for (const auto& item : frame.items)
        if (const auto* draw = std::get_if<FrameDraw>(&item)) reports[next++].object = draw->object;
}

Result<std::vector<PassReport>> runFrames(const RunInput& input, const Frame& frame) {
    std::vector<Sections> timed;
    const int measured = std::max(1, input.options.frames);
    for (int i = 0; i < input.options.warmUpFrames + measured; ++i) {
        auto sections = input.device.run([&](gpu::Recorder& recorder) { return record(frame, recorder); });
        if (!sections) return sections.error();
        if (i >= input.options.warmUpFrames) timed.push_back(std::move(*sections));
    }
    auto reports = medians(timed);
    nameObjects(frame, reports);
    return reports;
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

/// The different values of the objects' meshes, in order.
template <class Value>
std::string ofMeshes(std::span<const ObjectRun> objects, const Value& value) {
    std::vector<std::string> all;
    for (const ObjectRun& object : objects)
        if (std::string text = value(*object.input.mesh); !text.empty() && std::ranges::find(all, text) == all.end())
            all.push_back(std::move(text));
    return fmt::format("{}", fmt::join(all, "; "));
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
    auto image = readBack(input.device, *resources.picture());
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

std::map<std::string, std::string> metadata(std::span<const ObjectRun> objects) {
    const RunInput& input = objects.front().input;
    const Prepared& prepared = objects.front().prepared;
    std::map<std::string, std::string> entries{{"effect", input.effect.file.filename().string()},
                                               {"technique", prepared.plan.technique->name},
                                               {"setting", settingName(defined(input.effect, "TEGUMENT_SETTING", "2"))},
                                               {"map_size", defined(input.effect, "TEGUMENT_MAP_SIZE", "1024")},
                                               {"compiler", compilerName(input.options.compiler)},
                                               {"device", input.device.info().name},
                                               {"driver", input.device.info().driver}};
    if (const Numbers* seed = prepared.values.find("gSeed"); seed && !seed->empty()) entries["seed"] = fmt::format("{}", seed->front());
    if (input.options.samples > 1) entries["samples"] = fmt::format("{}", input.options.samples);
    if (!input.mesh || !prepared.drawsMesh) return entries;
    entries["mesh"] = ofMeshes(objects, [](const Mesh& mesh) { return mesh.name; });
    entries["unit_mm"] = ofMeshes(objects, [](const Mesh& mesh) { return fmt::format("{}", mesh.unitMm); });
    const std::string attribution = ofMeshes(objects, [](const Mesh& mesh) { return mesh.attribution; });
    if (!attribution.empty()) entries["attribution"] = attribution;
    return entries;
}

std::vector<Diagnostic> warningsOf(std::span<const ObjectRun> objects) {
    std::vector<Diagnostic> all;
    std::set<std::string> known;
    for (const ObjectRun& object : objects)
        for (const Diagnostic& warning : object.prepared.warnings)
            if (known.insert(format(warning)).second) all.push_back(warning);
    return all;
}

Result<RunResult> execute(std::span<const ObjectRun> objects, Resources& resources) {
    const RunInput& input = objects.front().input;
    const auto dump = targetsToDump(input, objects.back().prepared);
    if (!dump) return dump.error();
    RunResult result;
    result.deviceBytes = input.device.allocatedBytes();
    const auto frame = buildFrame(objects, resources);
    if (!frame) return frame.error();
    auto passes = runFrames(input, *frame);
    if (!passes) return passes.error();
    result.passes = std::move(*passes);
    result.technique = objects.front().prepared.plan.technique->name;
    if (const auto read = readTargets(input, *dump, resources, result); !read) return read.error();
    result.image.metadata = metadata(objects);
    for (auto& dumped : result.dumped) {
        dumped.second.metadata = result.image.metadata;
        dumped.second.metadata["target"] = dumped.first;
    }
    reportTargets(resources, result);
    result.warnings = warningsOf(objects);
    return result;
}

Result<RunResult> execute(const RunInput& input, const Prepared& prepared) {
    if (const auto dump = targetsToDump(input, prepared); !dump) return dump.error();
    Resources resources;
    if (const auto allocated = allocate(input, prepared, resources); !allocated) return allocated.error();
    const ObjectRun only{input, prepared};
    return execute(std::span(&only, 1), resources);
}

} // namespace tegument::run
