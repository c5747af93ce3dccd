#include "host/lab/app/verify_page.h"

#include "host/support/file.h"
#include "host/support/text.h"
#include "host/view/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 66em; padding: 0 1em; color: #1a1a1a; background: #fff; }
h1 { margin-bottom: 0.2em; } h2 { margin: 2.2em 0 0.3em; border-top: 1px solid #ccc; padding-top: 1em; }
table { border-collapse: collapse; margin: 0.8em 0; } th, td { text-align: left; padding: 0.2em 0.9em 0.2em 0; vertical-align: top; }
th { border-bottom: 1px solid #999; font-weight: 600; } td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
.pass { color: #11692c; font-weight: 600; } .fail { color: #b3140f; font-weight: 600; } .quiet { color: #555; }
.pictures { display: flex; gap: 0.8em; flex-wrap: wrap; margin: 0.4em 0 1.2em; }
figure { margin: 0; } figcaption { font-size: 13px; color: #555; } img { width: 256px; image-rendering: pixelated; background: #000; display: block; }
.scale { width: 256px; height: 12px; } .ends { display: flex; justify-content: space-between; width: 256px; font-size: 12px; color: #555; }
pre { background: #f4f4f4; padding: 0.8em; white-space: pre-wrap; }
)";

/// Errors from a millionth of the reference's mean (black) to all of it (white); steps of the colours of plasma, which are evenly bright.
constexpr double kLowest = -6; // powers of ten
constexpr std::array<std::array<float, 3>, 6> kRamp = {
    {{0, 0, 0}, {0.30F, 0.02F, 0.63F}, {0.66F, 0.14F, 0.57F}, {0.92F, 0.41F, 0.34F}, {0.99F, 0.71F, 0.17F}, {1, 1, 0.85F}}};

std::array<float, 3> rampColor(double error) {
    if (!std::isfinite(error)) return {0, 1, 0};
    const double level = error > 0 ? std::clamp(1 - std::log10(error) / kLowest, 0.0, 1.0) : 0.0;
    const double place = level * static_cast<double>(kRamp.size() - 1);
    const auto step = std::min(static_cast<std::size_t>(place), kRamp.size() - 2);
    const auto share = static_cast<float>(place - static_cast<double>(step));
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = kRamp[step][c] + share * (kRamp[step + 1][c] - kRamp[step][c]);
    return color;
}

std::string rampGradient() {
    std::string stops;
    for (const auto& color : kRamp)
        stops += fmt::format("{}rgb({:.0f} {:.0f} {:.0f})", stops.empty() ? "" : ", ", 255 * color[0], 255 * color[1], 255 * color[2]);
    return "linear-gradient(to right, " + stops + ")";
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '<') {
            result += "&lt;";
        } else if (c == '>') {
            result += "&gt;";
        } else if (c == '&') {
            result += "&amp;";
        } else if (c == '"') {
            result += "&quot;";
        } else {
            result += c;
        }
    }
    return result;
}

std::size_t pixelCount(const Image& image) {
    return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

double pixelError(const Image& difference, std::size_t pixel) {
    const auto channels = static_cast<std::size_t>(difference.channels);
    double largest = 0;
    for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c)
        largest = std::max(largest, std::abs(static_cast<double>(difference.pixels[pixel * channels + c])));
    return largest;
}

Image rampImage(const Image& difference) {
    Image picture{.width = difference.width, .height = difference.height, .channels = 3, .pixels = {}, .metadata = {}};
    picture.pixels.reserve(3 * pixelCount(difference));
    for (std::size_t pixel = 0; pixel < pixelCount(difference); ++pixel) {
        const auto color = rampColor(pixelError(difference, pixel));
        picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
    }
    return picture;
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

std::string values(const Image& image, std::size_t pixel) {
    std::string text;
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t c = 0; c < channels; ++c)
        text += fmt::format("{}{:.6g}", c == 0 ? "" : ", ", image.pixels[pixel * channels + c]);
    return text;
}

std::string worstPixel(const Subject& subject) {
    if (!subject.difference || !subject.rendered || !subject.reference || pixelCount(*subject.difference) == 0) return {};
    std::size_t worst = 0;
    for (std::size_t pixel = 1; pixel < pixelCount(*subject.difference); ++pixel)
        if (!(pixelError(*subject.difference, pixel) <= pixelError(*subject.difference, worst))) worst = pixel;
    const auto width = static_cast<std::size_t>(subject.difference->width);
    const auto height = static_cast<std::size_t>(subject.difference->height);
    const std::size_t x = worst % width;
    const std::size_t y = worst / width;
    return fmt::format("Worst pixel: ({}, {}), uv ({:.4f}, {:.4f}): {:.3g} of the mean. Rendered {}; reference {}.", x, y,
                       (static_cast<double>(x) + 0.5) / static_cast<double>(width),
                       (static_cast<double>(y) + 0.5) / static_cast<double>(height), pixelError(*subject.difference, worst),
                       values(*subject.rendered, worst), values(*subject.reference, worst));
}

std::string fileName(const VerifiedModule& module, const std::string& subject, const char* role) {
    std::string name = fmt::format("{}-{}-{}-{}", module.module, module.setting, subject, role);
    std::ranges::replace_if(
        name, [](char c) { return !(std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.'); }, '_');
    return name + ".png";
}

/// Writes one picture and returns its figure.
Result<std::string> figure(const fs::path& folder, const std::string& name, const Image& picture, const std::string& caption) {
    if (const auto written = writePng(folder / name, picture, PngEncoding::Raw); !written) return written.error();
    return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", escaped(name), escaped(caption),
                       escaped(caption));
}

Result<std::string> subjectHtml(const fs::path& folder, const VerifiedModule& module, const Subject& subject) {
    std::string html = fmt::format("<h3>{}</h3>\n<div class=\"pictures\">\n", escaped(subject.name));
    const Image* measure = subject.reference ? subject.reference : subject.rendered;
    const view::Levels levels = measure ? view::levelsOf(*measure) : view::Levels{};
    for (const auto& [image, role] : {std::pair{subject.rendered, "rendered"}, std::pair{subject.reference, "reference"}}) {
        if (!image) continue;
        auto shown = figure(folder, fileName(module, subject.name, role), view::applyLevels(*image, levels), role);
        if (!shown) return shown;
        html += *shown;
    }
    if (subject.difference) {
        auto shown = figure(folder, fileName(module, subject.name, "difference"), rampImage(*subject.difference), "difference");
        if (!shown) return shown;
        html += *shown;
    }
    return html + "</div>\n<p class=\"quiet\">" + escaped(worstPixel(subject)) + "</p>\n";
}

std::string verdict(bool pass) {
    return pass ? "<span class=\"pass\">pass</span>" : "<span class=\"fail\">FAIL</span>";
}

std::string metricRows(const ModuleReport& report) {
    std::string rows = "<table><tr><th>figure</th><th>value</th><th>limit</th><th></th><th>where the limit comes from</th></tr>\n";
    for (const Metric& metric : report.metrics)
        rows += fmt::format("<tr><td>{}</td><td class=\"number\">{:.3g}</td><td class=\"number\">{:.3g}</td><td>{}</td><td>{}</td></tr>\n",
                            escaped(metric.name), metric.value, metric.limit, verdict(metric.pass), escaped(metric.why));
    return rows + "</table>\n";
}

std::string anchor(const VerifiedModule& module) {
    return module.module + "-" + module.setting;
}

Result<std::string> moduleHtml(const fs::path& folder, const VerifiedModule& module) {
    std::string html = fmt::format("<h2 id=\"{}\">{} [{}] {}</h2>\n", escaped(anchor(module)), escaped(module.module),
                                   escaped(module.setting), verdict(module.pass()));
    if (module.error) return html + "<pre>" + escaped(format(*module.error)) + "</pre>\n";
    html += fmt::format("<p>{}</p>\n", escaped(module.report.summary)) + metricRows(module.report);
    for (const std::string& note : module.report.notes)
        html += fmt::format("<p class=\"quiet\">{}</p>\n", escaped(note));
    for (const Subject& subject : subjectsOf(module.report)) {
        auto shown = subjectHtml(folder, module, subject);
        if (!shown) return shown;
        html += *shown;
    }
    return html;
}

/// The metric nearest to its limit, or farthest beyond.
const Metric* tightest(const ModuleReport& report) {
    const auto strain = [](const Metric& metric) {
        const double share = std::abs(metric.value) / std::max(metric.limit, 1e-300);
        return std::isfinite(share) ? share : INFINITY;
    };
    const auto found = std::ranges::max_element(report.metrics, {}, strain);
    return found == report.metrics.end() ? nullptr : &*found;
}

std::string overview(const std::vector<VerifiedModule>& modules) {
    std::string rows =
        "<table><tr><th>module</th><th>setting</th><th></th><th>nearest to its limit</th><th>value</th><th>limit</th></tr>\n";
    for (const VerifiedModule& module : modules) {
        rows += fmt::format("<tr><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}</td>", escaped(anchor(module)), escaped(module.module),
                            escaped(module.setting), verdict(module.pass()));
        const Metric* metric = tightest(module.report);
        rows += metric ? fmt::format("<td>{}</td><td class=\"number\">{:.3g}</td><td class=\"number\">{:.3g}</td></tr>\n",
                                     escaped(metric->name), metric->value, metric->limit)
                       : "<td>did not run</td><td></td><td></td></tr>\n";
    }
    return rows + "</table>\n";
}

std::string opening(const PageHeader& header, const std::vector<VerifiedModule>& modules) {
    const auto passed = std::ranges::count_if(modules, &VerifiedModule::pass);
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>tegument verify</title><style>{}</style></head><body>\n"
        "<h1>Every module against its reference</h1>\n<p>{} of {} pass. {} ({}), {}, map size {}, {}.</p>\n"
        "<p class=\"quiet\">References are computed in double precision by code that shares nothing with the shaders. Rendered and "
        "reference pictures of one row are shown with the same levels. Differences are |a - b| / mean(b) on a logarithmic scale:</p>\n"
        "<div class=\"scale\" style=\"background: {}\"></div><div class=\"ends\"><span>1e-6</span><span>1e-3</span><span>1</span></div>\n",
        kStyle, passed, modules.size(), escaped(header.device), escaped(header.driver), escaped(header.compiler), header.mapSize,
        escaped(header.mesh), rampGradient());
}

} // namespace

Result<fs::path> writePage(const fs::path& folder, const PageHeader& header, const std::vector<VerifiedModule>& modules) {
    std::string html = opening(header, modules) + overview(modules);
    for (const VerifiedModule& module : modules) {
        auto shown = moduleHtml(folder, module);
        if (!shown) return shown.error();
        html += *shown;
    }
    const fs::path page = folder / "index.html";
    if (const auto written = writeFile(page, html + "</body></html>\n"); !written) return written.error();
    return page;
}

} // namespace tegument::app
