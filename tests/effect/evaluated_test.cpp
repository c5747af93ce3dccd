// What is known of an effect when it is read: calls of its functions, parts of its constants, indices that the host has not set yet.

#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {
namespace {

const std::string kList = "float4 VS(float4 p : POSITION) : POSITION { return p; }\n"
                          "float4 zero() : COLOR { return 0; }\nfloat4 one() : COLOR { return 1; }\nfloat4 two() : COLOR { return 2; }\n"
                          "PixelShader list[3] = { compile ps_2_0 zero(), compile ps_2_0 one(), compile ps_2_0 two() };\n";

struct Case {
    std::string name;
    std::string declarations;
    std::string index;
    std::string entry; // which shader the index means
};
void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.index;
}

class IndexOfShaders : public testing::TestWithParam<Case> {};

TEST_P(IndexOfShaders, is_evaluated) {
    const Effect effect = loaded(load(
        Files{{"main.fx", GetParam().declarations + kList + "technique T { pass P { PixelShader = (list[" + GetParam().index + "]); } }"}},
        {.lenient = true}));
    ASSERT_TRUE(effect.techniques[0].passes[0].pixelShader);
    EXPECT_EQ(effect.techniques[0].passes[0].pixelShader->entry, GetParam().entry);
}

INSTANTIATE_TEST_SUITE_P(
    OfCalls, IndexOfShaders,
    testing::Values(Case{"a_parameter_s", "int bones = 4;\nint which() { return min(bones, 2); }\n", "which()", "two"},
                    Case{"with_a_choice",
                         "int k = 3;\nint pick(int a, bool b) { int r = a - 2; if (b && r > 0) { return r; } else return 0; }\n",
                         "pick(k, true)", "one"},
                    Case{"with_a_loop_and_a_call",
                         "int half(int n) { return n / 2; }\n"
                         "int steps(int n) { int c = 0; for (int i = 0; i < 4; ++i) { c += 1; }\nreturn c; }\n"
                         "int count(int n) { int c = 0; for (int i = half(n); i > 0; i -= 1) c++; return c; }\n",
                         "count(5)", "two"},
                    Case{"of_vectors",
                         "float3 v = { 0.25, 0.5, 2.9 };\nfloat largest(float3 a) { float3 b = a * 1; return max(b.x, max(b.y, b.z)); }\n",
                         "(int)largest(v)", "two"},
                    Case{"that_shadow_a_global", "int n = 2;\nint f(int n) { n = n + 1; return n; }\n", "f(0) + n - 2", "one"}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    OfConstants, IndexOfShaders,
    testing::Values(
        Case{"a_structure", "struct Fog { bool on; float start; };\nstatic const Fog fog = { true, 1.0 };\nint kind = 2;\n",
             "(fog.on ? 1 : 0) * kind", "two"},
        Case{"a_structure_in_another",
             "struct In { int a[2]; };\nstruct Out { float3 c; In in0; };\nstatic const Out o = { { 1, 1, 1 }, { { 2, 1 } } };\n",
             "o.in0.a[1]", "one"},
        Case{"an_array_of_structures",
             "struct Lamp { float4 c; int kind; };\nstatic const Lamp lamps[2] = { { { 0, 0, 0, 0 }, 7 }, { { 1, 1, 1, 1 }, 2 } };\n",
             "lamps[1].kind", "two"},
        Case{"an_array", "static const int table[] = { 2, 1, 0 };\nint k = 1;\n", "table[k]", "one"}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(OfWhatTheHostSets, IndexOfShaders,
                         testing::Values(Case{"below_zero", "int kind;\n", "kind - 1", "zero"},
                                         Case{"far_below_zero", "float kind = -7.5;\n", "kind * 2", "zero"},
                                         Case{"beyond_the_last", "int kind = 5;\n", "kind", "two"},
                                         Case{"into_a_table", "static const int table[2] = { 1, 2 };\nint kind = 9;\n", "table[kind]",
                                              "two"}),
                         [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

TEST(IndexOfShaders, beyond_the_array_is_said) {
    const Effect effect = loaded(
        load(Files{{"main.fx", "int kind = 5;\n" + kList + "technique T { pass P { PixelShader = (list[kind]); } }"}}, {.lenient = true}));
    EXPECT_TRUE(std::ranges::any_of(effect.warnings, [](const Diagnostic& warning) { return warning.code == 2019; }));
}

TEST(EvaluatedStates, call_functions) {
    const auto passOf = [](const std::string& declarations, const std::string& state) {
        return loaded(load(Files{{"main.fx", declarations + "technique T { pass P { " + state + " } }"}}, {.lenient = true}))
            .techniques[0]
            .passes[0];
    };
    EXPECT_EQ(passOf("int a = 200; int ref() { return max(a, 10); }\n", "AlphaRef = ref();").alphaTest.reference, 200U);
    EXPECT_EQ(passOf("bool two = true; int sides(bool b) { return b ? 1 : 3; }\n", "CullMode = (sides(two));").state.cull, CullMode::None);
    EXPECT_TRUE(passOf("struct S { float o; }; static const S s = { 0.5 };\n", "AlphaBlendEnable = (s.o < 1);").state.targets[0].enable);
}

TEST(EvaluatedFunctions, that_never_end_or_call_themselves_are_no_values) {
    for (const std::string function :
         {"int f() { int i = 0; while (i < 1) { i = i * 1; } return i; }\n", "int f() { return f() + 1; }\n"}) {
        const auto effect =
            load(Files{{"main.fx", function + kList + "technique T { pass P { PixelShader = (list[f()]); } }"}}, {.lenient = true});
        EXPECT_EQ(firstCode(effect), 1106) << function;
    }
}

} // namespace
} // namespace tegument::test
