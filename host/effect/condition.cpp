#include "host/effect/condition.h"
#include "host/effect/operators.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace tegument {

namespace {

using Unsigned = std::uint64_t;

std::int64_t shifted(std::int64_t a, std::int64_t by, bool left) {
    if (by < 0 || by > 63) return 0;
    return left ? static_cast<std::int64_t>(static_cast<Unsigned>(a) << by) : a >> by;
}

std::int64_t arithmetic(char op, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<Unsigned>(a);
    const auto ub = static_cast<Unsigned>(b);
    switch (op) {
    case '+': return static_cast<std::int64_t>(ua + ub);
    case '-': return static_cast<std::int64_t>(ua - ub);
    case '*': return static_cast<std::int64_t>(ua * ub);
    case '|': return a | b;
    case '^': return a ^ b;
    case '&': return a & b;
    case '/': return b == -1 ? static_cast<std::int64_t>(0 - ua) : a / b;
    default: return b == -1 ? 0 : a % b;
    }
}

std::int64_t apply(std::string_view op, std::int64_t a, std::int64_t b) {
    if (const auto is = truth(op, a, b)) return *is ? 1 : 0;
    if (op == "<<" || op == ">>") return shifted(a, b, op == "<<");
    return arithmetic(op[0], a, b);
}

class Evaluator {
public:
    explicit Evaluator(std::span<const Token> tokens) : tokens_(tokens) {}

    std::variant<std::int64_t, ConditionError> run() {
        const std::int64_t value = ternary(true);
        if (!error_ && at_ < tokens_.size()) fail(fmt::format("'{}' does not belong to this expression", tokens_[at_].text));
        if (error_) return *error_;
        return value;
    }

private:
    std::int64_t fail(std::string text) {
        if (!error_) error_ = ConditionError{at_, std::move(text)};
        at_ = tokens_.size();
        return 0;
    }

    [[nodiscard]] bool is(std::string_view sign) const {
        if (at_ + sign.size() > tokens_.size()) return false;
        for (std::size_t i = 0; i < sign.size(); ++i)
            if (!tokens_[at_ + i].is(sign[i]) || (i > 0 && tokens_[at_ + i].space)) return false;
        return true;
    }

    bool accept(std::string_view sign) {
        if (!is(sign)) return false;
        at_ += sign.size();
        return true;
    }

    [[nodiscard]] const Operator* binaryOperator() const {
        for (const Operator& op : kOperators)
            if (is(op.text)) return &op;
        return nullptr;
    }

    /// `evaluated` is false in the branch that && || ?: do not take: a division by zero is no error there.
    std::int64_t ternary(bool evaluated) {
        if (++depth_ > kDeepestExpression) return fail(fmt::format("the expression is nested deeper than {}", kDeepestExpression));
        const std::int64_t condition = binary(1, evaluated);
        std::int64_t value = condition;
        if (accept("?")) {
            const std::int64_t a = ternary(evaluated && condition != 0);
            if (!accept(":")) return fail("':' expected after '?'");
            const std::int64_t b = ternary(evaluated && condition == 0);
            value = condition != 0 ? a : b;
        }
        --depth_;
        return value;
    }

    std::int64_t binary(int least, bool evaluated) {
        std::int64_t a = unary(evaluated);
        for (const Operator* op = binaryOperator(); op != nullptr && op->precedence >= least && !error_; op = binaryOperator()) {
            at_ += op->text.size();
            const bool skips = (op->text == "||" && a != 0) || (op->text == "&&" && a == 0);
            const std::int64_t b = binary(op->precedence + 1, evaluated && !skips);
            if ((op->text == "/" || op->text == "%") && b == 0) {
                if (evaluated) return fail("division by zero");
                a = 0;
            } else {
                a = apply(op->text, a, b);
            }
        }
        return a;
    }

    std::int64_t unary(bool evaluated) {
        std::string signs;
        while (at_ < tokens_.size() && (is("!") || is("-") || is("+") || is("~")))
            signs += tokens_[at_++].text[0];
        std::int64_t value = primary(evaluated);
        std::ranges::reverse(signs);
        for (const char sign : signs) {
            if (sign == '!') value = value == 0;
            if (sign == '-') value = arithmetic('-', 0, value);
            if (sign == '~') value = ~value;
        }
        return value;
    }

    std::int64_t primary(bool evaluated) {
        if (at_ == tokens_.size()) return fail("a value is missing");
        const Token& token = tokens_[at_];
        if (accept("(")) {
            const std::int64_t value = ternary(evaluated);
            if (!error_ && !accept(")")) return fail("')' expected");
            return value;
        }
        if (token.kind == TokenKind::Number) return number(token.text);
        if (token.kind == TokenKind::Word) {
            ++at_;
            return 0;
        }
        return fail(fmt::format("'{}' is not an integer", token.text));
    }

    std::int64_t number(std::string_view text) {
        const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
        std::string_view digits = hexadecimal ? text.substr(2) : text;
        while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos)
            digits.remove_suffix(1);
        const int base = hexadecimal ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
        Unsigned value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
        if (error != std::errc() || end != digits.data() + digits.size()) return fail(fmt::format("'{}' is not an integer", text));
        ++at_;
        return static_cast<std::int64_t>(value);
    }

    std::span<const Token> tokens_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::optional<ConditionError> error_;
};

} // namespace

std::variant<std::int64_t, ConditionError> evaluateCondition(std::span<const Token> tokens) {
    return Evaluator(tokens).run();
}

} // namespace tegument
