// Constant expressions: HLSL's operators, constructors and intrinsics on what the file declares.

#include "host/effect/operators.h"
#include "host/effect/parser.h"
#include "host/effect/types.h"
#include "host/support/text.h"

#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr double kSignLimit = 2147483648.0; // 2^31: what lies above it as a word is negative as an int
constexpr double kWords = 4294967296.0;

void replicate(std::vector<double>& numbers, std::size_t count) {
    if (numbers.size() == 1) numbers.resize(count, numbers[0]);
}

} // namespace

double convertedTo(const Type& type, double value) {
    if (type.base == BaseType::Bool) return value != 0;
    if (type.base == BaseType::Float) return value;
    const double whole = std::trunc(value);
    return type.base == BaseType::Int && whole >= kSignLimit && whole < kWords ? whole - kWords : whole;
}

Constant convertedTo(const Type& type, Constant value) {
    if (!type.isNumeric()) return value;
    for (double& n : value.numbers)
        n = convertedTo(type, n);
    const auto count = static_cast<std::size_t>(type.scalarCount());
    replicate(value.numbers, count);
    if (value.numbers.size() > count) value.numbers.resize(count);
    return constantOf(type, std::move(value.numbers));
}

std::optional<double> Parser::number(const Token& token, bool& integral) {
    std::string_view text = token.text;
    double value = 0;
    if (text.find(".#") != std::string_view::npos) { // 1.#INF: the largest float, so that every number stays finite
        integral = false;
        return std::numeric_limits<float>::max();
    }
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

/// The values between the brackets of a constructor or an intrinsic.
std::optional<std::vector<Constant>> Parser::callArguments(int depth, const Resolver& resolve) {
    take(); // the opening bracket
    std::vector<Constant> arguments;
    while (!accept(')')) {
        std::optional<Constant> part = conditional(depth + 1, resolve);
        if (!part) return std::nullopt;
        arguments.push_back(std::move(*part));
        if (!peek().is(')') && !expect(',', "between the values")) return std::nullopt;
    }
    return arguments;
}

std::optional<Constant> Parser::constructor(int depth, const Resolver& resolve) {
    const Token name = take();
    Type type = *namedType(name.text);
    if (peek().is('<') && !skipTemplate(type)) return std::nullopt;
    const auto parts = callArguments(depth, resolve);
    if (!parts) return std::nullopt;
    Constant result{.integral = type.base != BaseType::Float, .elements = 0, .rows = type.rows};
    for (const Constant& part : *parts)
        for (const double value : part.numbers)
            result.numbers.push_back(convertedTo(type, value));
    const auto count = static_cast<std::size_t>(type.scalarCount());
    replicate(result.numbers, count);
    if (parts->size() == 1 && result.numbers.size() > count) result.numbers.resize(count); // float3(someFloat4)
    if (result.numbers.size() == count) return result;
    fail(1105, name, fmt::format("{} takes {} numbers, not {}", name.text, count, result.numbers.size()));
    return std::nullopt;
}

std::optional<Constant> Parser::intrinsic(int depth, const Resolver& resolve) {
    const Token name = take();
    const auto arguments = callArguments(depth, resolve);
    if (!arguments) return std::nullopt;
    auto value = applyIntrinsic(name.text, *arguments);
    if (!value) fail(1104, name, fmt::format("'{}' has no finite result here", name.text));
    return value;
}

/// `(value)`, `(a, b)`, which is b, or the cast `(type)value`.
std::optional<Constant> Parser::bracketed(int depth, const Resolver& resolve) {
    const bool afterAngle = std::exchange(closesAngle_, false);
    take();
    const std::optional<Type> cast = peek().kind == TokenKind::Word && peek(1).is(')') ? namedType(peek().text) : std::nullopt;
    if (cast && cast->isNumeric()) {
        take();
        take();
        closesAngle_ = afterAngle;
        std::optional<Constant> value = unary(depth + 1, resolve);
        if (!value) return value;
        for (double& n : value->numbers)
            n = convertedTo(*cast, n);
        replicate(value->numbers, static_cast<std::size_t>(cast->scalarCount()));
        value->integral = cast->base != BaseType::Float;
        return value;
    }
    std::optional<Constant> value = conditional(depth + 1, resolve);
    while (value && accept(','))
        value = conditional(depth + 1, resolve);
    closesAngle_ = afterAngle;
    if (value && !expect(')', "after the expression")) return std::nullopt;
    return value;
}

std::optional<Constant> Parser::named(const Resolver& resolve) {
    const Token& token = take();
    if (locals_ != nullptr)
        if (const auto local = locals_->find(token.text); local != locals_->end()) return local->second.value;
    if (resolve)
        if (const std::optional<double> value = resolve(token.text)) return Constant{{*value}, true};
    if (const auto known = constants_.find(token.text); known != constants_.end()) return known->second;
    if (token.is("true")) return Constant{{1}, true};
    if (token.is("false")) return Constant{{0}, true};
    if (const bool yes = token.is("TRUE"); yes || token.is("FALSE")) { // words of states, where `resolve` knows them
        const bool read =
            resolve || refuse(1104, token, fmt::format("'{}' is not a constant", token.text), yes ? "write true" : "write false");
        return read ? std::optional(Constant{{yes ? 1.0 : 0.0}, true}) : std::nullopt;
    }
    if (!resolve) fail(1104, token, fmt::format("'{}' is not a constant", token.text));
    return std::nullopt;
}

std::optional<Constant> Parser::primary(int depth, const Resolver& resolve) {
    const Token& token = peek();
    if (token.kind == TokenKind::Number) {
        bool integral = false;
        const std::optional<double> value = number(take(), integral);
        return value ? std::optional(Constant{{*value}, integral}) : std::nullopt;
    }
    if (token.is('(')) return bracketed(depth, resolve);
    if (token.kind != TokenKind::Word) {
        unexpected("a value");
        return std::nullopt;
    }
    const bool calls = peek(1).is('(');
    const std::optional<Type> type = calls || peek(1).is('<') ? namedType(token.text) : std::nullopt;
    if (type && type->isNumeric() && (calls || type->name == "vector" || type->name == "matrix")) return constructor(depth, resolve);
    if (calls && functionTexts_.contains(token.text)) return called(depth, resolve);
    if (calls && isConstantIntrinsic(token.text)) return intrinsic(depth, resolve);
    return named(resolve);
}

/// `[index]` and `.member` behind a value.
std::optional<Constant> Parser::postfix(int depth, const Resolver& resolve) {
    std::optional<Constant> value = primary(depth, resolve);
    while (value && (peek().is('[') || peek().is('.'))) {
        const Token sign = take();
        if (sign.is('[')) {
            const auto index = conditional(depth + 1, resolve);
            if (!index || !expect(']', "after the index")) return std::nullopt;
            value = elementOf(*value, index->numbers[0], lenient_); // the host sets an index before it draws
        } else {
            Token letters;
            if (!expectName(letters, "components")) return std::nullopt;
            value = partOf(*value, letters.text);
        }
        if (!value) fail(1104, sign, "this is no part of the value");
    }
    return value;
}

std::optional<Constant> Parser::unary(int depth, const Resolver& resolve) {
    std::string signs;
    while (peek().is('-') || peek().is('+') || peek().is('!') || peek().is('~'))
        signs += take().text[0];
    std::optional<Constant> value = postfix(depth, resolve);
    for (auto sign = signs.rbegin(); value && sign != signs.rend(); ++sign)
        for (double& n : value->numbers)
            n = *sign == '-' ? -n : *sign == '!' ? static_cast<double>(n == 0) : *sign == '~' ? -std::trunc(n) - 1 : n;
    return value;
}

/// The operator at the cursor; none where a '>' ends `<value>` or a list of annotations.
const char* Parser::operatorHere(int& precedence, std::size_t& length) const {
    for (const Operator& op : kOperators) {
        length = op.text.size();
        const bool same = peek().is(op.text[0]) && (length == 1 || (peek(1).is(op.text[1]) && !peek(1).space));
        if (!same) continue;
        if (closesAngle_ && op.text[0] == '>') return nullptr;
        precedence = op.precedence;
        return op.text.data();
    }
    return nullptr;
}

std::optional<Constant> Parser::binary(int least, int depth, const Resolver& resolve) {
    std::optional<Constant> left = unary(depth, resolve);
    int precedence = 0;
    std::size_t length = 0;
    for (const char* op = operatorHere(precedence, length); left && op != nullptr && precedence >= least;
         op = operatorHere(precedence, length)) {
        const Token at = take();
        const std::string_view text(op, length);
        if (length == 2) take();
        const std::optional<Constant> right = binary(precedence + 1, depth, resolve);
        if (!right) return std::nullopt;
        left = applyOperator(text, *left, *right);
        if (!left) fail(1104, at, fmt::format("'{}' has no finite result here", text));
    }
    return left;
}

std::optional<Constant> Parser::conditional(int depth, const Resolver& resolve) {
    if (depth > kDeepestExpression) {
        fail(1106, peek(), fmt::format("the expression is nested deeper than {}", kDeepestExpression));
        return std::nullopt;
    }
    const std::optional<Constant> condition = binary(1, depth, resolve);
    if (!condition || !peek().is('?')) return condition;
    take();
    std::optional<Constant> yes = conditional(depth + 1, resolve);
    if (!yes || !expect(':', "of the choice")) return std::nullopt;
    std::optional<Constant> no = conditional(depth + 1, resolve);
    if (!no) return std::nullopt;
    return condition->numbers[0] != 0 ? yes : no;
}

std::optional<Constant> Parser::expression(const Resolver& resolve) {
    return conditional(0, resolve);
}

} // namespace tegument
