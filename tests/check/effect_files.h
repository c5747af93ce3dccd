#pragma once
// What tests of every effect go over.

#include "tools/check/check.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace tegument::test {

/// The files of effects/, sorted: tests run from the repository's root.
inline std::vector<std::filesystem::path> effectFiles() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator("effects"))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// By the compilers that this machine has.
inline std::vector<Target> spirvTargets() {
    if (compilerAvailable(Compiler::Dxc)) return {Target::SpirvDxc, Target::SpirvGlslang};
    return {Target::SpirvGlslang};
}

} // namespace tegument::test
