#include "tools/cli/replay.h"

#include "host/support/file.h"
#include "tools/view/keys.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tegument::app {

namespace {

using JsonStep = nlohmann::json;

constexpr int kNoReplay = 8049;
constexpr std::size_t kMostSteps = 1000000; // hours of input

Error refused(const std::filesystem::path& file, const std::string& why) {
    return inputError(kNoReplay, {.file = file.string(), .byte = {}}, "this is no replay: " + why,
                      R"(a list of steps such as {"drag": [0.1, 0]}, {"wheel": 1}, {"key": "t"}, {"edit": FILE, "from": A, "to": B})");
}

bool readMove(const JsonStep& step, const char* name, glm::dvec2& move) {
    const auto found = step.find(name);
    if (found == step.end() || !found->is_array() || found->size() != 2 || !found->at(0).is_number() || !found->at(1).is_number())
        return false;
    move = {found->at(0).get<double>(), found->at(1).get<double>()};
    return true;
}

/// "t" itself; "right" and "Esc" by the names in the help.
std::optional<char32_t> keyOf(const JsonStep& value) {
    if (!value.is_string()) return std::nullopt;
    const auto keys = view::keyBindings();
    const auto found = std::ranges::find_if(keys, [&](const view::KeyBinding& key) { return key.label == value.get<std::string>(); });
    return found == keys.end() ? std::nullopt : std::optional(found->key);
}

bool readEdit(const JsonStep& step, view::ReplayStep& read) {
    for (const char* name : {"edit", "from", "to"})
        if (!step.contains(name) || !step.at(name).is_string()) return false;
    read.file = step.at("edit").get<std::string>();
    read.from = step.at("from").get<std::string>();
    read.to = step.at("to").get<std::string>();
    return !read.from.empty();
}

bool readEditBack(const JsonStep& step, view::ReplayStep& read) {
    if (!step.contains("back") || !step.at("back").is_string()) return false;
    read.file = step.at("back").get<std::string>();
    return !read.file.empty();
}

bool readMore(const JsonStep& step, view::ReplayStep& read) {
    if (step.contains("meanwhile") && !readMove(step, "meanwhile", read.meanwhile)) return false;
    if (step.contains("cursor") && !readMove(step, "cursor", read.input.cursor)) return false;
    if (step.contains("soon") && !step.at("soon").is_boolean()) return false;
    if (step.contains("as") && !step.at("as").is_string()) return false;
    read.soon = step.value("soon", false);
    read.kind = step.value("as", read.kind);
    return true;
}

std::optional<view::ReplayStep> readStep(const JsonStep& step) {
    if (!step.is_object()) return std::nullopt;
    view::ReplayStep read;
    read.input.any = true;
    if (readMove(step, "drag", read.input.camera)) {
        read.kind = "drag";
    } else if (readMove(step, "pan", read.input.pan)) {
        read.kind = "pan";
    } else if (readMove(step, "light", read.input.light)) {
        read.kind = "light";
    } else if (step.contains("wheel") && step.at("wheel").is_number()) {
        read.kind = "wheel";
        read.input.wheel = step.at("wheel").get<double>();
    } else if (const auto key = step.contains("key") ? keyOf(step.at("key")) : std::nullopt) {
        read.kind = "key " + step.at("key").get<std::string>();
        read.input.keys = {*key};
    } else if (readEdit(step, read) || readEditBack(step, read)) {
        read.kind = "edit";
        read.input = {};
    } else {
        return std::nullopt;
    }
    return readMore(step, read) ? std::optional(read) : std::nullopt;
}

/// None where the step says no number of times that can be.
std::optional<std::size_t> timesOf(const JsonStep& step) {
    const auto asked = step.find("times");
    if (asked == step.end()) return 1;
    if (!asked->is_number_unsigned() || asked->get<std::uint64_t>() > kMostSteps) return std::nullopt;
    return asked->get<std::size_t>();
}

} // namespace

Result<std::vector<view::ReplayStep>> readReplay(const std::filesystem::path& file) {
    const auto text = readFile(file);
    if (!text) return text.error();
    const JsonStep list = JsonStep::parse(*text, nullptr, false);
    if (!list.is_array()) return refused(file, "it is no JSON list");
    std::vector<view::ReplayStep> steps;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto step = readStep(list[i]);
        const auto times = step ? timesOf(list[i]) : std::nullopt;
        if (!times) return refused(file, fmt::format("step {} is none of ours", i + 1));
        if (steps.size() + *times > kMostSteps) return refused(file, fmt::format("more than {} steps", kMostSteps));
        steps.insert(steps.end(), *times, *step);
    }
    return steps;
}

} // namespace tegument::app
