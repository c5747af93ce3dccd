#include "tools/cli/effect_options.h"

#include "tools/cli/command_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::app {

void addEffectOptions(CLI::App& command, EffectOptions& options) {
    repeatable(command.add_option("-D,--define", options.defines, "Preprocessor definition NAME or NAME=VALUE; may be repeated"));
    repeatable(command.add_option("-I,--include", options.includeFolders, "Folder searched for #include files; may be repeated"));
    command.add_flag("--anywhere", options.anywhere,
                     "Includes, and what effects and meshes name, may lie outside of their projects and -I");
    command.add_option("--setting", options.setting, "Setting of the effect, by name; tegument info lists them (docs/settings.md)");
    command.add_option("--map-size", options.mapSize, "Texels along each side of the texture-space maps")->check(CLI::Range(1, 16384));
    command
        .add_option("--shadow-size", options.shadowSize,
                    "Texels along each side of the maps seen from the light; default: as many as --map-size")
        ->check(CLI::Range(1, 16384));
}

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

} // namespace tegument::app
