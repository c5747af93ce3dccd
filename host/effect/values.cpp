// Constant expressions, initialisers and annotations.

#include "host/effect/parser.h"
#include "host/effect/types.h"
#include "host/support/text.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr int kDeepest = 128; // nested brackets; bounds our own recursion
constexpr double kExactInteger = 9007199254740992.0;
constexpr std::size_t kMostNumbers = 1u << 20;

int precedence(const Token& token) {
    if (token.kind != TokenKind::Sign) return 0;
    switch (token.text[0]) {
    case '|': return 1;
    case '^': return 2;
    case '&': return 3;
    case '+':
    case '-': return 4;
    case '*':
    case '/':
    case '%': return 5;
    default: return 0;
    }
}

bool isBitOperator(char op) {
    return op == '|' || op == '^' || op == '&';
}

std::optional<double> bits(char op, double a, double b) {
    if (!(std::abs(a) < kExactInteger) || !(std::abs(b) < kExactInteger)) return std::nullopt;
    const auto x = static_cast<std::int64_t>(a);
    const auto y = static_cast<std::int64_t>(b);
    return static_cast<double>(op == '|' ? x | y : op == '^' ? x ^ y : x & y);
}

/// HLSL's arithmetic on two scalars: between integers '/' truncates. Nullopt where the result is no finite number.
std::optional<double> calculate(char op, double a, double b, bool integral) {
    if (isBitOperator(op)) return bits(op, a, b);
    double value = 0;
    switch (op) {
    case '+': value = a + b; break;
    case '-': value = a - b; break;
    case '*': value = a * b; break;
    case '/': value = integral ? std::trunc(a / b) : a / b; break;
    default: value = std::fmod(a, b); break;
    }
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Componentwise; a scalar meets every component of the other side.
std::optional<Constant> combine(char op, const Constant& a, const Constant& b) {
    const std::size_t count = std::max(a.numbers.size(), b.numbers.size());
    if ((a.numbers.size() != count && a.numbers.size() != 1) || (b.numbers.size() != count && b.numbers.size() != 1)) return std::nullopt;
    Constant result{.integral = a.integral && b.integral};
    for (std::size_t i = 0; i < count; ++i) {
        const double x = a.numbers[a.numbers.size() == 1 ? 0 : i];
        const double y = b.numbers[b.numbers.size() == 1 ? 0 : i];
        const std::optional<double> value = calculate(op, x, y, result.integral);
        if (!value) return std::nullopt;
        result.numbers.push_back(*value);
    }
    return result;
}

double converted(double value, const Type& type) {
    if (type.base == BaseType::Bool) return value != 0;
    return type.base == BaseType::Float ? value : std::trunc(value);
}

char unescaped(char c) {
    return c == 'n' ? '\n' : c == 't' ? '\t' : c;
}

} // namespace

std::optional<double> Parser::number(const Token& token, bool& integral) {
    std::string_view text = token.text;
    double value = 0;
    const char* end = text.data() + text.size();
    std::from_chars_result read{};
    if (text.starts_with("0x") || text.starts_with("0X")) {
        std::uint64_t whole = 0;
        read = std::from_chars(text.data() + 2, end, whole, 16);
        value = static_cast<double>(whole);
        integral = true;
    } else {
        read = std::from_chars(text.data(), end, value);
        integral = text.find_first_of(".eEfFhH") == std::string_view::npos;
    }
    const std::string_view suffix(read.ptr, static_cast<std::size_t>(end - read.ptr));
    if (read.ec == std::errc() && suffix.find_first_not_of("fFhHlLuU") == std::string_view::npos && suffix.size() < 3) return value;
    fail(1104, token, fmt::format("'{}' is not a number", text));
    return std::nullopt;
}

std::optional<Constant> Parser::constructor(int depth, const Resolver& resolve) {
    const Token name = take();
    const Type type = *builtInType(name.text);
    Constant result{.integral = type.base != BaseType::Float};
    take(); // the opening bracket
    while (!accept(')')) {
        const std::optional<Constant> part = binary(1, depth + 1, resolve);
        if (!part) return std::nullopt;
        for (const double value : part->numbers)
            result.numbers.push_back(converted(value, type));
        if (!peek().is(')') && !expect(',', "between the values")) return std::nullopt;
    }
    const auto count = static_cast<std::size_t>(type.scalarCount());
    if (result.numbers.size() == 1) result.numbers.resize(count, result.numbers[0]);
    if (result.numbers.size() == count) return result;
    fail(1105, name, fmt::format("{} takes {} numbers, not {}", name.text, count, result.numbers.size()));
    return std::nullopt;
}

std::optional<Constant> Parser::primary(int depth, const Resolver& resolve) {
    const Token& token = peek();
    if (token.kind == TokenKind::Number) {
        bool integral = false;
        const std::optional<double> value = number(take(), integral);
        return value ? std::optional(Constant{{*value}, integral}) : std::nullopt;
    }
    if (accept('(')) {
        const std::optional<Type> cast = peek().kind == TokenKind::Word && peek(1).is(')') ? builtInType(peek().text) : std::nullopt;
        if (cast) {
            take();
            take();
            return unary(depth + 1, resolve);
        }
        std::optional<Constant> value = binary(1, depth + 1, resolve);
        if (value && !expect(')', "after the expression")) return std::nullopt;
        return value;
    }
    if (token.kind != TokenKind::Word) {
        unexpected("a value");
        return std::nullopt;
    }
    if (const std::optional<Type> type = builtInType(token.text); type && type->isNumeric() && peek(1).is('('))
        return constructor(depth, resolve);
    take();
    if (const auto known = constants_.find(token.text); known != constants_.end()) return known->second;
    if (resolve)
        if (const std::optional<double> value = resolve(token.text)) return Constant{{*value}, true};
    if (token.is("true") || token.is("TRUE")) return Constant{{1}, true};
    if (token.is("false") || token.is("FALSE")) return Constant{{0}, true};
    if (!resolve) fail(1104, token, fmt::format("'{}' is not a constant", token.text));
    return std::nullopt;
}

std::optional<Constant> Parser::unary(int depth, const Resolver& resolve) {
    bool negative = false;
    while (peek().is('-') || peek().is('+'))
        negative = take().is('-') ? !negative : negative;
    std::optional<Constant> value = primary(depth, resolve);
    if (value && negative)
        for (double& n : value->numbers)
            n = -n;
    return value;
}

std::optional<Constant> Parser::binary(int least, int depth, const Resolver& resolve) {
    if (depth > kDeepest) {
        fail(1106, peek(), fmt::format("the expression is nested deeper than {}", kDeepest));
        return std::nullopt;
    }
    std::optional<Constant> left = unary(depth, resolve);
    while (left && precedence(peek()) >= least && precedence(peek()) > 0) {
        const Token op = take();
        const std::optional<Constant> right = binary(precedence(op) + 1, depth, resolve);
        if (!right) return std::nullopt;
        left = combine(op.text[0], *left, *right);
        if (!left) fail(1104, op, fmt::format("'{}' has no finite result here", op.text));
    }
    return left;
}

std::optional<Constant> Parser::expression(const Resolver& resolve) {
    return binary(1, 0, resolve);
}

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

bool Parser::initialiser(const Type& type, Value& value) {
    const Token start = peek();
    std::vector<double> numbers;
    bool scalar = false;
    if (peek().is('{')) {
        if (!bracedValues(numbers, 0)) return false;
    } else {
        const std::optional<Constant> constant = expression();
        if (!constant) return false;
        numbers = constant->numbers;
        scalar = numbers.size() == 1 && type.elements == 0;
    }
    const auto count = static_cast<std::size_t>(type.scalarCount());
    if (scalar) numbers.resize(count, numbers[0]);
    if (numbers.size() != count) return fail(1105, start, fmt::format("{} numbers for {} that holds {}", numbers.size(), type.name, count));
    for (double& n : numbers)
        n = converted(n, type);
    value = std::move(numbers);
    return true;
}

bool Parser::string(std::string& text, std::vector<TextPiece>& pieces) {
    if (peek().kind != TokenKind::String) return unexpected("a string");
    while (peek().kind == TokenKind::String) {
        const Token& token = take();
        SourcePosition at = position(token);
        ++at.column;
        pieces.push_back({text.size(), std::move(at)});
        const std::string_view body = token.text.substr(1, token.text.size() - 2);
        for (std::size_t i = 0; i < body.size(); ++i)
            text += body[i] == '\\' && i + 1 < body.size() ? unescaped(body[++i]) : body[i];
    }
    return true;
}

bool Parser::annotation(Annotations& result) {
    Annotation annotation;
    const Token typeName = peek();
    const std::optional<Type> type = this->type();
    if (!type) return false;
    if (!type->isNumeric() && type->base != BaseType::String)
        return fail(1103, typeName, fmt::format("'{}' is not a type of annotations", typeName.text),
                    didYouMean(typeName.text, commonTypeNames()));
    annotation.type = *type;
    Token name;
    if (!expectName(name, "the annotation's name")) return false;
    annotation.name = name.text;
    annotation.at = position(name);
    if (peek().is('[') && !arraySize(annotation.type)) return false;
    if (!expect('=', "after the annotation's name")) return false;
    if (type->base == BaseType::String) {
        std::string text;
        if (!string(text, annotation.pieces)) return false;
        annotation.value = std::move(text);
    } else if (!initialiser(annotation.type, annotation.value)) {
        return false;
    }
    if (result.find(annotation.name) != nullptr) return fail(2015, name, fmt::format("annotation '{}' is given twice", name.text));
    result.list.push_back(std::move(annotation));
    return peek().is('>') || expect(';', "after the annotation");
}

bool Parser::annotations(Annotations& result) {
    const std::size_t first = mark();
    take(); // '<'
    while (!accept('>')) {
        if (annotation(result)) continue;
        while (!atEnd() && !peek().is(';') && !peek().is('>') && !peek().is('{') && !peek().is('}'))
            take();
        if (!accept(';') && !peek().is('>')) return false;
    }
    blankFrom(first);
    return true;
}

} // namespace tegument
