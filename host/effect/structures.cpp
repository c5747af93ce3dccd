// Structures: what stands between their braces, and the globals that have such a type.

#include "host/effect/parser.h"
#include "host/effect/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument {

namespace {

constexpr std::array<std::string_view, 10> kMemberModifiers{"row_major", "column_major",  "nointerpolation", "linear",  "centroid",
                                                            "sample",    "noperspective", "const",           "uniform", "unsigned"};

bool isMemberModifier(const Token& token, const Token& next) {
    return next.kind == TokenKind::Word && std::ranges::find(kMemberModifiers, token.text) != kMemberModifiers.end();
}

} // namespace

/// `float4 a : COLOR0, b[2];`, or a method, which has no value.
bool Parser::member(std::vector<TypeMember>& list) {
    while (isMemberModifier(peek(), peek(1)))
        take();
    if (peek().is("struct") && peek(1).kind == TokenKind::Word) take();
    const std::optional<Type> type = this->type();
    if (!type) return false;
    do {
        Token name;
        if (!expectName(name, "a name")) return false;
        if (peek().is('(')) return function(name);
        TypeMember member{.name = std::string(name.text), .type = *type};
        if (!arraySize(member.type)) return false;
        while (accept(':'))
            if (take().kind != TokenKind::Word || (peek().is('(') && !skipBalanced())) return false;
        Annotations ignored;
        if (peek().is('<') && !annotations(ignored)) return false;
        if (peek().is('=') && !skipValue()) return false;
        list.push_back(std::move(member));
    } while (accept(','));
    return accept(';');
}

/// Microsoft's compiler knows what we do not: what cannot be read here is no error, and the structure has no members.
std::shared_ptr<const std::vector<TypeMember>> Parser::members() {
    const std::size_t first = at_;
    const std::size_t errors = result_.errors.size();
    const std::size_t blanks = result_.blanks.size();
    take(); // '{'
    std::vector<TypeMember> list;
    bool good = true;
    while (good && !peek().is('}')) {
        if (!accept(';')) good = !atEnd() && member(list);
    }
    result_.errors.resize(std::min(errors, result_.errors.size()));
    if (good) {
        take();
        return std::make_shared<const std::vector<TypeMember>>(std::move(list));
    }
    result_.blanks.resize(blanks);
    at_ = first;
    if (!skipBalanced()) at_ = first + 1;
    return nullptr;
}

/// `struct Name { ... };`, `struct { ... } gLamp[2] <...> = { ... };`, `struct Name gLamp;`
bool Parser::structure(std::size_t start, const Modifiers& modifiers) {
    const Token keyword = take();
    acceptWord("class"); // enum class
    const Token name = peek().kind == TokenKind::Word ? take() : Token{};
    const bool hasMembers = keyword.is("struct") || keyword.is("class");
    while (!atEnd() && (peek().is(':') || peek().is(',') || (peek().kind == TokenKind::Word && !hasMembers)))
        take(), take(); // of which it is a kind
    Type type{.base = BaseType::Other, .name = std::string(name.text)};
    if (peek().is('{')) {
        if (hasMembers) type.members = members();
        if (!hasMembers && !skipBalanced()) return false;
        if (type.members) type.base = BaseType::Struct;
        if (!name.text.empty()) structures_[type.name] = type.members;
        if (accept(';')) return true;
    } else {
        if (accept(';')) { // declared only
            structures_.try_emplace(type.name, nullptr);
            return true;
        }
        type = namedType(name.text).value_or(type);
    }
    return declarators(start, keyword, type, modifiers);
}

} // namespace tegument
