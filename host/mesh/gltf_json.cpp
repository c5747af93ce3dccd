// Typed access to the JSON of a glTF file.

#include "host/mesh/gltf_json.h"

#include <fmt/format.h>

#include <cmath>

namespace tegument::meshfile {

GltfValue GltfValue::operator[](const char* key) const {
    static const Json kNothing = Json::object();
    return {*source_, has(key) ? (*json_)[key] : kNothing, path_.empty() ? key : path_ + "." + key};
}

GltfValue GltfValue::operator[](std::size_t index) const {
    assert(index < size());
    return {*source_, (*json_)[index], fmt::format("{}[{}]", path_, index)};
}

Result<std::size_t> GltfValue::whole(std::size_t limit) const {
    // exporters write 3.0 for 3
    const double number = json_->is_number() ? json_->get<double>() : -1;
    if (!(number >= 0) || number != std::floor(number)) return wrong("is not a whole number");
    if (number >= static_cast<double>(limit)) return wrong(fmt::format("is {}, but must be below {}", number, limit));
    return static_cast<std::size_t>(number);
}

Result<std::size_t> GltfValue::whole(const char* key, std::size_t limit, std::optional<std::size_t> absent) const {
    if (has(key)) return (*this)[key].whole(limit);
    if (absent) return *absent;
    return wrong(fmt::format("has no '{}'", key));
}

Result<std::vector<double>> GltfValue::numbers(const char* key, std::size_t count, std::vector<double> absent) const {
    if (!has(key)) return absent;
    const GltfValue list = (*this)[key];
    std::vector<double> values;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (const Json& item = list.json()[i]; item.is_number() && std::isfinite(item.get<double>())) values.push_back(item.get<double>());
    if (values.size() != count || list.size() != count) return list.wrong(fmt::format("is not a list of {} numbers", count));
    return values;
}

std::string GltfValue::text(const char* key) const {
    if (!has(key) || !(*json_)[key].is_string()) return {};
    return (*json_)[key].get<std::string>();
}

} // namespace tegument::meshfile
