#include "tools/direct3d/sm3.h"

#include "host/spirv/scan.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

namespace tegument {

namespace {

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    while (!line.empty()) {
        const std::size_t start = line.find_first_not_of(" \t,");
        if (start == std::string_view::npos) break;
        line.remove_prefix(start);
        const std::size_t end = std::min(line.find_first_of(" \t,"), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
    return words;
}

/// No register of shader model 3 has a number near it: what is beyond it is no listing of that compiler, which dies now and then.
constexpr int kMostRegisters = 65536;

std::optional<int> countOf(std::string_view word) {
    const auto number = wholeNumber(word);
    return number && *number >= 0 && *number <= kMostRegisters ? number : std::nullopt;
}

/// 12 for "v12.xy" and file 'v'.
std::optional<int> registerOf(std::string_view word, char file) {
    if (word.empty() || word.front() != file) return {};
    return countOf(word.substr(1, word.find('.') - 1));
}

class Listing {
public:
    bool valid = false;
    Sm3Usage usage;

    void read(std::string_view line) {
        const auto words = wordsOf(line);
        if (words.empty()) return;
        if (words[0] == "vs_3_0" || words[0] == "ps_3_0") {
            valid = true;
            vertex_ = words[0] == "vs_3_0";
        } else if (words[0] == "//") {
            comment(words);
        } else if (words[0] == "def" && words.size() > 1) {
            constants(registerOf(words[1], 'c'), 1);
        } else if (words[0].starts_with("dcl") && words.size() > 1) {
            declaration(words[0], words.back());
        }
    }

    void finish() {
        usage.samplers = static_cast<int>(samplers_.size());
        usage.interpolators = static_cast<int>(interpolators_.size());
    }

private:
    /// The table of constants ("//   gWorld  c4  3") and "// approximately 12 instruction slots used".
    void comment(const std::vector<std::string_view>& words) {
        if (words.size() > 2 && words[1] == "approximately") usage.instructionSlots = countOf(words[2]).value_or(0);
        if (words.size() == 4) constants(registerOf(words[2], 'c'), countOf(words[3]).value_or(0));
    }

    void constants(std::optional<int> first, int count) {
        if (first) usage.constants = std::max(usage.constants, *first + count);
    }

    /// Interpolators are what a pixel shader reads as v#, a vertex shader writes as o# (the position is not interpolated).
    void declaration(std::string_view kind, std::string_view name) {
        if (const auto sampler = registerOf(name, 's')) samplers_.insert(*sampler);
        const auto interpolator = registerOf(name, vertex_ ? 'o' : 'v');
        const bool position = kind == "dcl_position" || kind == "dcl_position0";
        if (!interpolator || (vertex_ && position)) return;
        interpolators_.insert(*interpolator);
        if (kind.starts_with("dcl_")) varying(kind.substr(4), name);
    }

    /// "texcoord3_pp" and "v2.xyz".
    void varying(std::string_view usage_, std::string_view name) {
        std::string semantic(usage_.substr(0, usage_.find('_')));
        if (semantic.empty()) return;
        std::ranges::transform(semantic, semantic.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        if (std::isdigit(static_cast<unsigned char>(semantic.back())) == 0) semantic += '0';
        const std::size_t dot = name.find('.');
        const std::string_view mask = dot == std::string_view::npos ? "xyzw" : name.substr(dot + 1);
        int& components = usage.varyings[semantic];
        for (const char letter : mask)
            components = std::max(components, static_cast<int>(std::string_view("xyzw").find(letter) + 1)); // another letter: 0
    }

    bool vertex_ = false;
    std::set<int> samplers_;
    std::set<int> interpolators_;
};

} // namespace

std::optional<Sm3Usage> readSm3Listing(std::string_view listing) {
    Listing reader;
    forEachLine(listing, [&](std::string_view line) { reader.read(line); });
    reader.finish();
    if (!reader.valid) return {};
    return reader.usage;
}

} // namespace tegument
