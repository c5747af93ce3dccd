// The example of docs/your-engine.md that skins the effects.

#include "tests/check/hook_example.h"

#include "tests/check/describe.h"
#include "tests/check/effect_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace tegument::test {
namespace {

/// Semantics that vertex shaders of this report read.
std::set<std::string> vertexInputs(const FileReport& file) {
    std::set<std::string> semantics;
    for (const EntryPoint& entry : file.entries)
        if (entry.kind == ShaderKind::Vertex && entry.glslang)
            for (const StageVariable& input : entry.glslang->reflection.inputs)
                semantics.insert(input.semantic);
    return semantics;
}

TEST(VertexHookExample, compiles_by_the_compilers_of_vulkan_with_its_streams) {
    const EffectsCopy copy;
    for (const char* effect : {"Main.fx", "FurRoots.fx", "Culling.fx", "peers/Separable.fx"}) {
        const FileReport file = checkEffects({copy.put(hookExample(), effect)}, spirvTargets()).files.at(0);
        for (const TargetCheck& target : file.targets) {
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
            EXPECT_NE(std::ranges::find(target.diagnostics, 4042, &Diagnostic::code), target.diagnostics.end()) << "this host has no bones";
        }
        for (const char* semantic : {"BLENDINDICES0", "BLENDWEIGHT0"})
            EXPECT_TRUE(vertexInputs(file).contains(semantic)) << effect << " without " << semantic;
    }
}

} // namespace
} // namespace tegument::test
