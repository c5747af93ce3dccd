// A program outside the tree: checks an effect for SPIR-V and writes it as GLSL.

#include "tools/emit/emit.h"

#include <cstdio>
#include <filesystem>

int main(int count, char** arguments) {
    if (count != 2) return 2;
    const std::filesystem::path file = arguments[1];
    const tegument::Target target = tegument::sourceOf(tegument::Target::Glsl);
    const tegument::CheckReport report = tegument::checkEffects({file}, {target});
    const tegument::FileReport& checked = report.files.front();
    if (report.failed() || !report.complete()) return 1;
    const auto folder = tegument::emitEffect(checked, {.folder = "glsl", .kinds = {tegument::Target::Glsl}});
    if (!folder) return std::fprintf(stderr, "%s\n", tegument::format(folder.error()).c_str()), 1;
    int texts = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder / "glsl"))
        texts += entry.is_regular_file() ? 1 : 0;
    const tegument::Technique& technique = checked.effect.techniques.front();
    std::printf("%s: %zu pass, %zu shaders, GLSL of %d\n", technique.name.c_str(), technique.passes.size(), checked.entries.size(), texts);
}
