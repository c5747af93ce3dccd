#include "meshprep/adopt/flow.h"

#include "host/effect/operators.h"
#include "meshprep/adopt/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_map>

namespace tegument::adopt {

namespace {

constexpr std::size_t kMostNodes = 30'000;
constexpr int kDeepestNode = 4000; // bounds our own recursion
constexpr int kMostStatements = 20'000;
constexpr int kDeepestCall = 24;
constexpr int kDeepestExpression = 100;

/// One component of a value: an operation on others. Equal ones are one node.
struct Node {
    std::string op;
    std::vector<int> of;
    std::string name; // of a parameter, an input or a number
};

/// A scalar, a vector or a matrix as its components (a matrix of the parameters is one), a structure, or an array, whose elements are
/// alike.
struct Known {
    std::vector<int> at;
    std::map<std::string, Known> members;
    bool matrix = false;
};

struct TooMuch {};

/// Where a value stands that can be assigned to.
struct Place {
    std::string root;
    std::vector<std::string> steps; // members and components; "[" for an element
};

struct Term {
    Known value;
    std::optional<Place> place;
};

bool isSwizzle(const std::string& text) {
    return !text.empty() && text.size() <= 4 &&
           (text.find_first_not_of("xyzw") == std::string::npos || text.find_first_not_of("rgba") == std::string::npos);
}

std::size_t componentOf(char letter) {
    const std::size_t place = std::string_view("xyzw").find(letter);
    return place != std::string_view::npos ? place : std::string_view("rgba").find(letter);
}

/// Runs functions on names.
class Runner {
public:
    explicit Runner(const Code& code) : code_(code) {}

    /// Outputs by semantic ("POSITION0").
    std::map<std::string, Known> run(const ShaderReference& shader, const std::map<std::string, Known>& inputs) {
        const Function* function = chosen(shader);
        if (!function) throw TooMuch{};
        std::vector<Known> values;
        std::size_t argument = 0;
        for (const Variable& parameter : function->parameters) {
            const Words type = code_.resolved(parameter.type);
            const bool structure = code_.structure(type.front().text) != nullptr;
            if (parameter.has("uniform") || (parameter.semantic.empty() && !structure && !parameter.has("out")))
                values.push_back(argument < shader.arguments.size() ? written(shader.arguments[argument++]) : initial(parameter));
            else
                values.push_back(taken(parameter, inputs, 0));
        }
        std::vector<Known> outs;
        const Known result = call(*function, std::move(values), &outs);
        std::map<std::string, Known> outputs;
        give({.type = function->type, .semantic = function->semantic}, result, outputs, 0);
        for (std::size_t i = 0; i < function->parameters.size(); ++i)
            if (function->parameters[i].has("out") || function->parameters[i].has("inout"))
                give(function->parameters[i], outs[i], outputs, 0);
        return outputs;
    }

    [[nodiscard]] const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }

    /// Whether a node that `is` finds is among what this one is made of, itself counted.
    template <class Test>
    [[nodiscard]] bool contains(int from, const Test& is) const {
        std::set<int> seen;
        std::vector<int> open{from};
        while (!open.empty()) {
            const int next = open.back();
            open.pop_back();
            if (!seen.insert(next).second) continue;
            if (is(node(next))) return true;
            open.insert(open.end(), node(next).of.begin(), node(next).of.end());
        }
        return false;
    }

    static std::string keyOf(const std::string& semantic) {
        std::string key = upper(semantic);
        if (key.empty() || std::isdigit(static_cast<unsigned char>(key.back())) == 0) key += '0';
        return key;
    }

private:
    // Nodes.
    int made(std::string op, std::vector<int> of, std::string name = {}) {
        std::string key = op + '|' + name;
        for (const int i : of)
            key += fmt::format(",{}", i);
        const auto [found, fresh] = known_.try_emplace(std::move(key), static_cast<int>(nodes_.size()));
        if (fresh) {
            if (nodes_.size() >= kMostNodes) throw TooMuch{};
            nodes_.push_back({std::move(op), std::move(of), std::move(name)});
        }
        return found->second;
    }

    int number(double value) { return made("number", {}, fmt::format("{}", value)); }

    [[nodiscard]] std::optional<double> numberOf(int index) const {
        double value = 0;
        const Node& n = node(index);
        if (n.op != "number") return std::nullopt;
        const auto read = std::from_chars(n.name.data(), n.name.data() + n.name.size(), value);
        return read.ec == std::errc() ? std::optional(value) : std::nullopt;
    }

    int negative(int index) {
        if (const auto value = numberOf(index)) return number(-*value);
        return node(index).op == "-1" ? node(index).of[0] : made("-1", {index});
    }

    int combined(const std::string& op, int a, int b) {
        const auto x = numberOf(a);
        const auto y = numberOf(b);
        if (x && y) {
            if (op == "+") return number(*x + *y);
            if (op == "-") return number(*x - *y);
            if (op == "*") return number(*x * *y);
            if (op == "/" && *y != 0) return number(*x / *y);
            if (op == "==") return number(*x == *y);
            if (op == "!=") return number(*x != *y);
            if (op == "<") return number(*x < *y);
            if (op == ">") return number(*x > *y);
            if (op == "<=") return number(*x <= *y);
            if (op == ">=") return number(*x >= *y);
            if (op == "&&") return number(*x != 0 && *y != 0);
            if (op == "||") return number(*x != 0 || *y != 0);
        }
        return made(op, {a, b});
    }

    // Values.
    static int component(const Known& value, std::size_t i) {
        return value.at[value.at.size() == 1 ? 0 : std::min(i, value.at.size() - 1)];
    }

    Known unknown() { return {.at = {made("unknown", {})}}; }

    Known vector(const std::string& op, const std::string& name, std::size_t count) {
        Known value;
        for (std::size_t i = 0; i < count; ++i)
            value.at.push_back(made(op, {number(static_cast<double>(i))}, name));
        return value;
    }

    /// A parameter of the effect, an input: named by where it is.
    Known leaf(const std::string& op, const Words& typeWords, const std::string& name, int depth) {
        const Words type = code_.resolved(typeWords);
        Known value;
        if (const Structure* structure = code_.structure(type.front().text); structure && depth < 8) {
            for (const Variable& member : structure->members)
                value.members[member.name.text] = leaf(op, member.type, name + "_" + member.name.text, depth + 1);
            return value;
        }
        const auto shape = shapeOf(type);
        if (shape && shape->matrix) return {.at = {made("matrix", {}, name)}, .matrix = true};
        return vector(op, name, shape ? static_cast<std::size_t>(shape->columns) : 1);
    }

    Known joined(const Known& a, const Known& b) {
        Known value = a;
        value.at.resize(std::max(a.at.size(), b.at.size()));
        for (std::size_t i = 0; i < value.at.size(); ++i) {
            const int x = a.at.empty() ? component(b, i) : component(a, i);
            const int y = b.at.empty() ? x : component(b, i);
            value.at[i] = x == y ? x : made("either", {x, y});
        }
        for (const auto& [name, member] : b.members) {
            const auto own = value.members.find(name);
            if (own == value.members.end())
                value.members.emplace(name, member);
            else
                own->second = joined(own->second, member);
        }
        return value;
    }

    int whole(const Known& value) {
        if (value.at.size() == 1) return value.at[0];
        std::vector<int> parts = value.at;
        for (const auto& [name, member] : value.members)
            parts.push_back(whole(member));
        return made("vector", std::move(parts));
    }

    // Inputs and outputs.
    Known taken(const Variable& variable, const std::map<std::string, Known>& inputs, int depth) {
        const Words type = code_.resolved(variable.type);
        if (const Structure* structure = code_.structure(type.front().text); structure && depth < 8) {
            Known value;
            for (const Variable& member : structure->members)
                value.members[member.name.text] = taken(member, inputs, depth + 1);
            return value;
        }
        const std::string key = keyOf(variable.semantic);
        if (const auto given = inputs.find(key); given != inputs.end()) {
            Known value = given->second;
            const auto shape = shapeOf(type);
            if (shape && !shape->matrix && value.at.size() > static_cast<std::size_t>(shape->columns))
                value.at.resize(static_cast<std::size_t>(shape->columns));
            return value;
        }
        const auto shape = shapeOf(type);
        if (shape && shape->matrix) return {.at = {made("stream", {}, key)}, .matrix = true};
        return vector("stream", key, shape ? static_cast<std::size_t>(shape->columns) : 1);
    }

    void give(const Variable& variable, const Known& value, std::map<std::string, Known>& outputs, int depth) {
        const Words type = code_.resolved(variable.type);
        if (const Structure* structure = code_.structure(type.front().text); structure && depth < 8) {
            for (const Variable& member : structure->members)
                if (const auto found = value.members.find(member.name.text); found != value.members.end())
                    give(member, found->second, outputs, depth + 1);
            return;
        }
        if (!variable.semantic.empty()) outputs.try_emplace(keyOf(variable.semantic), value);
    }

    [[nodiscard]] const Function* chosen(const ShaderReference& shader) const {
        const auto functions = code_.functions(shader.original.empty() ? shader.entry : shader.original);
        for (const Function* function : functions)
            if (static_cast<std::size_t>(std::ranges::count_if(function->parameters, [](const Variable& p) { return p.has("uniform"); })) ==
                shader.arguments.size())
                return function;
        return functions.empty() ? nullptr : functions.back();
    }

    Known written(const std::string& argument) {
        const Code words = readCode("x = " + argument + ";");
        for (const Item& item : words.items)
            if (const auto* other = std::get_if<Other>(&item); other && other->words.size() > 3)
                return evaluated({other->words.begin() + 2, other->words.end() - 1});
        return unknown();
    }

    Known initial(const Variable& variable) { return variable.initial.empty() ? unknown() : evaluated(variable.initial); }

    Known evaluated(const Words& words) {
        Cursor cursor{words};
        return expression(cursor).value;
    }

    // Functions.
    struct Frame {
        std::map<std::string, Known> locals;
        std::optional<Known> returned;
        bool ended = false; // nothing behind a return runs
    };

    Known call(const Function& function, std::vector<Known> arguments, std::vector<Known>* outs) {
        if (++calls_ > kDeepestCall) throw TooMuch{};
        Frame frame;
        for (std::size_t i = 0; i < function.parameters.size(); ++i) {
            const Variable& parameter = function.parameters[i];
            Known value = i < arguments.size() ? std::move(arguments[i]) : initial(parameter);
            const auto shape = shapeOf(code_.resolved(parameter.type));
            frame.locals[parameter.name.text] = shape ? converted(std::move(value), *shape) : std::move(value);
        }
        Frame* outer = std::exchange(frame_, &frame);
        Cursor cursor{function.body};
        statement(cursor);
        frame_ = outer;
        --calls_;
        if (outs)
            for (const Variable& parameter : function.parameters)
                outs->push_back(frame.locals[parameter.name.text]);
        return frame.returned.value_or(Known{});
    }

    Known converted(Known value, const Shape& shape) {
        const auto columns = static_cast<std::size_t>(shape.columns);
        if (shape.matrix || value.matrix || value.at.empty()) return value;
        if (value.at.size() == 1) value.at.resize(columns, value.at[0]);
        if (value.at.size() > columns) value.at.resize(columns);
        return value;
    }

    struct Cursor {
        const Words& words;
        std::size_t at = 0;
        int depth = 0;

        [[nodiscard]] bool ended() const { return at >= words.size(); }
        [[nodiscard]] bool is(std::string_view text, std::size_t ahead = 0) const {
            return at + ahead < words.size() && words[at + ahead].text == text;
        }
        /// Two signs side by side.
        [[nodiscard]] bool isPair(char a, char b) const {
            return at + 1 < words.size() && words[at].text == std::string(1, a) && words[at + 1].text == std::string(1, b) &&
                   !words[at + 1].space;
        }
        [[nodiscard]] bool isName(std::size_t ahead = 0) const { return at + ahead < words.size() && words[at + ahead].isName(); }
        bool accept(std::string_view text) {
            if (!is(text)) return false;
            ++at;
            return true;
        }
        void expect(std::string_view text) {
            if (!accept(text)) throw TooMuch{};
        }
    };

    void skipStatement(Cursor& c) {
        while (!c.ended() && !c.is(";"))
            c.at = c.is("{") || c.is("(") || c.is("[") ? behindBracket(c.words, c.at) : c.at + 1;
        c.accept(";");
    }

    void statement(Cursor& c) {
        if (++statements_ > kMostStatements) throw TooMuch{};
        while (c.is("["))
            c.at = behindBracket(c.words, c.at);
        if (c.ended() || c.accept(";")) return;
        if (c.is("{")) {
            const std::size_t end = behindBracket(c.words, c.at);
            ++c.at;
            while (c.at + 1 < end && !frame_->ended)
                statement(c);
            c.at = end;
            return;
        }
        if (c.accept("return")) {
            if (!c.is(";")) {
                const Known value = expression(c).value;
                frame_->returned = frame_->returned ? joined(*frame_->returned, value) : value;
            }
            frame_->ended = true;
            c.accept(";");
            return;
        }
        if (c.is("if")) return choice(c);
        if (c.is("for") || c.is("while")) return loop(c);
        if (c.accept("do")) {
            branch(c);
            return skipStatement(c);
        }
        if (c.is("discard") || c.is("break") || c.is("continue") || c.is("clip") || c.is("switch")) {
            if (c.is("switch")) throw TooMuch{};
            return skipStatement(c);
        }
        if (declares(c)) return declaration(c);
        expression(c);
        while (c.accept(","))
            expression(c);
        c.expect(";");
    }

    /// A body that may run or not.
    void branch(Cursor& c) {
        const std::map<std::string, Known> before = frame_->locals;
        const std::map<std::string, Known> globals = globals_;
        statement(c);
        if (frame_->ended) {
            frame_->locals = before;
            globals_ = globals;
            frame_->ended = false;
            return;
        }
        joinInto(frame_->locals, before);
        joinInto(globals_, globals);
    }

    void joinInto(std::map<std::string, Known>& values, const std::map<std::string, Known>& others) {
        for (const auto& [name, other] : others)
            if (const auto own = values.find(name); own != values.end()) own->second = joined(other, own->second);
    }

    void choice(Cursor& c) {
        ++c.at;
        c.expect("(");
        const Known condition = expression(c).value;
        c.expect(")");
        const auto known = condition.at.size() == 1 ? numberOf(condition.at[0]) : std::nullopt;
        const std::size_t yes = c.at;
        passOver(c);
        std::optional<std::size_t> no;
        if (c.accept("else")) {
            no = c.at;
            passOver(c);
        }
        const std::size_t end = c.at;
        if (known) {
            c.at = *known != 0 ? yes : no.value_or(end);
            if (*known != 0 || no) statement(c);
            c.at = end;
            return;
        }
        const std::map<std::string, Known> before = frame_->locals;
        const std::map<std::string, Known> globals = globals_;
        c.at = yes;
        statement(c);
        const bool endedYes = std::exchange(frame_->ended, false);
        std::map<std::string, Known> first = std::exchange(frame_->locals, before);
        std::map<std::string, Known> firstGlobals = std::exchange(globals_, globals);
        if (no) {
            c.at = *no;
            statement(c);
        }
        const bool endedNo = std::exchange(frame_->ended, false);
        frame_->ended = endedYes && endedNo && no;
        if (endedNo) {
            frame_->locals = std::move(first);
            globals_ = std::move(firstGlobals);
        } else if (!endedYes) {
            joinInto(frame_->locals, first);
            joinInto(globals_, firstGlobals);
        }
        c.at = end;
    }

    /// One statement that is not run.
    void passOver(Cursor& c) {
        while (c.is("["))
            c.at = behindBracket(c.words, c.at);
        if (c.is("{")) {
            c.at = behindBracket(c.words, c.at);
            return;
        }
        const bool chooses = c.is("if");
        if (chooses || c.is("for") || c.is("while")) {
            ++c.at;
            c.at = behindBracket(c.words, c.at);
            passOver(c);
            if (chooses && c.accept("else")) passOver(c);
            return;
        }
        skipStatement(c);
    }

    /// Once: what a second turn would do to signs and places the first one does.
    void loop(Cursor& c) {
        const bool counts = c.is("for");
        ++c.at;
        const std::size_t end = behindBracket(c.words, c.at);
        c.expect("(");
        if (counts) statement(c);
        c.at = end;
        branch(c);
    }

    [[nodiscard]] bool declares(const Cursor& c) const {
        if (!c.isName()) return false;
        if (c.is("const") || c.is("static") || c.is("precise")) return true;
        const std::string& word = c.words[c.at].text;
        if (c.is("<", 1)) return word == "vector" || word == "matrix";
        return c.isName(1) && word != "return" && word != "else";
    }

    void declaration(Cursor& c) {
        while (c.is("const") || c.is("static") || c.is("precise"))
            ++c.at;
        Words type{c.words[c.at++]};
        if (c.is("<"))
            while (!c.ended()) {
                type.push_back(c.words[c.at]);
                if (c.words[c.at++].is(">")) break;
            }
        const Words resolved = code_.resolved(type);
        do {
            if (!c.isName()) throw TooMuch{};
            const std::string name = c.words[c.at++].text;
            while (c.is("["))
                c.at = behindBracket(c.words, c.at);
            const auto shape = shapeOf(resolved);
            Known value = leaf("unset", resolved, name, 0);
            if (c.accept("=")) {
                const bool inBraces = c.is("{");
                Known given = inBraces ? braced(c) : expression(c).value;
                std::size_t next = 0;
                if (Known all; inBraces && code_.structure(resolved.front().text) != nullptr) {
                    all = filled(resolved, given.at, next, 0);
                    if (next == given.at.size()) value = std::move(all); // else a part of unknown size is among them
                } else {
                    value = shape ? converted(std::move(given), *shape) : std::move(given);
                    value.matrix = value.matrix || (shape && shape->matrix);
                }
            }
            frame_->locals[name] = std::move(value);
        } while (c.accept(","));
        c.expect(";");
    }

    /// Of components in the order of their declaration, from `next` on.
    Known filled(const Words& typeWords, const std::vector<int>& given, std::size_t& next, int depth) {
        const Words type = code_.resolved(typeWords);
        Known value;
        if (const Structure* structure = code_.structure(type.front().text); structure && depth < 8) {
            for (const Variable& member : structure->members)
                value.members[member.name.text] = filled(member.type, given, next, depth + 1);
            return value;
        }
        const auto shape = shapeOf(type);
        for (int i = 0; i < (shape && !shape->matrix ? shape->columns : 1); ++i, ++next)
            if (next < given.size()) value.at.push_back(given[next]);
        if (value.at.empty()) value = unknown();
        return value;
    }

    Known braced(Cursor& c) {
        Known value;
        c.expect("{");
        while (!c.accept("}")) {
            const Known part = c.is("{") ? braced(c) : expression(c).value;
            value.at.insert(value.at.end(), part.at.begin(), part.at.end());
            c.accept(",");
        }
        if (value.at.empty()) value = unknown();
        return value;
    }

    // Expressions.
    Term expression(Cursor& c) {
        if (++c.depth > kDeepestExpression) throw TooMuch{};
        Term left = binary(c, 1);
        if (c.is("?")) {
            ++c.at;
            const Known yes = expression(c).value;
            c.expect(":");
            const Known no = expression(c).value;
            const auto known = left.value.at.size() == 1 ? numberOf(left.value.at[0]) : std::nullopt;
            left = {known ? (*known != 0 ? yes : no) : joined(yes, no), std::nullopt};
        } else if (c.is("=") && !c.isPair('=', '=')) {
            ++c.at;
            const Known value = expression(c).value;
            assign(left, value);
            left.value = value;
        } else {
            for (const char op : {'+', '-', '*', '/', '%', '|', '&', '^'})
                if (c.isPair(op, '=')) {
                    c.at += 2;
                    const Known value = operated(std::string(1, op), left.value, expression(c).value);
                    assign(left, value);
                    left.value = value;
                    break;
                }
        }
        --c.depth;
        return left;
    }

    static std::optional<Operator> operatorAt(const Cursor& c) {
        for (const Operator& op : kOperators) {
            if (op.text.size() == 2 ? !c.isPair(op.text[0], op.text[1]) : !c.is(op.text)) continue;
            if (op.text.size() == 1 && c.isPair(op.text[0], '=')) return std::nullopt; // +=
            return op;
        }
        return std::nullopt;
    }

    Term binary(Cursor& c, int least) {
        Term left = unary(c);
        for (auto op = operatorAt(c); op && op->precedence >= least; op = operatorAt(c)) {
            c.at += op->text.size();
            const Term right = binary(c, op->precedence + 1);
            left = {operated(std::string(op->text), left.value, right.value), std::nullopt};
        }
        return left;
    }

    Known operated(const std::string& op, const Known& a, const Known& b) {
        if (a.at.empty() || b.at.empty()) return unknown();
        if (a.matrix || b.matrix) return {.at = {made(op, {whole(a), whole(b)})}, .matrix = true};
        Known value;
        const std::size_t count = a.at.size() == 1 ? b.at.size() : b.at.size() == 1 ? a.at.size() : std::min(a.at.size(), b.at.size());
        for (std::size_t i = 0; i < count; ++i)
            value.at.push_back(combined(op, component(a, i), component(b, i)));
        return value;
    }

    Term unary(Cursor& c) {
        if (c.isPair('+', '+') || c.isPair('-', '-')) {
            const std::string op = c.words[c.at].text;
            c.at += 2;
            const Term term = unary(c);
            assign(term, operated(op, term.value, {.at = {number(1)}}));
            return term;
        }
        if (c.accept("-")) {
            Known value = unary(c).value;
            for (int& i : value.at)
                i = negative(i);
            return {std::move(value), std::nullopt};
        }
        if (c.accept("+")) return unary(c);
        if (c.is("!") || c.is("~")) {
            ++c.at;
            Known value = unary(c).value;
            for (int& i : value.at) {
                const auto known = numberOf(i);
                i = known ? number(*known == 0) : made("!", {i});
            }
            return {std::move(value), std::nullopt};
        }
        if (c.is("(") && c.isName(1) && c.is(")", 2)) {
            const Words type = code_.resolved({c.words[c.at + 1]});
            const auto shape = shapeOf(type);
            const Structure* structure = shape ? nullptr : code_.structure(type.front().text);
            if (shape || structure) {
                c.at += 3;
                Known value = unary(c).value;
                if (shape) return {converted(std::move(value), *shape), std::nullopt};
                return {leaf("unset", type, "", 0), std::nullopt};
            }
        }
        return postfix(c);
    }

    Term postfix(Cursor& c) {
        Term term = primary(c);
        for (;;) {
            if (c.is("[")) {
                ++c.at;
                const Known index = expression(c).value;
                c.expect("]");
                term = element(term, index);
            } else if (c.is(".") && c.isName(1)) {
                const std::string name = c.words[c.at + 1].text;
                c.at += 2;
                if (c.is("(")) { // a method of a texture
                    std::vector<Known> arguments = argumentsOf(c, nullptr);
                    std::vector<int> parts{whole(term.value)};
                    for (const Known& argument : arguments)
                        parts.push_back(whole(argument));
                    term = {vectorOf("texture", parts, 4), std::nullopt};
                } else {
                    term = part(term, name);
                }
            } else if (c.isPair('+', '+') || c.isPair('-', '-')) {
                const std::string op = c.words[c.at].text;
                c.at += 2;
                assign(term, operated(op, term.value, {.at = {number(1)}}));
            } else {
                return term;
            }
        }
    }

    Term element(const Term& term, const Known& index) {
        Term result{term.value, term.place};
        if (result.place) result.place->steps.emplace_back("[");
        const auto known = index.at.size() == 1 ? numberOf(index.at[0]) : std::nullopt;
        if (term.value.matrix && result.place && result.place->steps.size() == 1 && arrays_.contains(result.place->root)) {
            result.value = term.value;
        } else if (term.value.matrix) {
            result.value = vectorOf("row", {whole(term.value), index.at.empty() ? number(0) : index.at[0]}, 4);
        } else if (known && *known >= 0 && static_cast<std::size_t>(*known) < term.value.at.size() && term.value.members.empty() &&
                   result.place && isVector(*result.place)) {
            result.place->steps.back() = std::string(1, "xyzw"[static_cast<std::size_t>(*known) % 4]);
            result.value = {.at = {term.value.at[static_cast<std::size_t>(*known)]}};
        }
        return result;
    }

    /// v[1] of a vector is a component, of an array it is an element like every other.
    [[nodiscard]] bool isVector(const Place& place) const { return place.steps.size() == 1 && !arrays_.contains(place.root); }

    Term part(const Term& term, const std::string& name) {
        Term result{{}, term.place};
        if (result.place) result.place->steps.push_back(name);
        if (const auto member = term.value.members.find(name); member != term.value.members.end()) {
            result.value = member->second;
        } else if (!term.value.matrix && isSwizzle(name) && !term.value.at.empty()) {
            for (const char letter : name)
                result.value.at.push_back(component(term.value, componentOf(letter)));
        } else {
            result.value = {.at = {made("part", {whole(term.value)}, name)}};
        }
        return result;
    }

    Known vectorOf(const std::string& op, std::vector<int> of, std::size_t count) {
        Known value;
        const int all = made(op, std::move(of));
        for (std::size_t i = 0; i < count; ++i)
            value.at.push_back(made("component", {all}, fmt::format("{}", i)));
        return value;
    }

    std::vector<Known> argumentsOf(Cursor& c, std::vector<Term>* terms) {
        std::vector<Known> list;
        c.expect("(");
        while (!c.accept(")")) {
            Term term = expression(c);
            list.push_back(term.value);
            if (terms) terms->push_back(std::move(term));
            if (!c.is(")")) c.expect(",");
        }
        return list;
    }

    Term primary(Cursor& c) {
        if (c.ended()) throw TooMuch{};
        const Word& word = c.words[c.at];
        if (c.accept("(")) {
            Term term = expression(c);
            while (c.accept(","))
                term = expression(c);
            c.expect(")");
            return term;
        }
        if (word.kind == TokenKind::Number) {
            ++c.at;
            double value = 0;
            std::from_chars(word.text.data(), word.text.data() + word.text.size(), value);
            return {{.at = {number(value)}}, std::nullopt};
        }
        if (!word.isName()) throw TooMuch{};
        ++c.at;
        if (word.is("true") || word.is("false")) return {{.at = {number(word.is("true"))}}, std::nullopt};
        if (c.is("<") && (word.is("vector") || word.is("matrix")))
            while (!c.ended() && !c.is("("))
                ++c.at;
        if (c.is("(")) return {called(c, word.text), std::nullopt};
        return {valueOf(word.text), Place{word.text, {}}};
    }

    Known& valueOf(const std::string& name) {
        if (frame_)
            if (const auto local = frame_->locals.find(name); local != frame_->locals.end()) return local->second;
        if (const auto global = globals_.find(name); global != globals_.end()) return global->second;
        const Variable* variable = code_.variable(name);
        Known value = unknown();
        if (variable && variable->has("static") && !variable->initial.empty()) {
            globals_[name] = value; // one that names itself
            Cursor cursor{variable->initial};
            Frame* outer = std::exchange(frame_, nullptr);
            value = cursor.is("{") ? braced(cursor) : expression(cursor).value;
            frame_ = outer;
            const auto shape = shapeOf(code_.resolved(variable->type));
            if (shape && variable->array.empty()) value = converted(std::move(value), *shape);
        } else if (variable) {
            if (!variable->array.empty()) arrays_.insert(name);
            value = leaf(variable->has("static") ? "unset" : "parameter", variable->type, name, 0);
        }
        return globals_[name] = std::move(value);
    }

    Known called(Cursor& c, const std::string& name) {
        std::vector<Term> terms;
        std::vector<Known> arguments = argumentsOf(c, &terms);
        if (const auto shape = shapeOf({Word{.text = name, .kind = TokenKind::Word}})) return constructed(*shape, arguments);
        for (const Function* function : code_.functions(name)) {
            if (function->parameters.size() != arguments.size()) continue;
            std::vector<Known> outs;
            const Known result = call(*function, std::move(arguments), &outs);
            for (std::size_t i = 0; i < terms.size(); ++i)
                if (function->parameters[i].has("out") || function->parameters[i].has("inout")) assign(terms[i], outs[i]);
            return result;
        }
        return intrinsic(name, arguments);
    }

    Known constructed(const Shape& shape, const std::vector<Known>& arguments) {
        Known value;
        for (const Known& argument : arguments) {
            if (argument.matrix && argument.at.size() == 1) return argument; // (float3x3) of a parameter
            value.at.insert(value.at.end(), argument.at.begin(), argument.at.end());
        }
        if (value.at.empty()) return unknown();
        value.matrix = shape.matrix;
        return shape.matrix ? value : converted(std::move(value), shape);
    }

    Known intrinsic(const std::string& name, const std::vector<Known>& arguments) {
        if (arguments.empty()) return unknown();
        for (const Known& argument : arguments)
            if (argument.at.empty() && argument.members.empty()) return unknown();
        if (name == "mul" && arguments.size() == 2) return multiplied(arguments[0], arguments[1]);
        if (name == "dot" && arguments.size() == 2) return {.at = {made("dot", {whole(arguments[0]), whole(arguments[1])})}};
        if (name == "normalize") {
            const int all = made("normalize", {whole(arguments[0])});
            Known value;
            for (std::size_t i = 0; i < arguments[0].at.size(); ++i)
                value.at.push_back(made("component", {all}, fmt::format("{}", i)));
            return value;
        }
        if (name == "transpose") return arguments[0];
        if (name == "length" || name == "distance" || name == "any" || name == "all" || name == "determinant")
            return {.at = {made(name, {whole(arguments[0])})}};
        std::vector<int> all;
        std::size_t count = 1;
        for (const Known& argument : arguments) {
            all.push_back(whole(argument));
            count = std::max(count, argument.at.size());
        }
        if (fetchOf(name)) return vectorOf("texture", all, 4);
        if (name == "cross" || name == "reflect" || name == "refract" || name == "lit" || name == "faceforward")
            return vectorOf(name, all, std::max<std::size_t>(count, 3));
        Known value;
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<int> of;
            for (const Known& argument : arguments)
                of.push_back(argument.at.empty() ? whole(argument) : component(argument, i));
            value.at.push_back(made(name, std::move(of)));
        }
        return value;
    }

    Known multiplied(const Known& a, const Known& b) {
        if (!a.matrix && !b.matrix) {
            if (a.at.size() > 1 && b.at.size() > 1) return {.at = {made("dot", {whole(a), whole(b)})}};
            return operated("*", a, b);
        }
        if (a.matrix && b.matrix) return {.at = {made("product", {whole(a), whole(b)})}, .matrix = true};
        const Known& v = a.matrix ? b : a;
        const Known& m = a.matrix ? a : b;
        return vectorOf("transformed", {whole(v), whole(m)}, 4);
    }

    void assign(const Term& term, const Known& value) {
        if (!term.place) return;
        Known* target = &valueOf(term.place->root);
        for (std::size_t i = 0; i < term.place->steps.size(); ++i) {
            const std::string& step = term.place->steps[i];
            if (step == "[") { // an element: all are alike
                if (target->matrix) return;
                *target = joined(*target, value);
                return;
            }
            if (const auto member = target->members.find(step); member != target->members.end()) {
                target = &member->second;
                continue;
            }
            if (!isSwizzle(step) || target->matrix || value.at.empty()) return;
            for (std::size_t k = 0; k < step.size(); ++k) {
                const std::size_t place = componentOf(step[k]);
                if (place >= target->at.size()) target->at.resize(place + 1, target->at.empty() ? made("unset", {}) : target->at[0]);
                target->at[place] = component(value, k);
            }
            return;
        }
        const std::size_t count = target->at.size();
        const bool vectorial = target->members.empty() && !target->matrix && count > 0 && !value.matrix && !value.at.empty();
        *target = value;
        if (vectorial && target->at.size() == 1) target->at.resize(count, target->at[0]);
        if (vectorial && target->at.size() > count) target->at.resize(count);
    }

    const Code& code_;
    std::vector<Node> nodes_;
    std::unordered_map<std::string, int> known_;
    std::map<std::string, Known> globals_;
    std::set<std::string> arrays_;
    Frame* frame_ = nullptr;
    int calls_ = 0;
    int statements_ = 0;
};

bool isPositionKey(const std::string& key) {
    return key == "POSITION0" || key == "SV_POSITION0" || key == "POSITIONT0";
}

/// Votes of the dot products that reach a pixel.
class Signs {
public:
    Signs(const Runner& runner, std::map<std::string, int>& votes) : runner_(runner), votes_(votes) {}

    void visit(int index, int sign, bool lit) {
        if (!seen_.insert({index, sign, lit}).second || depth_ > kDeepestNode) return;
        const Node& node = runner_.node(index);
        if (node.op == "dot") return vote(node, sign, lit);
        const bool lights = node.op == "saturate" || node.op == "max" || node.op == "clamp" || node.op == "lit" || node.op == "smoothstep";
        ++depth_;
        for (std::size_t i = 0; i < node.of.size(); ++i) {
            const bool turned = node.op == "-1" || (node.op == "-" && i == 1);
            visit(node.of[i], turned ? -sign : sign, lit || lights);
        }
        --depth_;
    }

private:
    using Leaves = std::map<std::string, int>;

    static void merge(Leaves& into, const Leaves& more, int sign) {
        for (const auto& [name, own] : more) {
            const auto [found, fresh] = into.try_emplace(name, own * sign);
            if (!fresh && found->second != own * sign) found->second = 0;
        }
    }

    /// Parameters and streams that this component is a multiple of, with their signs.
    const Leaves& leavesOf(int index) {
        if (const auto known = leaves_.find(index); known != leaves_.end()) return known->second;
        if (depth_ > kDeepestNode) return leaves_[index];
        leaves_[index] = {};
        ++depth_;
        const Node& node = runner_.node(index);
        Leaves found;
        if (node.op == "parameter") found[node.name] = 1;
        if (node.op == "stream") found["<" + node.name] = 1;
        const auto number = [&](int i) { return runner_.node(i).op == "number"; };
        if (node.op == "-1") merge(found, leavesOf(node.of[0]), -1);
        if (node.op == "+" || node.op == "either" || node.op == "lerp") {
            merge(found, leavesOf(node.of[0]), 1);
            merge(found, leavesOf(node.of[1]), 1);
        }
        if (node.op == "-") {
            merge(found, leavesOf(node.of[0]), 1);
            merge(found, leavesOf(node.of[1]), -1);
        }
        if (node.op == "*" || node.op == "/")
            for (std::size_t i = 0; i < (node.op == "*" ? 2U : 1U); ++i) {
                const int other = node.of[1 - i];
                if (!number(node.of[i]))
                    merge(found, leavesOf(node.of[i]), number(other) && runner_.node(other).name.starts_with('-') ? -1 : 1);
            }
        if (node.op == "component" || node.op == "normalize" || node.op == "transformed" || node.op == "vector")
            if (!node.of.empty()) merge(found, leavesOf(node.of[0]), 1);
        --depth_;
        return leaves_[index] = std::move(found);
    }

    void vote(const Node& dot, int sign, bool lit) {
        for (std::size_t i = 0; i < 2; ++i) {
            const Leaves own = leavesOf(dot.of[i]);
            const Leaves& other = leavesOf(dot.of[1 - i]);
            const bool otherTurned = !other.empty() && std::ranges::all_of(other, [](const auto& leaf) { return leaf.second < 0; });
            for (const auto& [name, direction] : own)
                if (!name.starts_with('<') && !other.contains(name))
                    votes_[name] += direction * sign * (otherTurned ? -1 : 1) * (lit ? 3 : 1);
        }
    }

    const Runner& runner_;
    std::map<std::string, int>& votes_;
    std::set<std::tuple<int, int, bool>> seen_;
    std::map<int, Leaves> leaves_;
    int depth_ = 0;
};

} // namespace

std::optional<PositionFlow> positionFlow(const Code& code, const ShaderReference& vertex, const IsTargetSize& isTargetSize) {
    try {
        Runner runner(code);
        const auto outputs = runner.run(vertex, {});
        for (const auto& [key, value] : outputs) {
            if (!isPositionKey(key) || value.at.empty()) continue;
            PositionFlow flow;
            const auto isStream = [](const Node& node) { return node.op == "stream" && isPositionKey(node.name); };
            const auto sized = [&](int index) {
                return runner.contains(index, [&](const Node& node) { return node.op == "parameter" && isTargetSize(node.name); });
            };
            const auto anywhere = [&](const auto& is) {
                return std::ranges::any_of(value.at, [&](int component) { return runner.contains(component, is); });
            };
            flow.placed = anywhere([](const Node& node) {
                return node.op == "matrix" && node.name != "MatrixTransform"; // XNA's SpriteBatch makes pixels clip space with it
            });
            flow.pixels = !flow.placed && anywhere([&](const Node& node) {
                return (node.op == "/" || node.op == "*") && node.of.size() == 2 && runner.contains(node.of[0], isStream) &&
                       sized(node.of[1]);
            });
            flow.farthest = value.at.size() == 4 && value.at[2] == value.at[3] && runner.node(value.at[2]).op != "number";
            return flow;
        }
    } catch (const TooMuch&) {
    }
    return std::nullopt;
}

void addDirectionSigns(const Code& code, const Pass& pass, std::map<std::string, int>& signs) {
    if (!pass.vertexShader || !pass.pixelShader) return;
    try {
        Runner runner(code);
        const auto varyings = runner.run(*pass.vertexShader, {});
        Signs found(runner, signs);
        for (const auto& [key, value] : runner.run(*pass.pixelShader, varyings))
            for (const int component : value.at)
                found.visit(component, 1, false);
    } catch (const TooMuch&) {
    }
}

int directionSign(const std::map<std::string, int>& signs, const std::string& parameter) {
    const auto found = signs.find(parameter);
    if (found != signs.end()) return found->second;
    std::string plain; // lights_0_dir: lights_dir
    for (std::size_t i = 0; i < parameter.size(); ++i) {
        std::size_t end = i + 1;
        while (parameter[i] == '_' && end < parameter.size() && std::isdigit(static_cast<unsigned char>(parameter[end])) != 0)
            ++end;
        const bool index = end > i + 1 && (end == parameter.size() || parameter[end] == '_');
        if (index)
            i = end - 1;
        else
            plain += parameter[i];
    }
    const auto member = signs.find(plain);
    return member == signs.end() ? 0 : member->second;
}

} // namespace tegument::adopt
