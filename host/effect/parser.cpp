#include "host/effect/parser.h"

#include "host/effect/types.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument {

namespace {

constexpr std::string_view kReservedWords =
    " AppendStructuredBuffer asm_fragment BlendState break Buffer ByteAddressBuffer case catch cbuffer centroid class "
    "column_major compile compile_fragment CompileShader ComputeShader const const_cast ConsumeStructuredBuffer continue "
    "default delete DepthStencilState DepthStencilView discard do DomainShader dynamic_cast else enum explicit export extern "
    "false for friend fxgroup GeometryShader goto groupshared HullShader if in inline inout InputPatch interface line lineadj "
    "linear LineStream matrix mutable namespace new nointerpolation noperspective NULL operator out OutputPatch packoffset "
    "pixelfragment PixelShader pixelshader point PointStream private protected public RasterizerState register "
    "reinterpret_cast RenderTargetView return row_major RWBuffer RWByteAddressBuffer RWStructuredBuffer RWTexture1D "
    "RWTexture1DArray RWTexture2D RWTexture2DArray RWTexture3D sampler sampler1D sampler2D sampler3D sampler_state "
    "SamplerComparisonState samplerCUBE SamplerState shared signed sizeof snorm stateblock stateblock_state static "
    "static_cast String string struct StructuredBuffer switch tbuffer technique10 technique11 template texture texture1D "
    "texture2D texture3D textureCUBE throw triangle triangleadj TriangleStream true try typedef typename uniform union unorm "
    "unsigned using vector vertexfragment VertexShader vertexshader virtual void volatile while ";

/// Texture1D, Texture2DMSArray ...
bool isTextureType(std::string_view word) {
    const auto type = word.starts_with("Texture") && word != "Texture" && word != "TextureBuffer" ? builtInType(word) : std::nullopt;
    return type && type->name == word;
}

/// Neither a semantic nor the name of a pass or an annotation.
bool isReserved(std::string_view word) {
    for (const std::string_view any : {"asm", "pass", "technique"}) // the only ones whose case does not count
        if (equalsIgnoreCase(word, any)) return true;
    return kReservedWords.find(' ' + std::string(word) + ' ') != std::string_view::npos || isTextureType(word);
}

/// `float`, `half3`, `int4x4`: also no name of a parameter or a technique.
bool isNumericType(std::string_view word) {
    const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (word.ends_with("_t") || std::ranges::any_of(word, isUpper)) return false; // float16_t, DWORD: names like any other there
    const auto type = builtInType(word);
    return type && type->isNumeric();
}

constexpr std::size_t kMostErrors = 20;

char closing(char opening) {
    return opening == '(' ? ')' : opening == '[' ? ']' : '}';
}

} // namespace

Parser::Parser(const Sources& sources, const std::vector<Token>& tokens, bool lenient)
    : sources_(sources), tokens_(tokens), lenient_(lenient) {
    if (!tokens.empty()) end_ = tokens.back();
    end_.kind = TokenKind::Newline;
    end_.text = {};
}

const Token& Parser::peek(std::size_t ahead) const {
    return at_ + ahead < tokens_.size() ? tokens_[at_ + ahead] : end_;
}

const Token& Parser::take() {
    const Token& token = peek();
    if (!atEnd()) ++at_;
    return token;
}

bool Parser::accept(char sign) {
    if (!peek().is(sign)) return false;
    ++at_;
    return true;
}

bool Parser::isWord(std::string_view word) const {
    return peek().kind == TokenKind::Word && equalsIgnoreCase(peek().text, word);
}

bool Parser::acceptWord(std::string_view word) {
    if (!isWord(word)) return false;
    ++at_;
    return true;
}

bool Parser::expect(char sign, std::string_view where) {
    return accept(sign) || unexpected(fmt::format("'{}' {}", sign, where));
}

bool Parser::expectName(Token& name, std::string_view what) {
    if (peek().kind != TokenKind::Word) return unexpected(what);
    name = take();
    return true;
}

bool Parser::nameable(const Token& name, std::string_view what, bool types) {
    if (!isReserved(name.text) && !(types && isNumericType(name.text))) return true;
    return refuse(1101, name, fmt::format("expected {}, found '{}', a word of the language", what, name.text),
                  fmt::format("'my_{}' would be a name", name.text));
}

bool Parser::fail(int code, const Token& at, std::string text, std::string hint) {
    if (!full()) result_.errors.push_back({.code = code, .at = position(at), .text = std::move(text), .hint = std::move(hint)});
    return false;
}

bool Parser::refuse(int code, const Token& at, std::string text, std::string hint) {
    if (!lenient_) return fail(code, at, std::move(text), std::move(hint));
    warn(code, position(at), std::move(text), std::move(hint));
    return true;
}

void Parser::soften(std::size_t firstError) {
    if (!lenient_ || firstError >= result_.errors.size()) return;
    for (auto error = result_.errors.begin() + static_cast<std::ptrdiff_t>(firstError); error != result_.errors.end(); ++error)
        warn(error->code, error->at, error->text, error->hint);
    result_.errors.resize(firstError);
}

bool Parser::unexpected(std::string_view expected) {
    const std::string found = atEnd() ? "the end of the file" : fmt::format("'{}'", peek().text);
    return fail(1101, peek(), fmt::format("expected {}, found {}", expected, found));
}

void Parser::warn(int code, const SourcePosition& at, std::string text, std::string hint) {
    result_.effect.warnings.push_back(inputWarning(code, at, std::move(text), std::move(hint)));
}

bool Parser::full() const {
    return result_.errors.size() >= kMostErrors;
}

bool Parser::skipBalanced() {
    const Token opened = peek();
    const char open = opened.text[0];
    int depth = 0;
    do {
        if (atEnd()) return fail(1102, opened, fmt::format("this '{}' is never closed", open));
        const Token& token = take();
        depth += token.is(open) ? 1 : token.is(closing(open)) ? -1 : 0;
    } while (depth > 0);
    return true;
}

bool Parser::skipAngles() {
    const Token opened = peek();
    int depth = 0;
    do {
        if (atEnd() || peek().is(';') || peek().is('{')) return fail(1102, opened, "this '<' is never closed");
        const Token& token = take();
        depth += token.is('<') ? 1 : token.is('>') ? -1 : 0;
    } while (depth > 0);
    return true;
}

void Parser::recover() {
    while (!atEnd() && !peek().is('}')) {
        if (accept(';')) return;
        if (peek().is('{')) {
            skipBalanced();
            accept(';');
            return;
        }
        take();
    }
}

bool Parser::skipStatement() {
    while (!atEnd() && !peek().is(';') && !peek().is('}')) {
        if (peek().is('{') || peek().is('(') || peek().is('[')) {
            if (!skipBalanced()) return false;
        } else {
            take();
        }
    }
    return expect(';', "at the end of the declaration");
}

Parsed Parser::run() {
    while (!atEnd() && !full()) {
        const std::size_t before = at_;
        if (!topLevel()) recover();
        if (at_ == before) {
            unexpected("a declaration");
            take();
        }
    }
    return std::move(result_);
}

bool Parser::topLevel() {
    if (accept(';')) return true;
    if (peek().is('[')) return skipBalanced();
    if (peek().kind == TokenKind::BadString) return unexpected("a declaration");
    for (const std::string_view word : {"technique", "technique10", "technique11"})
        if (isWord(word)) return technique();
    if (isWord("fxgroup")) return group();
    if (peek().is("shared") && (peek(1).is("cbuffer") || peek(1).is("tbuffer"))) { // of a pool of effects: here one effect is all
        blankFrom(at_);
        take();
        result_.blanks.back().last = at_;
    }
    if (isWord("cbuffer") || isWord("tbuffer")) return constantBuffer();
    if (peek().is("typedef")) return alias();
    if (isWord("stateblock") && peek(1).kind == TokenKind::Word) return stateBlockObject(at_);
    if (peek().is("using")) return skipStatement();
    if (peek().is("namespace")) {
        take();
        while (peek().kind == TokenKind::Word || peek().is(':'))
            take();
        return peek().is('{') ? skipBalanced() : unexpected("'{' of the namespace");
    }
    if (peek().is("template")) {
        take();
        return peek().is('<') ? skipAngles() : unexpected("'<' of the template");
    }
    return declaration();
}

} // namespace tegument
