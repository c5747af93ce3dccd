#include "host/scene/presets.h"

#include "host/scene/located_json.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <optional>

namespace tegument {

namespace fs = std::filesystem;

namespace {

class PresetReader : LocatedReader {
public:
    PresetReader(std::string_view text, const fs::path& path) : LocatedReader(text, path) {}

    Result<std::vector<Preset>> read(const LocatedJson& root) {
        if (expect(root, LocatedJson::Kind::Object, "the file"))
            for (std::size_t i = 0; i < root.items.size(); ++i)
                if (root.keys[i] != "comment") readPreset(root.keys[i], root.items[i]);
        if (error_) return *error_;
        return std::move(presets_);
    }

private:
    void readPreset(const std::string& name, const LocatedJson& value) {
        if (!expect(value, LocatedJson::Kind::Object, fmt::format("the preset '{}'", name))) return;
        Preset preset{.name = name, .at = positionAt(text_, value.offset, path_.string())};
        for (std::size_t i = 0; i < value.items.size() && !error_; ++i) {
            const LocatedJson& item = value.items[i];
            if (value.keys[i] == "comment")
                preset.comment = expect(item, LocatedJson::Kind::Text, "comment") ? item.text : std::string();
            else if (value.keys[i] == "parameters")
                readParameters(item, preset);
            else
                fail(5401, item, fmt::format("unknown key '{}' in the preset '{}'", value.keys[i], name),
                     "known keys: parameters, comment");
        }
        presets_.push_back(std::move(preset));
    }

    void readParameters(const LocatedJson& value, Preset& preset) {
        if (!expect(value, LocatedJson::Kind::Object, "parameters")) return;
        for (std::size_t i = 0; i < value.items.size() && !error_; ++i)
            preset.parameters[value.keys[i]] = numbers(value.items[i], value.keys[i]);
    }

    std::vector<double> numbers(const LocatedJson& value, const std::string& what) {
        auto read = parameterNumbers(value);
        if (!read) fail(5402, value, fmt::format("{} must be a number, true, false or a list of numbers", what), {});
        return std::move(read).value_or(std::vector<double>());
    }

    std::vector<Preset> presets_;
};

} // namespace

fs::path presetsFile(const fs::path& effect) {
    fs::path path = effect;
    return path.replace_extension(".presets.json");
}

Result<std::vector<Preset>> parsePresets(const std::string& text, const fs::path& path) {
    const Result<LocatedJson> root = parseLocatedJson(text, path.string());
    if (!root) return root.error();
    return PresetReader(text, path).read(*root);
}

Result<std::vector<Preset>> loadPresets(const fs::path& effect) {
    const fs::path path = presetsFile(effect);
    std::error_code none;
    if (!fs::is_regular_file(path, none)) return std::vector<Preset>();
    const Result<std::string> text = readFile(path);
    if (!text) return text.error();
    return parsePresets(*text, path);
}

} // namespace tegument
