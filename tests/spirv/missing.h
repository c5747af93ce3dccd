#pragma once
// Why a test with a compiler cannot run here. ./bootstrap test installs both or stops, so in CI nothing is skipped; who builds by hand may
// leave DXC out, and the program then works with glslang alone.

#include "host/spirv/compile.h"

#include <gtest/gtest.h>

#include <string>

namespace tegument::test {

/// Empty when the compiler is there.
inline std::string compilerMissing(Compiler compiler) {
    if (compilerAvailable(compiler)) return {};
    return compilerName(compiler) +
           " was left out of this build (./bootstrap test brings it): there is nothing to run, or to compare with, here";
}

/// Names the cases of INSTANTIATE_TEST_SUITE_P over compilers.
inline std::string compilerTestName(const testing::TestParamInfo<Compiler>& info) {
    return info.param == Compiler::Dxc ? "Dxc" : "Glslang";
}

} // namespace tegument::test
