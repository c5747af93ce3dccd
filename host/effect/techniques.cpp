// Techniques, groups, passes and the statements in them.

#include "host/effect/parser.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace tegument {

namespace {

TechniqueKind kindOf(std::string_view keyword) {
    if (equalsIgnoreCase(keyword, "technique11")) return TechniqueKind::D3D11;
    return equalsIgnoreCase(keyword, "technique10") ? TechniqueKind::D3D10 : TechniqueKind::D3D9;
}

bool isShaderStage(std::string_view name) {
    for (const std::string_view stage : {"VertexShader", "PixelShader", "GeometryShader", "ComputeShader", "HullShader", "DomainShader"})
        if (equalsIgnoreCase(name, stage)) return true;
    return false;
}

bool isStateType(std::string_view name) {
    return name == "DepthStencilState" || name == "BlendState" || name == "RasterizerState";
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
        if (accept(';')) continue;
        if (!isWord("technique11") && !isWord("technique10") && !(lenient_ && isWord("technique"))) return unexpected("technique11");
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
        if (!nameable(peek(), "a technique's name", true)) return false;
        technique.name = take().text;
    } else if (peek().kind == TokenKind::String) {
        technique.at = position(peek());
        technique.name = peek().text.substr(1, peek().text.size() - 2);
        take();
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
        if (!nameable(peek(), "a pass's name")) return false;
        pass.name = take().text;
    }
    if (peek().is('<') && !annotations(pass.annotations)) return false;
    const Token opened = peek();
    if (!expect('{', "of the pass")) return false;
    vertexAssembly_.reset();
    pixelAssembly_.reset();
    registers_.clear();
    States states{.pipeline = technique.kind == TechniqueKind::D3D9 ? direct3D9Defaults() : direct3D10Defaults()};
    if (!passStatements(technique, pass, states, opened)) return false;
    if (technique.kind == TechniqueKind::D3D9) finishDirect3D9(states);
    pass.state = states.pipeline;
    assemble(pass);
    technique.passes.push_back(std::move(pass));
    return true;
}

/// Until the '}' of what was opened.
bool Parser::passStatements(const Technique& technique, Pass& pass, States& states, const Token& opened) {
    while (!accept('}')) {
        if (atEnd()) return fail(1102, opened, "this '{' is never closed");
        if (full()) return false;
        if (peek().is(';')) {
            if (!emptyState()) return false;
            continue;
        }
        const std::size_t before = mark();
        if (!passStatement(technique, pass, states)) recover();
        if (mark() == before) return unexpected("a state");
    }
    return true;
}

/// `StateBlock = <name>;` of Direct3D 9: its statements stand here. Within them it is unknown.
bool Parser::applyStateBlock(const Technique& technique, const Assignment& assignment, Pass& pass, States& states) {
    std::size_t named = assignment.value.first;
    while (named + 1 < assignment.value.last && tokens_[named].kind != TokenKind::Word)
        ++named;
    auto block = stateBlocks_.extract(std::string(tokens_[named].text));
    if (block.empty()) return refuse(2021, assignment.name, fmt::format("there is no state block '{}'", tokens_[named].text));
    const std::size_t after = std::exchange(at_, block.mapped() + 1);
    const bool good = passStatements(technique, pass, states, tokens_[block.mapped()]);
    at_ = after;
    stateBlocks_.insert(std::move(block));
    return good;
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
        direct3D10Assignment(technique, list[0], pass, states);
    else if (lenient_ && sameStateName(list[0].name.text, "StateBlock"))
        return applyStateBlock(technique, list[0], pass, states);
    else
        applyToPass(list[0], pass, states);
    return true;
}

/// `RasterizerState = rs;`, `DS_StencilRef = 1;`: what the Set calls do. Microsoft's compiler takes Direct3D 9's states too and drops them.
bool Parser::direct3D10Assignment(const Technique& technique, const Assignment& assignment, Pass& pass, States& states) {
    const std::string name(assignment.name.text);
    if (isStateType(name)) {
        const std::size_t after = std::exchange(at_, assignment.value.first);
        const bool good = setState(technique, name, states);
        at_ = after;
        return good;
    }
    if (name == "AB_BlendFactor" || name == "DS_StencilRef") {
        const auto value = stateValue(assignment, {});
        if (!value) return false;
        for (std::size_t i = 0; name == "AB_BlendFactor" && i < std::min<std::size_t>(4, value->size()); ++i)
            states.pipeline.blendConstant[i] = static_cast<float>((*value)[i]);
        if (name == "DS_StencilRef" && (*value)[0] >= 0 && (*value)[0] <= 255)
            states.pipeline.stencilReference = static_cast<unsigned>((*value)[0]);
        return true;
    }
    if (name == "AB_SampleMask") return true;
    if (lenient_ && technique.kind == TechniqueKind::D3D10) applyToPass(assignment, pass, states);
    return refuse(2003, assignment.name, fmt::format("'{}' in a Direct3D 10 technique", name),
                  "use SetDepthStencilState, SetBlendState, SetRasterizerState");
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
    } else if (isStateType(stage)) {
        if (!setState(technique, stage, states)) return false;
    } else if (stage == "RenderTargets") {
        if (!refuse(2021, name, "targets of Direct3D 11's effects are not set", "use a script: RenderColorTarget0=...")) return false;
        --at_;
        return skipBalanced() && expect(';', "after the call");
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
    const Token at = peek();
    const std::optional<std::string> name = objectName(fmt::format("a {}", type));
    if (!name) return false;
    const auto object = stateObjects_.find(*name);
    const bool null = equalsIgnoreCase(*name, "NULL");
    if (!null && (object == stateObjects_.end() || object->second.type != type)) {
        std::vector<std::string> names;
        for (const auto& [other, state] : stateObjects_)
            if (state.type == type) names.push_back(other);
        return fail(2019, at, fmt::format("unknown {} '{}'", type, *name), didYouMean(*name, names));
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
    const std::size_t errors = result_.errors.size();
    std::size_t given = 0;
    for (; accept(','); ++given) {
        const std::optional<Constant> value = expression();
        if (value) numbers.insert(numbers.end(), value->numbers.begin(), value->numbers.end());
        if (!value && !lenient_) return false;
        if (!value) { // Microsoft's compiler takes a string for a number
            soften(errors);
            while (!atEnd() && !peek().is(')') && !peek().is(',') && !peek().is(';'))
                take();
        }
    }
    const std::size_t wanted = type == "BlendState" ? 2 : type == "DepthStencilState" ? 1 : 0;
    if (given != wanted && !refuse(1105, start, fmt::format("Set{} takes {} values behind the object, not {}", type, wanted, given)))
        return false;
    if (numbers.empty()) return true;
    if (type == "DepthStencilState" && numbers.size() == 1 && (lenient_ || (numbers[0] >= 0 && numbers[0] <= 255))) {
        state.stencilReference = static_cast<unsigned>(static_cast<std::int64_t>(std::clamp(numbers[0], 0.0, kLargestWord))) & 255u;
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
