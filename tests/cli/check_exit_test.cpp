// `tegument check` tells the truth by its exit code: passed, failed, not applicable, not checked.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

namespace tegument::test {
namespace {

const std::map<std::string, std::string> kNoDxc = {{"TEGUMENT_DXC", "/nonexistent.so"}};

const std::string kShaders = "struct V { float4 position : SV_Position; };\n"
                             "V QuadVS(float3 position : POSITION) { V o; o.position = float4(position, 1); return o; }\n";

std::string effect(const std::string& name, const std::string& colour) {
    return write(name, kShaders + "float4 QuadPS(V i) : SV_Target0 { return " + colour +
                           "; }\n#ifndef FX_ENTRY\ntechnique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, QuadVS())); "
                           "SetPixelShader(CompileShader(ps_5_0, QuadPS())); } }\n#endif\n");
}

std::string good() {
    return effect("good.fx", "1");
}

/// As Direct3D 9 has it: nothing in it is for Vulkan.
std::string nine() {
    return write("nine.fx", "texture gMap;\nsampler2D gSkin = sampler_state { Texture = <gMap>; };\n"
                            "float4 PS(float2 uv : TEXCOORD0) : COLOR0 { return tex2D(gSkin, uv); }\n"
                            "technique T { pass P { PixelShader = compile ps_3_0 PS(); } }\n");
}

Ran check(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "check");
    return tegument(arguments, kNoDxc);
}

TEST(CheckExit, is_0_when_every_target_passed) {
    const Ran ran = check({good(), "--target", "spirv-glslang"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("1 passed, 0 failed, 0 not applicable, 0 not checked"), std::string::npos) << ran.out;
}

TEST(CheckExit, is_3_when_the_machine_lacks_a_tool_and_the_message_says_what_brings_it) {
    const Ran ran = check({good(), "--target", "spirv-glslang", "--target", "spirv-dxc"});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.out.find("1 passed, 0 failed, 0 not applicable, 1 not checked"), std::string::npos) << ran.out;
    EXPECT_NE(ran.err.find("./bootstrap build"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("--skip-missing"), std::string::npos) << ran.err;
}

TEST(CheckExit, is_0_when_what_is_missing_was_accepted) {
    const Ran ran = check({good(), "--target", "spirv-dxc", "--skip-missing"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("spirv-dxc not checked"), std::string::npos) << "said all the same\n" << ran.err;
}

TEST(CheckExit, is_0_when_the_file_has_nothing_for_one_target_and_another_passed) {
    const std::string quiet = effect("quiet.fx", "1");
    const Ran ran = check({quiet, "--target", "spirv-glslang", "--target", "fx_2_0", "--skip-missing"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("fx_2_0 not applicable"), std::string::npos) << ran.err;
}

TEST(CheckExit, is_3_when_no_target_has_a_verdict) {
    const Ran ran = check({nine(), "--target", "spirv-glslang"});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.err.find("nine.fx: spirv-glslang not applicable: written for Direct3D 9"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("no target has a verdict"), std::string::npos) << ran.err;
}

TEST(CheckExit, is_1_when_a_target_failed_whatever_is_missing) {
    const std::string bad = effect("bad.fx", "nowhere");
    EXPECT_EQ(check({bad, "--target", "spirv-glslang", "--skip-missing"}).code, 1);
    EXPECT_EQ(check({good(), bad, "--target", "spirv-glslang", "--target", "spirv-dxc"}).code, 1);
}

TEST(CheckExit, json_says_what_the_exit_code_says) {
    struct Case {
        std::vector<std::string> arguments;
        bool passed;
        bool complete;
        std::string verdict; // of the last target
    };
    const std::vector<Case> cases = {
        {{good(), "--target", "spirv-glslang"}, true, true, "passed"},
        {{good(), "--target", "spirv-dxc"}, false, false, "not checked"},
        {{good(), "--target", "spirv-dxc", "--skip-missing"}, true, false, "not checked"},
        {{nine(), "--target", "spirv-glslang"}, false, true, "not applicable"},
        {{effect("bad.fx", "nowhere"), "--target", "spirv-glslang"}, false, true, "failed"},
    };
    for (const Case& one : cases) {
        auto arguments = one.arguments;
        arguments.emplace_back("--json");
        const Ran ran = check(arguments);
        const auto json = ran.json();
        ASSERT_TRUE(json.is_object()) << ran.out;
        EXPECT_EQ(json["passed"], one.passed) << ran.out;
        EXPECT_EQ(json["passed"], ran.code == 0) << ran.out;
        EXPECT_EQ(json["complete"], one.complete) << ran.out;
        EXPECT_EQ(json["files"][0]["targets"].back()["verdict"], one.verdict) << ran.out;
    }
}

TEST(CheckExit, of_a_folder_with_an_include_named_like_an_effect_is_that_of_the_effects) {
    const std::string part = write("included/part.fx", "float4 grey() { return 0.5; }\n");
    const std::string whole =
        write("included/whole.fx", "#include \"part.fx\"\nfloat4 VS(float4 p : POSITION) : SV_Position { return p; }\n"
                                   "float4 PS() : SV_Target0 { return grey(); }\ntechnique10 T { pass P { "
                                   "SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, PS())); } }\n");
    const Ran both = tegument({"check", part, whole, "--target", "spirv-glslang"});
    EXPECT_EQ(both.code, 0) << both.err;
    EXPECT_NE(both.out.find("1 passed, 0 failed, 0 not applicable"), std::string::npos) << both.out;
    EXPECT_EQ(tegument({"check", part, "--target", "spirv-glslang"}).code, kMachine) << "by itself nothing of it can be checked";
}

} // namespace
} // namespace tegument::test
