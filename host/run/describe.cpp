#include "host/run/describe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tegument::run {

namespace {

std::string callersName(const std::string& target) {
    return isCallers(target) ? std::string() : target;
}

bool writesColor(const DrawStep& step, const PassUse& use, std::size_t slot) {
    return (use.writtenColors >> slot & 1U) != 0 && step.pass->state.targets.at(slot).writeMask != 0;
}

/// Of the effect, that any object uses.
std::vector<std::string> ownTargets(std::span<const ObjectRun> objects) {
    std::set<std::string> names;
    for (const ObjectRun& object : objects)
        for (const auto& target : object.prepared.targets)
            if (!isCallers(target.first)) names.insert(target.first);
    return {names.begin(), names.end()};
}

/// Of the effect, that any object reads.
std::vector<std::string> ownParameters(std::span<const ObjectRun> objects) {
    std::set<std::string> names;
    for (const ObjectRun& object : objects)
        for (const std::string& name : object.prepared.reads)
            if (object.input.effect.findParameter(name)) names.insert(name);
    return {names.begin(), names.end()};
}

/// Each once: objects of one effect have most of their warnings in common.
std::vector<Diagnostic> warningsOf(std::span<const ObjectRun> objects) {
    std::vector<Diagnostic> all;
    std::set<std::string> known;
    for (const ObjectRun& object : objects)
        for (const Diagnostic& warning : object.prepared.warnings)
            if (known.insert(format(warning)).second) all.push_back(warning);
    return all;
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

/// What a picture must say about its making (docs/running.md, "Metadata").
std::map<std::string, std::string> metadata(std::span<const ObjectRun> objects, const gpu::DeviceInfo& device) {
    const RunInput& input = objects.front().input;
    const Prepared& prepared = objects.front().prepared;
    std::map<std::string, std::string> entries{{"Software", "Tegument"},
                                               {"effect", input.effect.file.filename().string()},
                                               {"technique", prepared.plan.technique->name},
                                               {"compiler", compilerName(input.options.compiler)},
                                               {"device", device.name},
                                               {"driver", device.driver}};
    if (input.effect.settings) entries["setting"] = input.effect.settings->current;
    entries.insert(input.effect.metadata.begin(), input.effect.metadata.end());
    for (const Parameter& parameter : input.effect.parameters) {
        const Numbers* value = prepared.values.find(parameter.name);
        const auto entry = parameter.annotations.string("Metadata");
        if (value && entry) entries[*entry] = fmt::format("{}", fmt::join(*value, " "));
    }
    if (input.options.samples > 1) entries["samples"] = fmt::format("{}", input.options.samples);
    if (!input.mesh || !prepared.drawsMesh) return entries;
    entries["mesh"] = ofMeshes(objects, [](const Mesh& mesh) { return mesh.name; });
    entries["unit_mm"] = ofMeshes(objects, [](const Mesh& mesh) { return fmt::format("{}", mesh.unitMm); });
    const std::string attribution = ofMeshes(objects, [](const Mesh& mesh) { return mesh.attribution; });
    if (!attribution.empty()) entries["attribution"] = attribution;
    return entries;
}

} // namespace

SessionPass describe(const DrawStep& step, const Prepared& prepared, int object) {
    const PassUse& use = prepared.programs.at(step.pass)->use;
    SessionPass pass{.name = step.pass->name, .object = object};
    for (std::size_t slot = 0; slot < step.colors.size(); ++slot) {
        if (!step.colors[slot]) continue;
        pass.targets.push_back(callersName(*step.colors[slot]));
        if (writesColor(step, use, slot)) pass.writes.push_back(pass.targets.back());
    }
    for (const std::string& stored : use.stored) {
        pass.targets.push_back(callersName(stored));
        pass.writes.push_back(pass.targets.back());
    }
    if (step.depth) pass.targets.push_back(callersName(*step.depth));
    if (step.depth && pass.writes.empty()) pass.writes.push_back(pass.targets.back());
    for (const std::string& name : use.sampled) // a copy of what it draws into counts as that
        if (prepared.targets.contains(name)) pass.reads.push_back(callersName(name));
    return pass;
}

SessionFrame describe(std::span<const ObjectRun> objects, const Frame& frame, const gpu::DeviceInfo& device) {
    SessionFrame described{.technique = objects.front().prepared.plan.technique->name,
                           .targets = ownTargets(objects),
                           .parameters = ownParameters(objects),
                           .metadata = metadata(objects, device),
                           .warnings = warningsOf(objects)};
    for (const FrameNode& node : frame.before)
        described.produced.push_back(node.effect);
    for (const FrameItem& item : frame.items)
        if (const auto* draw = std::get_if<FrameDraw>(&item)) described.passes.push_back(draw->described);
    return described;
}

} // namespace tegument::run
