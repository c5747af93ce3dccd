// Techniques, groups, passes and the statements in them.

#include "host/effect/parser.h"
#include "host/support/text.h"

#include <array>

#include <fmt/format.h>

namespace tegument {

namespace {

TechniqueKind kindOf(std::string_view keyword) {
    if (equalsIgnoreCase(keyword, "technique11")) return TechniqueKind::D3D11;
    return equalsIgnoreCase(keyword, "technique10") ? TechniqueKind::D3D10 : TechniqueKind::D3D9;
}

std::optional<ShaderReference>* shaderSlot(Pass& pass, std::string_view stage) {
    if (equalsIgnoreCase(stage, "VertexShader")) return &pass.vertexShader;
    if (equalsIgnoreCase(stage, "PixelShader")) return &pass.pixelShader;
    if (equalsIgnoreCase(stage, "GeometryShader")) return &pass.geometryShader;
    return equalsIgnoreCase(stage, "ComputeShader") ? &pass.computeShader : nullptr;
}

bool isShaderStage(std::string_view name) {
    for (const std::string_view stage : {"VertexShader", "PixelShader", "GeometryShader", "ComputeShader", "HullShader", "DomainShader"})
        if (equalsIgnoreCase(name, stage)) return true;
    return false;
}

void copyDepthStencil(const PipelineState& from, PipelineState& to) {
    to.depthTest = from.depthTest;
    to.depthWrite = from.depthWrite;
    to.depthCompare = from.depthCompare;
    to.stencilTest = from.stencilTest;
    to.stencilFront = from.stencilFront;
    to.stencilBack = from.stencilBack;
    to.stencilReadMask = from.stencilReadMask;
    to.stencilWriteMask = from.stencilWriteMask;
}

void copyBlend(const PipelineState& from, PipelineState& to) {
    to.targets = from.targets;
    to.alphaToCoverage = from.alphaToCoverage;
}

void copyRasterizer(const PipelineState& from, PipelineState& to) {
    to.fill = from.fill;
    to.cull = from.cull;
    to.frontCounterClockwise = from.frontCounterClockwise;
    to.depthBias = from.depthBias;
    to.slopeScaledDepthBias = from.slopeScaledDepthBias;
    to.depthClip = from.depthClip;
    to.scissorTest = from.scissorTest;
}

} // namespace

bool Parser::group() {
    const std::size_t first = mark();
    take();
    if (peek().kind == TokenKind::Word) take();
    Annotations ignored;
    if (peek().is('<') && !annotations(ignored)) return false;
    const Token opened = peek();
    if (!expect('{', "of the group")) return false;
    while (!accept('}')) {
        if (atEnd()) return fail(1102, opened, "this '{' is never closed");
        if (!isWord("technique11") && !isWord("technique10")) return unexpected("technique11");
        if (!technique()) return false;
    }
    blankFrom(first);
    return true;
}

bool Parser::technique() {
    const std::size_t first = mark();
    Technique technique{.kind = kindOf(peek().text), .at = position(peek())};
    take();
    if (peek().kind == TokenKind::Word) {
        technique.at = position(peek());
        technique.name = take().text;
    }
    if (peek().is('<') && !annotations(technique.annotations)) return false;
    const Token opened = peek();
    if (!expect('{', "of the technique")) return false;
    while (!accept('}')) {
        if (atEnd()) return fail(1102, opened, "this '{' is never closed");
        if (full()) return false;
        if (accept(';')) continue;
        const std::size_t before = mark();
        if (!pass(technique)) recover();
        if (mark() == before) return unexpected("a pass");
    }
    accept(';');
    blankFrom(first);
    result_.effect.techniques.push_back(std::move(technique));
    return true;
}

bool Parser::pass(Technique& technique) {
    Pass pass{.at = position(peek())};
    if (!acceptWord("pass")) return unexpected("a pass");
    if (peek().kind == TokenKind::Word) {
        pass.at = position(peek());
        pass.name = take().text;
    }
    if (peek().is('<') && !annotations(pass.annotations)) return false;
    const Token opened = peek();
    if (!expect('{', "of the pass")) return false;
    States states{.pipeline = technique.kind == TechniqueKind::D3D9 ? direct3D9Defaults() : direct3D10Defaults()};
    while (!accept('}')) {
        if (atEnd()) return fail(1102, opened, "this '{' is never closed");
        if (full()) return false;
        if (accept(';')) continue;
        const std::size_t before = mark();
        if (!passStatement(technique, pass, states)) recover();
        if (mark() == before) return unexpected("a state");
    }
    if (technique.kind == TechniqueKind::D3D9) finishDirect3D9(states);
    pass.state = states.pipeline;
    technique.passes.push_back(std::move(pass));
    return true;
}

bool Parser::passStatement(const Technique& technique, Pass& pass, States& states) {
    if (peek().kind == TokenKind::Word && peek(1).is('(')) return setStatement(technique, pass, states);
    if (isShaderStage(peek().text) && peek(1).is('=')) {
        const Token stage = take();
        take();
        return shaderStatement(pass, stage) && expect(';', "after the shader");
    }
    std::vector<Assignment> list;
    if (!assignment(list)) return false;
    if (technique.kind != TechniqueKind::D3D9)
        fail(2003, list[0].name, fmt::format("'{}' in a Direct3D 10 technique", list[0].name.text),
             "use SetDepthStencilState, SetBlendState, SetRasterizerState");
    else
        applyState(list[0], "", states);
    return true;
}

bool Parser::shaderStatement(Pass& pass, const Token& stage) {
    std::optional<ShaderReference> shader;
    if (!shaderValue(shader)) return false;
    std::optional<ShaderReference>* slot = shaderSlot(pass, stage.text);
    if (slot == nullptr && shader) return fail(2021, stage, fmt::format("{} is not supported", stage.text));
    if (slot != nullptr) *slot = std::move(shader);
    return true;
}

/// NULL, `compile ps_3_0 F(2, true)`, `CompileShader(ps_5_0, F())`, or the name of a shader object, bare or in brackets.
bool Parser::shaderValue(std::optional<ShaderReference>& shader) {
    if (peek().is("NULL") || peek().is("null") || (peek().kind == TokenKind::Number && peek().text == "0")) {
        take();
        return true;
    }
    if (isWord("asm")) return fail(2021, peek(), "assembly shaders are not supported", "write HLSL");
    if (isWord("ConstructGSWithSO")) return fail(2021, peek(), "stream output is not supported");
    const bool call = isWord("CompileShader");
    if (!isWord("compile") && !call) return shaderByName(shader);
    take();
    if (call && !expect('(', "after CompileShader")) return false;
    Token profile;
    Token entry;
    if (!expectName(profile, "a profile such as ps_3_0")) return false;
    if (call && !expect(',', "after the profile")) return false;
    if (!expectName(entry, "the shader's function")) return false;
    shader = ShaderReference{.entry = std::string(entry.text), .profile = std::string(profile.text), .at = position(entry)};
    if (!shaderArguments(shader->arguments)) return false;
    return !call || expect(')', "after the shader");
}

bool Parser::shaderByName(std::optional<ShaderReference>& shader) {
    const char opening = peek().is('(') || peek().is('<') ? take().text[0] : '\0';
    Token name;
    if (!expectName(name, "a shader")) return false;
    if (opening != '\0' && !expect(opening == '(' ? ')' : '>', "after the shader's name")) return false;
    const auto object = shaderObjects_.find(name.text);
    if (object == shaderObjects_.end()) return fail(2019, name, fmt::format("unknown shader object '{}'", name.text));
    shader = object->second;
    return true;
}

/// The arguments for `uniform` parameters, each as written but for its spaces.
bool Parser::shaderArguments(std::vector<std::string>& arguments) {
    const std::size_t first = mark() + 1;
    if (!peek().is('(')) return unexpected("'(' after the shader's function");
    if (!skipBalanced()) return false;
    int depth = 0;
    for (std::size_t i = first; i + 1 < mark(); ++i) {
        const Token& token = tokens_[i];
        depth += token.is('(') ? 1 : token.is(')') ? -1 : 0;
        if (arguments.empty() || (depth == 0 && token.is(','))) arguments.emplace_back();
        if (depth > 0 || !token.is(',')) arguments.back() += token.text;
    }
    return true;
}

/// SetVertexShader(...), SetBlendState(object, factor, mask), ...
bool Parser::setStatement(const Technique& technique, Pass& pass, States& states) {
    const Token name = take();
    take(); // '('
    const std::string stage = name.text.starts_with("Set") ? std::string(name.text.substr(3)) : std::string();
    if (isShaderStage(stage)) {
        Token stageName = name;
        stageName.text = name.text.substr(3);
        if (!shaderStatement(pass, stageName)) return false;
    } else if (stage == "DepthStencilState" || stage == "BlendState" || stage == "RasterizerState") {
        if (!setState(technique, stage, states)) return false;
    } else {
        static const std::array<std::string, 7> kNames{"SetVertexShader",      "SetPixelShader", "SetGeometryShader", "SetComputeShader",
                                                       "SetDepthStencilState", "SetBlendState",  "SetRasterizerState"};
        return fail(2001, name, fmt::format("unknown pass statement '{}'", name.text), didYouMean(name.text, kNames));
    }
    return expect(')', "at the end of the call") && expect(';', "after the call");
}

bool Parser::setState(const Technique& technique, const std::string& type, States& states) {
    if (technique.kind == TechniqueKind::D3D9)
        fail(2003, peek(), fmt::format("Set{} in a Direct3D 9 technique", type), "write the states themselves, or technique11");
    Token name;
    if (!expectName(name, fmt::format("a {}", type))) return false;
    const auto object = stateObjects_.find(name.text);
    const bool null = equalsIgnoreCase(name.text, "NULL");
    if (!null && (object == stateObjects_.end() || object->second.type != type)) {
        std::vector<std::string> names;
        for (const auto& [other, state] : stateObjects_)
            if (state.type == type) names.push_back(other);
        return fail(2019, name, fmt::format("unknown {} '{}'", type, name.text), didYouMean(name.text, names));
    }
    States built = null ? States{.pipeline = direct3D10Defaults()} : object->second.states;
    if (type == "DepthStencilState") copyDepthStencil(built.pipeline, states.pipeline);
    if (type == "RasterizerState") copyRasterizer(built.pipeline, states.pipeline);
    if (type == "BlendState") {
        if (technique.kind == TechniqueKind::D3D11) finishBlend(built);
        copyBlend(built.pipeline, states.pipeline);
    }
    return setStateArguments(type, states.pipeline);
}

/// The stencil reference, or the blend constant and the sample mask.
bool Parser::setStateArguments(const std::string& type, PipelineState& state) {
    std::vector<double> numbers;
    const Token start = peek();
    while (accept(',')) {
        const std::optional<Constant> value = expression();
        if (!value) return false;
        numbers.insert(numbers.end(), value->numbers.begin(), value->numbers.end());
    }
    if (numbers.empty()) return true;
    if (type == "DepthStencilState" && numbers.size() == 1 && numbers[0] >= 0 && numbers[0] <= 255) {
        state.stencilReference = static_cast<unsigned>(numbers[0]);
        return true;
    }
    if (type == "BlendState" && numbers.size() >= 4 && numbers.size() <= 5) {
        for (std::size_t i = 0; i < 4; ++i)
            state.blendConstant[i] = static_cast<float>(numbers[i]);
        return true;
    }
    return fail(1105, start, fmt::format("wrong arguments of Set{}", type));
}

} // namespace tegument
