#pragma once
// How an effect is to be loaded, as a command line or a script says it.

#include "host/effect/model.h"
#include "host/support/text.h"

#include <string>
#include <vector>

namespace tegument::assets {

struct EffectOptions {
    std::vector<std::string> defines; // NAME or NAME=VALUE
    std::vector<std::string> includeFolders;
    bool anywhere = false;
    std::string setting; // one of the effect's own; empty: its default
    int mapSize = 0;     // 0: the effect's default
    int shadowSize = 0;  // likewise
};

/// Defines in the order given; --map-size becomes TEGUMENT_MAP_SIZE, --shadow-size TEGUMENT_SHADOW_SIZE.
[[nodiscard]] LoadOptions loadOptions(const EffectOptions& options);

} // namespace tegument::assets
