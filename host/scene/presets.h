#pragma once
// Named sets of parameters that lie beside an effect: NAME.presets.json beside NAME.fx. JSON, schema in docs/workspace.md.

#include "host/support/result.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tegument {

struct Preset {
    std::string name; // "short plush"
    std::string comment;
    std::map<std::string, std::vector<double>> parameters;
    SourcePosition at; // of its name
};

/// Where the presets of an effect lie.
[[nodiscard]] std::filesystem::path presetsFile(const std::filesystem::path& effect);

/// In the file's order; none where there is no such file. TG5001, TG5400 to TG5404.
[[nodiscard]] Result<std::vector<Preset>> loadPresets(const std::filesystem::path& effect);
/// The same from text; `path` names it in messages.
[[nodiscard]] Result<std::vector<Preset>> parsePresets(const std::string& text, const std::filesystem::path& path);

} // namespace tegument
