// Shaders in assembly inside of a pass, and the registers that it gives.

#include "host/effect/assembly.h"
#include "host/effect/parser.h"
#include "host/effect/types.h"
#include "host/support/text.h"

#include <algorithm>

#include <fmt/format.h>

namespace tegument {

namespace {

/// Of `<name>`, `(name)`: the name.
std::string withoutBrackets(std::string text) {
    const bool bracket = text.size() > 2 && ((text.front() == '<' && text.back() == '>') || (text.front() == '(' && text.back() == ')'));
    return bracket ? std::string(trim(text.substr(1, text.size() - 2))) : text;
}

} // namespace

std::string Parser::textOf(const TokenRange& range) const {
    std::string text;
    for (std::size_t i = range.first; i < range.last; ++i)
        text += (tokens_[i].space && !text.empty() ? " " : "") + std::string(tokens_[i].text);
    return text;
}

/// A matrix fills four registers with its columns, as Direct3D 9 lays it out; what is shorter than a register is filled with zeros.
void Parser::giveConstant(const Assignment& given, std::map<int, std::string>& constants) const {
    const int first = std::max(given.index, 0);
    const std::string text = withoutBrackets(textOf(given.value));
    const Parameter* parameter = result_.effect.findParameter(text);
    if (text.starts_with('{')) {
        constants[first] = fmt::format("float4({})", text.substr(1, text.size() - 2));
    } else if (!parameter) {
        constants[first] = fmt::format("float4({})", text);
    } else if (parameter->type.rows > 1) {
        for (int column = 0; column < parameter->type.columns; ++column) {
            std::string parts;
            for (int row = 0; row < 4; ++row)
                parts += (row > 0 ? ", " : "") + (row < parameter->type.rows ? fmt::format("{}[{}][{}]", text, row, column) : "0");
            constants[first + column] = fmt::format("float4({})", parts);
        }
    } else {
        for (int i = 0; i < std::max(parameter->type.elements, 1); ++i) {
            std::string value = parameter->type.elements > 0 ? fmt::format("{}[{}]", text, i) : text;
            if (parameter->type.columns < 4) value = fmt::format("float4({}", value);
            for (int c = parameter->type.columns; c < 4; ++c)
                value += c == 3 ? ", 0)" : ", 0";
            constants[first + i] = value;
        }
    }
}

/// `Sampler[0] = (name)`, or a sampler made for `Texture[0] = <name>`.
std::string Parser::stageSampler(const Assignment& given) {
    const std::string text = withoutBrackets(textOf(given.value));
    if (equalsIgnoreCase(given.name.text, "Sampler")) return result_.effect.findSampler(text) ? text : std::string();
    if (!result_.effect.findParameter(text)) return {};
    Sampler sampler{
        .name = fmt::format("tg_stage{}_{}", assembled_, std::max(given.index, 0)), .texture = text, .at = position(given.name)};
    sampler.state = direct3D9SamplerDefaults();
    result_.assembled += fmt::format("sampler {};\n", sampler.name);
    result_.effect.samplers.push_back(sampler);
    return sampler.name;
}

void Parser::assemble(Pass& pass, bool vertex, const TokenRange& text) {
    Assembly assembly{.name = fmt::format("tg_assembly{}", ++assembled_)};
    for (const Assignment& given : registers_) {
        const std::string name = toLower(given.name.text);
        const bool constant = name.find("constant") != std::string::npos;
        if (constant && name.starts_with('v') == vertex) giveConstant(given, assembly.constants);
        if (!constant && !vertex) assembly.samplers[std::max(given.index, 0)] = stageSampler(given);
    }
    bool comment = false; // ';' begins one
    for (std::size_t i = text.first; i < text.last; ++i) {
        const Token& token = tokens_[i];
        const bool fresh = i == text.first || token.line != tokens_[i - 1].line || token.file != tokens_[i - 1].file;
        if (fresh) assembly.lines.emplace_back();
        comment = (comment && !fresh) || token.is(';');
        if (!comment) assembly.lines.back() += (token.space && !fresh ? " " : "") + std::string(token.text);
    }
    const Token& first = tokens_[text.first];
    std::string why;
    const auto made = translateAssembly(assembly, why);
    if (!made) return warn(2021, position(first), fmt::format("the assembly's '{}' is not translated", why), "write HLSL");
    result_.assembled += made->text;
    result_.functions.insert(assembly.name);
    (vertex ? pass.vertexShader : pass.pixelShader) =
        ShaderReference{.entry = assembly.name, .profile = made->profile, .at = position(first)};
    --pass.assemblyShaders;
}

void Parser::assemble(Pass& pass) {
    if (vertexAssembly_) assemble(pass, true, *vertexAssembly_);
    if (pixelAssembly_) assemble(pass, false, *pixelAssembly_);
    if (vertexAssembly_ || pixelAssembly_) return;
    States unused;
    for (const Assignment& given : registers_) // says that it cannot be expressed
        applyState(given, "", unused);
}

} // namespace tegument
