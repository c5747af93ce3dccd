#include "lab/app/bench_page.h"

#include "host/image/image.h"
#include "tools/report/plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::app {

namespace {

constexpr std::size_t kMostPixels = 1U << 20U; // of a picture in a page; a larger one would make it slow to open

struct Quantity {
    const char* key;
    const char* place;
    const char* title;
    double unit = 1; // what is shown is the value divided by it
};

constexpr double kMebi = 1 << 20;
constexpr std::array kAcross = {
    Quantity{"ms", "/ms/median", "milliseconds on the device, median, without clears"},
    Quantity{"gross", "/ms_gross/median", "milliseconds with clears"}, Quantity{"targets", "/target_bytes", "MiB of targets", kMebi},
    Quantity{"fetches", "/counts/fetches", "million look-ups", 1e6}, Quantity{"read", "/counts/bytes_read", "MiB read", kMebi}};
constexpr std::array kUp = {Quantity{"rel_l2", "/error/rel_l2", "relative L2 error"},
                            Quantity{"p99", "/error/p99", "99th percentile of the error"},
                            Quantity{"max_interior", "/error/max_interior", "largest error"}, Quantity{"flip", "/error/flip", "FLIP"},
                            Quantity{"own", "/own_error/rel_l2", "relative L2 against its own definition"}};

std::string integerAt(const Json& row, const char* place) {
    const auto value = numberAt(row, place);
    return value ? fmt::format("{:.0f}", *value) : std::string();
}

std::string sizeOf(const Json& row) {
    return integerAt(row, "/resolution/0") + " x " + integerAt(row, "/resolution/1");
}

std::string mapsOf(const Json& row) {
    const std::string maps = integerAt(row, "/map_size");
    const std::string shadow = integerAt(row, "/shadow_size");
    return maps == shadow ? maps : maps + ", shadow " + shadow;
}

std::string nameOf(const Json& row) {
    return fmt::format("{} {}, {}, {}, maps {}", textAt(row, "/technique"), textAt(row, "/setting"), textAt(row, "/scene"), sizeOf(row),
                       mapsOf(row));
}

Json pointOf(const Json& row) {
    Json values = Json::object();
    const auto add = [&](const Quantity& quantity) {
        if (const auto value = numberAt(row, quantity.place)) values[quantity.key] = *value / quantity.unit;
    };
    std::ranges::for_each(kAcross, add);
    std::ranges::for_each(kUp, add);
    return {{"name", textAt(row, "/technique")},
            {"group", textAt(row, "/source")},
            {"mark", textAt(row, "/setting")},
            {"facets",
             {{"scene", textAt(row, "/scene") + ", " + sizeOf(row)},
              {"maps", mapsOf(row)},
              {"setting", textAt(row, "/setting")},
              {"device", textAt(row, "/device")}}},
            {"values", std::move(values)},
            {"ranges", {{"ms", {valueAt(row, "/ms/p5"), valueAt(row, "/ms/p95")}}}},
            {"details",
             {fmt::format("{:.1f} MiB of targets", numberAt(row, "/target_bytes").value_or(0) / kMebi),
              fmt::format("bias {:+.4f}", numberAt(row, "/error/bias").value_or(0))}}};
}

/// Only what some row has.
template <std::size_t N>
Json axes(const std::array<Quantity, N>& quantities, const Json& points) {
    Json list = Json::array();
    for (const Quantity& quantity : quantities)
        if (std::ranges::any_of(points, [&](const Json& point) { return point["values"].contains(quantity.key); }))
            list.push_back({{"key", quantity.key}, {"title", quantity.title}});
    return list;
}

Json scatter(const Json& rows) {
    Json points = Json::array();
    for (const Json& row : rows)
        if (numberAt(row, "/ms/median")) points.push_back(pointOf(row));
    Json section{{"kind", "scatter"},
                 {"title", "Time against error"},
                 {"note",
                  "Down and to the left is better. The grey line joins what nothing beats in both; a bar is the 5th to the 95th percentile "
                  "of the times. Compare techniques on one scene, not scenes."},
                 {"oneOf", {"scene", "device"}},
                 {"axes", {{"x", axes(kAcross, points)}, {"y", axes(kUp, points)}}}};
    section["points"] = std::move(points);
    return section;
}

Json timeline(const Json& rows) {
    Json bars = Json::array();
    for (const Json& row : rows) {
        Json parts = Json::array();
        for (const Json& pass : valueAt(row, "/passes"))
            parts.push_back({{"name", textAt(pass, "/name")}, {"value", numberAt(pass, "/ms").value_or(0)}});
        if (!parts.empty()) bars.push_back({{"name", nameOf(row)}, {"parts", std::move(parts)}});
    }
    return {{"kind", "timeline"},
            {"title", "Where the time goes"},
            {"note", "Medians of each pass, in their order; passes of one name together. Open a row for its figures."},
            {"unit", "ms"},
            {"rows", std::move(bars)}};
}

Json figures(const Json& rows) {
    Json cells = Json::array();
    for (const Json& row : rows) {
        if (!numberAt(row, "/ms/median")) continue;
        const auto targets = numberAt(row, "/target_bytes");
        cells.push_back({textAt(row, "/technique"), textAt(row, "/setting"), textAt(row, "/scene"), mapsOf(row), valueAt(row, "/ms/median"),
                         valueAt(row, "/ms_gross/median"), valueAt(row, "/ms/p95"), targets ? Json(*targets / kMebi) : Json(nullptr),
                         valueAt(row, "/error/rel_l2"), valueAt(row, "/error/p99"), valueAt(row, "/error/max_interior"),
                         valueAt(row, "/error/bias"), valueAt(row, "/error/psnr"), valueAt(row, "/error/flip"),
                         valueAt(row, "/own_error/rel_l2")});
    }
    return report::table("Figures", "Errors are to light by brute force, relative to its mean; docs/bench.md explains every column.",
                         {{"technique"},
                          {"setting"},
                          {"scene"},
                          {"maps"},
                          {"ms", "number", "median, without clears"},
                          {"gross", "number", "with clears"},
                          {"p95", "number", "95th percentile of the milliseconds"},
                          {"MiB", "number", "render targets"},
                          {"rel L2", "number"},
                          {"p99", "number"},
                          {"max", "number", "the largest error"},
                          {"bias", "number", "energy gained or lost"},
                          {"PSNR", "number", "dB"},
                          {"FLIP", "number"},
                          {"own", "number", "relative L2 against what the technique itself claims"}},
                         std::move(cells));
}

Json failures(const Json& rows) {
    Json cells = Json::array();
    for (const Json& row : rows)
        if (const std::string failure = textAt(row, "/failure"); !failure.empty()) cells.push_back({"failed", nameOf(row), failure});
    return report::table("What could not be drawn", {}, {{"", "verdict"}, {"what"}, {"why"}}, std::move(cells));
}

/// |picture - truth| over the truth's mean, where it is known: elsewhere both are black.
Image differenceOf(const Image& picture, const Image& truth) {
    double sum = 0;
    std::size_t known = 0;
    for (const float value : truth.pixels) {
        sum += value;
        known += value != 0;
    }
    const double mean = known > 0 && sum > 0 ? sum / static_cast<double>(known) : 1;
    Image difference = truth;
    for (std::size_t i = 0; i < difference.pixels.size() && i < picture.pixels.size(); ++i)
        difference.pixels[i] = static_cast<float>(std::abs(static_cast<double>(picture.pixels[i]) - truth.pixels[i]) / mean);
    return difference;
}

std::string pictureName(const Json& row) {
    std::string name = textAt(row, "/technique") + "-" + textAt(row, "/setting");
    std::ranges::replace(name, ' ', '_');
    return name;
}

/// Null where the picture or its truth is not there, is not whole, or is too large.
Json subjectOf(const Json& row, const std::filesystem::path& folder) {
    if (textAt(row, "/reference/kind") != "brute force, every pixel") return nullptr;
    const std::string stem = fmt::format("{}-{}-", textAt(row, "/scene"), integerAt(row, "/map_size"));
    const auto truth = loadImage(folder / (stem + "truth.exr"));
    const auto picture = loadImage(folder / (stem + pictureName(row) + ".exr"));
    if (!truth || !picture || truth->pixels.size() != picture->pixels.size()) return nullptr;
    if (static_cast<std::size_t>(truth->width) * static_cast<std::size_t>(truth->height) > kMostPixels) return nullptr;
    const Image difference = differenceOf(*picture, *truth);
    return {{"name", textAt(row, "/technique") + " " + textAt(row, "/setting")},
            {"group", textAt(row, "/scene") + ", maps " + mapsOf(row)},
            {"worst", std::ranges::max(difference.pixels)},
            {"levels", {{"scale", {1, 1, 1, 1}}, {"offset", {0, 0, 0, 0}}, {"channel", 0}, {"toneMap", true}, {"encode", true}}},
            {"rendered", report::plane(*picture)},
            {"reference", report::plane(*truth)},
            {"difference", report::plane(difference)}};
}

Json pictures(const Json& rows, const std::filesystem::path& folder) {
    Json subjects = Json::array();
    for (const Json& row : rows)
        if (Json subject = subjectOf(row, folder); !subject.is_null()) subjects.push_back(std::move(subject));
    return {{"kind", "pictures"},
            {"title", "Picture, truth, difference"},
            {"note",
             "All three under one slider; what has no reference is black. A difference is |a - b| over the truth's mean, on a logarithmic "
             "scale. The number behind a name is its largest."},
            {"subjects", std::move(subjects)}};
}

std::string nearest(const Json& rows) {
    const Json* best = nullptr;
    for (const Json& row : rows)
        if (const auto error = numberAt(row, "/error/rel_l2"); error && (!best || *error < *numberAt(*best, "/error/rel_l2"))) best = &row;
    if (!best) return "nothing could be drawn";
    return fmt::format("{} rows; nearest to the truth: {} {} on {}, relative L2 {:.4f} in {:.3f} ms", rows.size(),
                       textAt(*best, "/technique"), textAt(*best, "/setting"), textAt(*best, "/scene"), *numberAt(*best, "/error/rel_l2"),
                       numberAt(*best, "/ms/median").value_or(0));
}

} // namespace

std::vector<report::Figure> benchFigures(const Json& rows) {
    std::vector<report::Figure> figures;
    if (!rows.is_array()) return figures;
    for (const Json& row : rows) {
        if (textAt(row, "/technique").empty()) continue;
        const std::string subject = nameOf(row);
        const auto add = [&](const std::string& name, const char* place, double noise = 0) {
            if (const auto value = numberAt(row, place))
                figures.push_back({.subject = subject, .name = name, .value = *value, .noise = noise});
        };
        add("ms on " + textAt(row, "/device"), "/ms/median", numberAt(row, "/ms/noise").value_or(0));
        add("relative L2", "/error/rel_l2");
        add("p99", "/error/p99");
        add("FLIP", "/error/flip");
        add("bytes of targets", "/target_bytes");
    }
    return figures;
}

report::Page benchPage(const Json& rows, const std::filesystem::path& folder) {
    report::Page page{.title = "tegument bench", .summary = nearest(rows), .sections = {scatter(rows), timeline(rows)}};
    if (!rows.empty()) {
        const Json& first = rows.front();
        for (const auto& [name, place] : {std::pair{"device", "/device"},
                                          {"driver", "/driver"},
                                          {"compiler", "/compiler"},
                                          {"date", "/date"},
                                          {"version", "/version"},
                                          {"reference", "/reference/kind"}})
            page.facts.emplace_back(name, textAt(first, place));
        if (valueAt(first, "/cpu") == Json(true)) page.facts.emplace_back("times", "of a software device: good as ratios only");
    }
    Json shown = folder.empty() ? Json() : pictures(rows, folder);
    if (!shown.is_null() && !shown["subjects"].empty()) page.sections.push_back(std::move(shown));
    page.sections.push_back(figures(rows));
    Json failed = failures(rows);
    if (!failed["rows"].empty()) page.sections.push_back(std::move(failed));
    return page;
}

std::vector<report::Figure> stabilityFigures(const Json& run) {
    std::vector<report::Figure> figures;
    for (const Json& row : valueAt(run, "/rows")) {
        if (textAt(row, "/figure").empty()) continue;
        const std::string subject = textAt(row, "/module") + ", " + textAt(row, "/case");
        if (const auto value = numberAt(row, "/value"))
            figures.push_back({.subject = subject,
                               .name = textAt(row, "/figure"),
                               .value = std::abs(*value),
                               .noise = numberAt(row, "/limit").value_or(0) / 200}); // both runs' together: a hundredth of the limit
        figures.push_back(
            {.subject = subject, .name = textAt(row, "/figure") + ", not finite", .value = numberAt(row, "/not_finite").value_or(0)});
    }
    return figures;
}

report::Page stabilityPage(const Json& run) {
    Json cells = Json::array();
    std::size_t passed = 0;
    for (const Json& row : valueAt(run, "/rows")) {
        const auto value = numberAt(row, "/value");
        const auto limit = numberAt(row, "/limit");
        const bool pass = valueAt(row, "/pass") == Json(true);
        passed += pass ? 1U : 0U;
        const Json share = value && limit && *limit > 0 ? Json(std::abs(*value) / *limit) : Json(nullptr);
        cells.push_back({pass ? "pass" : "fail", textAt(row, "/part"), textAt(row, "/module"), textAt(row, "/case"), textAt(row, "/figure"),
                         valueAt(row, "/value"), valueAt(row, "/limit"), share, valueAt(row, "/not_finite"), textAt(row, "/cause"),
                         textAt(row, "/why")});
    }
    const std::size_t count = cells.size();
    report::Page page{.title = "tegument bench --stability",
                      .summary = fmt::format("{} of {} figures of hard cases are within their limits", passed, count),
                      .verdict = passed == count ? "pass" : "fail",
                      .facts = {{"device", textAt(run, "/device")}, {"driver", textAt(run, "/driver")}, {"maps", integerAt(run, "/size")}}};
    page.sections.push_back(report::table(
        "Hard cases", "What each module draws where it is most likely to break. A figure without a limit is reported, not judged.",
        {{"", "verdict"},
         {"part"},
         {"module"},
         {"hard case"},
         {"figure"},
         {"value", "number"},
         {"limit", "number"},
         {"share", "share", "of the limit"},
         {"not finite", "number"},
         {"caused by"},
         {"where the limit comes from"}},
        std::move(cells)));
    if (const Json said = valueAt(run, "/notes"); said.is_array() && !said.empty())
        page.sections.push_back(report::notes("Not measured", said.get<std::vector<std::string>>()));
    return page;
}

} // namespace tegument::app
