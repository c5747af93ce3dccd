#pragma once
// Options that every subcommand which loads an effect shares.

#include "host/effect/model.h"
#include "host/support/text.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tegument::app {

struct EffectOptions {
    std::vector<std::string> defines; // NAME or NAME=VALUE
    std::vector<std::string> includeFolders;
    std::string setting; // seed, deon2007, corrected
    int mapSize = 0;     // 0: the effect's default
};

void addEffectOptions(CLI::App& command, EffectOptions& options);

/// Defines in the order given; --setting and --map-size become TEGUMENT_SETTING and TEGUMENT_MAP_SIZE.
[[nodiscard]] LoadOptions loadOptions(const EffectOptions& options);

/// The settings by name, in the order of TEGUMENT_SETTING's values.
[[nodiscard]] const std::vector<std::string>& settingNames();

} // namespace tegument::app
