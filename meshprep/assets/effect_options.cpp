#include "meshprep/assets/effect_options.h"

namespace tegument::assets {

LoadOptions loadOptions(const EffectOptions& options) {
    LoadOptions load;
    for (const std::string& define : options.defines) {
        const std::size_t equals = define.find('=');
        if (equals == std::string::npos) {
            load.defines.emplace_back(define, "1");
        } else {
            load.defines.emplace_back(define.substr(0, equals), define.substr(equals + 1));
        }
    }
    load.lenient = true;
    load.setting = options.setting;
    load.roots.anywhere = options.anywhere;
    if (options.mapSize > 0) load.defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(options.mapSize));
    if (options.shadowSize > 0) load.defines.emplace_back("TEGUMENT_SHADOW_SIZE", std::to_string(options.shadowSize));
    for (const std::string& folder : options.includeFolders)
        load.includeFolders.emplace_back(folder);
    return load;
}

} // namespace tegument::assets
