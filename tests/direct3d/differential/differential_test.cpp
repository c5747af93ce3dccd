// Small effects, changed at random but the same on every machine: what Microsoft's compiler reads we read, and what it refuses we refuse.
// TEGUMENT_MUTANTS says how many (default 300), TEGUMENT_MUTANTS_FROM the first one's seed (default 0); TEGUMENT_MUTANTS_SHOW=1 prints each
// about which the two do not agree.

#include "host/support/file.h"
#include "host/support/temporary.h"
#include "tests/effect/support.h"
#include "tools/direct3d/microsoft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace tegument::test {
namespace {

constexpr std::uint32_t kUsual = 300;
/// What is changed: all but the code of functions, which is the compilers' alone. Tokens are separated by blanks.
struct Base {
    const char* profile;
    const char* parameters;
    const char* functions;
    const char* technique;
};

constexpr Base kDirect3D9 = {
    "fx_2_0",
    "float4 gColor : DIFFUSE < string UIName = \"Colour\" ; float UIMin = 0 ; > = float4 ( 1 , 0.5 , 0.25 , 1 ) ; \n"
    "float gScale [ 2 ] = { 1 , 2 } ; \n"
    "float4x4 gWorld : WORLD ; \n"
    "bool gOn = true ; \n"
    "int gCount < int UIMax = 4 ; > = 3 ; \n"
    "float3 gAxis = { 0 , 1 , - 2 } ; \n"
    "texture gMap < string ResourceName = \"a.png\" ; > ; \n"
    "sampler2D gSampler = sampler_state { Texture = < gMap > ; MinFilter = LINEAR ; MagFilter = POINT ; AddressU = WRAP ; } ; \n",
    "float4 VS(float4 p : POSITION) : POSITION { return p; }\nfloat4 PS() : COLOR { return 1; }\n",
    "technique T < int a = 1 ; > { \n"
    "pass P < string Script = \"Draw=geometry;\" ; > { \n"
    "CullMode = NONE ; ZEnable = TRUE ; AlphaBlendEnable = false ; SrcBlend = SRCALPHA ; StencilRef = 1 ; \n"
    "VertexShader = compile vs_2_0 VS ( ) ; \n"
    "PixelShader = compile ps_2_0 PS ( ) ; \n"
    "} } \n"};

/// As many lines of parameters, so that the functions stand in the same ones.
constexpr Base kDirect3D11 = {
    "fx_5_0",
    "float4 gColor : DIFFUSE < string UIName = \"Colour\" ; float UIMin = 0 ; > = float4 ( 1 , 0.5 , 0.25 , 1 ) ; \n"
    "cbuffer B { float4x4 gWorld : WORLD ; float gScale [ 2 ] ; } ; \n"
    "int gCount < int UIMax = 4 ; > = 3 ; \n"
    "Texture2D gMap < string ResourceName = \"a.png\" ; > ; \n"
    "SamplerState gSampler { Filter = MIN_MAG_MIP_LINEAR ; AddressU = WRAP ; } ; \n"
    "BlendState gBlend { BlendEnable [ 0 ] = TRUE ; SrcBlend = SRC_ALPHA ; DestBlend = INV_SRC_ALPHA ; } ; \n"
    "DepthStencilState gDepth { DepthEnable = TRUE ; DepthFunc = LESS_EQUAL ; } ; \n"
    "RasterizerState gRaster { CullMode = NONE ; FillMode = SOLID ; } ; \n",
    "float4 VS(float4 p : POSITION) : SV_Position { return p; }\nfloat4 PS() : SV_Target { return 1; }\n",
    "technique11 T < int a = 1 ; > { \n"
    "pass P < string Script = \"Draw=geometry;\" ; > { \n"
    "SetBlendState ( gBlend , float4 ( 0 , 0 , 0 , 0 ) , 0xffffffff ) ; SetDepthStencilState ( gDepth , 1 ) ; SetRasterizerState ( gRaster "
    ") ; \n"
    "SetVertexShader ( CompileShader ( vs_4_0 , VS ( ) ) ) ; \n"
    "SetPixelShader ( CompileShader ( ps_4_0 , PS ( ) ) ) ; \n"
    "} } \n"};

std::vector<std::string> wordsOf(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        if (end > at) words.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

const std::vector<std::string>& others() {
    static const auto kOthers =
        wordsOf("; { } ( ) < > = , : [ ] 0 1 2 -1 1.5 1e2 1.0f 0x10 true false TRUE NULL float float2 float4 float4x4 int bool half "
                "string texture texture2D sampler sampler2D matrix vector static const uniform shared register c0 POSITION "
                "WORLDVIEWPROJECTION LINEAR NONE CCW CLAMP Texture MipFilter FillMode compile vs_3_0 ps_3_0 technique pass \"x\" + * / 99 "
                "gColor gMap");
    return kOthers;
}

/// Another word of the same kind: what is well-formed stays so more often than not.
std::string like(const std::string& word, std::mt19937& random, bool direct3D11) {
    static const std::vector<std::vector<std::string>> kKinds = {
        {"0", "1", "2", "3", "0.5", "1e2", "1.0f", "0x10", "99", "-1"},
        {"float", "float2", "float3", "float4", "float4x4", "int", "bool", "half", "string", "matrix", "texture", "sampler2D"},
        {"DIFFUSE", "WORLD", "POSITION", "WORLDVIEWPROJECTION", "COLOR0", "Anything"},
        {"NONE", "CCW", "LINEAR", "POINT", "WRAP", "CLAMP", "TRUE", "true", "false", "SRCALPHA", "INVSRCALPHA", "ONE", "1"},
        {"CullMode", "ZEnable", "AlphaBlendEnable", "SrcBlend", "DestBlend", "StencilRef", "ZWriteEnable", "FillMode", "AlphaRef",
         "Lighting"},
        {"MinFilter", "MagFilter", "MipFilter", "AddressU", "AddressV", "AddressW", "BorderColor", "MaxAnisotropy"},
        {"vs_2_0", "vs_3_0", "vs_1_1", "ps_2_0", "ps_3_0"},
        {"gColor", "gScale", "gWorld", "gOn", "gCount", "gAxis", "gMap", "gSampler", "T", "P", "VS", "PS"}};
    static const std::vector<std::vector<std::string>> kKindsOfDirect3D11 = {
        {"vs_4_0", "ps_4_0", "vs_5_0", "ps_5_0", "gs_4_0"},
        {"BlendEnable", "SrcBlendAlpha", "AlphaToCoverageEnable", "RenderTargetWriteMask", "BlendOp"},
        {"DepthEnable", "DepthFunc", "DepthWriteMask", "StencilEnable", "FrontFaceStencilFunc"},
        {"SRC_ALPHA", "INV_SRC_ALPHA", "LESS_EQUAL", "LESS", "ALWAYS", "SOLID", "WIREFRAME", "MIN_MAG_MIP_LINEAR", "ANISOTROPIC", "ADD"},
        {"SetBlendState", "SetDepthStencilState", "SetRasterizerState", "SetVertexShader", "SetPixelShader", "SetGeometryShader"},
        {"gBlend", "gDepth", "gRaster", "NULL"}};
    for (const auto* kinds : {&kKinds, direct3D11 ? &kKindsOfDirect3D11 : nullptr}) {
        if (kinds == nullptr) continue;
        for (const std::vector<std::string>& kind : *kinds)
            if (std::ranges::find(kind, word) != kind.end()) return kind[random() % kind.size()];
    }
    return word;
}

/// One to two changes: a word left out, doubled, exchanged with the next one, or replaced by another, in half of the cases by one of its
/// kind.
std::vector<std::string> changed(std::vector<std::string> words, std::mt19937& random, bool direct3D11) {
    for (unsigned changes = 1 + random() % 2; changes > 0; --changes) {
        const std::size_t at = random() % words.size();
        const auto place = words.begin() + static_cast<std::ptrdiff_t>(at);
        switch (random() % 8) {
        case 0: words.erase(place); break;
        case 1: words.insert(place, words[at]); break;
        case 2: std::swap(words[at], words[(at + 1) % words.size()]); break;
        case 3: words[at] = others()[random() % others().size()]; break;
        default: words[at] = like(words[at], random, direct3D11); break;
        }
    }
    return words;
}

std::string textOf(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += word + ' ';
    return text;
}

/// In one half of the files the parameters are changed, in the other the technique.
std::string mutant(const Base& base, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::string> parameters = wordsOf(base.parameters);
    std::vector<std::string> technique = wordsOf(base.technique);
    const bool direct3D11 = base.profile != std::string_view(kDirect3D9.profile);
    (seed % 2 == 0 ? parameters : technique) = changed(seed % 2 == 0 ? parameters : technique, random, direct3D11);
    return textOf(parameters) + "\n" + base.functions + textOf(technique) + "\n";
}

/// The code of functions is the compilers' alone: lines 10 and 11, and where they are made into instructions (X4000 to X4999), as when a
/// pass has the other's function.
bool isOfCode(const MicrosoftResult& result) {
    const auto first = std::ranges::find(result.diagnostics, Severity::Error, &Diagnostic::severity);
    return first != result.diagnostics.end() && (first->at.line == 10 || first->at.line == 11 || first->text.starts_with("X4"));
}

std::uint32_t numberIn(const char* variable, std::uint32_t usual) {
    const char* asked = std::getenv(variable);
    return asked != nullptr ? static_cast<std::uint32_t>(std::strtoul(asked, nullptr, 10)) : usual;
}

class Differential : public testing::TestWithParam<Base> {};

TEST_P(Differential, effects_that_microsofts_compiler_reads_and_refuses_are_read_and_refused) {
    const Base& base = GetParam();
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const bool show = std::getenv("TEGUMENT_MUTANTS_SHOW") != nullptr;
    const std::uint32_t count = numberIn("TEGUMENT_MUTANTS", kUsual);
    const std::uint32_t first = numberIn("TEGUMENT_MUTANTS_FROM", 0);
    const Temporary folder(std::filesystem::temp_directory_path() / ("tegument-differential-" + std::to_string(::getpid())));
    std::vector<MicrosoftJob> jobs;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto file = folder.path() / (std::to_string(first + i) + ".fx");
        ASSERT_TRUE(writeFile(file, mutant(base, first + i)));
        jobs.push_back({.profile = base.profile, .source = file});
    }
    const auto theirs = compileWithMicrosoft(jobs);
    ASSERT_TRUE(theirs) << format(theirs.error());
    std::size_t read = 0;
    std::size_t refusedByUs = 0;
    std::size_t readByUs = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool good = (*theirs)[i].ok;
        const auto ours = load({{"main.fx", mutant(base, first + i)}}, {.lenient = true});
        read += good ? 1 : 0;
        refusedByUs += good && !ours ? 1 : 0;
        const bool silent = ours && ours->warnings.empty() && !isOfCode((*theirs)[i]); // what is left out leniently is said
        readByUs += !good && silent ? 1 : 0;
        if (show && (good ? !ours : silent)) {
            std::cout << "--- " << first + i << (good ? ": they read it; " + format(ours.error()) : ": we read it; ")
                      << (good || (*theirs)[i].diagnostics.empty() ? std::string() : format((*theirs)[i].diagnostics.front())) << "\n"
                      << mutant(base, first + i);
        }
    }
    std::cout << count << " effects: Microsoft's compiler reads " << read << ", of which we refuse " << refusedByUs << "; of the "
              << count - read << " that it refuses we read without a warning " << readByUs << "\n";
    EXPECT_EQ(refusedByUs, 0U);
    EXPECT_EQ(readByUs, 0U);
}

INSTANTIATE_TEST_SUITE_P(Of, Differential, testing::Values(kDirect3D9, kDirect3D11),
                         [](const auto& of) { return std::string(of.param.profile); });

} // namespace
} // namespace tegument::test
