// `tegument test`: what passes, what fails where, and what it says.

#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tegument::test {
namespace {

using nlohmann::json;

Ran run(const std::string& name, const std::string& text, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"test", write(name, text)});
    return tegument(more);
}

/// The failures of a file that both compilers take, one list for each: they must agree.
json failures(const std::string& name, const std::string& text, std::vector<std::string> more = {}) {
    more.emplace_back("--json");
    const Ran ran = run(name, text, more);
    EXPECT_EQ(ran.code, kInput) << ran.out << ran.err;
    json first;
    const json printed = ran.json();
    for (const json& test : printed.value("tests", json::array())) {
        EXPECT_TRUE(test["compiled"]) << ran.out;
        json found = json::array();
        for (const json& failure : test["failures"])
            found.push_back({failure["code"], failure["line"], failure["values"]});
        EXPECT_TRUE(first.is_null() || first == found) << ran.out;
        first = found;
    }
    EXPECT_GE(printed.value("tests", json::array()).size(), 1U) << ran.out << ran.err;
    return printed["tests"][0]["failures"];
}

void expectPassed(const Ran& ran) {
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
}

std::string read(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(ShaderTests, FirstTestPassesWithEveryCompilerUnderTheValidationLayers) {
    const Ran ran =
        run("first.test.hlsl",
            "TG_TEST(sum) { tgEqual(1 + 1, 2); }\nTG_TEST(root) { float x = tgRange(0, 4, 50); tgNear(sqrt(x) * sqrt(x), x, tgUlp(4)); }\n"
            "TG_PIXEL_TEST(p) { tgTrue(tgQuad.x < 2); }\nTG_GROUP_TEST(g, 8) { tgTrue(tgThread < 8); }\n",
            {"--validate"});
    expectPassed(ran);
    EXPECT_NE(ran.out.find("root  dxc  50 cases"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("root  glslang  50 cases"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("8 passed, 0 failed"), std::string::npos) << ran.out;
}

TEST(ShaderTests, SampleOfThePagePasses) {
    const Ran ran = tegument({"test", "docs/samples/test/fresnel.test.hlsl"});
    expectPassed(ran);
    EXPECT_NE(ran.out.find("6 passed, 0 failed"), std::string::npos) << ran.out;
}

TEST(ShaderTests, WrongConstantIsFoundWithInputsValueAndExpected) {
    const json found = failures("constant.test.hlsl", R"(float luminance(float3 c) { return dot(c, float3(0.2126, 0.7152, 0.0822)); }
TG_TEST(white_is_one)
{
    float3 c = tgCases(float3(0, 0, 0), float3(1, 1, 1));
    tgWatch(c.b * 2);
    tgNear(luminance(c), c.r, tgAbsolute(1e-5));
}
)");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["code"], "TG8210");
    EXPECT_EQ(found[0]["line"], 6);
    EXPECT_EQ(found[0]["values"]["c"], "(1, 1, 1)");
    EXPECT_EQ(found[0]["values"]["c.b * 2"], "2");
    EXPECT_EQ(found[0]["expected"], "1");
}

TEST(ShaderTests, WrongOperatorAndWrongBranchAreFound) {
    const json found = failures("operator.test.hlsl", R"(float lift(float x) { return x - 1; }
int sign3(int x) { if (x >= 0) return 1; return x < 0 ? -1 : 0; }
TG_TEST(both)
{
    int x = tgCases(-3, 0, 3);
    tgEqual(lift(x), x + 1.0);
    tgEqual(sign3(x), sign(x));
}
)");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0]["line"], 6);
    EXPECT_EQ(found[0]["cases"], 3);
    EXPECT_EQ(found[1]["line"], 7);
    EXPECT_EQ(found[1]["values"]["x"], "0");
}

TEST(ShaderTests, FirstNanIsPlaced) {
    (void)write("nan.hlsl",
                "float3 unit(float3 v)\n{\n    float length2 = dot(v, v);\n    float3 n = v / sqrt(length2);\n    return n;\n}\n");
    const json found = failures("nan.test.hlsl", R"(#include "nan.hlsl"
TG_TEST(is_finite)
{
    float x = tgCases(1, 0);
    float3 n = unit(float3(x, 0, 0));
    tgFinite(n);
}
)");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["line"], 6);
    const std::string text = found[0]["text"];
    EXPECT_NE(text.find("nan.hlsl(4): float3 n = v / sqrt(length2)"), std::string::npos) << text;
}

TEST(ShaderTests, EndlessLoopEndsAndIsPlacedAtItsHead) {
    const auto start = std::chrono::steady_clock::now();
    const json found = failures("endless.test.hlsl", R"(int collatz(int n)
{
    int steps = 0;
    for (int i = 0; i < 3; i++)
        while (n != 1)
        {
            n = n % 2 == 0 ? n / 2 : 3 * n + 1;
            steps++;
        }
    return steps;
}
TG_TEST(ends)
{
    int n = tgCases(1, 6, 0);
    tgTrue(collatz(n) < 100);
}
)");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["code"], "TG8211");
    EXPECT_EQ(found[0]["line"], 5);
    EXPECT_EQ(found[0]["values"]["n"], "0");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(ShaderTests, ReadBehindAnArrayIsFound) {
    const json found = failures("index.test.hlsl", R"(StructuredBuffer<float> gWeights;
static const float kTable[4] = { 1, 2, 3, 4 };
float pick(int i) { return kTable[i] + gWeights[i]; }
TG_TEST(in_range)
{
    tgBuffer(gWeights, { 1, 1, 1, 1, 1 });
    int i = tgCases(3, 4);
    tgTrue(pick(i) > 0);
}
)");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["code"], "TG8212");
    EXPECT_EQ(found[0]["line"], 3);
    EXPECT_EQ(found[0]["value"], "4");
}

std::string reduction(const std::string& barrier) {
    return fmt::format(R"(groupshared float gSums[64];
float total(uint thread, float x)
{{
    gSums[thread] = x;
    {}
    float sum = 0;
    for (uint i = 0; i < 64; i++) sum += gSums[i];
    return sum;
}}
TG_GROUP_TEST(sums, 64) {{ tgEqual(total(tgThread, 2.0), 128); }}
)",
                       barrier);
}

TEST(ShaderTests, MissingBarrierFails) {
    expectPassed(run("barrier.test.hlsl", reduction("GroupMemoryBarrierWithGroupSync();")));
    const Ran ran = run("no_barrier.test.hlsl", reduction(""));
    expectSaid(ran, kInput, {});
    EXPECT_NE(ran.out.find("(10,"), std::string::npos) << ran.out;
}

TEST(ShaderTests, FixturesReachTheShader) {
    (void)write("ramp.csv", "# energy\nx, y\n1, 10\n2, 20\n");
    expectPassed(run("fixtures.test.hlsl", R"(Texture2D gMap;
SamplerState gSampler;
RWStructuredBuffer<uint> gOut;
StructuredBuffer<float2> gRamp;
cbuffer Frame { float4x4 gView; float gExposure; };
float gGain = 0.25;
tgTexture(gMap, 2, 1, { 0, 0.5,   1, 0.25 });
tgSampler(gSampler, LINEAR, CLAMP);
tgBuffer(gRamp, "ramp.csv");
TG_TEST(sampled)
{
    tgEqual(gMap.SampleLevel(gSampler, float2(0.5, 0.5), 0).xy, float2(0.5, 0.375));
    tgEqual(gMap.Load(int3(1, 0, 0)), float4(1, 0.25, 0, 1));
    tgEqual(gRamp[1], float2(2, 20));
}
TG_TEST(constants)
{
    tgConstant(gView, 1, 2, 3, 4,  5, 6, 7, 8,  9, 10, 11, 12,  13, 14, 15, 16);
    tgConstant(gExposure, -2.5);
    tgEqual(gExposure * gGain, -0.625);
    tgEqual(gView[1], float4(5, 6, 7, 8));
    tgEqual(mul(float4(0, 0, 1, 0), gView), float4(9, 10, 11, 12));
}
TG_GROUP_TEST(stored, 4)
{
    tgBuffer(gOut, 4);
    gOut[tgThread] = tgThread * 3;
    DeviceMemoryBarrierWithGroupSync();
    tgEqual(gOut[(tgThread + 1) % 4], (tgThread + 1) % 4 * 3);
}
TG_PIXEL_TEST(derivatives)
{
    float scale = tgCases(1, 4);
    float2 uv = tgQuad * scale;
    tgEqual(ddx(uv), float2(scale, 0));
    tgEqual(ddy(uv.y), scale);
}
)",
                     {"--validate"}));
}

TEST(ShaderTests, PropertiesHoldBetweenNeighbouringCases) {
    expectPassed(run("rises.test.hlsl", R"(TG_TEST(rises)
{
    float x = tgRange(0, 1, 101);
    float y = tgCases(2, 1);
    tgIncreasing(x * x * y);
    tgDecreasing(float2(-x, y));
    tgContinuous(x * x * y, 0.05);
}
TG_TEST(where_it_is_reached) { int x = tgCases(1, 2, 3, 2, 5); if (x != 2) tgIncreasing(x); }
)"));
    const json fallen = failures("falls.test.hlsl", "TG_TEST(t) { float x = tgRange(0, 4, 5); tgIncreasing(x > 2.5 ? 0.5 : x); }\n");
    ASSERT_EQ(fallen.size(), 1U);
    EXPECT_EQ(fallen[0]["cases"], 1);
    EXPECT_EQ(fallen[0]["values"]["x"], "3");
    EXPECT_NE(fallen[0]["text"].get<std::string>().find("0.5 after 2"), std::string::npos) << fallen;
    EXPECT_EQ(failures("jumps.test.hlsl", "TG_TEST(t) { float x = tgRange(0, 1, 11); tgContinuous(step(0.45, x), 0.5); }\n").size(), 1U);
    EXPECT_EQ(failures("nan.test.hlsl", "TG_TEST(t) { float x = tgRange(-1, 1, 3); tgIncreasing(sqrt(x)); }\n").size(), 1U);
    expectSaid(run("random.test.hlsl", "TG_TEST(t) { float x = tgRandom(0, 1, 10); tgIncreasing(x); }\n"), kInput, {"TG8202", "tgRange("});
    expectSaid(run("outside.test.hlsl", "float f(float x) { tgIncreasing(x); return x; }\nTG_TEST(t) { tgTrue(f(1) > 0); }\n"), kInput,
               {"outside.test.hlsl(1,", "TG8202", "stands in a test"});
}

TEST(ShaderTests, HlslOfDirect3D9IsRespelt) {
    const std::string effect = R"(float4x4 gWorld;
float gScale = 2.0;
texture2D gSkin < string ResourceName = "skin.png"; >;
sampler2D gSkinSampler = sampler_state { Texture = <gSkin>; MinFilter = Point; MagFilter = Point; AddressU = Clamp; };
sampler gPlain : register(s3);
struct Vertex { float4 place : POSITION; float2 uv : TEXCOORD0; };
float4 through(sampler2D s, float2 uv) { return tex2D(s, uv) * gScale; }
Vertex VS(float4 place : POSITION, float2 uv : TEXCOORD0) { Vertex o; o.place = mul(place, gWorld); o.uv = uv; return o; }
float4 PS(Vertex i) : COLOR { return through(gSkinSampler, i.uv) + tex2Dlod(gPlain, float4(i.uv, 0, 0)); }
technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
tgTexture(gSkin, 2, 1, { 0.25, 0.5 });
tgTexture(gPlain, 1, 1, { 1, 2, 3, 4 });
)";
    expectPassed(run("old.test.hlsl", effect + R"(TG_TEST(vertices)
{
    tgConstant(gWorld, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1);
    tgEqual(VS(float4(1, 2, 3, 1), 0.5).place, float4(6, 8, 10, 1));
}
TG_PIXEL_TEST(pixels)
{
    float u = tgCases(0.2, 0.8, 3.0);
    Vertex i;
    i.place = 0;
    i.uv = float2(u, 0.5);
    tgNear(PS(i).xyz, (u < 0.5 ? 0.5 : 1.0) * float3(1, 0, 0) + float3(1, 2, 3), 1e-5);
}
TG_TEST(arithmetic) { float x = tgCases(-2, 2); tgNear(pow(x, 2), 4, 1e-4); tgEqual(normalize(float3(0, 0, 0)), 0); }
)"));
    const json found = failures("old_wrong.test.hlsl", effect + "TG_TEST(wrong)\n{\n    tgEqual(gScale, 3);\n}\n");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["line"], 15);
    expectSaid(run("old_bare.test.hlsl", "sampler2D gMap;\nTG_PIXEL_TEST(t) { tgEqual(tex2D(gMap, 0.5).x, 0); }\n"), kInput,
               {"TG8205", "tgTexture(gMap, width, height"});
}

TEST(ShaderTests, FixtureOfWhatIsNotDeclaredOrWithoutItsSemicolonIsSaid) {
    const std::string test = "TG_TEST(map) { tgTrue(gMap.Load(int3(0, 0, 0)).r > 0); }\n";
    for (const std::string compiler : {"dxc", "glslang"}) {
        const Ran ran =
            tegument({"test", write("undeclared.test.hlsl", "tgTexture(gMap, 2, 1, { 1, 1 });\n" + test), "--compiler", compiler});
        EXPECT_EQ(ran.code, 1);
        EXPECT_NE(ran.err.find("Texture2D gMap;"), std::string::npos) << ran.err;
    }
    const Ran open = tegument({"test", write("open.test.hlsl", "Texture2D gMap;\ntgTexture(gMap, 2, 1, { 1, 1 })\n" + test)});
    EXPECT_EQ(open.code, 1);
    EXPECT_NE(open.err.find("open.test.hlsl(2,31): error TG8203: a fixture ends with a semicolon"), std::string::npos) << open.err;
}

TEST(ShaderTests, WhatHasNoFixtureIsNamed) {
    expectSaid(run("bare.test.hlsl", "Texture2D gMap;\nTG_TEST(t) { tgEqual(gMap.Load(int3(0, 0, 0)).x, 0); }\n"), kInput,
               {"TG8205", "(2,1)", "gMap", "tgTexture(gMap"});
    expectSaid(run("fixture.test.hlsl", "Texture2D gMap;\ntgTexture(gMap, 2, 2, { 1, 2, 3 });\nTG_TEST(t) { tgEqual(1, 1); }\n"), kInput,
               {"TG8203", "(2,17)", "3 numbers do not fill 2 x 2 texels"});
    expectSaid(run("table.test.hlsl", "TG_TEST(t) { float x = tgTable(\"cut.csv\"); tgFinite(x); }\n"), kInput, {"TG8203", "cut.csv"});
    (void)write("cut.csv", "1, 2\n3\n");
    expectSaid(run("table.test.hlsl", "TG_TEST(t) { float x = tgTable(\"cut.csv\"); tgFinite(x); }\n"), kInput, {"TG8204", "cut.csv(2,"});
}

TEST(ShaderTests, CompileErrorHasTheLineOfItsFile) {
    (void)write("broken.hlsl", "float f()\n{\n    return undeclared;\n}\n");
    expectSaid(run("broken.test.hlsl", "#include \"broken.hlsl\"\nTG_TEST(t) { tgEqual(f(), 1); }\n"), kInput,
               {"broken.hlsl(3,12)", "TG3001", "undeclared"});
    expectSaid(run("struct.test.hlsl", "struct S { float x; };\nTG_TEST(t)\n{\n    S s;\n    s.x = 1;\n    tgEqual(s, 1);\n}\n"), kInput,
               {"struct.test.hlsl(6,"});
}

TEST(ShaderTests, LevelByDerivativesIsRefusedWhereThereAreNone) {
    // DXC removes such a read, and calls it success.
    expectSaid(run("level.test.hlsl",
                   "Texture2D gMap;\nSamplerState gSampler;\ntgTexture(gMap, 1, 1, { 1 });\n"
                   "TG_TEST(t) { float u = tgCases(0.2, 0.4); tgEqual(gMap.Sample(gSampler, u).x, 1); }\n",
                   {"--compiler", "dxc"}),
               kInput, {"level.test.hlsl", "TG3001", "TG_PIXEL_TEST", "SampleLevel"});
}

TEST(ShaderTests, MatrixIsNoValueWithEitherCompiler) {
    for (const char* compiler : {"dxc", "glslang"})
        expectSaid(run("matrix.test.hlsl", "TG_TEST(t) { float4x4 m = (float4x4)1; tgEqual(m, m); }\n", {"--compiler", compiler}), kInput,
                   {"TG3001", "(1,1)", "rows of matrices"});
}

TEST(ShaderTests, MalformedTestsAreUsageOfTheLanguage) {
    expectSaid(run("empty.test.hlsl", "// nothing\n"), kInput, {"TG8201", "no tests"});
    expectSaid(run("twice.test.hlsl", "TG_TEST(a) { tgTrue(true); }\nTG_TEST(a) { tgTrue(true); }\n"), kInput,
               {"TG8202", "(2,1)", "line 1"});
    expectSaid(run("arity.test.hlsl", "TG_TEST(a) { tgNear(1, 1); }\n"), kInput, {"TG8202", "tolerance"});
    expectSaid(run("open.test.hlsl", "TG_TEST(a) { tgTrue(true);\n"), kInput, {"TG8202", "not closed"});
    EXPECT_NE(run("none.test.hlsl", "TG_TEST(a) { if (tgCase > 9) tgTrue(true); }\n").out.find("no assertion was reached"),
              std::string::npos);
    expectSaid(run("filter.test.hlsl", "TG_TEST(a) { tgTrue(true); }\n", {"--filter", "b*"}), kUsage, {"TG8200", "b*"});
    expectSaid(tegument({"test", out("absent.test.hlsl")}), kUsage, {"absent.test.hlsl"});
}

TEST(ShaderTests, FileThatCannotBeReadFailsAlone) {
    const std::string empty = write("none.test.hlsl", "// nothing\n");
    const Ran ran = run("other.test.hlsl", "TG_TEST(a) { tgTrue(true); }\n", {empty, "--compiler", "glslang"});
    EXPECT_EQ(ran.code, kInput);
    EXPECT_NE(ran.err.find("TG8201"), std::string::npos) << ran.err;
    EXPECT_NE(ran.out.find("1 passed, 0 failed, 1 file not read;"), std::string::npos) << ran.out;
}

TEST(ShaderTests, ExpectedFailurePassesAndItsSuccessFails) {
    expectPassed(run("known.test.hlsl", "TG_TEST(a) { tgExpectFailure(\"issue 12\"); tgEqual(1, 2); }\n"));
    const json found = failures("fixed.test.hlsl", "TG_TEST(a)\n{\n    tgExpectFailure(\"issue 12\");\n    tgEqual(2, 2);\n}\n");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["code"], "TG8213");
}

/// numpy.save's file of two columns.
std::string npy(std::size_t rows) {
    std::string head = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, 2), }}", rows);
    head.resize(117, ' ');
    std::string bytes = std::string("\x93NUMPY\x01", 7) + '\0' + static_cast<char>(118) + '\0' + head + '\n';
    for (std::size_t i = 0; i < rows; ++i) {
        const float row[] = {static_cast<float>(i), static_cast<float>(i) * static_cast<float>(i)};
        bytes.append(reinterpret_cast<const char*>(row), sizeof row);
    }
    return bytes;
}

TEST(ShaderTests, TableOfTenThousandCasesTakesAtMostASecondMore) {
    const std::string text =
        "TG_TEST(square) { float x = tgTable(\"squares.npy\"); float y = tgTable(\"squares.npy\", 1); tgNear(x * x, y, tgUlp(1)); }\n";
    const auto seconds = [&](std::size_t rows) {
        (void)write("squares.npy", npy(rows));
        expectPassed(run("squares.test.hlsl", text)); // both are in the cache then
        const Ran ran = run("squares.test.hlsl", text, {"--json"});
        EXPECT_EQ(ran.json()["tests"][0]["assertions"], rows);
        return ran.json()["seconds"].get<double>();
    };
    const double few = seconds(10);
    EXPECT_LT(seconds(10000), few + 1);
}

TEST(ShaderTests, ErrorsAreToldInUlpAndRelative) {
    const Ran ran = run("errors.test.hlsl", "TG_TEST(off) { float x = tgRange(1, 2, 64); tgNear(asfloat(asuint(x) + 3), x, tgUlp(4)); }\n",
                        {"--errors", "--json"});
    expectPassed(ran);
    const json errors = ran.json()["tests"][0]["errors"][0];
    EXPECT_EQ(errors["ulp"], 3);
    EXPECT_EQ(errors["ulp_classes"][3], 64);
    EXPECT_NEAR(errors["relative"].get<double>(), 3 * 1.19e-7, 1e-8);
    EXPECT_NE(run("errors.test.hlsl", read(out("errors.test.hlsl")), {"--errors"}).out.find("<= 4 ulp"), std::string::npos);
}

TEST(ShaderTests, RandomInputsFollowTheirSeed) {
    const std::string text = "TG_TEST(r)\n{\n    float x = tgRandom(0, 1, 100);\n    tgTrue(x < 0.5);\n}\n";
    const json first = failures("random.test.hlsl", text);
    EXPECT_EQ(first, failures("random.test.hlsl", text));
    EXPECT_NE(first[0]["values"], failures("random.test.hlsl", text, {"--seed", "2"})[0]["values"]);
    EXPECT_GT(first[0]["cases"], 25);
    EXPECT_LT(first[0]["cases"], 75);
}

TEST(ShaderTests, ListFilterAndJUnit) {
    const std::string text = "TG_TEST(wet_skin) { tgTrue(true); }\nTG_TEST(dry_skin) { tgEqual(1 < 2, false); }\n";
    const Ran listed = run("list.test.hlsl", text, {"--list"});
    expectPassed(listed);
    EXPECT_NE(listed.out.find("dry_skin  1 cases"), std::string::npos) << listed.out;
    expectPassed(run("list.test.hlsl", text, {"--filter", "wet*"}));
    const std::string report = out("list.xml");
    EXPECT_EQ(run("list.test.hlsl", text, {"--junit", report, "--compiler", "glslang"}).code, kInput);
    const std::string xml = read(report);
    EXPECT_NE(xml.find("tests=\"2\" failures=\"1\" errors=\"0\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("tgEqual(1 &lt; 2, false)"), std::string::npos) << xml;
    expectSaid(run("list.test.hlsl", text, {"--junit", out("list.txt")}), kUsage, {"TG8024"});
}

TEST(ShaderTests, CoverageNamesLinesThatDidNotRun) {
    (void)write("covered.hlsl",
                "float f(float x)\n{\n    if (x < 0)\n        return 0;\n    else if (x > 10)\n        return 10;\n    return x;\n}\n");
    const Ran ran = run("covered.test.hlsl",
                        "#include \"covered.hlsl\"\nTG_TEST(t)\n{\n    float x = tgCases(-1, 5);\n    tgEqual(f(x), max(x, 0));\n}\n",
                        {"--coverage", out("covered.info")});
    expectPassed(ran);
    EXPECT_NE(ran.out.find("4 of 5"), std::string::npos) << ran.out;
    const std::string info = read(out("covered.info"));
    EXPECT_NE(info.find("covered.hlsl\nBRDA:3,0,0,1\nBRDA:3,0,1,1\nBRDA:5,0,0,0\nBRDA:5,0,1,1\nBRF:4\nBRH:3\n"
                        "DA:3,2\nDA:4,1\nDA:5,1\nDA:6,0\nDA:7,1\n"),
              std::string::npos)
        << info;
}

TEST(ShaderTests, CoverageNamesBranchesThatWentOneWay) {
    (void)write("sides.hlsl", R"(float f(float x, int n)
{
    if (x < 0) return 0;
    float y = x > 10 ? 10 : x;
    float3 z = x > 1.5 ? 1.0 : (n == 2 ? 2.0 : 3.0);
    for (int i = 0; i < n; i++) y += z.x;
    return y;
}
)");
    const Ran ran = run("sides.test.hlsl", R"(#include "sides.hlsl"
TG_TEST(t) { float x = tgCases(1, 5); int n = tgCases(0, 2); tgTrue(f(x, n) > 0); }
)",
                        {"--coverage", out("sides.info")});
    expectPassed(ran);
    EXPECT_NE(ran.out.find("8 of 10"), std::string::npos) << ran.out;
    const std::string info = read(out("sides.info"));
    EXPECT_NE(info.find("sides.hlsl\nBRDA:3,0,0,0\nBRDA:3,0,1,4\nBRDA:4,0,0,0\nBRDA:4,0,1,4\nBRDA:5,0,0,2\nBRDA:5,0,1,2\nBRDA:5,1,0,1\n"
                        "BRDA:5,1,1,1\nBRDA:6,0,0,4\nBRDA:6,0,1,4\nBRF:10\nBRH:8\n"),
              std::string::npos)
        << info;
}

TEST(ShaderTests, ReferenceInPythonIsAskedWithTheInputs) {
    const std::string python = write("refs.py", R"(import math
def mixed(v, w):
    return [math.exp(x) * w for x in v]
def wrong(x):
    return (x, x)
)");
    const std::string text = R"(TG_TEST(mixes)
{
    float2 v = tgRandom(-1, 1, 40);
    float w = tgCases(1, 2);
    float2 expected = tgReference("mixed", v, w);
    float twice = tgReference("half", expected.x * 2.0);
    tgNear(exp(v) * w, expected, tgUlp(8));
    tgEqual(twice, expected.x);
}
)";
    std::string half = read(python) + "half = lambda x: x / 2\n";
    expectPassed(run("reference.test.hlsl", text, {"--reference", write("refs.py", half), "--validate"}));
    const Ran missing = run("reference.test.hlsl", text);
    expectSaid(missing, kInput, {"reference.test.hlsl(5,23)", "TG8206", "--reference refs.py"});
    const json found =
        failures("off.test.hlsl", "TG_TEST(off) { float x = tgCases(2, 3); float y = tgReference(\"half\", x); tgEqual(x, y + 1); }\n",
                 {"--reference", python});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["values"]["y"], "1.5");
    expectSaid(run("wrong.test.hlsl", "TG_TEST(t) { float x = tgCases(2); float y = tgReference(\"wrong\", x); tgEqual(x, y); }\n",
                   {"--reference", python}),
               kInput, {"TG8206", "wrong returns 2 numbers"});
    expectSaid(run("absent.test.hlsl", "TG_TEST(t) { float x = tgCases(2); float y = tgReference(\"absent\", x); tgEqual(x, y); }\n",
                   {"--reference", python}),
               kInput, {"TG8206", "absent", "KeyError"});
}

TEST(ShaderTests, ReferenceInALibraryIsCalled) {
    const std::string source =
        write("refs.cpp", "extern \"C\" void product(const double* a, double* r) { r[0] = a[0] * a[2]; r[1] = a[1] * a[2]; }\n");
    const std::string library = out("librefs.so");
    if (std::system(("c++ -shared -fPIC " + source + " -o " + library + " 2> /dev/null").c_str()) != 0)
        GTEST_SKIP() << "there is no compiler";
    const std::string text =
        "TG_TEST(t) { float2 v = tgCases(float2(2, 3)); float2 p = tgReference(\"product\", v, 1.5); tgEqual(v * 1.5, p); }\n";
    expectPassed(run("library.test.hlsl", text, {"--reference", library}));
    expectSaid(run("library.test.hlsl", "TG_TEST(t) { float x = tgCases(2); float y = tgReference(\"sum\", x); tgEqual(x, y); }\n",
                   {"--reference", library}),
               kInput, {"TG8206", "no function sum"});
}

TEST(ShaderTests, MutantThatNoTestNoticesIsNamed) {
    (void)write("mutated.hlsl", "float f(float x)\n{\n    return x * 2.0;\n}\n");
    const std::string weak = "#include \"mutated.hlsl\"\nTG_TEST(t) { float x = tgCases(0); tgEqual(f(x), 0); }\n";
    const Ran ran = run("weak.test.hlsl", weak, {"--mutate", "10"});
    EXPECT_EQ(ran.code, kInput) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("mutated.hlsl(3,14): survived: / in place of *"), std::string::npos) << ran.out;
    expectPassed(
        run("strong.test.hlsl", "#include \"mutated.hlsl\"\nTG_TEST(t) { float x = tgCases(3); tgEqual(f(x), 6); }\n", {"--mutate", "10"}));
}

} // namespace
} // namespace tegument::test
