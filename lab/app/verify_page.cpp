#include "lab/app/verify_page.h"

#include "tools/report/plane.h"
#include "tools/view/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tegument::app {

namespace {

/// Of a figure's limit: between two runs on one machine nothing moves by so little, and nothing is lost by it.
constexpr double kNoiseOfLimit = 0.01;

Json numberOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double strain(const Metric& metric) {
    const double share = std::abs(metric.value) / std::max(metric.limit, 1e-300);
    return std::isfinite(share) ? share : std::numeric_limits<double>::infinity();
}

const char* verdictOf(bool pass) {
    return pass ? "pass" : "fail";
}

/// The metric nearest to its limit, or farthest beyond.
const Metric* tightest(const ModuleReport& report) {
    const auto found = std::ranges::max_element(report.metrics, {}, strain);
    return found == report.metrics.end() ? nullptr : &*found;
}

Json moduleRow(const VerifiedModule& module) {
    const Metric* metric = tightest(module.report);
    if (!metric) return {verdictOf(module.pass()), module.module, module.setting, "did not run", nullptr, module.report.summary};
    return {verdictOf(module.pass()), module.module, module.setting, metric->name, numberOrNull(strain(*metric)), module.report.summary};
}

Json overview(const std::vector<VerifiedModule>& modules) {
    Json rows = Json::array();
    for (const VerifiedModule& module : modules)
        rows.push_back(moduleRow(module));
    return report::table(
        "Modules",
        "Each module is drawn alone and compared with a reference in double precision, by code that shares nothing with the "
        "shaders. Share: of the limit, by the figure that comes nearest to it; the bar's left end is a thousandth.",
        {{"", "verdict"}, {"module"}, {"setting"}, {"nearest to its limit"}, {"share", "share"}, {"what is compared"}}, std::move(rows));
}

Json figures(const std::vector<VerifiedModule>& modules) {
    Json rows = Json::array();
    for (const VerifiedModule& module : modules)
        for (const Metric& metric : module.report.metrics)
            rows.push_back({verdictOf(metric.pass), module.module, module.setting, metric.name, numberOrNull(metric.value), metric.limit,
                            numberOrNull(strain(metric)), metric.why});
    return report::table("Figures", "Relative figures are to the reference's mean over the pixels that count.",
                         {{"", "verdict"},
                          {"module"},
                          {"setting"},
                          {"figure"},
                          {"value", "number"},
                          {"limit", "number"},
                          {"share", "share", "of the limit"},
                          {"where the limit comes from"}},
                         std::move(rows));
}

struct Subject {
    std::string name;
    const Image* rendered = nullptr;
    const Image* reference = nullptr;
    const Image* difference = nullptr;
};

std::vector<Subject> subjectsOf(const ModuleReport& report) {
    std::vector<Subject> subjects;
    for (const VerifyPicture& picture : report.pictures) {
        auto found = std::ranges::find(subjects, picture.subject, &Subject::name);
        if (found == subjects.end()) found = subjects.insert(subjects.end(), Subject{.name = picture.subject});
        if (picture.role == PictureRole::Rendered) found->rendered = &picture.image;
        if (picture.role == PictureRole::Reference) found->reference = &picture.image;
        if (picture.role == PictureRole::Difference) found->difference = &picture.image;
    }
    return subjects;
}

Json levelsJson(const view::Levels& levels) {
    return {{"scale", levels.scale},
            {"offset", levels.offset},
            {"channel", levels.channel},
            {"toneMap", levels.toneMap},
            {"encode", levels.encode}};
}

Json subjectJson(const VerifiedModule& module, const Subject& subject) {
    Json json{{"name", subject.name},
              {"group", fmt::format("{} [{}]", module.module, module.setting)},
              {"levels", levelsJson(view::levelsOf(subject.reference ? *subject.reference : *subject.rendered))},
              {"rendered", report::plane(*subject.rendered)}};
    if (subject.reference) json["reference"] = report::plane(*subject.reference);
    if (!subject.difference) return json;
    json["difference"] = report::plane(*subject.difference);
    double worst = 0;
    for (const float value : subject.difference->pixels)
        worst = std::max(worst, std::abs(static_cast<double>(value)));
    json["worst"] = worst;
    return json;
}

Json pictures(const std::vector<VerifiedModule>& modules) {
    Json subjects = Json::array();
    for (const VerifiedModule& module : modules)
        for (const Subject& subject : subjectsOf(module.report))
            if (subject.rendered) subjects.push_back(subjectJson(module, subject));
    return {{"kind", "pictures"},
            {"title", "Picture, reference, difference"},
            {"note",
             "All three under one slider. Picture and reference are shown with the same levels; a difference is |a - b| over the "
             "reference's mean, on a logarithmic scale, and 0 where a pixel does not count. The number behind a name is its largest."},
            {"subjects", std::move(subjects)}};
}

Json remarks(const std::vector<VerifiedModule>& modules) {
    Json rows = Json::array();
    for (const VerifiedModule& module : modules) {
        for (const std::string& note : module.report.notes)
            rows.push_back({"note", module.module, module.setting, note});
        for (const Diagnostic& warning : module.report.warnings)
            rows.push_back({"warning", module.module, module.setting, format(warning)});
        if (module.error)
            for (const Diagnostic& diagnostic : module.error->diagnostics)
                rows.push_back({"error", module.module, module.setting, format(diagnostic)});
    }
    return report::table("Notes and diagnostics", "Pixels treated apart, their share and why; what kept a module from running.",
                         {{"severity", "verdict"}, {"module"}, {"setting"}, {"what"}}, std::move(rows));
}

} // namespace

Json metricsJson(const std::vector<VerifiedModule>& modules) {
    Json list = Json::array();
    for (const VerifiedModule& module : modules) {
        for (const Metric& metric : module.report.metrics)
            list.push_back({{"module", module.module},
                            {"setting", module.setting},
                            {"metric", metric.name},
                            {"value", metric.value},
                            {"limit", metric.limit},
                            {"pass", metric.pass}});
        if (module.error)
            list.push_back({{"module", module.module},
                            {"setting", module.setting},
                            {"metric", "runs"},
                            {"value", nullptr},
                            {"limit", nullptr},
                            {"pass", false},
                            {"diagnostics", toJson(module.error->diagnostics)}});
    }
    return list;
}

std::vector<report::Figure> verifyFigures(const Json& metrics) {
    std::vector<report::Figure> figures;
    if (!metrics.is_array()) return figures;
    for (const Json& metric : metrics) {
        const std::string module = textAt(metric, "/module");
        const auto limit = numberAt(metric, "/limit");
        if (module.empty() || !limit) continue; // of a module that did not run no figure is known
        const auto value = numberAt(metric, "/value");
        figures.push_back({.subject = fmt::format("{} [{}]", module, textAt(metric, "/setting")),
                           .name = textAt(metric, "/metric"),
                           .value = value ? std::abs(*value) : std::numeric_limits<double>::quiet_NaN(),
                           .noise = kNoiseOfLimit / 2 * *limit});
    }
    return figures;
}

report::Page verifyPage(const PageHeader& header, const std::vector<VerifiedModule>& modules) {
    const auto passed = static_cast<std::size_t>(std::ranges::count_if(modules, &VerifiedModule::pass));
    return {.title = "tegument verify",
            .summary = fmt::format("{} of {} modules are within their limits", passed, modules.size()),
            .verdict = verdictOf(passed == modules.size()),
            .facts = {{"device", header.device},
                      {"driver", header.driver},
                      {"compiler", header.compiler},
                      {"maps", fmt::format("{0} x {0}", header.mapSize)},
                      {"mesh", header.mesh}},
            .sections = {overview(modules), pictures(modules), figures(modules), remarks(modules)}};
}

} // namespace tegument::app
