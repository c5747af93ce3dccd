#include "host/effect/code_view.h"
#include "host/effect/model.h"
#include "host/effect/source.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr std::array<std::string_view, 4> kFamilies{"tex1D", "tex2D", "tex3D", "texCUBE"};
constexpr std::array<std::string_view, 5> kForms{"", "bias", "grad", "lod", "proj"};
constexpr std::array<std::string_view, 6> kTypes{"texture", "sampler1D", "sampler2D", "sampler3D", "samplerCUBE", "sampler_state"};

bool isDirect3D9(std::string_view word) {
    if (std::ranges::find(kTypes, word) != kTypes.end()) return true;
    for (const std::string_view family : kFamilies)
        if (word.starts_with(family) && std::ranges::find(kForms, word.substr(family.size())) != kForms.end()) return true;
    return false;
}

/// Follows the `#line N "file"` directives that codeView wrote.
struct Place {
    std::string file;
    int offset = 0; // of the present file's lines from the text's

    void update(const Token& number, const Token& name) {
        int line = 0;
        std::from_chars(number.text.data(), number.text.data() + number.text.size(), line);
        offset = line - (number.line + 1);
        file = name.text.substr(1, name.text.size() - 2);
    }
};

} // namespace

std::optional<Diagnostic> direct3D9Intrinsic(const Effect& effect) {
    Sources sources;
    const LexResult lexed = lex(sources, sources.add("code", std::make_shared<const std::string>(effect.code)));
    Place place;
    const std::vector<Token>& tokens = lexed.tokens;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].is('#') && i + 3 < tokens.size() && tokens[i + 1].is("line") && tokens[i + 3].kind == TokenKind::String)
            place.update(tokens[i + 2], tokens[i + 3]);
        if (tokens[i].kind != TokenKind::Word || !isDirect3D9(tokens[i].text)) continue;
        return inputWarning(2023, {place.file, tokens[i].line + place.offset, tokens[i].column, std::nullopt},
                            fmt::format("not checked: Direct3D 9 intrinsic '{}'", tokens[i].text),
                            "SPIR-V targets need the spelling of Direct3D 10 or hlsl/platform.fxh");
    }
    return std::nullopt;
}

} // namespace tegument
