#include "tools/report/report.h"

#include "generated/report_assets.h"
#include "host/support/file.h"

#include <fmt/format.h>

namespace tegument::report {

namespace {

/// No request leaves the page, whatever stands in its data.
constexpr const char* kPolicy = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        if (letter == '<') {
            result += "&lt;";
        } else if (letter == '&') {
            result += "&amp;";
        } else {
            result += letter;
        }
    }
    return result;
}

/// JSON within a script element: "<" stands in strings alone, and would end the element as "</script".
std::string embedded(const Json& json) {
    std::string result;
    for (const char letter : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
        if (letter == '<')
            result += "\\u003c";
        else
            result += letter;
    }
    return result;
}

Json dataOf(const Page& page) {
    Json data{
        {"title", page.title}, {"summary", page.summary}, {"verdict", page.verdict}, {"facts", Json::array()}, {"sections", page.sections}};
    for (const auto& [name, value] : page.facts)
        data["facts"].push_back(Json::array({name, value}));
    return data;
}

} // namespace

Json table(const std::string& title, const std::string& note, const std::vector<Column>& columns, Json rows) {
    Json section{{"kind", "table"}, {"title", title}, {"note", note}, {"columns", Json::array()}, {"rows", std::move(rows)}};
    for (const Column& column : columns)
        section["columns"].push_back({{"title", column.title}, {"kind", column.kind}, {"help", column.help}});
    return section;
}

Json notes(const std::string& title, const std::vector<std::string>& paragraphs) {
    return {{"kind", "notes"}, {"title", title}, {"paragraphs", paragraphs}};
}

std::string html(const Page& page) {
    return fmt::format("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>\n{}</style>\n"
                       "</head>\n<body>\n<noscript>This report is drawn by a script of its own; switch scripts on to see it.</noscript>\n"
                       "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n\"use "
                       "strict\";\n{}{}{}{}show();\n</script>\n</body>\n</html>\n",
                       kPolicy, escaped(page.title), k_page_css, embedded(dataOf(page)), k_planes_js, k_page_js, k_charts_js,
                       k_pictures_js);
}

Result<void> write(const std::filesystem::path& path, const Page& page) {
    return writeFile(path, html(page));
}

} // namespace tegument::report
