// Samplers and Direct3D 10's state objects, each alone or in an array.

#include "host/effect/parser.h"
#include "host/effect/types.h"
#include "host/support/text.h"

#include <fmt/format.h>

namespace tegument {

/// `= sampler_state { ... }`, `{ ... }`, or nothing.
bool Parser::samplerBlock(Sampler& sampler, bool direct3D9, const Declarator& d) {
    const std::size_t first = at_;
    bool block = peek().is('{');
    if (accept('=')) {
        if (peek().is('{')) {
            if (!refuse(1101, peek(), "expected 'sampler_state', found '{'")) return false;
        } else if (!acceptWord("sampler_state")) {
            return unexpected("'sampler_state'");
        }
        block = true;
        if (!peek().is('{')) return unexpected("'{' after sampler_state");
    }
    if (!samplerStates(sampler, block, direct3D9)) return false;
    if (block) blankFrom(first);
    if (const int dimension = samplerDimension(d.type.name); dimension != 0) result_.samplerDimensions[sampler.name] = dimension;
    result_.effect.samplers.push_back(std::move(sampler));
    return true;
}

/// `sampler s[2] = { sampler_state { ... }, sampler_state { ... } };` are the samplers s[0] and s[1].
bool Parser::samplerArray(const Declarator& d, const Sampler& sampler, bool direct3D9) {
    const std::size_t first = at_;
    const bool given = accept('=');
    if (given && !expect('{', "of the array")) return false;
    for (int i = 0; i < d.type.elements || d.type.unsized; ++i) {
        Sampler element = sampler;
        element.name = fmt::format("{}[{}]", sampler.name, i);
        if (given && peek().is('}')) break;
        if (given) acceptWord("sampler_state");
        if (given && !peek().is('{')) return unexpected("'{' after sampler_state");
        if (!samplerStates(element, given, direct3D9)) return false;
        if (const int dimension = samplerDimension(d.type.name); dimension != 0) result_.samplerDimensions[element.name] = dimension;
        result_.effect.samplers.push_back(std::move(element));
        if (given && !accept(',')) break;
        if (!given && d.type.unsized) break;
    }
    if (given && !expect('}', "at the end of the array")) return false;
    blankFrom(first);
    return true;
}

bool Parser::samplerDeclarator(const Declarator& d, Annotations annotations) {
    Sampler sampler{.name = std::string(d.name.text), .annotations = std::move(annotations), .at = position(d.name)};
    const bool direct3D9 = isDirect3D9Sampler(d.type.name);
    if (d.type.elements > 0 || d.type.unsized) return samplerArray(d, sampler, direct3D9);
    return samplerBlock(sampler, direct3D9, d);
}

/// One `{ ... }` of a state object.
bool Parser::stateBlock(const std::string& name, const std::string& type) {
    StateObject object{.type = type, .states = {.pipeline = direct3D10Defaults()}};
    const Token at = peek();
    std::vector<Assignment> list;
    if (peek().is('{') && !assignments(list)) return false;
    for (const Assignment& assignment : list)
        applyState(assignment, object.type, object.states);
    if (stateObjects_.contains(name)) fail(2015, at, fmt::format("state object '{}' is declared twice", name));
    stateObjects_.insert_or_assign(name, std::move(object));
    return true;
}

/// DepthStencilState X { ... }; RasterizerState Y[2] { { ... }, { ... } };
bool Parser::stateObject(std::size_t start) {
    const std::string type(take().text);
    Token name;
    if (!expectName(name, "the state object's name")) return false;
    Type shape{.name = type};
    if (!arraySize(shape)) return false;
    Annotations ignored;
    if (peek().is('<') && !annotations(ignored)) return false;
    if (lenient_) accept('=');
    if (!peek().is('{') && !peek().is(';')) return unexpected("'{' or ';'");
    const std::string text(name.text);
    if (shape.elements == 0 && !shape.unsized) {
        if (stateObjects_.contains(text)) fail(2015, name, fmt::format("state object '{}' is declared twice", text));
        stateObjects_.erase(text);
        if (!stateBlock(text, type)) return false;
    } else if (accept('{')) {
        for (int i = 0; !accept('}'); ++i) {
            if (!peek().is('{')) return unexpected("'{' of the array's element");
            if (!stateBlock(fmt::format("{}[{}]", text, i), type)) return false;
            accept(',');
        }
    }
    if (!accept(';') && !refuse(1101, peek(), "expected ';' after the state object")) return false;
    blankFrom(start);
    return true;
}

/// `stateblock X = stateblock_state { ... };` of Direct3D 9: passes name it.
bool Parser::stateBlockObject(std::size_t start) {
    const Token keyword = take();
    const std::string name(take().text);
    if (lenient_ && accept('=') && acceptWord("stateblock_state") && peek().is('{')) stateBlocks_.insert_or_assign(name, at_);
    if (!skipStatement()) return false;
    blankFrom(start);
    return lenient_ || fail(2021, keyword, "state blocks are not applied");
}

} // namespace tegument
