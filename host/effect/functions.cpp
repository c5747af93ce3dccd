// Calls of the file's own functions in constant expressions: their statements run on what is known when the file is read.

#include "host/effect/operators.h"
#include "host/effect/parser.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr int kMostSteps = 20'000; // statements of one call and what it calls
constexpr int kDeepestFunction = 32;

} // namespace

/// Remembers where the function stands: the cursor is on the bracket of its parameters.
void Parser::rememberFunction(const Token& name, std::size_t parameters) {
    for (std::size_t i = at_; i < tokens_.size() && !tokens_[i].is(';'); ++i)
        if (tokens_[i].is('{')) {
            functionTexts_[std::string(name.text)].push_back({.parameters = parameters, .body = i});
            return;
        }
}

/// `int a, uniform float b : TEXCOORD0 = 2`: types and names.
std::vector<Parser::Local> Parser::parametersOf(const FunctionText& function) {
    std::vector<Local> list;
    Local next;
    bool named = false; // behind the name nothing counts
    int depth = 0;
    for (std::size_t i = function.parameters; i < tokens_.size(); ++i) {
        const Token& token = tokens_[i];
        depth += token.is('(') || token.is('[') ? 1 : token.is(')') || token.is(']') ? -1 : 0;
        if (depth == 0 || (depth == 1 && token.is(','))) {
            if (!next.name.empty()) list.push_back(std::exchange(next, {}));
            named = false;
            if (depth == 0) break;
        } else if (token.is(':') || token.is('=') || token.is('[')) {
            named = true;
        } else if (token.kind == TokenKind::Word && !named) {
            if (const auto type = namedType(token.text)) next.type = *type;
            next.name = token.text;
        }
    }
    std::erase_if(list, [](const Local& local) { return local.name == "void"; });
    return list;
}

std::optional<Constant> Parser::called(int depth, const Resolver& resolve) {
    const Token name = take();
    auto arguments = callArguments(depth, resolve);
    if (!arguments) return std::nullopt;
    const auto known = functionTexts_.find(name.text);
    for (const FunctionText& function : known->second) {
        const std::vector<Local> parameters = parametersOf(function);
        if (parameters.size() != arguments->size()) continue;
        if (calls_ >= kDeepestFunction) {
            fail(1106, name, fmt::format("calls are nested deeper than {}", kDeepestFunction));
            return std::nullopt;
        }
        Locals locals;
        for (std::size_t i = 0; i < parameters.size(); ++i)
            locals[parameters[i].name] = {.type = parameters[i].type, .value = convertedTo(parameters[i].type, (*arguments)[i])};
        return runFunction(function, std::move(locals), name);
    }
    fail(1104, name, fmt::format("no function '{}' takes {} values", name.text, arguments->size()));
    return std::nullopt;
}

std::optional<Constant> Parser::runFunction(const FunctionText& function, Locals locals, const Token& call) {
    const std::size_t after = std::exchange(at_, function.body);
    const bool angle = std::exchange(closesAngle_, false);
    Locals* outer = std::exchange(locals_, &locals);
    if (calls_++ == 0) steps_ = 0;
    std::optional<Constant> returned;
    const bool good = runStatement(returned);
    --calls_;
    locals_ = outer;
    closesAngle_ = angle;
    at_ = after;
    if (good && !returned) fail(1104, call, fmt::format("'{}' returns nothing", call.text));
    return good ? returned : std::nullopt;
}

/// Passes over one statement that is not run.
bool Parser::skipLocalStatement() {
    if (peek().is('{')) return skipBalanced();
    const bool choice = peek().is("if");
    if (choice || peek().is("for") || peek().is("while")) {
        take();
        if (!skipBalanced() || !skipLocalStatement()) return false;
        if (!choice || !peek().is("else")) return true;
        take();
        return skipLocalStatement();
    }
    while (!atEnd() && !peek().is(';'))
        if (peek().is('(') ? !skipBalanced() : (take(), false)) return false;
    return expect(';', "after the statement");
}

/// Runs one statement; `returned` is set where a return was met, and nothing behind it runs.
bool Parser::runStatement(std::optional<Constant>& returned) {
    if (++steps_ > kMostSteps) return fail(1106, peek(), fmt::format("more than {} statements to evaluate", kMostSteps));
    while (peek().is('[')) // [unroll]
        if (!skipBalanced()) return false;
    if (accept(';')) return true;
    if (accept('{')) {
        while (!accept('}')) {
            if (atEnd()) return unexpected("'}' of the function");
            if (returned ? !skipLocalStatement() : !runStatement(returned)) return false;
        }
        return true;
    }
    if (peek().is("return")) {
        take();
        returned = expression();
        return returned && expect(';', "after the value");
    }
    if (peek().is("if")) return runChoice(returned);
    if (peek().is("for") || peek().is("while")) return runLoop(returned);
    return runAssignments();
}

bool Parser::runChoice(std::optional<Constant>& returned) {
    take();
    if (!expect('(', "of the condition")) return false;
    const auto condition = expression();
    if (!condition || !expect(')', "of the condition")) return false;
    const bool holds = condition->numbers[0] != 0;
    if (holds ? !runStatement(returned) : !skipLocalStatement()) return false;
    if (!peek().is("else")) return true;
    take();
    return holds ? skipLocalStatement() : runStatement(returned);
}

/// for (int i = 0; i < n; ++i), while (c).
bool Parser::runLoop(std::optional<Constant>& returned) {
    const bool counts = take().is("for");
    const std::size_t head = at_;
    if (!skipBalanced()) return false;
    const std::size_t body = at_;
    if (!skipLocalStatement()) return false;
    const std::size_t after = at_;
    at_ = head + 1;
    if (counts && !runStatement(returned)) return false;
    for (const std::size_t condition = at_;;) {
        at_ = condition;
        const auto holds = counts && peek().is(';') ? std::optional(Constant{{1}, true}) : expression();
        if (!holds) return false;
        const std::size_t step = at_ + 1; // behind the ';'
        if (holds->numbers[0] == 0) break;
        at_ = body;
        if (!runStatement(returned)) return false;
        if (returned) break;
        at_ = step;
        if (counts && !peek().is(')') && !runAssignments()) return false;
        if (++steps_ > kMostSteps) return fail(1106, peek(), fmt::format("more than {} statements to evaluate", kMostSteps));
    }
    at_ = after;
    return true;
}

/// `const int a = 1, b = 2;`, `a += 2;`, `a++;`, also at the end of a for.
bool Parser::runAssignments() {
    while (peek().is("const") || peek().is("static"))
        take();
    std::optional<Type> type;
    if (peek(1).kind == TokenKind::Word) type = namedType(take().text);
    do {
        if (!runAssignment(type)) return false;
    } while (accept(','));
    return peek().is(')') || expect(';', "after the statement");
}

bool Parser::runAssignment(const std::optional<Type>& type) {
    std::string step;
    const auto counted = [&] { return (peek().is('+') || peek().is('-')) && peek(1).is(peek().text[0]); };
    if (counted()) step = take().text, take();
    Token name;
    if (!expectName(name, "a variable")) return false;
    if (type) (*locals_)[std::string(name.text)] = {.type = *type, .value = {{0}, true}};
    const auto local = locals_->find(name.text);
    if (local == locals_->end()) return fail(1104, name, fmt::format("'{}' cannot be evaluated here", name.text));
    if (counted()) step = take().text, take();
    std::optional<Constant> value = Constant{{1}, true};
    if (step.empty()) {
        if (type && !peek().is('=')) return true; // a declaration alone
        if (!peek().is('=')) step = take().text;
        if (!expect('=', "of the value")) return false;
        value = expression();
        if (!value) return false;
    }
    if (!step.empty()) value = applyOperator(step, local->second.value, *value);
    if (!value) return fail(1104, name, fmt::format("'{}' has no finite result here", step));
    local->second.value = convertedTo(local->second.type, *value);
    return true;
}

} // namespace tegument
