#include "lab/bench/catalogue.h"

#include "host/support/file.h"
#include "host/support/text.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument::bench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kHint = "docs/bench.md describes the file";

Error malformed(const fs::path& file, const std::string& text) {
    return inputError(8070, {.file = file.string()}, text, kHint);
}

/// Definitions and parameters, as settings and variants have them.
std::optional<std::string> apply(const Json& json, Contender& contender) {
    if (!json.is_object()) return "a setting or a variant must be an object";
    for (const auto& [key, value] : json.items()) {
        if ((key != "defines" && key != "parameters") || !value.is_object()) return fmt::format("'{}' is not known here", key);
        for (const auto& [name, content] : value.items()) {
            if (key == "defines") {
                if (!content.is_string()) return fmt::format("the definition '{}' must be a string", name);
                std::erase_if(contender.defines, [&name = name](const auto& define) { return define.first == name; });
                contender.defines.emplace_back(name, content.get<std::string>());
            } else {
                const Json list = content.is_array() ? content : Json::array({content});
                std::vector<double>& numbers = contender.parameters[name];
                numbers.clear();
                for (const Json& number : list) {
                    if (!number.is_number()) return fmt::format("the parameter '{}' must be a number or a list of numbers", name);
                    numbers.push_back(number.get<double>());
                }
            }
        }
    }
    return std::nullopt;
}

std::optional<std::string> readProfile(const Json& json, Contender& contender) {
    if (json == "six-gaussians") {
        contender.claim = Claim::SixGaussians;
    } else if (json == "none") {
        contender.claim = Claim::None;
    } else if (json == "delta") {
        contender.claim = Claim::Delta;
    } else if (json.is_object() && json.size() == 1 && json.contains("burley") && json["burley"].is_array() && json["burley"].size() == 3) {
        contender.claim = Claim::Burley;
        for (std::size_t c = 0; c < 3; ++c) {
            const Json& distance = json["burley"][c];
            if (!distance.is_number() || distance.get<double>() <= 0) return "the distances of 'burley' must be positive numbers, in mm";
            contender.burley[c] = distance.get<double>();
        }
    } else {
        return R"('profile' must be "six-gaussians", "delta", "none" or {"burley": [3 distances in mm]})";
    }
    return std::nullopt;
}

std::optional<std::string> readText(const Json& entry, const char* key, std::string& text) {
    if (!entry.contains(key) || !entry[key].is_string()) return fmt::format("'{}' must be a string", key);
    text = entry[key].get<std::string>();
    return std::nullopt;
}

std::optional<std::string> readKeys(const Json& entry) {
    static const std::set<std::string> kKeys = {"technique", "effect", "source", "settings", "variants", "profile", "comment"};
    if (!entry.is_object()) return "each entry must be an object";
    for (const auto& item : entry.items())
        if (!kKeys.contains(item.key())) return fmt::format("unknown key '{}'", item.key());
    if (!entry.contains("settings") || !entry["settings"].is_object() || entry["settings"].empty())
        return "'settings' must be an object that names at least one";
    return std::nullopt;
}

/// Settings times variants.
std::optional<std::string> readEntry(const Json& entry, const fs::path& folder, std::vector<Contender>& list) {
    Contender common;
    std::string effect;
    if (auto wrong = readKeys(entry)) return wrong;
    if (auto wrong = readText(entry, "technique", common.technique)) return wrong;
    if (auto wrong = readText(entry, "effect", effect)) return wrong;
    if (auto wrong = readText(entry, "source", common.source)) return wrong;
    if (entry.contains("profile"))
        if (auto wrong = readProfile(entry["profile"], common)) return wrong;
    common.effect = (folder / effect).lexically_normal();
    const Json variants = entry.value("variants", Json{{"", Json::object()}});
    if (!variants.is_object()) return "'variants' must be an object";
    for (const auto& [setting, settingValues] : entry["settings"].items())
        for (const auto& [variant, variantValues] : variants.items()) {
            Contender contender = common;
            contender.setting = setting;
            contender.variant = variant;
            if (auto wrong = apply(settingValues, contender)) return wrong;
            if (auto wrong = apply(variantValues, contender)) return wrong;
            list.push_back(std::move(contender));
        }
    return std::nullopt;
}

template <class Matches>
Result<void> everyNameChooses(const char* option, const std::vector<std::string>& wanted, const std::vector<std::string>& known,
                              const std::vector<Contender>& contenders, Matches matches) {
    for (const std::string& name : wanted)
        if (std::ranges::none_of(contenders, [&](const Contender& contender) { return matches(name, contender); }))
            return usageError(8071, fmt::format("{} {} chooses nothing of the catalogue", option, name), didYouMean(name, known));
    return {};
}

} // namespace

std::string Contender::ownDefinition() const {
    if (claim == Claim::Delta) return "no diffusion";
    if (claim == Claim::Burley) return fmt::format("normalised diffusion, d = {}, {}, {} mm", burley[0], burley[1], burley[2]);
    return {};
}

bool Contender::isCalled(const std::string& wanted) const {
    return equalsIgnoreCase(wanted, technique) || equalsIgnoreCase(wanted, name());
}

Result<std::vector<Contender>> loadCatalogue(const fs::path& file) {
    const auto text = readFile(file);
    if (!text) return text.error();
    const Json json = Json::parse(*text, nullptr, false);
    if (!json.is_array()) return malformed(file, "not a JSON list of techniques");
    std::vector<Contender> list;
    for (std::size_t i = 0; i < json.size(); ++i)
        if (const auto wrong = readEntry(json[i], file.parent_path(), list))
            return malformed(file, fmt::format("entry {}: {}", i + 1, *wrong));
    return list;
}

Result<std::vector<Contender>> choose(const std::vector<Contender>& contenders, const std::vector<std::string>& techniques,
                                      const std::vector<std::string>& settings) {
    std::vector<std::string> knownTechniques;
    std::vector<std::string> knownSettings;
    for (const Contender& contender : contenders) {
        knownTechniques.push_back(contender.technique);
        knownSettings.push_back(contender.setting);
    }
    const auto names = [](const std::string& wanted, const Contender& contender) { return contender.isCalled(wanted); };
    const auto sets = [](const std::string& wanted, const Contender& contender) { return equalsIgnoreCase(wanted, contender.setting); };
    if (auto all = everyNameChooses("--technique", techniques, knownTechniques, contenders, names); !all) return all.error();
    if (auto all = everyNameChooses("--setting", settings, knownSettings, contenders, sets); !all) return all.error();
    std::vector<Contender> chosen;
    for (const Contender& contender : contenders) {
        const bool technique =
            techniques.empty() || std::ranges::any_of(techniques, [&](const std::string& name) { return names(name, contender); });
        const bool setting =
            settings.empty() || std::ranges::any_of(settings, [&](const std::string& name) { return sets(name, contender); });
        if (technique && setting) chosen.push_back(contender);
    }
    if (chosen.empty())
        return usageError(8071, "--technique and --setting together choose nothing of the catalogue", "leave one of them out");
    return chosen;
}

} // namespace tegument::bench
