#pragma once
// What tests of every effect go over.

#include "tools/check/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
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

/// Of a test that has one of these files as its parameter.
inline std::string effectName(const testing::TestParamInfo<std::filesystem::path>& each) {
    return each.param.stem().string();
}

/// By the compilers that this machine has.
inline std::vector<Target> spirvTargets() {
    if (compilerAvailable(Compiler::Dxc)) return {Target::SpirvDxc, Target::SpirvGlslang};
    return {Target::SpirvGlslang};
}

} // namespace tegument::test
