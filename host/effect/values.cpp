// Initialisers, strings and annotations.

#include "host/effect/parser.h"
#include "host/effect/types.h"
#include "host/support/text.h"

#include <cmath>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr int kDeepest = 128; // nested brackets; bounds our own recursion
constexpr std::size_t kMostNumbers = 1u << 20;

char unescaped(char c) {
    return c == 'n' ? '\n' : c == 't' ? '\t' : c;
}

} // namespace

bool Parser::bracedValues(std::vector<double>& numbers, int depth) {
    if (depth > kDeepest) return fail(1106, peek(), fmt::format("braces are nested deeper than {}", kDeepest));
    take(); // the opening brace
    while (!accept('}')) {
        if (peek().is('{')) {
            if (!bracedValues(numbers, depth + 1)) return false;
        } else {
            const std::optional<Constant> value = expression();
            if (!value) return false;
            numbers.insert(numbers.end(), value->numbers.begin(), value->numbers.end());
        }
        if (numbers.size() > kMostNumbers) return fail(1107, peek(), fmt::format("more than {} numbers", kMostNumbers));
        if (!peek().is('}') && !expect(',', "between the values")) return false;
    }
    return true;
}

/// The first parameter that is named from this token on.
const Token* Parser::namedSince(std::size_t first) const {
    for (std::size_t i = first; i < at_; ++i)
        if (tokens_[i].kind == TokenKind::Word && !tokens_[i - 1].is('.') && changing_.contains(tokens_[i].text)) return &tokens_[i];
    return nullptr;
}

/// Microsoft's compiler takes no value that the host may change for an initial value or an annotation's (X3011).
bool Parser::literal(std::size_t first) {
    const Token* name = namedSince(first);
    return name == nullptr || refuse(1104, *name, fmt::format("'{}' is a parameter: it is not a constant", name->text),
                                     "write its value, or make it static const");
}

/// Between an effect's own braces a value per scalar; behind '=' a scalar fills all, and a longer vector is cut, as HLSL converts.
bool Parser::initialiser(Type& type, Value& value) {
    const Token start = peek();
    const std::size_t first = mark();
    std::vector<double> numbers;
    const bool braced = start.is('{');
    if (braced) {
        if (!bracedValues(numbers, 0)) return false;
    } else {
        const std::optional<Constant> constant = expression();
        if (!constant) return false;
        numbers = constant->numbers;
    }
    if (!literal(first)) return false;
    if (type.unsized && numbers.size() % static_cast<std::size_t>(type.scalarCount()) == 0 && !numbers.empty()) {
        type.elements = static_cast<int>(numbers.size()) / type.scalarCount();
        type.unsized = false;
    }
    const auto count = static_cast<std::size_t>(type.scalarCount());
    if (!braced && numbers.size() == 1 && type.elements == 0) numbers.resize(count, numbers[0]);
    if (!braced && numbers.size() > count && type.elements == 0 && type.isNumeric()) numbers.resize(count);
    if (numbers.size() != count) return fail(1105, start, fmt::format("{} numbers for {} that holds {}", numbers.size(), type.name, count));
    if (type.isNumeric())
        for (double& n : numbers)
            n = convertedTo(type, n);
    value = std::move(numbers);
    return true;
}

/// Literals one behind the other, in any number of brackets.
bool Parser::string(std::string& text, std::vector<TextPiece>& pieces) {
    int brackets = 0;
    while (peek().is('(') || peek().is('{')) {
        take();
        ++brackets;
    }
    if (peek().kind != TokenKind::String) return unexpected("a string");
    while (peek().kind == TokenKind::String || (brackets > 0 && peek().is(','))) {
        const Token& token = take();
        if (token.is(',')) continue; // of an array of strings; all of them, one behind the other
        SourcePosition at = position(token);
        ++at.column;
        pieces.push_back({text.size(), std::move(at)});
        const std::string_view body = token.text.substr(1, token.text.size() - 2);
        for (std::size_t i = 0; i < body.size(); ++i)
            text += body[i] == '\\' && i + 1 < body.size() ? unescaped(body[++i]) : body[i];
    }
    for (; brackets > 0; --brackets)
        if (!accept(')') && !expect('}', "after the string")) return false;
    return true;
}

/// `float a = 1`, and what follows a comma behind it: further names of the same type.
bool Parser::annotation(Annotations& result) {
    const Token typeName = peek();
    const std::optional<Type> type = this->type();
    if (!type) return false;
    if (!type->isNumeric() && type->base != BaseType::String)
        return fail(1103, typeName, fmt::format("'{}' is not a type of annotations", typeName.text),
                    didYouMean(typeName.text, commonTypeNames()));
    do {
        if (!annotationValue(*type, result)) return false;
    } while (accept(','));
    if (peek().is('>')) return refuse(1101, peek(), "expected ';' after the annotation, found '>'");
    return expect(';', "after the annotation");
}

bool Parser::annotationValue(const Type& type, Annotations& result) {
    Annotation annotation;
    annotation.type = type;
    Token name;
    if (!expectName(name, "the annotation's name") || !nameable(name, "the annotation's name")) return false;
    annotation.name = name.text;
    annotation.at = position(name);
    if (peek().is('[') && !arraySize(annotation.type)) return false;
    if (!expect('=', "after the annotation's name")) return false;
    if (type.base == BaseType::String) {
        std::string text;
        if (!string(text, annotation.pieces)) return false;
        annotation.value = std::move(text);
    } else if (!initialiser(annotation.type, annotation.value)) {
        return false;
    }
    if (result.find(annotation.name) != nullptr) {
        if (!refuse(2015, name, fmt::format("annotation '{}' is given twice", name.text))) return false;
    } else {
        result.list.push_back(std::move(annotation));
    }
    return true;
}

bool Parser::annotations(Annotations& result) {
    const std::size_t first = mark();
    take(); // '<'
    closesAngle_ = true;
    const bool good = annotationList(result);
    closesAngle_ = false;
    if (good) blankFrom(first);
    return good;
}

bool Parser::annotationList(Annotations& result) {
    while (!accept('>')) {
        const std::size_t errors = result_.errors.size();
        if (peek().is(';') && !refuse(1101, peek(), "expected an annotation, found ';'")) return false;
        if (accept(';') || annotation(result)) continue;
        soften(errors);
        while (!atEnd() && !peek().is(';') && !peek().is('>') && !peek().is('{') && !peek().is('}'))
            take();
        if (!accept(';') && !peek().is('>')) return false;
    }
    return true;
}

} // namespace tegument
