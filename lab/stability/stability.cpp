#include "lab/stability/stability.h"

#include "host/support/text.h"
#include "lab/stability/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::bench {

namespace {

struct Part {
    const char* name;
    const char* title;
    Result<void> (*measure)(const stability::Context&);
};

constexpr std::array kParts = {
    Part{"finite", "Values that are not finite", stability::measureFinite},
    Part{"roughness", "Grazing angles and m near 0", stability::measureRoughness},
    Part{"scale", "Distances from 1e-4 to 1e6 mm", stability::measureScale},
    Part{"shadow", "Shadow acne and peter-panning against the tolerance", stability::measureShadow},
    Part{"charts", "Degenerate texture coordinates, huge and tiny stretch", stability::measureCharts},
    Part{"formats", "Half against full float targets", stability::measureFormats},
    Part{"compilers", "DXC against glslang", stability::measureCompilers},
    Part{"devices", "Device against device", stability::measureDevices},
};

std::string cell(const StabilityRow& row) {
    return row.limit ? fmt::format("{:.2g} | {:.2g}", row.value, *row.limit) : fmt::format("{:.2g} | -", row.value);
}

} // namespace

bool StabilityRow::pass() const {
    return notFinite == 0 && std::isfinite(value) && (!limit || value <= *limit);
}

bool StabilityReport::pass() const {
    return !rows.empty() && std::ranges::all_of(rows, &StabilityRow::pass);
}

const std::vector<std::string>& stabilityParts() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        all.reserve(kParts.size());
        for (const Part& part : kParts)
            all.emplace_back(part.name);
        return all;
    }();
    return names;
}

Result<StabilityReport> measureStability(gpu::Device& device, const StabilityOptions& options) {
    const auto& known = stabilityParts();
    for (const std::string& part : options.parts)
        if (std::ranges::find(known, part) == known.end())
            return usageError(8080, fmt::format("the stability report has no part '{}'", part),
                              fmt::format("{} known: {}", didYouMean(part, known), fmt::join(known, ", ")));
    StabilityReport report{.device = device.info().name,
                           .driver = device.info().driver,
                           .compiler = compilerName(options.compiler),
                           .size = options.size,
                           .rows = {}};
    const stability::Context context{device, options, report};
    for (const Part& part : kParts) {
        if (!options.parts.empty() && std::ranges::find(options.parts, part.name) == options.parts.end()) continue;
        const std::size_t first = report.rows.size();
        if (const auto measured = part.measure(context); !measured) return measured.error();
        for (std::size_t i = first; i < report.rows.size(); ++i)
            report.rows[i].part = part.name;
    }
    if (report.rows.empty() && report.notes.empty())
        return usageError(8081, fmt::format("no effect in {} that these parts of the stability report draw", options.effects.string()),
                          "--module takes names of effects, Main for Main.fx; --part shadow draws ShadowMap alone");
    return report;
}

std::string stabilityMarkdown(const StabilityReport& report) {
    std::string text =
        fmt::format("{}, driver {}, {}, maps of {} x {}\n\n", report.device, report.driver, report.compiler, report.size, report.size);
    for (const Part& part : kParts) {
        bool begun = false;
        for (const StabilityRow& row : report.rows) {
            if (row.part != part.name) continue;
            if (!begun)
                text += fmt::format("## {}\n\n| module | hard case | figure | value | limit | not finite | caused by |\n"
                                    "|---|---|---|---|---|---|---|\n",
                                    part.title);
            begun = true;
            text +=
                fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.module, row.hardCase, row.figure, cell(row), row.notFinite, row.cause);
        }
        if (begun) text += "\n";
    }
    for (const std::string& note : report.notes)
        text += fmt::format("* {}\n", note);
    return text;
}

} // namespace tegument::bench
