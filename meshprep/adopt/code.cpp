#include "meshprep/adopt/code.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace tegument::adopt {

namespace {

constexpr std::array<std::string_view, 25> kModifiers{
    "static",      "uniform",         "extern", "shared",   "const",         "volatile", "row_major", "column_major", "inline",
    "precise",     "nointerpolation", "linear", "centroid", "noperspective", "in",       "out",       "inout",        "sample",
    "groupshared", "unsigned",        "snorm",  "unorm",    "triangle",      "point",    "line"};

bool isModifier(const Word& word) {
    return word.isName() && std::ranges::find(kModifiers, word.text) != kModifiers.end();
}

char closing(char opening) {
    return opening == '(' ? ')' : opening == '[' ? ']' : '}';
}

/// Tokens with the places that the `#line` directives give; directives apart.
struct Lexed {
    Words words;
    std::vector<std::string> files;
    std::vector<std::string> pragmas;
};

class Reader {
public:
    explicit Reader(std::string_view text) : text_(std::make_shared<const std::string>(text)) {}

    Lexed run() {
        const LexResult lexed = lex(sources_, sources_.add("code", text_));
        const std::vector<Token>& tokens = lexed.tokens;
        bool newLine = true;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (newLine && tokens[i].is('#')) {
                const std::size_t first = i;
                while (i < tokens.size() && tokens[i].kind != TokenKind::Newline)
                    ++i;
                directive({tokens.data() + first, i - first});
                continue;
            }
            newLine = tokens[i].kind == TokenKind::Newline;
            if (!newLine)
                result_.words.push_back({.text = std::string(tokens[i].text),
                                         .kind = tokens[i].kind,
                                         .space = tokens[i].space,
                                         .file = file_,
                                         .line = tokens[i].line + offset_});
        }
        return std::move(result_);
    }

private:
    void directive(std::span<const Token> line) {
        if (line.size() >= 4 && line[1].is("line") && line[3].kind == TokenKind::String) {
            int number = 0;
            std::from_chars(line[2].text.data(), line[2].text.data() + line[2].text.size(), number);
            offset_ = number - (line[0].line + 1);
            result_.files.emplace_back(line[3].text.substr(1, line[3].text.size() - 2));
            file_ = static_cast<int>(result_.files.size()) - 1;
        } else if (line.size() >= 3 && line[1].is("pragma") && line[2].is("pack_matrix")) {
            std::string text = "#";
            for (std::size_t i = 1; i < line.size(); ++i)
                text += std::string(line[i].text) + (i == 1 ? " " : "");
            result_.pragmas.push_back(text);
        }
    }

    Sources sources_;
    std::shared_ptr<const std::string> text_;
    Lexed result_;
    int file_ = 0;
    int offset_ = 0;
};

class CodeParser {
public:
    explicit CodeParser(Lexed lexed) : words_(std::move(lexed.words)) {
        code_.files = std::move(lexed.files);
        code_.pragmas = std::move(lexed.pragmas);
        if (code_.files.empty()) code_.files.emplace_back("effect");
    }

    Code run() {
        while (!atEnd()) {
            const std::size_t before = at_;
            if (peek().is(";") || peek().is("}")) {
                ++at_;
                continue;
            }
            if (!item()) {
                at_ = before;
                other();
            }
            if (at_ == before) ++at_;
        }
        return std::move(code_);
    }

private:
    [[nodiscard]] bool atEnd() const { return at_ >= words_.size(); }
    [[nodiscard]] const Word& peek(std::size_t ahead = 0) const {
        static const Word kEnd;
        return at_ + ahead < words_.size() ? words_[at_ + ahead] : kEnd;
    }
    Word take() { return atEnd() ? Word{} : words_[at_++]; }
    bool accept(std::string_view sign) {
        if (!peek().is(sign)) return false;
        ++at_;
        return true;
    }
    Words bracket() {
        const std::size_t first = at_;
        at_ = behindBracket(words_, at_);
        return {words_.begin() + static_cast<std::ptrdiff_t>(first), words_.begin() + static_cast<std::ptrdiff_t>(at_)};
    }
    Words until(std::initializer_list<std::string_view> stops) {
        Words result;
        while (!atEnd() && std::ranges::find(stops, std::string_view(peek().text)) == stops.end()) {
            if (peek().is("{") || peek().is("(") || peek().is("[")) {
                const Words inside = bracket();
                result.insert(result.end(), inside.begin(), inside.end());
            } else {
                result.push_back(take());
            }
        }
        return result;
    }

    void add(const std::string& name, Item item) {
        if (!name.empty()) code_.byName[name].push_back(code_.items.size());
        code_.items.push_back(std::move(item));
    }

    void other() {
        Words words = until({";", "}", "{"});
        if (peek().is("{")) { // a method's body: what follows is a declaration of its own
            const Words inside = bracket();
            words.insert(words.end(), inside.begin(), inside.end());
        }
        if (peek().is(";")) words.push_back(take());
        add({}, Other{.words = std::move(words)});
    }

    bool item() {
        if (peek().is("typedef")) return alias();
        if (peek().is("using") || peek().is("template") || peek().is("namespace") || peek().is("enum") || peek().is("interface"))
            return copied();
        if (peek().is("cbuffer") || peek().is("tbuffer")) return buffer();
        Words attributes;
        while (peek().is("[")) {
            const Words attribute = bracket();
            attributes.insert(attributes.end(), attribute.begin(), attribute.end());
        }
        const Words modifiers = this->modifiers();
        if (peek().is("struct") || peek().is("class")) return structure(modifiers);
        const Words type = this->type();
        if (type.empty()) return false;
        return declarators(modifiers, type, attributes);
    }

    bool copied() {
        const std::string name = peek(1).isName() ? peek(1).text : std::string();
        const bool block = peek().is("namespace") || peek().is("interface") || peek().is("enum");
        Words words = until({block ? "{" : ";"});
        if (block && peek().is("{")) {
            const Words inside = bracket();
            words.insert(words.end(), inside.begin(), inside.end());
        }
        if (peek().is(";")) words.push_back(take());
        add(name, Other{.name = name, .words = std::move(words)});
        return true;
    }

    bool alias() {
        if (peek(1).is("struct")) { // typedef struct { ... } Name;
            take();
            take();
            const std::string tag = peek().isName() ? take().text : std::string();
            if (!peek().is("{")) return false;
            Structure made{.members = members(bracket())};
            made.name = peek().isName() ? take().text : tag;
            accept(";");
            add(made.name, made);
            return true;
        }
        Words words = until({";"});
        words.push_back(take());
        std::string name;
        for (std::size_t i = 0; i + 1 < words.size(); ++i)
            if (words[i].isName() && !words[i].is("typedef")) name = words[i].is("]") ? name : words[i].text;
        add(name, Other{.name = name, .words = std::move(words)});
        return true;
    }

    Words modifiers() {
        Words list;
        // Some of these were names in Direct3D 9: `float4 sample = ...`.
        while (isModifier(peek()) && peek(1).isName()) {
            const bool second = !list.empty() && ((list.back().is("in") && peek().is("out")) || (list.back().is("out") && peek().is("in")));
            const Word word = take();
            if (second) list.back().text = "inout";
            if (!second) list.push_back(word);
        }
        return list;
    }

    Words type() {
        Words list;
        if (!peek().isName()) return list;
        list.push_back(take());
        while (peek().is(":") && peek(1).is(":"))
            for (int i = 0; i < 3; ++i)
                list.push_back(take());
        if (!peek().is("<")) return list;
        int depth = 0;
        do {
            depth += peek().is("<") ? 1 : peek().is(">") ? -1 : 0;
            list.push_back(take());
        } while (depth > 0 && !atEnd());
        return list;
    }

    /// `[4] : SEMANTIC : register(c0) = value`.
    void tail(Variable& variable, std::initializer_list<std::string_view> stops) {
        while (peek().is("[")) {
            const Words array = bracket();
            variable.array.insert(variable.array.end(), array.begin(), array.end());
        }
        while (accept(":")) {
            const Word name = take();
            if (peek().is("("))
                bracket();
            else if (variable.semantic.empty())
                variable.semantic = name.text;
        }
        if (accept("=")) variable.initial = until(stops);
    }

    bool structure(const Words& modifiers) {
        const std::size_t first = at_;
        take();
        const Word name = peek().isName()
                              ? take()
                              : Word{.text = fmt::format("tg_anonymous{}", code_.items.size()), .kind = TokenKind::Word, .space = true};
        if (peek().is(";")) return accept(";"); // declared only: the definition follows
        if (!peek().is("{") && !peek().is(":")) return declarators(modifiers, {name}, {});
        const bool derived = peek().is(":");
        until({"{"});
        if (!peek().is("{")) return false;
        Structure made{.name = name.text};
        const Words inside = bracket();
        made.members = members(inside);
        const bool methods = std::ranges::any_of(made.members, [](const Variable& member) { return member.name.text.empty(); });
        if (methods || derived) {
            made.members.clear();
            made.whole.assign(words_.begin() + static_cast<std::ptrdiff_t>(first), words_.begin() + static_cast<std::ptrdiff_t>(at_));
        }
        add(made.name, made);
        if (accept(";") || atEnd()) return true;
        return declarators(modifiers, {name}, {});
    }

    /// A method leaves a member without a name, and so does what is not understood.
    static std::vector<Variable> members(Words block) {
        CodeParser inside({.words = {block.begin() + 1, block.end() - (block.size() > 1 ? 1 : 0)}});
        std::vector<Variable> list;
        while (!inside.atEnd()) {
            const std::size_t before = inside.at_;
            if (inside.accept(";")) continue;
            const Words modifiers = inside.modifiers();
            const Words type = inside.type();
            do {
                Variable member{.modifiers = modifiers, .type = type, .name = inside.take()};
                if (inside.peek().is("(") || type.empty() || !member.name.isName()) {
                    list.push_back({.type = {Word{}}});
                    inside.until({";", "}"});
                    break;
                }
                inside.tail(member, {";", ","});
                list.push_back(std::move(member));
            } while (inside.accept(","));
            if (inside.at_ == before) ++inside.at_;
        }
        return list;
    }

    /// Its members are globals to the code, and to this host: they may be structures, have values, be written.
    bool buffer() {
        until({"{", ";"});
        if (!peek().is("{")) return false;
        for (Variable& member : members(bracket())) {
            if (member.name.text.empty()) continue;
            const std::string name = member.name.text;
            add(name, std::move(member));
        }
        return true;
    }

    bool declarators(const Words& modifiers, const Words& type, const Words& attributes) {
        for (bool first = true;; first = false) {
            if (!peek().isName()) return false;
            Word name = take();
            if (peek().is(":") && peek(1).is(":")) return false; // a method's definition: copied
            if (first && peek().is("(")) return function(modifiers, type, std::move(name), attributes);
            Variable made{.modifiers = modifiers, .type = type, .name = std::move(name)};
            tail(made, {";", ","});
            add(made.name.text, made);
            if (accept(",")) continue;
            return accept(";");
        }
    }

    bool function(const Words& modifiers, const Words& type, Word name, const Words& attributes) {
        Function made{.attributes = attributes, .modifiers = modifiers, .type = type, .name = std::move(name)};
        const Words inside = bracket();
        if (inside.size() > 2)
            for (const Words& words : splitAtCommas(inside, 1, inside.size() - 1))
                if (words.size() != 1 || !words[0].is("void")) made.parameters.push_back(parameter(words));
        while (accept(":")) {
            made.semantic = take().text;
            if (peek().is("(")) bracket();
        }
        if (peek().is("{"))
            made.body = bracket();
        else if (!accept(";"))
            return false;
        add(made.name.text, made);
        return true;
    }

    static Variable parameter(const Words& words) {
        CodeParser inside({.words = words});
        Variable made{.modifiers = inside.modifiers(), .type = inside.type()};
        if (made.type.empty()) made.type.push_back(Word{});
        if (inside.peek().isName()) made.name = inside.take();
        inside.tail(made, {});
        return made;
    }

    Words words_;
    std::size_t at_ = 0;
    Code code_;
};

} // namespace

bool Variable::has(std::string_view modifier) const {
    return std::ranges::any_of(modifiers, [&](const Word& word) { return word.is(modifier); });
}

std::size_t behindBracket(const Words& words, std::size_t at) {
    std::string open;
    for (; at < words.size(); ++at) {
        const std::string& text = words[at].text;
        if (text == "{" || text == "(" || text == "[") open += closing(text[0]);
        if (!open.empty() && text.size() == 1 && text[0] == open.back()) open.pop_back();
        if (open.empty()) return at + 1;
    }
    return at;
}

std::vector<Words> splitAtCommas(const Words& words, std::size_t first, std::size_t last) {
    std::vector<Words> parts(1);
    for (std::size_t i = first; i < last;) {
        if (words[i].is(",")) {
            parts.emplace_back();
            ++i;
            continue;
        }
        const bool opens = words[i].is("{") || words[i].is("(") || words[i].is("[");
        const std::size_t end = opens ? std::min(behindBracket(words, i), last) : i + 1;
        parts.back().insert(parts.back().end(), words.begin() + static_cast<std::ptrdiff_t>(i),
                            words.begin() + static_cast<std::ptrdiff_t>(end));
        i = end;
    }
    return parts;
}

const Structure* Code::structure(std::string_view name) const {
    const auto found = byName.find(name);
    if (found == byName.end()) return nullptr;
    for (const std::size_t index : found->second)
        if (const auto* made = std::get_if<Structure>(&items[index])) return made;
    return nullptr;
}

Words Code::resolved(const Words& type) const {
    Words result = type;
    for (int i = 0; i < 8 && !result.empty(); ++i) { // typedefs of typedefs
        const auto found = byName.find(result.front().text);
        const Other* alias = nullptr;
        if (found != byName.end())
            for (const std::size_t index : found->second)
                if (const auto* made = std::get_if<Other>(&items[index]); made && !made->words.empty() && made->words[0].is("typedef"))
                    alias = made;
        if (!alias) return result;
        result.clear();
        for (std::size_t w = 1; w < alias->words.size() && !alias->words[w].is(alias->name); ++w)
            if (!isModifier(alias->words[w])) result.push_back(alias->words[w]);
    }
    return result;
}

std::vector<const Function*> Code::functions(std::string_view name) const {
    std::vector<const Function*> list;
    if (const auto found = byName.find(name); found != byName.end())
        for (const std::size_t index : found->second)
            if (const auto* made = std::get_if<Function>(&items[index]); made && !made->body.empty()) list.push_back(made);
    return list;
}

const Variable* Code::variable(std::string_view name) const {
    if (const auto found = byName.find(name); found != byName.end())
        for (const std::size_t index : found->second)
            if (const auto* made = std::get_if<Variable>(&items[index])) return made;
    return nullptr;
}

Code readCode(std::string_view text) {
    return CodeParser(Reader(text).run()).run();
}

void Printer::print(const Words& words) {
    for (const Word& word : words)
        print(word);
}

void Printer::print(const Word& word) {
    constexpr int kNear = 8; // lines bridged by line breaks
    if (word.line > 0 && (word.file != file_ || word.line != line_)) {
        const bool near = word.file == file_ && word.line > line_ && word.line - line_ <= kNear;
        if (near)
            text_.append(static_cast<std::size_t>(word.line - line_), '\n');
        else
            text_ += fmt::format("{}#line {} \"{}\"\n", text_.empty() || text_.back() == '\n' ? "" : "\n", word.line,
                                 files_[static_cast<std::size_t>(word.file)]);
        file_ = word.file;
        line_ = word.line;
    } else if (word.space && !text_.empty() && text_.back() != '\n') {
        text_ += ' ';
    }
    text_ += word.text;
}

void Printer::own(const std::string& text) {
    if (!text_.empty() && text_.back() != '\n') text_ += '\n';
    text_ += text;
    if (!text_.empty() && text_.back() != '\n') text_ += '\n';
    file_ = -1;
}

} // namespace tegument::adopt
