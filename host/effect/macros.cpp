#include "host/effect/macros.h"

#include <algorithm>

#include <fmt/format.h>

namespace tegument {

namespace {

/// Each doubling macro of a chain doubles the output; this many tokens is twenty times the largest effect.
constexpr std::size_t kMostTokens = 500'000;
/// Macro calls as arguments of macro calls; bounds our own recursion.
constexpr int kDeepestCall = 128;

void place(Token& token, const Token& at) {
    token.file = at.file;
    token.line = at.line;
    token.column = at.column;
}

std::size_t parameterIndex(const Macro& macro, const Token& token) {
    if (token.kind != TokenKind::Word) return macro.parameters.size();
    return static_cast<std::size_t>(std::ranges::find(macro.parameters, token.text) - macro.parameters.begin());
}

} // namespace

bool isPaste(std::span<const Token> tokens, std::size_t i) {
    return i + 1 < tokens.size() && tokens[i].is('#') && tokens[i + 1].is('#') && !tokens[i + 1].space;
}

bool Macro::sameAs(const Macro& other) const {
    const auto same = [](const Token& a, const Token& b) { return a.text == b.text && a.kind == b.kind; };
    return isFunction == other.isFunction && parameters == other.parameters && std::ranges::equal(body, other.body, same);
}

bool Macros::define(Macro macro) {
    const std::string name(macro.name.text);
    const auto old = table_.find(name);
    const bool replaced = old != table_.end() && !old->second.sameAs(macro);
    table_.insert_or_assign(name, std::move(macro));
    return replaced;
}

std::vector<std::string> Macros::words(std::string_view name) const {
    std::vector<std::string> words;
    if (const auto found = table_.find(name); found != table_.end())
        for (const Token& token : found->second.body)
            words.emplace_back(token.text);
    return words;
}

void Macros::undefine(std::string_view name) {
    if (const auto found = table_.find(name); found != table_.end()) table_.erase(found);
}

bool Macros::fail(int code, const Token& at, std::string text, std::string hint) {
    if (!failure_)
        failure_ =
            Diagnostic{.code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint), .sourceLine = {}};
    return false;
}

bool Macros::tooMany(const Token& at) {
    return fail(1011, at, fmt::format("macros expand to more than {} tokens", kMostTokens));
}

bool Macros::expand(std::span<const Token> input, std::vector<Token>& output) {
    if (input.empty()) return true;
    if (++depth_ > kDeepestCall) {
        --depth_;
        return fail(1011, input[0], fmt::format("macro calls are nested deeper than {}", kDeepestCall));
    }
    Frames frames;
    frames.push_back({{input.begin(), input.end()}, 0, nullptr});
    const bool good = expandFrames(frames, output);
    for (const Frame& frame : frames)
        if (frame.macro != nullptr) --frame.macro->active;
    --depth_;
    return good;
}

bool Macros::expandFrames(Frames& frames, std::vector<Token>& output) {
    while (const std::optional<Token> token = next(frames)) {
        if (token->kind == TokenKind::Word && !token->noExpand) {
            if (!expandWord(frames, *token, output)) return false;
        } else {
            output.push_back(*token);
        }
    }
    return true;
}

bool Macros::isOpenCall(std::span<const Token> tokens) const {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto macro = tokens[i].kind == TokenKind::Word ? table_.find(tokens[i].text) : table_.end();
        if (macro == table_.end() || !macro->second.isFunction) continue;
        int depth = 0;
        std::size_t at = i + 1;
        for (; at < tokens.size(); ++at) {
            depth += tokens[at].is('(') ? 1 : tokens[at].is(')') ? -1 : 0;
            if (depth <= 0) break;
        }
        if (at == tokens.size()) return true;
        i = at;
    }
    return false;
}

std::optional<Token> Macros::builtIn(const Token& name) {
    Token token = name;
    if (name.text == "__LINE__") {
        token.kind = TokenKind::Number;
        token.text = sources_.keep(std::to_string(name.line));
        return token;
    }
    if (name.text == "__FILE__") {
        token.kind = TokenKind::String;
        token.text = sources_.keep('"' + sources_[name.file].name + '"');
        return token;
    }
    return std::nullopt;
}

bool Macros::expandWord(Frames& frames, Token token, std::vector<Token>& output) {
    const auto found = table_.find(token.text);
    if (found == table_.end()) {
        output.push_back(builtIn(token).value_or(token));
        return true;
    }
    Macro& macro = found->second;
    if (macro.active > 0) {
        token.noExpand = true;
        output.push_back(token);
        return true;
    }
    Arguments arguments;
    if (macro.isFunction) {
        if (!nextIsOpen(frames)) {
            output.push_back(token);
            return true;
        }
        std::optional<Arguments> collected = collect(frames, macro, token);
        if (!collected) return false;
        arguments = std::move(*collected);
    }
    std::optional<std::vector<Token>> result = substitute(macro, arguments, token);
    return result && push(frames, macro, std::move(*result));
}

bool Macros::push(Frames& frames, Macro& macro, std::vector<Token> tokens) {
    if (!tokens.empty()) tokens[0].space = true;
    ++macro.active;
    frames.push_back({std::move(tokens), 0, &macro});
    return true;
}

/// The next token of the innermost frame that has one; frames read to their end are left.
std::optional<Token> Macros::next(Frames& frames) {
    while (!frames.empty()) {
        Frame& frame = frames.back();
        if (frame.at < frame.tokens.size()) {
            Token token = frame.tokens[frame.at++];
            token.space = token.space || spaceNext_;
            spaceNext_ = false;
            return token;
        }
        if (frame.macro != nullptr) --frame.macro->active;
        frames.pop_back();
        spaceNext_ = true;
    }
    return std::nullopt;
}

bool Macros::nextIsOpen(Frames& frames) const {
    const auto unread = std::find_if(frames.rbegin(), frames.rend(), [](const Frame& frame) { return frame.at < frame.tokens.size(); });
    return unread != frames.rend() && unread->tokens[unread->at].is('(');
}

std::optional<Macros::Arguments> Macros::collect(Frames& frames, const Macro& macro, const Token& call) {
    Arguments arguments(1);
    next(frames); // the opening bracket
    for (int depth = 1; depth > 0;) {
        const std::optional<Token> token = next(frames);
        if (!token) {
            fail(1009, call, fmt::format("the call of macro '{}' is never closed", call.text));
            return std::nullopt;
        }
        depth += token->is('(') ? 1 : token->is(')') ? -1 : 0;
        if (depth == 1 && token->is(',')) {
            arguments.emplace_back();
        } else if (depth > 0) {
            arguments.back().push_back(*token);
        }
        if (++produced_ > kMostTokens) { // nested calls copy their arguments once for each level
            tooMany(call);
            return std::nullopt;
        }
    }
    if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
    if (arguments.size() == macro.parameters.size()) return arguments;
    fail(1009, call, fmt::format("macro '{}' takes {} arguments, not {}", call.text, macro.parameters.size(), arguments.size()));
    return std::nullopt;
}

/// The texts side by side, read again: one token, several (`a##.##b`) or, of two strings, the two.
void Macros::paste(std::vector<Token>& result, const Token& right) {
    if (result.empty()) return result.push_back(right);
    const Token left = result.back();
    result.pop_back();
    const std::string_view text = sources_.keep(std::string(left.text) + std::string(right.text));
    std::vector<Token> tokens = tokensOf(sources_, text, left);
    if (!tokens.empty()) tokens.front().space = left.space;
    result.insert(result.end(), tokens.begin(), tokens.end());
}

void Macros::appendArgument(std::vector<Token>& result, const std::vector<Token>& argument, bool pasted) {
    for (std::size_t i = 0; i < argument.size(); ++i) {
        if (i == 0 && pasted) {
            paste(result, argument[0]);
            continue;
        }
        result.push_back(argument[i]);
        if (i == 0) result.back().space = true;
    }
}

Token Macros::stringified(const std::vector<Token>& argument, const Token& call) {
    std::string text = "\"";
    for (const Token& token : argument) {
        if (token.space && text.size() > 1) text += ' ';
        for (const char c : token.text) {
            if (token.kind == TokenKind::String && (c == '"' || c == '\\')) text += '\\';
            text += c;
        }
    }
    Token token = call;
    token.kind = TokenKind::String;
    token.text = sources_.keep(text + '"');
    return token;
}

std::optional<std::vector<Token>> Macros::substitute(const Macro& macro, const Arguments& arguments, const Token& call) {
    std::vector<Token> result;
    std::vector<std::optional<std::vector<Token>>> expanded(arguments.size());
    bool pasteNext = false;
    bool spaceAfter = false;
    for (std::size_t i = 0; i < macro.body.size(); ++i) {
        if (isPaste(macro.body, i)) {
            pasteNext = true;
            ++i;
            continue;
        }
        Token token = macro.body[i];
        place(token, call);
        token.space = token.space || spaceAfter;
        spaceAfter = false;
        const bool hash = macro.isFunction && token.is('#') && i + 1 < macro.body.size();
        if (hash && parameterIndex(macro, macro.body[i + 1]) < arguments.size()) {
            // Microsoft's compiler expands the argument first, C does not: the strings of an effect are what its own host sees.
            const std::size_t p = parameterIndex(macro, macro.body[++i]);
            if (!expanded[p] && !expand(arguments[p], expanded[p].emplace())) return std::nullopt;
            result.push_back(stringified(*expanded[p], call));
        } else if (const std::size_t p = parameterIndex(macro, token); p < arguments.size()) {
            const bool raw = pasteNext || isPaste(macro.body, i + 1);
            if (!raw && !expanded[p] && !expand(arguments[p], expanded[p].emplace())) return std::nullopt;
            appendArgument(result, raw ? arguments[p] : *expanded[p], pasteNext);
            spaceAfter = true;
        } else if (!pasteNext) {
            result.push_back(token);
        } else {
            paste(result, token);
        }
        pasteNext = false;
        if (produced_ + result.size() > kMostTokens) {
            tooMany(call);
            return std::nullopt;
        }
    }
    produced_ += result.size();
    return result;
}

} // namespace tegument
