// Effects of ReShade over a picture of 8 bits, against the same formulas in double precision.

#include "host/effect/reshade.h"
#include "host/support/file.h"
#include "tests/run/fixture.h"
#include "tests/spirv/missing.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 16;
constexpr int kHeight = 8;
constexpr double kTolerance = 1e-3; // of the task; the target between has 16 bits

using Colour = std::array<double, 3>;

/// The picture, clamped at its edges.
Colour at(int x, int y) {
    x = std::clamp(x, 0, kWidth - 1);
    y = std::clamp(y, 0, kHeight - 1);
    return {x * 16 / 255.0, y * 32 / 255.0, (x * 7 + y * 11) % 256 / 255.0};
}

double depthAt(int x, int y) {
    return (x * 8 + y * 16) / 255.0;
}

Colour each(const std::function<double(int channel)>& value) {
    return {value(0), value(1), value(2)};
}

double decoded(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double encoded(double v) {
    return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// What every file begins with: the names that ReShade documents.
const std::string kBegin = "texture Back : COLOR; texture Deep : DEPTH; sampler Picture { Texture = Back; };\n"
                           "void VS(uint id : SV_VertexID, out float4 p : SV_Position, out float2 uv : TEXCOORD)\n"
                           "{ uv = float2(id == 2 ? 2 : 0, id == 1 ? 2 : 0); p = float4(uv * float2(2, -2) + float2(-1, 1), 0, 1); }\n";
const std::string kEnd = "technique T { pass { VertexShader = VS; PixelShader = PS; } }";
const std::string kHead = "float4 PS(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target ";

struct Case {
    const char* name;
    std::string code;
    std::function<Colour(int x, int y)> expected;
};

void PrintTo(const Case& one, std::ostream* stream) {
    *stream << one.name;
}

std::vector<Case> cases() {
    return {
        {"inverted", kHead + "{ return 1 - tex2D(Picture, uv); }" + kEnd,
         [](int x, int y) { return each([=](int c) { return 1 - at(x, y)[c]; }); }},
        {"uniforms",
         "namespace A { uniform float Strength < ui_type = \"slider\"; ui_min = 0.0; ui_max = 1.0; ui_label = \"Strength\"; > = 0.25;\n"
         "namespace B { uniform float Strength = 0.5; float of(float3 c) { return A::Strength * c.r + Strength * c.g; } } }\n" +
             kHead + "{ return A::B::of(tex2D(Picture, uv).rgb) * A::B::Strength; }" + kEnd,
         [](int x, int y) { return each([=](int) { return 0.5 * (0.25 * at(x, y)[0] + 0.5 * at(x, y)[1]); }); }},
        {"offsets",
         kHead +
             "{ return (tex2D(Picture, uv, int2(-1, 0)) + tex2Doffset(Picture, uv, int2(1, 0)) + tex2Dlod(Picture, float4(uv, 0, 0), "
             "int2(0, 1))) / 3; }" +
             kEnd,
         [](int x, int y) { return each([=](int c) { return (at(x - 1, y)[c] + at(x + 1, y)[c] + at(x, y + 1)[c]) / 3; }); }},
        {"targets",
         "texture Half { Width = BUFFER_WIDTH; Height = BUFFER_HEIGHT; Format = RGBA16F; };\nsampler Squares { Texture = Half; MinFilter = "
         "POINT; };\n"
         "float4 First(float4 p : SV_Position, float2 uv : TEXCOORD) : SV_Target { float4 c = tex2D(Picture, uv); return c * c; }\n" +
             kHead +
             "{ return 0.5 * (tex2D(Picture, uv) + tex2D(Squares, uv)); }\ntechnique T { pass { VertexShader = VS; PixelShader = First; "
             "RenderTarget0 = Half; } pass { VertexShader = VS; PixelShader = PS; } }",
         [](int x, int y) { return each([=](int c) { return 0.5 * (at(x, y)[c] + at(x, y)[c] * at(x, y)[c]); }); }},
        {"fetched", kHead + "{ int2 size = tex2Dsize(Picture); return tex2Dfetch(Picture, int2(size.x - 1 - (int)p.x, p.y)); }" + kEnd,
         [](int x, int y) { return at(kWidth - 1 - x, y); }},
        {"handed_over",
         "float3 twice(sampler2D s, float2 uv) { return tex2Dlod(s, float4(uv, 0, 0)).rgb * 0.5; }\nfloat3 again(sampler s, float2 uv) { "
         "return twice(s, uv); }\n" +
             kHead + "{ return float4(again(Picture, uv).bgr, 1f); }" + kEnd,
         [](int x, int y) { return each([=](int c) { return 0.5 * at(x, y)[2 - c]; }); }},
        {"gathered",
         kHead + "{ float4 g = tex2DgatherG(Picture, uv + 0.5 * float2(BUFFER_RCP_WIDTH, BUFFER_RCP_HEIGHT)); return dot(g, 0.25); }" +
             kEnd,
         [](int x, int y) {
             return each([=](int) { return (at(x, y)[1] + at(x + 1, y)[1] + at(x, y + 1)[1] + at(x + 1, y + 1)[1]) / 4; });
         }},
        {"blended",
         kHead + "{ return float4(1, 0.5, 0, 0.25); }\ntechnique T { pass { VertexShader = VS; PixelShader = PS; BlendEnable = true; "
                 "SrcBlend = SRCALPHA; "
                 "DestBlend = INVSRCALPHA; } }",
         [](int x, int y) {
             const Colour over{1, 0.5, 0};
             return each([=](int c) { return 0.25 * over[static_cast<std::size_t>(c)] + 0.75 * at(x, y)[c]; });
         }},
        {"stored",
         "texture Made { Width = BUFFER_WIDTH; Height = BUFFER_HEIGHT; Format = RGBA16F; };\nstorage Into { Texture = Made; };\nsampler "
         "From { Texture = Made; };\n"
         "groupshared float row[8];\nvoid CS(uint3 id : SV_DispatchThreadID, uint3 t : SV_GroupThreadID) { row[t.x] = tex2Dfetch(Picture, "
         "int2(id.xy)).r; "
         "barrier(); tex2Dstore(Into, id.xy, float4(row[7 - t.x], row[0], 0.5, 1)); }\n" +
             kHead +
             "{ return tex2D(From, uv); }\ntechnique T { pass { ComputeShader = CS<8, 1>; DispatchSizeX = BUFFER_WIDTH / 8; DispatchSizeY "
             "= "
             "BUFFER_HEIGHT; } pass { VertexShader = VS; PixelShader = PS; } }",
         [](int x, int y) {
             return Colour{at(x / 8 * 8 + 7 - x % 8, y)[0], at(x / 8 * 8, y)[0], 0.5};
         }},
        {"linear_light",
         "sampler Linear { Texture = Back; SRGBTexture = true; };\nfloat4 read(sampler s, float2 uv) { return tex2D(s, uv); }\n" + kHead +
             "{ return read(Linear, uv) * 0.5; }\ntechnique T { pass { VertexShader = VS; PixelShader = PS; SRGBWriteEnable = true; } }",
         [](int x, int y) { return each([=](int c) { return encoded(0.5 * decoded(at(x, y)[c])); }); }},
        {"one_after_another",
         kHead + "{ return tex2D(Picture, uv) * 0.5; }\ntechnique T { pass { VertexShader = VS; PixelShader = PS; } pass { VertexShader = "
                 "VS; PixelShader = PS; } }",
         [](int x, int y) { return each([=](int c) { return 0.25 * at(x, y)[c]; }); }},
        {"names_of_functions",
         "uniform float degrees = 0.5; texture Tiny { Width = BUFFER_WIDTH / 64; Height = 1; MipLevels = 9; };\n" + kHead +
             "{ float sin = sin(0); return degrees * tex2D(Picture, uv) + sin; }" + kEnd,
         [](int x, int y) { return each([=](int c) { return 0.5 * at(x, y)[c]; }); }},
        {"masked", kHead + "{ return 1; }\ntechnique T { pass tgShow { VertexShader = VS; PixelShader = PS; RenderTargetWriteMask = 2; } }",
         [](int x, int y) {
             return Colour{at(x, y)[0], 1, at(x, y)[2]};
         }},
        {"depth", "sampler Near { Texture = Deep; };\n" + kHead + "{ return tex2D(Near, uv).x; }" + kEnd,
         [](int x, int y) { return each([=](int) { return depthAt(x, y); }); }},
        {"sources",
         "uniform float timer < source = \"timer\"; >; uniform bool ready < source = \"bufready_depth\"; >; uniform int none;\n" + kHead +
             "{ return ready ? timer / 4000 + none : 0; }" + kEnd,
         [](int, int) {
             return Colour{0.25, 0.25, 0.25};
         }},
        {"strip",
         "void Left(uint id : SV_VertexID, out float4 p : SV_Position, out float2 uv : TEXCOORD) { uv = 0; p = float4(id & 1 ? 0 : -1, id "
         "& 2 ? 1 : -1, 0, 1); }\n" +
             kHead +
             "{ return 1; }\ntechnique T { pass { VertexShader = Left; PixelShader = PS; PrimitiveTopology = TRIANGLESTRIP; VertexCount = "
             "4; } }",
         [](int x, int y) {
             return x < kWidth / 2 ? Colour{1, 1, 1} : at(x, y);
         }},
    };
}

class Reshade : public Run, public testing::WithParamInterface<Case> {
protected:
    void SetUp() override {
        Run::SetUp();
        if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    }
};

fs::path written(const std::string& name, const std::string& text) {
    const fs::path file = fs::path(testing::TempDir()) / ("reshade_" + name + ".fx");
    EXPECT_TRUE(succeeded(writeFile(file, text)));
    return file;
}

/// A picture of the test, as a file.
std::string picture(const std::string& name, const std::function<Colour(int x, int y)>& colour) {
    Image image{.width = kWidth, .height = kHeight, .channels = 3};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (const double value : colour(x, y))
                image.pixels.push_back(static_cast<float>(value));
    const fs::path file = fs::path(testing::TempDir()) / name;
    EXPECT_TRUE(succeeded(writePng(file, image, PngEncoding::Raw)));
    return file.string();
}

TEST_P(Reshade, draws_what_its_formula_says) {
    const fs::path file = written(GetParam().name, kBegin + GetParam().code);
    const LoadOptions load{.defines = {{"BUFFER_WIDTH", std::to_string(kWidth)},
                                       {"BUFFER_HEIGHT", std::to_string(kHeight)},
                                       {kPictureIn, "1"},
                                       {kDepthIn, "1"}},
                           .lenient = true};
    const auto effect = loadEffect(file, load);
    ASSERT_TRUE(succeeded(effect));
    RunOptions options{.technique = "T", .width = kWidth, .height = kHeight};
    options.textures = {{"tgPictureIn", picture(fmt::format("{}_picture.png", GetParam().name), at)},
                        {"tgDepthIn", picture(fmt::format("{}_depth.png", GetParam().name),
                                              [](int x, int y) { return each([=](int) { return depthAt(x, y); }); })}};
    const auto result = runEffect(*device_, *effect, nullptr, {}, options);
    ASSERT_TRUE(succeeded(result));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(result->image.at(x, y, c), GetParam().expected(x, y)[static_cast<std::size_t>(c)], kTolerance)
                    << x << ", " << y << ", channel " << c;
}

INSTANTIATE_TEST_SUITE_P(Cases, Reshade, testing::ValuesIn(cases()), [](const auto& one) { return std::string(one.param.name); });

/// Without a picture of the user's there is ours, and a technique that draws it alone.
TEST_F(Run, an_effect_of_reshade_has_a_scene_to_change) {
    if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    const auto effect = loadEffect(written("scene", kBegin + kHead + "{ return tex2D(Picture, uv) * 0.5; }" + kEnd), {.lenient = true});
    ASSERT_TRUE(succeeded(effect));
    RunOptions options{.technique = kPictureTechnique, .width = 64, .height = 64};
    const auto plain = runEffect(*device_, *effect, nullptr, {}, options);
    ASSERT_TRUE(succeeded(plain));
    options.technique = "T";
    const auto changed = runEffect(*device_, *effect, nullptr, {}, options);
    ASSERT_TRUE(succeeded(changed));
    EXPECT_GT(plain->image.at(32, 4, 2), plain->image.at(32, 4, 0)) << "the sky is blue";
    EXPECT_NEAR(changed->image.at(20, 50, 1), 0.5F * plain->image.at(20, 50, 1), 1e-4F);
}

struct Wrong {
    const char* text;
    int code;
    int line;
};

/// One error each, with its place.
TEST(ReshadeErrors, what_cannot_be_read_is_said_once) {
    const std::vector<Wrong> all = {
        {"sampler S { MinFilter = POINT; };", 1101, 4},
        {"namespace N {", 1102, 5},
        {"float f( { ", 1102, 4},
        {"technique U { pass { VertexShader = VS; PixelShader = PS; PrimitiveTopology = POINTLIST; } }", 2003, 4},
        {"technique U { pass { VertexShader = VS; PixelShader = Nowhere; } }", 2022, 4},
        {"technique U { draw { } }", 1101, 4},
        {"technique U { pass tgShow { VertexShader = VS; } }", 1101, 4},
        {"texture { Width = 1; };", 1101, 4}};
    for (const Wrong& wrong : all) {
        const auto effect = loadEffect(written("wrong", kBegin + wrong.text + "\n" + kHead + "{ return 0; }" + kEnd), {.lenient = true});
        ASSERT_FALSE(effect) << wrong.text;
        EXPECT_EQ(code(effect), wrong.code) << format(effect.error());
        EXPECT_EQ(effect.error().diagnostics.front().at.line, wrong.line) << wrong.text;
    }
}

/// A name that Direct3D 9 gives a shader object is none of ReShade's.
TEST(ReshadeErrors, an_effect_of_direct3d_9_stays_one) {
    const auto effect = loadEffect(written("nine", "float4 P() : COLOR { return 1; } PixelShader shader = compile ps_2_0 P();\n"
                                                   "technique T { pass A { PixelShader = (shader); } }"),
                                   {.lenient = true});
    ASSERT_TRUE(succeeded(effect));
    EXPECT_FALSE(effect->reshade);
}

} // namespace
} // namespace tegument::test
