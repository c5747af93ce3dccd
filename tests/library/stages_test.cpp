// Every function of tegument.hlsl is called from vertex, pixel and compute shaders, by both compilers, and none has anything to remark: DXC
// takes a look-up whose level only a pixel shader knows out of all others, and calls that a warning.

#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "tests/spirv/missing.h"
#include "tools/emit/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace tegument::test {
namespace {

struct Argument {
    std::string type;
    std::string name;
    std::string elements; // "[6]"
    bool written = false;
};

struct Function {
    std::string result;
    std::string name;
    std::vector<Argument> arguments;
    bool derives = false; // asks what neighbouring pixels see
};

std::vector<Argument> argumentsOf(const std::string& list) {
    static const std::regex kArgument(R"((out |inout |in )?(\w+) (\w+)(\[\d+\])?)");
    std::vector<Argument> arguments;
    for (std::sregex_iterator at(list.begin(), list.end(), kArgument), end; at != end; ++at)
        arguments.push_back({(*at)[2], (*at)[3], (*at)[4], (*at)[1].matched && (*at)[1] != "in "});
    return arguments;
}

std::vector<Function> functionsOf(const std::string& library) {
    static const std::regex kMap(R"(TG_SAMPLER2D_PARAM\((\w+)\))");
    static const std::regex kFunction(R"(\n(\w+) (tg\w+)\(([^()]*)\)\s*\n\{)");
    const std::string text = std::regex_replace(library, kMap, "map $1");
    std::vector<Function> functions;
    for (std::sregex_iterator at(text.begin(), text.end(), kFunction), end; at != end; ++at) {
        const std::size_t from = static_cast<std::size_t>(at->position()) + 1;
        const std::string body = text.substr(from, text.find("\n}", from) - from);
        functions.push_back({(*at)[1], (*at)[2], argumentsOf((*at)[3]), body.find("ddx(") != std::string::npos});
    }
    return functions;
}

/// Members of every struct, by its name.
std::map<std::string, std::vector<Argument>> structsOf(const std::string& library) {
    static const std::regex kStruct(R"(\nstruct (Tg\w+)\n\{\n([^}]*)\};)");
    static const std::regex kMembers(R"((\w+) ([\w, ]+);)");
    static const std::regex kName(R"(\w+)");
    std::map<std::string, std::vector<Argument>> structs;
    for (std::sregex_iterator at(library.begin(), library.end(), kStruct), end; at != end; ++at) {
        const std::string body = (*at)[2];
        for (std::sregex_iterator m(body.begin(), body.end(), kMembers); m != end; ++m) {
            const std::string names = (*m)[2];
            for (std::sregex_iterator n(names.begin(), names.end(), kName); n != end; ++n)
                structs[(*at)[1]].push_back({(*m)[1], n->str(), "", false});
        }
    }
    return structs;
}

class Caller {
public:
    explicit Caller(const std::string& library) : structs_(structsOf(library)) {}

    /// A block that calls it with numbers that no compiler knows, and adds up all that it gives back.
    [[nodiscard]] std::string call(const Function& function) const {
        std::string text = "    {\n";
        std::string list;
        std::string after;
        for (const Argument& argument : function.arguments) {
            if (argument.type == "map") {
                list += ", TG_SAMPLER2D_ARG_OF(anySampler, anyMap)";
                continue;
            }
            list += ", " + argument.name;
            text += filled(argument);
            if (argument.written) after += sum(argument.type, argument.name, argument.elements);
        }
        const std::string called = function.name + "(" + (list.empty() ? list : list.substr(2)) + ")";
        if (function.result == "void") return text + "        " + called + ";\n" + after + "    }\n";
        return text + "        " + function.result + " given = " + called + ";\n" + sum(function.result, "given", "") + after + "    }\n";
    }

private:
    [[nodiscard]] std::string filled(const Argument& argument) const {
        std::string text = "        " + argument.type + " " + argument.name + argument.elements;
        if (!argument.elements.empty())
            return text + ";\n        [unroll] for (int k_" + argument.name + " = 0; k_" + argument.name + " < 6; k_" + argument.name +
                   "++)\n" + "            " + argument.name + "[k_" + argument.name + "] = seed + k_" + argument.name + ";\n";
        const auto found = structs_.find(argument.type);
        if (found == structs_.end()) return text + " = " + value(argument.type) + ";\n";
        text += " = (" + argument.type + ")0;\n";
        for (const Argument& member : found->second)
            if (!structs_.contains(member.type))
                text += "        " + argument.name + "." + member.name + " = " + value(member.type) + ";\n";
        return text;
    }
    static std::string value(const std::string& type) {
        if (type == "float") return "seed.x";
        if (type == "float2") return "seed.xy";
        if (type == "float3") return "seed.xyz";
        if (type == "float4") return "seed";
        if (type == "float4x4") return "float4x4(seed, seed.yzwx, seed.zwxy, seed.wxyz)";
        if (type == "bool") return "seed.x > 0.5";
        if (type == "int" || type == "uint") return "3";
        return "(" + type + ")0";
    }
    [[nodiscard]] std::string sum(const std::string& type, const std::string& name, const std::string& elements) const {
        if (!elements.empty()) return sum(type, name + "[0]", "");
        const auto found = structs_.find(type);
        if (found == structs_.end()) return "        total += " + name + (type == "float4x4" ? "[1].x" : "") + addend(type) + ";\n";
        std::string text;
        for (const Argument& member : found->second)
            text += sum(member.type, name + "." + member.name, "");
        return text;
    }
    static std::string addend(const std::string& type) {
        if (type == "float2") return ".xyxy";
        if (type == "float3") return ".xyzz";
        if (type == "bool") return " ? 1.0 : 0.0";
        return "";
    }

    std::map<std::string, std::vector<Argument>> structs_;
};

std::string entry(ShaderStage stage, const std::string& calls) {
    const std::string body = "    float4 total = 0.0;\n" + calls;
    if (stage == ShaderStage::Compute)
        return "RWTexture2D<float4> store;\n[numthreads(8, 8, 1)]\nvoid main(uint3 id : SV_DispatchThreadID)\n{\n"
               "    float4 seed = float4(id.xyz, 1.0) * 0.01;\n" +
               body + "    store[id.xy] = total;\n}\n";
    return "float4 main(float4 seed : TEXCOORD0) : " + std::string(stage == ShaderStage::Pixel ? "SV_Target0" : "SV_Position") + "\n{\n" +
           body + "    return total;\n}\n";
}

/// Look-ups that SPIR-V holds: whose level only a pixel shader knows, and all others.
struct Looks {
    int byNeighbours = 0;
    int byLevel = 0;
};

Looks looksOf(const std::vector<std::uint32_t>& spirv) {
    constexpr std::uint32_t kFirst = 87; // OpImageSampleImplicitLod; then explicit, and so on in turns up to OpImageFetch
    constexpr std::uint32_t kFetch = 95;
    Looks looks;
    for (std::size_t at = 5; at < spirv.size(); at += std::max(spirv[at] >> 16U, 1U)) {
        const std::uint32_t operation = spirv[at] & 0xffffU;
        if (operation >= kFirst && operation < kFetch && operation % 2 == 1) ++looks.byNeighbours;
        if ((operation >= kFirst && operation < kFetch && operation % 2 == 0) || operation == kFetch) ++looks.byLevel;
    }
    return looks;
}

struct Place {
    ShaderStage stage;
    Compiler compiler;
};

class EveryFunction : public testing::TestWithParam<Place> {
protected:
    void SetUp() override {
        const auto text = flattenLibrary("hlsl/tegument.fxh", {.read = readFile});
        ASSERT_TRUE(text) << format(text.error());
        library_ = *text;
    }
    /// What the compiler says of it; empty where it says nothing.
    [[nodiscard]] std::string said(const std::string& calls, ShaderStage stage) const {
        const std::string code = library_ + "\nTexture2D anyMap;\nSamplerState anySampler;\n" + entry(stage, calls);
        const auto shader = compileShader({.code = code, .file = "stages.hlsl", .entry = "main", .stage = stage}, GetParam().compiler);
        if (!shader) return format(shader.error());
        std::string all;
        for (const Diagnostic& warning : shader->warnings)
            all += format(warning) + "\n";
        const Looks looks = looksOf(shader->spirv);
        if (stage != ShaderStage::Pixel && looks.byNeighbours > 0) all += "look-ups take their level from neighbours\n";
        if (calls.find("anyMap") != std::string::npos && looks.byNeighbours + looks.byLevel == 0) all += "look-ups are gone\n";
        return all;
    }
    /// How many look-ups a shader is left with; DXC takes some out without a word.
    [[nodiscard]] int looks(const std::string& calls, ShaderStage stage) const {
        const std::string code = library_ + "\nTexture2D anyMap;\nSamplerState anySampler;\n" + entry(stage, calls);
        const auto shader = compileShader({.code = code, .file = "stages.hlsl", .entry = "main", .stage = stage}, GetParam().compiler);
        if (!shader) return -1;
        const Looks found = looksOf(shader->spirv);
        return found.byNeighbours + found.byLevel;
    }
    [[nodiscard]] const std::string& library() const { return library_; }

private:
    std::string library_;
};

TEST_P(EveryFunction, compiles_without_a_remark) {
    if (const std::string missing = compilerMissing(GetParam().compiler); !missing.empty()) GTEST_SKIP() << missing;
    const std::vector<Function> functions = functionsOf(library());
    ASSERT_GT(functions.size(), 200U) << "they are not found";
    const Caller caller(library());
    const ShaderStage stage = GetParam().stage;
    std::string all;
    std::set<std::string> derive;
    for (const Function& function : functions) {
        if (function.derives) derive.insert(function.name);
        if (!function.derives || stage == ShaderStage::Pixel) all += caller.call(function);
    }
    EXPECT_EQ(derive, (std::set<std::string>{"tgPreintegratedCurvature", "tgTransmissionScale"})) << "the manual names them";
    std::string reading;
    for (const Function& function : functions)
        if (const std::string call = caller.call(function); call.find("anyMap") != std::string::npos) reading += call;
    EXPECT_EQ(looks(reading, stage), looks(reading, ShaderStage::Pixel)) << "look-ups are gone that pixel shaders have";
    if (said(all, stage).empty()) return;
    for (const Function& function : functions) { // one by one: which
        if (function.derives && stage != ShaderStage::Pixel) continue;
        EXPECT_EQ(said(caller.call(function), stage), "") << function.name;
    }
}

TEST_P(EveryFunction, that_takes_its_level_from_neighbours_is_found) {
    if (const std::string missing = compilerMissing(GetParam().compiler); !missing.empty()) GTEST_SKIP() << missing;
    const bool pixel = GetParam().stage == ShaderStage::Pixel;
    const std::string remark = said("    total += anyMap.Sample(anySampler, seed.xy);\n", GetParam().stage);
    EXPECT_EQ(remark.empty(), pixel || GetParam().compiler == Compiler::Glslang) << remark; // glslang takes the finest level by itself
}

std::string nameOf(const testing::TestParamInfo<Place>& tested) {
    static constexpr const char* kStages[] = {"Vertex", "Pixel", "Compute"};
    const auto stage = tested.param.stage;
    const std::size_t at = stage == ShaderStage::Vertex ? 0 : stage == ShaderStage::Pixel ? 1 : 2;
    return std::string(kStages[at]) + (tested.param.compiler == Compiler::Dxc ? "Dxc" : "Glslang");
}

INSTANTIATE_TEST_SUITE_P(Stages, EveryFunction,
                         testing::Values(Place{ShaderStage::Vertex, Compiler::Dxc}, Place{ShaderStage::Pixel, Compiler::Dxc},
                                         Place{ShaderStage::Compute, Compiler::Dxc}, Place{ShaderStage::Vertex, Compiler::Glslang},
                                         Place{ShaderStage::Pixel, Compiler::Glslang}, Place{ShaderStage::Compute, Compiler::Glslang}),
                         nameOf);

} // namespace
} // namespace tegument::test
