#include "meshprep/adopt/columns.h"

#include "meshprep/adopt/bind.h"
#include "meshprep/adopt/spelling.h"

#include <algorithm>
#include <string_view>

namespace tegument::adopt {

namespace {

constexpr std::string_view kTranspose = "TRANSPOSE";

/// `m`, `(m)`, `(float4x4) m`, `m[0]`; "" of anything else.
std::string nameIn(const Words& words) {
    std::string name;
    for (std::size_t i = 0; i < words.size(); i = words[i].is("[") ? behindBracket(words, i) : i + 1) {
        if (words[i].is("[") || words[i].is("(") || words[i].is(")")) continue;
        if (!words[i].isName() || (!name.empty() && !shapeOf({Word{.text = name, .kind = TokenKind::Word}}))) return {};
        name = words[i].text;
    }
    return name;
}

struct Sides {
    int before = 0; // products with a projection before something else
    int behind = 0;
};

void count(const Words& words, const std::set<std::string>& projections, Sides& sides) {
    const auto projects = [&](const Words& side) {
        const std::string name = nameIn(side);
        return projections.contains(name) || matrixName(name).value_or("").find("PROJECTION") != std::string::npos;
    };
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        if (!words[i].is("mul") || !words[i + 1].is("(")) continue;
        const auto factors = splitAtCommas(words, i + 2, std::max(i + 2, behindBracket(words, i + 1) - 1));
        if (factors.size() != 2) continue;
        const bool first = projects(factors[0]);
        const bool second = projects(factors[1]);
        sides.before += first && !second ? 1 : 0;
        sides.behind += second && !first ? 1 : 0;
    }
}

} // namespace

bool multipliesColumns(const Code& code, const std::set<std::string>& projections) {
    Sides sides;
    for (const Item& item : code.items) {
        if (const auto* function = std::get_if<Function>(&item)) count(function->body, projections, sides);
        if (const auto* variable = std::get_if<Variable>(&item)) count(variable->initial, projections, sides);
    }
    return sides.before > 0 && sides.behind == 0;
}

std::string transposedSemantic(const std::string& semantic) {
    return semantic.ends_with(kTranspose) ? semantic.substr(0, semantic.size() - kTranspose.size()) : semantic + std::string(kTranspose);
}

} // namespace tegument::adopt
