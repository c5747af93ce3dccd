// Every construct that foreign effects are refused for elsewhere stands in three or more of the effects that are read, compiled and drawn.

#include "host/support/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLeast = 3;

struct Construct {
    std::string name;
    std::string pattern; // ECMAScript
};
void PrintTo(const Construct& construct, std::ostream* out) {
    *out << construct.name;
}

/// Includes stand with the effect that they belong to: each is a text of its own here, counted once.
const std::vector<std::pair<std::string, std::string>>& texts() {
    static const auto kTexts = [] {
        std::vector<std::pair<std::string, std::string>> list;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator("tests/adopt/effects"))
            if (entry.is_regular_file()) list.emplace_back(entry.path().filename().string(), *readFile(entry.path()));
        return list;
    }();
    return kTexts;
}

class Constructs : public testing::TestWithParam<Construct> {};

TEST_P(Constructs, stand_in_three_effects_or_more) {
    const std::regex pattern(GetParam().pattern, std::regex::ECMAScript | std::regex::optimize);
    int files = 0;
    std::string names;
    for (const auto& [name, text] : texts()) {
        if (!std::regex_search(text, pattern)) continue;
        ++files;
        names += " " + name;
    }
    EXPECT_GE(files, kLeast) << GetParam().pattern << " is found in" << names;
}

INSTANTIATE_TEST_SUITE_P(
    Of, Constructs,
    testing::Values(
        Construct{"StringsInBrackets", R"(=\s*\(\s*")"}, Construct{"StatesFromAngles", R"((Enable|Mode|Ref|Mask)\s*=\s*<\s*\w+\s*>)"},
        Construct{"StatesFromBrackets", R"((Enable|Mode|Ref|Mask)\s*=\s*\(\s*[a-z]\w*\s*\))"},
        Construct{"StatesFromExpressions", R"((Enable|Mode|Ref|Blend)\s*=\s*\([^;")]*[<>?+*/][^;"]*;)"},
        Construct{"SamplerStatesFromParameters", R"((Filter|Address[UVW]|BorderColor|Anisotropy|Bias)\s*=\s*[<(])"},
        Construct{"ShaderArrays", R"((Vertex|Pixel)Shader\s+\w+\s*\[)"},
        Construct{"StructureParameters", R"(struct\s*\w*\s*\{[^}]*\}\s*\w+\s*[<=])"},
        Construct{"StructuresWithValues", R"(\n\s*[A-Z]\w+ \w+(\[\d\])?\s*(<[^>]*>)?\s*=\s*\{)"},
        Construct{"SelectorLabels", R"(=\s*\w+\?\w+)"}, Construct{"AnnotationLists", R"(<[^>]*\w+\s*=\s*[\d.]+f?\s*,\s*\w+\s*=)"},
        Construct{"ConstantIntrinsics", R"(float\d?\s+\w+\s*(<[^>]*>)?\s*=\s*\w*\(?\s*(normalize|sqrt|pow|cos|radians|exp2|log2)\s*\()"},
        Construct{"CommaValues", R"(float[234]\s+\w+\s*(<[^>]*>)?\s*=\s*\(\s*[\d.]+f?\s*,)"},
        Construct{"UnsizedArrays", R"(\w\s*\[\s*\]\s*=)"}, Construct{"ClearInScripts", R"(ClearColor\s*=\s*\(|ClearDepth\s*=\s*[\d.]+;)"},
        Construct{"SamplersInPasses", R"((Sampler|Texture)\s*\[\s*\d\s*\]\s*=)"},
        Construct{"FixedFunction", R"((Lighting|FogEnable|ColorOp\[0\]|ShadeMode|SpecularEnable)\s*=)"},
        Construct{"AlphaTest", R"([Aa]lphaTestEnable)"}, Construct{"AlphaFunction", R"(AlphaFunc\s*=)"},
        Construct{"StringInCapitals", R"(\bString\s+\w+\s*=)"}, Construct{"Pasting", R"(#define[^\n]*\w\s*##\s*\w)"},
        Construct{"StateObjectArrays", R"((RasterizerState|BlendState|DepthStencilState)\s+\w+\s*\[)"},
        Construct{"Methods", R"(\b(class|struct)\s+\w+[^;]*\{[^}]*\)\s*\{\s*return)"},
        Construct{"StencilReferences", R"(StencilRef\s*=\s*[<(]|SetDepthStencilState\(\s*\w+(\[\d\])?\s*,\s*g)"},
        Construct{"Multisampling", R"(MultisampleEnable)"}, Construct{"Assembly", R"(\basm\b)"},
        Construct{"StreamOutput", R"(ConstructGSWithSO)"},
        Construct{"IncludesInAnotherCase", R"(#\s*include "[^"\n]*(Inc/|Quad\.FXH|structures\.fxh|Material_Common|Shaders/))"},
        Construct{"Backslashes", R"(#\s*include "[^"\n]*\\)"}, Construct{"ScriptExternal", R"(ScriptExternal\s*=)"},
        Construct{"Srgb", R"(SRGBWriteEnable|SRGBTexture)"}, Construct{"ByteOrderMarks", "^\xef\xbb\xbf"},
        Construct{"CarriageReturns", R"(\r\n)"}, Construct{"ShiftJis", "[\x81-\x9f][\x40-\x7e]"}, Construct{"Pixels", R"(\bVPOS\b)"},
        Construct{"Faces", R"(\bVFACE\b)"}, Construct{"Controllers", R"(CONTROLOBJECT)"}, Construct{"Addresses", R"(SasBindAddress)"},
        Construct{"Functions", R"([Ff]unction\s*=\s*\(?")"}, Construct{"Volumes", R"(tex3D)"}, Construct{"Cubes", R"(texCUBE|TextureCube)"},
        Construct{"DepthTargets", R"(RENDERDEPTHSTENCILTARGET)"}, Construct{"Fill", R"(FillMode\s*=\s*([Ww]ire|WIRE|[Pp]oint))"},
        Construct{"Border", R"(Address\w\s*=\s*(BORDER|Border))"}, Construct{"Stencil", R"(StencilEnable\s*=\s*([Tt]rue|TRUE))"},
        Construct{"Scissor", R"([Ss]cissor\w*\s*=)"}, Construct{"Lit", R"(\blit\s*\()"}, Construct{"Levels", R"(tex2Dlod|texCUBElod)"},
        Construct{"Biases", R"(tex2Dbias)"}, Construct{"Projections", R"(tex2Dproj)"},
        Construct{"NoVertexShader", R"(VertexShader\s*=\s*(NULL|null|0)|pass\s+\w+\s*\{\s*(ZEnable = FALSE;)?\s*PixelShader)"},
        Construct{"Targets", R"(COLOR1|SV_Target1)"}, Construct{"Weights", R"(BLENDWEIGHT)"},
        Construct{"SharedParameters", R"(\bshared\b)"}, Construct{"Arguments", R"(compile\s+\w+\s+\w+\s*\(\s*[^)\s])"},
        Construct{"OpenGl", R"(\bOPENGL\b)"}, Construct{"GeometryShaders", R"(SetGeometryShader\s*\(\s*(C|g|S))"},
        Construct{"Loops", R"(LoopByCount)"}, Construct{"PointSizes", R"(PSIZE)"}, Construct{"Halves", R"(\bhalf\d?\b)"},
        Construct{"PackOffsets", R"(packoffset)"}, Construct{"StateBlocks", R"(stateblock_state)"},
        Construct{"NamelessTechniques", R"([Tt]echnique\s*\{)"}),
    [](const testing::TestParamInfo<Construct>& tested) { return tested.param.name; });

} // namespace
} // namespace tegument::test
