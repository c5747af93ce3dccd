#include "host/app/effect_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace tegument::app {

void addEffectOptions(CLI::App& command, EffectOptions& options) {
    command.add_option("-D,--define", options.defines, "Preprocessor definition NAME or NAME=VALUE");
    command.add_option("-I,--include", options.includeFolders, "Folder searched for #include files");
    command.add_option("--setting", options.setting, "Setting of the effect, by name; tegument info lists them (docs/settings.md)");
    command.add_option("--map-size", options.mapSize, "Texels along each side of the texture-space maps")->check(CLI::Range(1, 16384));
}

std::filesystem::path effectPath(const std::filesystem::path& named) {
    namespace fs = std::filesystem;
    std::error_code code;
    if (named.is_absolute() || fs::exists(named, code)) return named;
    const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path();
    for (const fs::path& root : {program / "../share/tegument", fs::path(TEGUMENT_TREE)})
        for (const fs::path& candidate : {root / named, root / "effects" / named})
            if (fs::is_regular_file(candidate, code)) return candidate.lexically_normal();
    return named;
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
    load.setting = options.setting;
    if (options.mapSize > 0) load.defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(options.mapSize));
    for (const std::string& folder : options.includeFolders)
        load.includeFolders.emplace_back(folder);
    return load;
}

} // namespace tegument::app
