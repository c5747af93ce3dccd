// The example of docs/your-engine.md that skins the effects, by Microsoft's compiler.

#include "tests/check/hook_example.h"

#include "tests/check/describe.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

/// FurRoots' vertex shaders are the longest and take the most registers.
TEST(VertexHookExample, compiles_for_direct3d_9_10_and_11_within_the_limits_of_shader_model_3) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const EffectsCopy copy;
    for (const char* effect : {"Main.fx", "FurRoots.fx", "Culling.fx", "peers/Separable.fx"}) {
        const FileReport file =
            checkEffects({copy.put(hookExample(), effect)}, {Target::Fx2, Target::Fx4, Target::Fx5, Target::Sm5}).files.at(0);
        for (const TargetCheck& target : file.targets)
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
        // 60 bones of 3 registers are in use.
        EXPECT_TRUE(std::ranges::any_of(file.sm3, [](const PassUsage& pass) { return pass.usage.constants > 180; })) << describe(file);
    }
}

} // namespace
} // namespace tegument::test
