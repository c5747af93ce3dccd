// Types and global declarations.

#include "host/effect/parser.h"
#include "host/effect/types.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr int kLongestArray = 65536; // sixteen times what a constant buffer holds

constexpr std::array<std::string_view, 21> kModifiers{
    "static",       "const",  "uniform",       "extern",      "shared",   "volatile",        "row_major",
    "column_major", "inline", "precise",       "export",      "snorm",    "nointerpolation", "linear",
    "centroid",     "sample", "noperspective", "groupshared", "unsigned", "unorm",           "globallycoherent"};

bool isModifier(const Token& token) {
    return token.kind == TokenKind::Word && std::ranges::find(kModifiers, token.text) != kModifiers.end();
}

bool isStateObject(const Token& token) {
    return token.is("DepthStencilState") || token.is("BlendState") || token.is("RasterizerState");
}

bool isShaderObject(const Token& token) {
    for (const std::string_view name : {"VertexShader", "PixelShader", "GeometryShader", "ComputeShader", "HullShader", "DomainShader",
                                        "VertexFragment", "PixelFragment"})
        if (token.kind == TokenKind::Word && equalsIgnoreCase(token.text, name)) return true;
    return false;
}

bool holdsNumbers(const Type& type) {
    return type.isNumeric() || type.members != nullptr;
}

bool isStructure(const Token& token) {
    return token.is("struct") || token.is("class") || token.is("interface") || token.is("enum");
}

/// float4[8]: `vector<float, 4>` and `matrix<float, 4, 4>` say their dimensions in angle brackets.
void applyTemplate(Type& type, const std::vector<Token>& arguments) {
    if (type.name != "vector" && type.name != "matrix") return;
    std::vector<int> dimensions;
    for (const Token& token : arguments) {
        if (const std::optional<Type> scalar = builtInType(token.text)) type.base = scalar->base;
        if (token.kind == TokenKind::Number && token.text.size() == 1 && token.text[0] >= '1' && token.text[0] <= '4')
            dimensions.push_back(token.text[0] - '0');
    }
    if (type.name == "vector" && dimensions.size() == 1) type.columns = dimensions[0];
    if (type.name == "matrix" && dimensions.size() == 2) {
        type.rows = dimensions[0];
        type.columns = dimensions[1];
    }
}

} // namespace

std::optional<Type> Parser::namedType(std::string_view name) const {
    if (const auto known = aliases_.find(name); known != aliases_.end()) return known->second;
    if (const auto known = structures_.find(name); known != structures_.end())
        return Type{.base = known->second ? BaseType::Struct : BaseType::Other, .name = std::string(name), .members = known->second};
    return builtInType(name);
}

bool Parser::skipTemplate(Type& type) {
    const std::size_t first = at_;
    if (!skipAngles()) return false;
    applyTemplate(type, {tokens_.begin() + static_cast<std::ptrdiff_t>(first), tokens_.begin() + static_cast<std::ptrdiff_t>(at_)});
    return true;
}

std::optional<Type> Parser::type() {
    Token name;
    if (!expectName(name, "a type")) return std::nullopt;
    Type type = namedType(name.text).value_or(Type{.base = BaseType::Other, .name = std::string(name.text)});
    while (peek().is(':') && peek(1).is(':') && !peek(1).space) {
        take();
        take();
        if (!expectName(name, "a name after '::'")) return std::nullopt;
        type = {.base = BaseType::Other, .name = type.name + "::" + std::string(name.text)};
    }
    if (peek().is('<') && type.base != BaseType::Struct && !skipTemplate(type)) return std::nullopt;
    return type;
}

bool Parser::alias() {
    take();
    while (isModifier(peek()))
        take();
    std::optional<Type> target;
    if (peek().is("struct")) {
        take();
        const Token tag = peek().kind == TokenKind::Word ? take() : Token{};
        const auto found = peek().is('{') ? members() : nullptr;
        target = Type{.base = found ? BaseType::Struct : BaseType::Other, .name = std::string(tag.text), .members = found};
        if (!tag.text.empty() && found) structures_[std::string(tag.text)] = found;
        if (!tag.text.empty() && !found) target = namedType(tag.text).value_or(*target);
    } else {
        target = type();
    }
    Token name;
    if (!target || !expectName(name, "the new type's name")) return false;
    if (peek().is('[') && !arraySize(*target)) return false;
    if (target->members) target->name = name.text;
    if (target->base == BaseType::Other) structures_[std::string(name.text)] = nullptr;
    aliases_[std::string(name.text)] = *target;
    return skipStatement();
}

/// `cbuffer Name : register(b0)`.
bool Parser::constantBufferHead() {
    take();
    const bool named = peek().kind == TokenKind::Word;
    if (!named && !refuse(1101, peek(), "expected the constant buffer's name")) return false;
    if (named && !nameable(peek(), "the constant buffer's name", true)) return false;
    if (named) take();
    while (accept(':')) {
        if (peek().kind == TokenKind::Word) take();
        if (peek().is('(') && !skipBalanced()) return false;
    }
    if (Annotations none; peek().is('<') && !annotations(none)) return false;
    if (!atEnd() && !peek().is('{') && !refuse(1101, peek(), fmt::format("expected '{{' of the constant buffer, found '{}'", peek().text)))
        return false;
    while (!atEnd() && !peek().is('{') && !peek().is(';'))
        take();
    return true;
}

bool Parser::constantBuffer() {
    if (!constantBufferHead()) return false;
    const Token opened = peek();
    if (!expect('{', "of the constant buffer")) return false;
    inBuffer_ = true;
    const bool good = constantBufferMembers(opened);
    inBuffer_ = false;
    return good;
}

bool Parser::constantBufferMembers(const Token& opened) {
    while (!accept('}')) {
        if (atEnd()) return fail(1102, opened, "this '{' is never closed");
        if (full()) return false;
        if (accept(';')) continue;
        const std::size_t before = at_;
        if (!declaration()) recover();
        if (at_ == before) return unexpected("a declaration");
    }
    accept(';');
    return true;
}

bool Parser::arraySize(Type& type) {
    while (accept('[')) {
        const Token at = peek();
        if (accept(']')) {
            type.unsized = true;
            continue;
        }
        const std::optional<Constant> size = expression();
        if (!size || !expect(']', "after the array size")) return false;
        const double n = size->numbers.size() == 1 ? size->numbers[0] : 0;
        if (!(n >= 1) || n * std::max(type.elements, 1) > kLongestArray)
            return fail(1107, at, fmt::format("an array has 1 to {} elements", kLongestArray));
        type.elements = std::max(type.elements, 1) * static_cast<int>(n);
    }
    return true;
}

/// `: SEMANTIC`, `: register(c0)`, `: packoffset(c0)`, any number of them. Only the semantic is effect syntax.
bool Parser::semantic(std::string& text) {
    while (peek().is(':')) {
        const std::size_t first = at_;
        take();
        Token name;
        if (!expectName(name, "a semantic")) return false;
        if (peek().is('(')) {
            if (!skipBalanced()) return false;
        } else {
            if (!nameable(name, "a semantic")) return false;
            text = name.text;
            blankFrom(first);
        }
    }
    return true;
}

bool Parser::function(const Token& name) {
    result_.functions.insert(std::string(name.text));
    const std::size_t parameters = at_;
    if (!skipBalanced()) return false;
    rememberFunction(name, parameters);
    while (!atEnd() && !peek().is('{') && !peek().is(';') && !peek().is('<'))
        take(); // : COLOR0
    Annotations ignored;
    if (peek().is('<') && !annotations(ignored)) return false;
    if (peek().is('{')) return skipBalanced();
    return expect(';', "after the function's declaration");
}

bool Parser::declaration() {
    const std::size_t start = at_;
    Modifiers modifiers;
    while (isModifier(peek())) {
        const Token& token = take();
        modifiers.isStatic |= token.is("static") || token.is("groupshared");
        modifiers.isConst |= token.is("const");
        modifiers.last = at_;
    }
    if (isStructure(peek())) return structure(start, modifiers);
    if (isStateObject(peek())) return stateObject(start);
    if (isShaderObject(peek()) && peek(1).kind == TokenKind::Word) return shaderObject(start);
    const Token typeName = peek();
    const std::optional<Type> type = this->type();
    if (!type) return false;
    return declarators(start, typeName, *type, modifiers);
}

bool Parser::declarators(std::size_t start, const Token& typeName, const Type& type, const Modifiers& modifiers) {
    for (bool first = true;; first = false) {
        Token name;
        if (!expectName(name, "a name")) return false;
        while (peek().is(':') && peek(1).is(':') && !peek(1).space) { // a method: float3 Lamp::colour() { ... }
            take();
            take();
            if (!expectName(name, "a name after '::'")) return false;
        }
        if (first && peek().is('(')) return function(name);
        if (!nameable(name, "a name", true)) return false;
        if (!declarator({start, typeName, name, type, modifiers})) return false;
        if (accept(';')) break;
        if (!accept(',')) return unexpected("',' or ';' after the declaration");
    }
    return true;
}

bool Parser::declarator(Declarator d) {
    if (!arraySize(d.type)) return false;
    Parameter parameter{.name = std::string(d.name.text), .type = d.type, .at = position(d.name)};
    if (!semantic(parameter.semantic)) return false;
    const bool effectSyntax = peek().is('<') || (peek().is('=') && !d.modifiers.isStatic);
    const bool unknown = d.type.base == BaseType::Other && !namedType(d.typeName.text) && !isStructure(d.typeName) &&
                         d.type.name.find(':') == std::string::npos;
    if (peek().is('<') && !annotations(parameter.annotations)) return false;
    if (lenient_ && inBuffer_ && (d.type.isTexture() || d.type.base == BaseType::Sampler || d.type.base == BaseType::String))
        warn(1103, position(d.typeName), fmt::format("'{}' is not a type of constant buffers", d.typeName.text), "declare it outside");
    if (effectSyntax && unknown) {
        fail(1103, d.typeName, fmt::format("unknown type '{}'", d.typeName.text), didYouMean(d.typeName.text, commonTypeNames()));
        return skipValue();
    }
    if (unknown && (lenient_ || !parameter.semantic.empty()))
        refuse(1103, d.typeName, fmt::format("unknown type '{}'", d.typeName.text), didYouMean(d.typeName.text, commonTypeNames()));
    if (d.type.base == BaseType::Sampler) return samplerDeclarator(d, std::move(parameter.annotations));
    if (d.modifiers.isStatic) return staticValue(d);
    if (peek().is('=') && !defaultValue(parameter) && !skipValue()) return false;
    if (parameter.type.unsized && parameter.type.isNumeric() &&
        !refuse(1107, d.name, fmt::format("array '{}' has neither a size nor an initial value", d.name.text), "write its size"))
        return false;
    if (d.type.name == "RWTexture2D")
        result_.effect.storages.push_back(
            {.name = std::move(parameter.name), .annotations = std::move(parameter.annotations), .at = parameter.at});
    if (d.type.base == BaseType::Other && d.type.name.starts_with("Texture")) result_.otherTextures.insert(parameter.name);
    if (d.type.base == BaseType::Other) return true;
    if (const auto* numbers = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr) {
        constants_[parameter.name] = constantOf(parameter.type, *numbers);
    } else if (lenient_ && holdsNumbers(parameter.type)) { // states may ask for it: the host sets it later, and it starts at zero
        constants_[parameter.name] =
            constantOf(parameter.type, std::vector<double>(static_cast<std::size_t>(parameter.type.scalarCount())));
    }
    blankQualifiers(d);
    addParameter(std::move(parameter), d);
    return true;
}

/// Remembers the value of a constant; everything else up to the end of the declarator is the compiler's business.
bool Parser::staticValue(const Declarator& d) {
    if (!accept('=')) return true;
    if ((d.modifiers.isConst || lenient_) && holdsNumbers(d.type)) {
        const std::size_t first = at_;
        const std::size_t errors = result_.errors.size();
        const std::size_t warnings = result_.effect.warnings.size();
        std::optional<Constant> value = staticNumbers(d.type);
        result_.errors.resize(std::min(errors, result_.errors.size()));
        result_.effect.warnings.resize(std::min(warnings, result_.effect.warnings.size()));
        if (value && (peek().is(';') || peek().is(','))) {
            constants_[std::string(d.name.text)] = std::move(*value);
            if (namedSince(first) != nullptr) changing_.emplace(d.name.text);
        }
        at_ = first;
    }
    return skipValue();
}

/// `{ 1, 2 }` or an expression, as a value of this type.
std::optional<Constant> Parser::staticNumbers(Type type) {
    if (!peek().is('{')) {
        auto value = expression();
        const bool same = value && value->elements == type.elements && (value->members != nullptr) == (type.members != nullptr);
        return same ? std::optional(convertedTo(type, std::move(*value))) : std::nullopt;
    }
    std::vector<double> numbers;
    if (!bracedValues(numbers, 0)) return std::nullopt;
    const auto one = static_cast<std::size_t>(type.scalarCount());
    if (type.unsized && one > 0) type.elements = static_cast<int>(numbers.size() / one);
    if (numbers.size() != static_cast<std::size_t>(type.scalarCount())) return std::nullopt;
    for (double& n : numbers)
        n = type.isNumeric() ? convertedTo(type, n) : n;
    return constantOf(type, std::move(numbers));
}

/// To the ';' or ',' behind an initial value that is none of our business.
bool Parser::skipValue() {
    while (!atEnd() && !peek().is(';') && !peek().is(',')) {
        if (peek().is('{') || peek().is('(') || peek().is('[')) {
            if (!skipBalanced()) return false;
        } else {
            take();
        }
    }
    return true;
}

/// An initial value that cannot be read: where reading is lenient the parameter has none.
bool Parser::softenValue(std::size_t sign, std::size_t firstError) {
    soften(firstError);
    at_ = sign + 1; // behind the '=': reading may have stopped between braces
    return skipValue();
}

bool Parser::defaultValue(Parameter& parameter) {
    const std::size_t first = at_;
    const std::size_t errors = result_.errors.size();
    take(); // '='
    if (parameter.type.base == BaseType::String) {
        std::string text;
        std::vector<TextPiece> pieces;
        if (string(text, pieces)) {
            parameter.defaultValue = std::move(text);
        } else if (lenient_) {
            if (!softenValue(first, errors)) return false;
        } else {
            return false;
        }
    } else if (parameter.type.isNumeric() || parameter.type.base == BaseType::Struct) {
        Value value;
        if (initialiser(parameter.type, value)) {
            parameter.defaultValue = std::move(value);
        } else if (lenient_) {
            if (!softenValue(first, errors)) return false;
        } else {
            return false;
        }
    } else if (!refuse(1101, peek(), fmt::format("'{}' takes no initial value", parameter.type.name)) || !skipValue()) {
        return false;
    }
    blankFrom(first);
    return true;
}

/// `const`, `uniform`, `extern`, `shared`: glslang reads a const parameter as the constant zero, HLSL 202x drops uniform.
void Parser::blankQualifiers(const Declarator& d) {
    for (std::size_t i = d.start; i < d.modifiers.last; ++i)
        if (tokens_[i].is("const") || tokens_[i].is("uniform") || tokens_[i].is("extern") || tokens_[i].is("shared"))
            result_.blanks.push_back({i, i + 1});
}

/// Strings and the global script mean nothing to the compilers: their whole declaration is blanked out. (The script's own float would also
/// break the layout rule for parameters: every 16 bytes filled exactly.)
void Parser::addParameter(Parameter parameter, const Declarator& d) {
    const bool onlyEffect = parameter.type.base == BaseType::String || parameter.hasSemantic(kStandardsGlobal);
    if (onlyEffect && peek().is(';')) result_.blanks.push_back({d.start, at_ + 1});
    changing_.insert(parameter.name);
    result_.effect.parameters.push_back(std::move(parameter));
}

} // namespace tegument
