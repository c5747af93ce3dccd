// A page with a section of every kind, from formulas, into the file that is named.

#include "tools/report/against.h"
#include "tools/report/plane.h"
#include "tools/report/report.h"

#include <cmath>
#include <cstdio>

using namespace tegument;
using report::Json;

namespace {

constexpr int kSide = 48;
constexpr double kError = 0.02; // of one pixel, (30, 20); elsewhere there is a hundredth of it

Image ball(double error) {
    Image image{.width = kSide, .height = kSide, .channels = 3};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (const double tint : {0.9, 0.6, 0.45}) {
                const double radius = std::hypot(x - 23.5, y - 23.5) / 23;
                const double light = radius < 1 ? std::sqrt(1 - radius * radius) : 0;
                const double off = x == 30 && y == 20 ? error : error / 100 * std::sin(x);
                image.pixels.push_back(static_cast<float>(light > 0 ? tint * light + off : 0));
            }
    return image;
}

Json pictures() {
    const Image rendered = ball(kError);
    const Image reference = ball(0);
    Image difference = reference;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i)
        difference.pixels[i] = std::abs(rendered.pixels[i] - reference.pixels[i]);
    Json subject{{"name", "ball"}, {"group", "formulas"}, {"worst", kError}};
    subject["levels"] = {{"scale", {1, 1, 1, 1}}, {"offset", {0, 0, 0, 0}}, {"channel", 0}, {"toneMap", true}, {"encode", true}};
    subject["rendered"] = report::plane(rendered);
    subject["reference"] = report::plane(reference);
    subject["difference"] = report::plane(difference);
    Json other = subject;
    other["name"] = "the same again";
    return {{"kind", "pictures"}, {"title", "Pictures"}, {"note", ""}, {"subjects", {subject, other}}};
}

Json point(const char* name, const char* scene, double ms, double error) {
    return {{"name", name},
            {"group", ms < 2 ? "fast" : "slow"},
            {"mark", "corrected"},
            {"facets", {{"scene", scene}}},
            {"values", {{"ms", ms}, {"rel_l2", error}, {"p99", 2 * error}}},
            {"details", {"1 MiB"}}};
}

Json scatter() {
    Json section{{"kind", "scatter"}, {"title", "Time against error"}, {"note", ""}, {"oneOf", {"scene"}}};
    section["axes"]["x"] = {{{"key", "ms"}, {"title", "milliseconds"}}};
    section["axes"]["y"] = {{{"key", "rel_l2"}, {"title", "relative L2"}}, {{"key", "p99"}, {"title", "99th percentile"}}};
    section["points"] = {point("Quick", "head", 0.5, 0.2), point("Middle", "head", 2, 0.05), point("Slow", "head", 8, 0.01),
                         point("Beaten", "head", 9, 0.1), point("Quick", "sphere", 0.4, 0.1)};
    return section;
}

Json timeline() {
    const Json parts = {{{"name", "Shadow"}, {"value", 0.5}}, {{"name", "Blur"}, {"value", 1.5}}};
    return {{"kind", "timeline"},
            {"title", "Passes"},
            {"note", ""},
            {"unit", "ms"},
            {"rows", {{{"name", "one"}, {"parts", parts}}, {{"name", "two"}, {"parts", parts}}, {{"name", "three"}, {"parts", parts}}}}};
}

Json figures() {
    Json rows = Json::array();
    for (int i = 0; i < 12; ++i)
        rows.push_back({i == 7 ? "fail" : "pass", "row " + std::to_string(i), i == 3 ? Json(nullptr) : Json(i * 0.37 - 1), i / 8.0,
                        "a<b>&\"c\"</script>"});
    return report::table("Figures", "A note.",
                         {{"", "verdict"}, {"name"}, {"value", "number", "what it is"}, {"share", "share"}, {"text", "code"}},
                         std::move(rows));
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto changes =
        report::compareRuns({{.subject = "Blur", .name = "ms", .value = 1}}, {{.subject = "Blur", .name = "ms", .value = 2}}, 0.05);
    const report::Page page{.title = "sample",
                            .summary = "every kind of section </title>",
                            .verdict = "fail",
                            .facts = {{"device", "none"}},
                            .sections = {report::changesSection(changes, "old.json", 0.05), pictures(), scatter(), timeline(), figures(),
                                         report::notes("Notes", {"One.", "Two </script> & <i>three</i>."})}};
    const auto written = report::write(argv[1], page);
    if (!written) std::fputs(format(written.error()).c_str(), stderr);
    return written ? 0 : 1;
}
