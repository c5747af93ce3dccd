// The stability report as JSON, and back for its tables.

#include "lab/stability/stability.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace tegument::bench {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const StabilityRow& row) {
    Json json{{"part", row.part}, {"module", row.module}, {"case", row.hardCase}, {"figure", row.figure}};
    json["value"] = std::isfinite(row.value) ? Json(row.value) : Json(nullptr);
    json["limit"] = row.limit ? Json(*row.limit) : Json(nullptr);
    json["not_finite"] = row.notFinite;
    json["pass"] = row.pass();
    json["cause"] = row.cause;
    json["why"] = row.why;
    return json;
}

StabilityRow rowFrom(const Json& json) {
    StabilityRow row{.part = json.at("part"),
                     .module = json.at("module"),
                     .hardCase = json.at("case"),
                     .figure = json.at("figure"),
                     .value = std::numeric_limits<double>::quiet_NaN(),
                     .cause = json.at("cause"),
                     .notFinite = json.at("not_finite"),
                     .why = json.at("why")};
    if (!json.at("value").is_null()) row.value = json.at("value");
    if (!json.at("limit").is_null()) row.limit = json.at("limit").get<double>();
    return row;
}

} // namespace

std::string stabilityJson(const StabilityReport& report) {
    Json json{{"device", report.device}, {"driver", report.driver}, {"compiler", report.compiler}, {"size", report.size},
              {"pass", report.pass()},   {"rows", Json::array()},   {"notes", report.notes}};
    for (const StabilityRow& row : report.rows)
        json["rows"].push_back(toJson(row));
    return json.dump(2) + "\n";
}

std::optional<StabilityReport> stabilityFromJson(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        StabilityReport report{.device = json.at("device"),
                               .driver = json.at("driver"),
                               .compiler = json.at("compiler"),
                               .size = json.at("size"),
                               .rows = {},
                               .notes = json.at("notes")};
        for (const Json& row : json.at("rows"))
            report.rows.push_back(rowFrom(row));
        return report;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

} // namespace tegument::bench
