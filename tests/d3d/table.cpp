// d3d_table: the drawings' distances as the table of docs/design/direct3d.md. Run it after the tests of label d3d.

#include "tests/d3d/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace tegument::test {
namespace {

struct Worst {
    double largest = 0;
    std::size_t beyond = 0;
};

std::map<Kind, Worst> worstOf(const Case& drawn, Engine engine) {
    std::map<Kind, Worst> worst;
    for (const DrawnTarget& target : targetsOf(drawn)) {
        if (!readable(engine, target)) continue;
        const auto found = distance(drawn, engine, target);
        if (!found) continue;
        Worst& kind = worst[target.kind];
        kind.largest = std::max(kind.largest, found->largest);
        kind.beyond = std::max(kind.beyond, found->beyond);
    }
    return worst;
}

/// Largest difference; in parentheses the pixels beyond the tolerance, where there are any.
std::string cell(const std::map<Kind, Worst>& worst, Kind kind) {
    const auto found = worst.find(kind);
    if (found == worst.end()) return "-";
    const std::string number = found->second.largest == 0 ? "0" : fmt::format("{:.1e}", found->second.largest);
    return found->second.beyond == 0 ? number : fmt::format("{} ({})", number, found->second.beyond);
}

void print() {
    fmt::print("| technique | engine | depth | float | half | picture |\n|---|---|---|---|---|---|\n");
    for (const Case& drawn : allCases())
        for (const Engine engine : kDirect3D) {
            if (!drawnBy(drawn, engine)) continue;
            const auto worst = worstOf(drawn, engine);
            fmt::print("| {} {}{} | {} | {} | {} | {} | {} |\n", drawn.effect.stem().string(), drawn.technique,
                       drawn.mapBits == 16 ? "" : ", 32-bit maps", engineName(engine).substr(3), cell(worst, Kind::Depth),
                       cell(worst, Kind::Float), cell(worst, Kind::Half), cell(worst, Kind::Picture));
        }
    fmt::print("\nKnown differences, in the same units:\n\n");
    for (const Exception& exception : exceptions())
        fmt::print("* {}, {}..., {}...: up to {:g} but for a few pixels, beyond the tolerance at most {:.3g} % of them: {}.\n",
                   engineName(exception.engine), exception.cases, exception.targets, exception.largest, 100 * exception.beyond,
                   exception.reason);
}

} // namespace
} // namespace tegument::test

int main() {
    tegument::test::print();
}
